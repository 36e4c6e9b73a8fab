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
fn a_file_of_another_kind_is_no_scene() {
    for (text, position) in [("# Path tracing\n", "1:1"), ("\n  [1, 2]", "2:3")] {
        let message = problem(text);
        let expected = format!("scene:{position}: this is not a scene: a scene begins with `{{`. ");
        assert!(message.starts_with(&expected), "{message}");
    }
}

#[test]
fn reports_the_position_of_an_unknown_key_and_lists_the_known_ones() {
    let shape = SPHERE.replace("radius", "radus");
    let expected = "scene:6:40: unknown key `radus` (did you mean radius?); the keys here are: center, \
        radius, material\n    \
        6 |     { \"sphere\": { \"center\": [0, 0, 0], \"radus\": 1, \"material\": \"red\" } }\n      \
          |                                        ^";
    assert_eq!(with_shape(&shape), expected);
    let kind = with_shape(r#"{ "cube": {} }"#);
    assert!(
        kind.starts_with(
            "scene:6:7: there is no kind of shape `cube`; the kinds are: sphere, polygon"
        ),
        "{kind}"
    );
}

#[test]
fn reports_the_name_of_a_missing_key() {
    let message = with_shape(r#"{ "sphere": { "center": [0, 0, 0], "material": "red" } }"#);
    assert!(
        message.starts_with("scene:6:17: missing key `radius`"),
        "{message}"
    );
}

#[test]
fn reports_the_position_of_an_invalid_number() {
    let radius = |value: &str| with_shape(&SPHERE.replace(": 1,", &format!(": {value},")));
    assert!(
        radius("0").contains("scene:6:50: `radius`: expected a number above 0, up to 1e9, got 0"),
        "{}",
        radius("0")
    );
    assert!(radius("-2").contains("expected a number above 0, up to 1e9, got -2"));
    assert!(
        radius("1e39").contains("expected a number above 0, up to 1e9"),
        "{}",
        radius("1e39")
    );
    assert!(
        radius("1e999").contains("the number is too large"),
        "{}",
        radius("1e999")
    );
    assert!(
        radius("null").contains("`radius`: expected a number, got null"),
        "{}",
        radius("null")
    );
    assert!(radius("NaN").contains("scene:6:"), "{}", radius("NaN"));
    assert!(
        radius("\"one\"").contains("`radius`: expected a number, got the text \"one\""),
        "{}",
        radius("\"one\"")
    );

    let center = |value: &str| with_shape(&SPHERE.replace("[0, 0, 0]", value));
    assert!(center("[0, 1e39, 0]").contains("expected three numbers from -1e9 to 1e9"));
    assert!(
        center("[0, 0]").contains("scene:6:29: `center`: expected three numbers"),
        "{}",
        center("[0, 0]")
    );
    assert!(
        center("[0, 0, 0, 1]")
            .contains("`center`: expected three numbers from -1e9 to 1e9, got [0.0")
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
    assert!(with_material(glass).contains("expected a number above 0, up to 1e9, got 0"));
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
fn an_error_points_at_the_value_and_not_at_the_end_of_its_object() {
    let polygon = |uv: &str| {
        with_shape(&format!(
            "{{ \"polygon\": {{\n \"points\": [[0,0,0], [1,0,0], [0,1,0]],\n \"uv\": {uv},\n \
             \"material\": \"red\"\n}} }}"
        ))
    };
    let infinite = polygon("[[0,0], [1,0], [0,1e39]]");
    assert!(
        infinite.starts_with("scene:8:23: `uv`: expected two finite numbers"),
        "{infinite}"
    );
    let short = polygon("[[0,0], [1,0]]");
    assert!(short.starts_with("scene:8:8: `uv` has length 2"), "{short}");
    let camera = with_camera("\"up\": [0, 1, 0]", "\"up\": [0, 0, 2]");
    assert!(
        camera.starts_with("scene:3:56: `up` is parallel"),
        "{camera}"
    );
    let material = with_material(r#""red": { "metal": { "albedo": [1, 1, 1] } }"#);
    assert!(
        material.starts_with("scene:4:27: there is no kind of material `metal`"),
        "{material}"
    );
    let text_only = with_material(r#""red": "mirror""#);
    assert!(
        text_only.starts_with("scene:4:25: `mirror`: expected an object"),
        "{text_only}"
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
    assert!(
        with_camera("[4, 3]", "[4, -3]")
            .contains("`film`: expected a whole number that is not negative, got -3")
    );
}

#[test]
fn reports_the_line_of_an_invalid_polygon() {
    let points = r#"{ "polygon": { "points": [[0,0,0], [1,0,0]], "material": "red" } }"#;
    let message = with_shape(points);
    assert!(
        message.starts_with("scene:6:30: `points` has length 2: a polygon needs 3 or more"),
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
    let truncated = problem("{\n  \"camera\": {");
    assert!(
        truncated.contains("scene:2:") && truncated.contains("a `}` is missing"),
        "{truncated}"
    );
    assert!(problem("{ \"camera\": hello").contains("scene:1:13: expected a value"));
    let after = problem(&format!("{}\n]", scene(CAMERA, RED, SPHERE)));
    assert!(
        after.contains("scene:9:1: the scene ends before this"),
        "{after}"
    );
}

/// Terms of the parser's library, which mean nothing to the author of a scene.
const JARGON: [&str; 12] = [
    "invalid type",
    "invalid value",
    "invalid length",
    "struct",
    "enum",
    "variant",
    "field",
    "map",
    "sequence",
    "f32",
    "u32",
    "EOF",
];

#[test]
fn no_message_uses_the_terms_of_the_parsers_library() {
    let whole = scene(CAMERA, RED, SPHERE);
    let replaced = |from: &str, to: &str| {
        assert!(whole.contains(from), "{from}");
        whole.replacen(from, to, 1)
    };
    let values = [
        "1",
        "-1.5",
        "\"x\"",
        "null",
        "true",
        "[]",
        "{}",
        "[1, 2]",
        "{ \"x\": 1 }",
        "[{}]",
    ];
    let places = [
        "40",
        "[4, 3]",
        "[0, 0, 5]",
        "[0, 1, 0]",
        CAMERA,
        RED,
        SPHERE,
        "[0.8, 0.1, 0.1]",
        "\"red\" }",
        "1,",
        "{ \"albedo\": [0.8, 0.1, 0.1] }",
        &format!("{{ {RED} }}"),
    ];
    let mut texts: Vec<String> = (0..whole.len())
        .step_by(3)
        .map(|end| whole[..end].to_owned())
        .collect();
    for place in places {
        let end = &place[place.trim_end_matches([',', ' ', '}']).len()..];
        let end = if place.starts_with('{') || place == RED {
            ""
        } else {
            end
        };
        texts.extend(values.map(|value| replaced(place, &format!("{value}{end}"))));
    }
    texts.extend(values.map(str::to_owned));
    let mut errors = 0;
    for text in texts {
        let Err(error) = Scene::from_text(&text) else {
            continue;
        };
        errors += 1;
        // The line that is printed below is the author's own.
        let message = error.kind.to_string();
        let word = JARGON.iter().find(|word| message.contains(*word));
        assert_eq!(word, None, "{message}\n{text}");
        let has_position = error.position.is_some() || text.trim().is_empty();
        assert!(has_position, "{message}\n{text}");
    }
    assert!(errors > 150, "{errors}");
}

#[test]
fn rejects_a_mesh_in_a_scene_without_a_folder() {
    let message = with_shape(r#"{ "mesh": { "file": "teapot.obj", "material": "red" } }"#);
    assert!(
        message.starts_with("scene:6:25: meshes are separate files"),
        "{message}"
    );
}
