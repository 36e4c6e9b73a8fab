//! Tests of the errors for invalid scenes: their positions, reasons and remedies.

use super::Scene;

const CAMERA: &str = r#"{ "vertical_fov": 40, "film": [4, 3],
    "position": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0] }"#;
const SPHERE: &str = r#"{ "sphere": { "center": [0, 0, 0], "radius": 1, "material": "red" } }"#;
const RED: &str = r#""red": { "lambertian": { "albedo": [0.8, 0.1, 0.1] } }"#;

/// Returns the text of a scene with this camera, material and shape.
fn scene(camera: &str, material: &str, shape: &str) -> String {
    format!(
        "{{\n  \"camera\": {camera},\n  \"materials\": {{ {material} }},\n  \"shapes\": [\n    {shape}\n  ]\n}}"
    )
}

/// Replaces part of a valid scene and checks the message about the result.
fn check(from: &str, to: &str, expected: &str) {
    let valid = scene(CAMERA, RED, SPHERE);
    assert!(valid.contains(from), "{from}");
    check_text(&valid.replacen(from, to, 1), expected);
}

/// Checks that the error for `text` begins with `scene:` and the expected text.
fn check_text(text: &str, expected: &str) {
    let error = Scene::from_text(text).expect_err("the scene is invalid");
    let message = error.to_string();
    let rest = message
        .strip_prefix("scene:")
        .expect("the file comes first");
    assert!(
        rest.starts_with(expected),
        "expected {expected}\ngot {message}"
    );
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
    let message = "this is not a scene: a scene begins with `{`. ";
    check_text("# Path tracing\n", &format!("1:1: {message}"));
    check_text("\n  [1, 2]", &format!("2:3: {message}"));
    check_text("", " the scene is empty");
    check_text(" \n", " the scene is empty");
}

#[test]
fn an_error_shows_the_line_and_a_mark_under_the_column() {
    check(
        "radius",
        "radus",
        "6:40: unknown key `radus` (did you mean radius?); the keys here are: center, radius, \
         material\n    \
         6 |     { \"sphere\": { \"center\": [0, 0, 0], \"radus\": 1, \"material\": \"red\" } }\n      \
           |                                        ^",
    );
}

#[test]
fn wrong_keys_names_and_kinds_are_listed_with_the_known_ones() {
    let metal = r#""red": { "metal": { "albedo": [1, 1, 1] } }"#;
    let kinds = "4:27: unknown kind of material `metal`; the kinds are: lambertian, checker";
    check(RED, metal, kinds);
    let kinds = "6:7: unknown kind of shape `cube`; the kinds are: sphere, polygon, mesh";
    check(SPHERE, r#"{ "cube": {} }"#, kinds);
    check(" \"radius\": 1,", "", "6:17: missing key `radius`");
    check(
        "\"radius\": 1",
        "\"radius\": 1, \"radius\": 2",
        "6:53: the key `radius` occurs twice",
    );
    let twice = format!("{RED}, {RED}");
    check(RED, &twice, "4:74: the key `red` occurs twice");
    check(
        "\"red\" }",
        "\"rde\" }",
        "6:65: there is no material `rde` (did you mean red?); the scene defines: red",
    );
}

#[test]
fn an_error_points_at_the_value_and_says_what_is_allowed() {
    let positive = "expected a number greater than 0 and at most 1e9, got";
    for value in ["0", "-2", "1e39", "null"] {
        let expected = format!("6:50: `radius`: {positive} {value}\n");
        check("1, \"mat", &format!("{value}, \"mat"), &expected);
    }
    let text = format!("6:50: `radius`: {positive} the string \"one\"\n");
    check("1, \"mat", "\"one\", \"mat", &text);
    check("1, \"mat", "1e999, \"mat", "6:54: the number is too large");
    check(
        "1, \"mat",
        "NaN, \"mat",
        "6:50: expected a value: a number, a string in quotes",
    );
    check(
        "[0, 1, 0]",
        "[0, 0, 2]",
        "3:56: `up` is parallel to the view direction",
    );
    check(
        "[0, 1, 0]",
        "[0, 0, 0]",
        "3:56: `up` is parallel to the view direction",
    );
    let same = "3:39: `look_at` and `position` are the same point";
    check("\"look_at\": [0, 0, 0]", "\"look_at\": [0, 0, 5]", same);
    let degrees = "2:31: `vertical_fov`: expected an angle in degrees, greater than 0 and less \
                   than 180, got 180";
    check("40", "180", degrees);
    let kind = "4:25: `red`: expected an object in { } whose only key is its kind, got the string \
                \"mirror\"";
    check(RED, r#""red": "mirror""#, kind);
    check(
        SPHERE,
        r#"{ "sphere": {}, "mesh": {} }"#,
        "6:5: `shapes`: expected an object in { } whose",
    );
    for value in ["[0, 1e39, 0]", "[0, 0]", "[0, 0, 0, 1]", "[0, \"a\", 0]"] {
        let expected =
            format!("6:29: `center`: expected three numbers from -1e9 to 1e9, got {value}\n");
        check("[0, 0, 0], \"rad", &format!("{value}, \"rad"), &expected);
    }
    let film = "2:43: `film`: expected two whole numbers from 1 to 16384: the width and height in \
                pixels, got";
    for value in ["[0, 3]", "[4, 16385]", "[4, -3]", "[4]"] {
        check("[4, 3]", value, &format!("{film} {value}\n"));
    }
    let colour = "4:53: `albedo`: expected red, green and blue, each from 0 to 1, got [1.5";
    check("[0.8", "[1.5", colour);
    let emitter = r#""red": { "emitter": { "radiance": [1, -1, 1] } }"#;
    check(
        RED,
        emitter,
        "4:52: `radiance`: expected red, green and blue, each 0 or more, got [1, -1",
    );
    let glass = r#""red": { "glass": { "ior": 0 } }"#;
    check(RED, glass, &format!("4:45: `ior`: {positive} 0"));
}

#[test]
fn an_error_in_a_polygon_points_at_its_points_or_uv() {
    for (uv, expected) in [
        (
            "[[0,0], [1,0], [0,1e39]]",
            "8:23: `uv`: expected two finite numbers",
        ),
        (
            "[[0,0], [1,0]]",
            "8:8: `uv` has length 2 and `points` has length 3",
        ),
    ] {
        let polygon = format!(
            "{{ \"polygon\": {{\n \"points\": [[0,0,0], [1,0,0], [0,1,0]],\n \"uv\": {uv},\n \
             \"material\": \"red\"\n}} }}"
        );
        check(SPHERE, &polygon, expected);
    }
    let short = r#"{ "polygon": { "points": [[0,0,0], [1,0,0]], "material": "red" } }"#;
    check(
        SPHERE,
        short,
        "6:30: `points` has length 2: a polygon needs at least 3",
    );
}

#[test]
fn a_scene_without_a_folder_can_have_no_mesh() {
    let mesh = r#"{ "mesh": { "file": "teapot.obj", "material": "red" } }"#;
    check(SPHERE, mesh, "6:25: meshes are separate files");
}

#[test]
fn reports_the_line_of_truncated_or_invalid_json() {
    let truncated = "{\n  \"camera\": {";
    check_text(
        truncated,
        "2:13: the file ends inside an object: a `}` is missing",
    );
    check_text("{ \"camera\": hello", "1:13: expected a value");
    let after = format!("{}\n]", scene(CAMERA, RED, SPHERE));
    check_text(&after, "9:1: the scene ends before this");
}

/// Terms of the parsing library that mean nothing to the author of a scene.
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

/// Checks that the error uses terms that a scene's author knows, and that it has a position.
fn check_words(text: &str) {
    let error = Scene::from_text(text).expect_err("the scene is invalid");
    let word = JARGON.iter().find(|word| error.message.contains(*word));
    assert_eq!(word, None, "{}\n{text}", error.message);
    assert!(error.position.is_some() || text.is_empty(), "{text}");
}

#[test]
fn no_message_uses_the_terms_of_the_parsers_library() {
    let valid = scene(CAMERA, RED, SPHERE);
    for end in (0..valid.len()).step_by(3) {
        check_words(&valid[..end]);
    }
    let materials = format!("{{ {RED} }}");
    let albedo = "[0.8, 0.1, 0.1]";
    let parts = [
        "40",
        "[4, 3]",
        "[0, 0, 5]",
        "\"red\"",
        CAMERA,
        SPHERE,
        albedo,
        &materials,
    ];
    let values = [
        "-1",
        "\"x\"",
        "null",
        "[]",
        "{}",
        "[1]",
        "{ \"x\": 1 }",
        "[{}]",
    ];
    for (part, value) in parts
        .iter()
        .flat_map(|part| values.map(|value| (part, value)))
    {
        check_words(&valid.replacen(part, value, 1));
    }
}

#[test]
fn the_extent_covers_shapes_and_camera() {
    let near = Scene::from_text(&scene(CAMERA, RED, SPHERE)).expect("the scene is valid");
    assert_eq!(near.extent(), 5.0);
    let mut far = near.clone();
    far.camera.placement.position.z = 1.0;
    far.shapes.clear();
    assert_eq!(far.extent(), 1.0);
    far.camera.placement.position.z = -50.0;
    assert_eq!(far.extent(), 50.0);
}
