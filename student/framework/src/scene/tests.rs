//! A scene that can not be used says where, why, and what would do.

use super::Scene;

const CAMERA: &str = r#"{ "vertical_fov": 40, "film": [4, 3],
    "position": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0] }"#;
const BALL: &str = r#"{ "sphere": { "center": [0, 0, 0], "radius": 1, "material": "red" } }"#;

/// A scene with a camera, a material and a shape of which one may be replaced.
fn scene(camera: &str, material: &str, shape: &str) -> String {
    format!(
        "{{\n  \"camera\": {camera},\n  \"materials\": {{ {material} }},\n  \"shapes\": [\n    {shape}\n  ]\n}}"
    )
}

const RED: &str = r#""red": { "lambertian": { "albedo": [0.8, 0.1, 0.1] } }"#;

fn problem(text: &str) -> String {
    let error = Scene::from_text(text).expect_err("it is refused");
    error.to_string()
}

fn with_shape(shape: &str) -> String {
    problem(&scene(CAMERA, RED, shape))
}

fn with_material(material: &str) -> String {
    problem(&scene(CAMERA, material, BALL))
}

fn with_camera(from: &str, to: &str) -> String {
    problem(&scene(&CAMERA.replace(from, to), RED, BALL))
}

#[test]
fn a_scene_is_read() {
    let scene = Scene::from_text(&scene(CAMERA, RED, BALL)).expect("a scene");
    assert_eq!(scene.shapes.len(), 1);
    assert_eq!(scene.camera.pinhole.aspect_ratio, 4.0 / 3.0);
    assert_eq!(scene.max_leaf_size, 4);
}

#[test]
fn reports_the_position_of_an_unknown_key_and_lists_the_known_ones() {
    let shape = BALL.replace("radius", "radus");
    let wanted = "scene:6:46: unknown field `radus`, expected one of `center`, `radius`, `material`\n    \
        6 |     { \"sphere\": { \"center\": [0, 0, 0], \"radus\": 1, \"material\": \"red\" } }\n      \
          |                                              ^";
    assert_eq!(with_shape(&shape), wanted);
    let kind = with_shape(r#"{ "cube": {} }"#);
    assert!(
        kind.contains("unknown variant `cube`, expected one of `sphere`"),
        "{kind}"
    );
}

#[test]
fn a_missing_key_is_named() {
    let told = with_shape(r#"{ "sphere": { "center": [0, 0, 0], "material": "red" } }"#);
    assert!(
        told.starts_with("scene:6:") && told.contains("missing field `radius`"),
        "{told}"
    );
}

#[test]
fn reports_the_position_of_an_invalid_number() {
    let radius = |value: &str| with_shape(&BALL.replace(": 1,", &format!(": {value},")));
    assert!(
        radius("0").contains("scene:6:50: 0 is not a finite number above 0"),
        "{}",
        radius("0")
    );
    assert!(radius("-2").contains("-2 is not a finite number above 0"));
    assert!(
        radius("1e39").contains("is not a finite number above 0"),
        "{}",
        radius("1e39")
    );
    assert!(
        radius("1e999").contains("number out of range"),
        "{}",
        radius("1e999")
    );
    assert!(
        radius("null").contains("invalid type: null"),
        "{}",
        radius("null")
    );
    assert!(radius("NaN").contains("scene:6:"), "{}", radius("NaN"));
    assert!(
        radius("\"one\"").contains("invalid type: string"),
        "{}",
        radius("\"one\"")
    );

    let center = |value: &str| with_shape(&BALL.replace("[0, 0, 0]", value));
    assert!(center("[0, 1e39, 0]").contains("is not three finite numbers"));
    assert!(
        center("[0, 0]").contains("invalid length 2"),
        "{}",
        center("[0, 0]")
    );
}

#[test]
fn rejects_albedos_above_one_and_negative_radiance() {
    let albedo = RED.replace("0.8", "1.5");
    assert!(
        with_material(&albedo).contains("each from 0 to 1"),
        "{}",
        with_material(&albedo)
    );
    let lamp = r#""red": { "emitter": { "radiance": [1, -1, 1] } }"#;
    assert!(
        with_material(lamp).contains("each 0 or more"),
        "{}",
        with_material(lamp)
    );
    let glass = r#""red": { "glass": { "ior": 0 } }"#;
    assert!(with_material(glass).contains("0 is not a finite number above 0"));
}

#[test]
fn reports_the_position_of_an_unknown_material_and_lists_the_known_ones() {
    let shape = BALL.replace("\"red\"", "\"rde\"");
    let told = with_shape(&shape);
    assert!(
        told.starts_with("scene:6:65: no material is called `rde`; there are: red"),
        "{told}"
    );
}

#[test]
fn rejects_a_duplicate_name() {
    let told = with_material(&format!("{RED}, {RED}"));
    assert!(told.contains("the name `red` comes twice"), "{told}");
}

#[test]
fn rejects_a_camera_without_a_view_direction() {
    let at_itself = with_camera("\"look_at\": [0, 0, 0]", "\"look_at\": [0, 0, 5]");
    assert!(
        at_itself.contains("`look_at` is the camera's own `position`"),
        "{at_itself}"
    );
    let along = with_camera("[0, 1, 0]", "[0, 0, 2]");
    assert!(along.contains("`up` is along the view"), "{along}");
    let no_up = with_camera("[0, 1, 0]", "[0, 0, 0]");
    assert!(no_up.contains("`up` is along the view"), "{no_up}");
    let wide = with_camera("40", "180");
    assert!(
        wide.contains("`vertical_fov` is 180: degrees, below 180"),
        "{wide}"
    );
}

#[test]
fn rejects_an_empty_or_oversized_film() {
    assert!(with_camera("[4, 3]", "[0, 3]").contains("a film of 0 x 3 pixels"));
    let told = with_camera("[4, 3]", "[4, 16385]");
    assert!(told.contains("each side must be from 1 to 16384"), "{told}");
    assert!(with_camera("[4, 3]", "[4, -3]").contains("expected u32"));
}

#[test]
fn reports_the_line_of_an_invalid_polygon() {
    let points = r#"{ "polygon": { "points": [[0,0,0], [1,0,0]], "material": "red" } }"#;
    let told = with_shape(points);
    assert!(
        told.starts_with("scene:6:") && told.contains("takes three or more"),
        "{told}"
    );
}

#[test]
fn rejects_an_empty_text() {
    assert!(problem("").contains("is empty"));
    assert!(problem(" \n").contains("is empty"));
}

#[test]
fn reports_the_line_of_truncated_or_invalid_json() {
    assert!(problem("{\n  \"camera\": {").contains("scene:2:"));
    assert!(problem("hello").contains("scene:1:1: expected value"));
}

#[test]
fn rejects_a_mesh_in_a_scene_without_a_folder() {
    let told = with_shape(r#"{ "mesh": { "file": "teapot.obj", "material": "red" } }"#);
    assert!(
        told.starts_with("scene:6:25: a mesh stands in a file of its own"),
        "{told}"
    );
}
