//! Tests of the errors for invalid scenes: their position, reason and remedy.

use super::Scene;

const CAMERA: &str = r#"{ "vertical_fov": 40, "film": [4, 3],
    "position": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0] }"#;
const SPHERE: &str = r#"{ "sphere": { "center": [0, 0, 0], "radius": 1, "material": "red" } }"#;

/// Returns the text of a scene with this camera, material and shape.
fn scene(camera: &str, material: &str, shape: &str) -> String {
    format!(
        "{{\n  \"camera\": {camera},\n  \"materials\": {{ {material} }},\n  \"shapes\": [\n    {shape}\n  ]\n}}"
    )
}

const RED: &str = r#""red": { "lambertian": { "albedo": [0.8, 0.1, 0.1] } }"#;

fn problem(text: &str) -> String {
    let error = Scene::from_text(text).expect_err("the scene is invalid");
    error.to_string()
}

fn with_shape(shape: &str) -> String {
    problem(&scene(CAMERA, RED, shape))
}

fn with_material(material: &str) -> String {
    problem(&scene(CAMERA, material, SPHERE))
}

fn with_camera(from: &str, to: &str) -> String {
    problem(&scene(&CAMERA.replace(from, to), RED, SPHERE))
}

#[test]
fn parses_a_scene() {
    let scene = Scene::from_text(&scene(CAMERA, RED, SPHERE)).expect("the scene is valid");
    assert_eq!(scene.shapes.len(), 1);
    assert_eq!(scene.camera.pinhole.aspect_ratio, 4.0 / 3.0);
    assert_eq!(scene.max_leaf_size, 4);
}

#[test]
fn reports_the_position_of_an_unknown_key_and_lists_the_known_ones() {
    let shape = SPHERE.replace("radius", "radus");
    let expected = "scene:6:46: unknown key `radus`, expected one of `center`, `radius`, `material`\n    \
        6 |     { \"sphere\": { \"center\": [0, 0, 0], \"radus\": 1, \"material\": \"red\" } }\n      \
          |                                              ^";
    assert_eq!(with_shape(&shape), expected);
    let kind = with_shape(r#"{ "cube": {} }"#);
    assert!(
        kind.contains("unknown kind `cube`, expected one of `sphere`"),
        "{kind}"
    );
}

#[test]
fn reports_the_name_of_a_missing_key() {
    let message = with_shape(r#"{ "sphere": { "center": [0, 0, 0], "material": "red" } }"#);
    assert!(
        message.starts_with("scene:6:") && message.contains("missing key `radius`"),
        "{message}"
    );
}

#[test]
fn reports_the_position_of_an_invalid_number() {
    let radius = |value: &str| with_shape(&SPHERE.replace(": 1,", &format!(": {value},")));
    assert!(
        radius("0").contains("scene:6:50: expected a finite number above 0, got 0"),
        "{}",
        radius("0")
    );
    assert!(radius("-2").contains("expected a finite number above 0, got -2"));
    assert!(
        radius("1e39").contains("expected a finite number above 0"),
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

    let center = |value: &str| with_shape(&SPHERE.replace("[0, 0, 0]", value));
    assert!(center("[0, 1e39, 0]").contains("expected three finite numbers"));
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
    let emitter = r#""red": { "emitter": { "radiance": [1, -1, 1] } }"#;
    assert!(
        with_material(emitter).contains("each 0 or more"),
        "{}",
        with_material(emitter)
    );
    let glass = r#""red": { "glass": { "ior": 0 } }"#;
    assert!(with_material(glass).contains("expected a finite number above 0, got 0"));
}

#[test]
fn reports_the_position_of_an_unknown_material_and_lists_the_known_ones() {
    let shape = SPHERE.replace("\"red\"", "\"rde\"");
    let message = with_shape(&shape);
    assert!(
        message.starts_with(
            "scene:6:65: there is no material `rde` (did you mean red?); the scene defines: red"
        ),
        "{message}"
    );
}

#[test]
fn rejects_a_duplicate_name() {
    let message = with_material(&format!("{RED}, {RED}"));
    let expected = "the name `red` is defined twice";
    assert!(message.contains(expected), "{message}");
}

#[test]
fn rejects_a_camera_without_a_view_direction() {
    let at_itself = with_camera("\"look_at\": [0, 0, 0]", "\"look_at\": [0, 0, 5]");
    assert!(
        at_itself.contains("`look_at` and `position` are the same point"),
        "{at_itself}"
    );
    let along = with_camera("[0, 1, 0]", "[0, 0, 2]");
    assert!(along.contains("`up` is parallel to the view"), "{along}");
    let no_up = with_camera("[0, 1, 0]", "[0, 0, 0]");
    assert!(no_up.contains("`up` is parallel to the view"), "{no_up}");
    let wide = with_camera("40", "180");
    assert!(
        wide.contains("`vertical_fov` is 180: it must be less than 180 degrees"),
        "{wide}"
    );
}

#[test]
fn rejects_an_empty_or_oversized_film() {
    assert!(with_camera("[4, 3]", "[0, 3]").contains("`film` is 0 x 3 pixels"));
    let message = with_camera("[4, 3]", "[4, 16385]");
    assert!(
        message.contains("each side must be from 1 to 16384"),
        "{message}"
    );
    assert!(with_camera("[4, 3]", "[4, -3]").contains("expected u32"));
}

#[test]
fn reports_the_line_of_an_invalid_polygon() {
    let points = r#"{ "polygon": { "points": [[0,0,0], [1,0,0]], "material": "red" } }"#;
    let message = with_shape(points);
    assert!(
        message.starts_with("scene:6:") && message.contains("needs 3 or more points"),
        "{message}"
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
    let message = with_shape(r#"{ "mesh": { "file": "teapot.obj", "material": "red" } }"#);
    assert!(
        message.starts_with("scene:6:25: meshes are separate files"),
        "{message}"
    );
}
