//! Tests of scene and mesh files. Error messages must begin with the name of the file to fix.

use std::fs;
use std::path::Path;

use protocol::Shape;

use super::{Environment, Scene};
use crate::tests::Folder;

/// Checks that the message about a scene begins with this text, after the name of the folder.
fn check(scene: &Path, expected: &str) {
    let error = Scene::load(scene).expect_err("the scene is invalid");
    let folder = scene.parent().expect("the scene is in a folder");
    let folder = format!("{}{}", folder.display(), std::path::MAIN_SEPARATOR);
    let message = error.to_string().replace(&folder, "");
    assert!(message.starts_with(expected), "{message}");
}

fn scene_with(mesh: &str) -> String {
    format!(
        r#"{{
  "camera": {{ "vertical_fov": 40, "film": [4, 3], "position": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0] }},
  "materials": {{ "red": {{ "lambertian": {{ "albedo": [0.8, 0.1, 0.1] }} }} }},
  "shapes": [
    {{ "mesh": {{ "file": "a.obj", "material": "red" {mesh} }} }}
  ]
}}"#
    )
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

#[test]
fn a_mesh_is_scaled_rotated_and_translated() {
    let folder = Folder::new();
    folder.write("a.obj", SQUARE);
    let keys = r#", "scale": 2, "rotate": [90, 0, 0], "translate": [5, 0, 0]"#;
    let scene = Scene::load(&folder.write("s.json", scene_with(keys)));
    let scene = scene.expect("the scene is valid");
    assert_eq!(scene.shapes.len(), 2);
    let Shape::Triangle { vertices, .. } = scene.shapes[0] else {
        panic!("expected a triangle, got {:?}", scene.shapes[0]);
    };
    let far = vertices[2];
    assert!(
        far.position.abs_diff_eq(glam::vec3(7.0, 0.0, 2.0), 1e-5),
        "{far:?}"
    );
    // The file has no normals, so the rotated face's normal is used.
    assert!(far.normal.abs_diff_eq(glam::Vec3::NEG_Y, 1e-5), "{far:?}");
}

#[test]
fn names_in_a_mesh_can_have_any_encoding() {
    let folder = Folder::new();
    let mesh = [b"o Kugelfl\xe4che\n# \xfc\n", SQUARE.as_bytes()].concat();
    folder.write("a.obj", mesh);
    let scene = Scene::load(&folder.write("s.json", scene_with("")));
    assert_eq!(scene.expect("the scene is valid").shapes.len(), 2);
}

#[test]
fn an_error_in_a_mesh_names_both_files() {
    let folder = Folder::new();
    let scene = folder.write("s.json", scene_with(""));
    let missing = "s.json:5:25: mesh: a.obj: cannot read the file: ";
    check(&scene, missing);
    folder.write("a.obj", SQUARE.replace("f 1 2 3 4", "f 1 2 9"));
    let line = "s.json:5:25: mesh: a.obj:5: there is no position 9: the indices go from 1 to 4\n    \
                5 | f 1 2 9";
    check(&scene, line);
    folder.write("a.obj", SQUARE);
    let small = folder.write("small.json", scene_with(r#", "scale": 1e-30"#));
    let no_area = "small.json:5:25: every triangle of the mesh has zero area";
    check(&small, no_area);
    folder.write("a.obj", SQUARE.replace("v 1 1 0", "v 1e5 1 0"));
    let large = folder.write("large.json", scene_with(r#", "scale": 1e6"#));
    let beyond = "large.json:5:25: the mesh has a coordinate beyond 1e9";
    check(&large, beyond);
}

#[test]
fn an_error_begins_with_the_name_of_the_file() {
    let folder = Folder::new();
    let not_utf8 = "s.json: the file is not UTF-8 text (invalid byte at offset 1); is it the right";
    check(&folder.write("s.json", [b'{', 0xff, 0xfe]), not_utf8);
    let empty = "empty.json: the scene is empty";
    check(&folder.write("empty.json", ""), empty);
    let unreadable = "none.json: cannot read the file: ";
    check(&folder.0.join("none.json"), unreadable);
    let mesh = "a.obj: this is a mesh, not a scene. To show it in a scene, add this entry to its \
                `shapes`: { \"mesh\": { \"file\": \"a.obj\"";
    check(&folder.write("a.obj", SQUARE), mesh);
}

#[test]
fn reads_files_with_a_byte_order_mark() {
    let folder = Folder::new();
    folder.write("a.obj", format!("\u{feff}{SQUARE}"));
    let marked = format!("\u{feff}{}", scene_with(""));
    let units: Vec<u16> = marked.encode_utf16().collect();
    let little = units.iter().copied().flat_map(u16::to_le_bytes).collect();
    let big = units.iter().copied().flat_map(u16::to_be_bytes).collect();
    for bytes in [marked.into_bytes(), little, big] {
        let scene = Scene::load(&folder.write("s.json", bytes)).expect("the scene is valid");
        assert_eq!(scene.shapes.len(), 2);
    }
}

#[test]
fn every_scene_in_the_scenes_folder_loads() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    // A bundle made from this repository may contain no scenes.
    let Ok(entries) = fs::read_dir(&scenes) else {
        return;
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.extension().is_some_and(|ending| ending == "json") {
            let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
            assert!(
                !scene.about.is_empty(),
                "{}: `about` is empty",
                path.display()
            );
        }
    }
    let text = fs::read_to_string(scenes.join("cornell-box.json")).expect("the scene exists");
    Scene::from_text(&text).expect("the scene uses no other file");
}

#[test]
fn an_environment_map_is_read_from_an_hdr_file_and_what_is_wrong_with_it_is_named() {
    let with_map = |map: &str| {
        let entry = format!(r#""environment": {{ "map": "{map}", "scale": 2 }}, "materials""#);
        let text = scene_with("").replace("\"materials\"", &entry);
        text.replace("a.obj", "b.obj")
    };
    // Two rows of four pixels: red, green, blue and an exponent, without compression.
    let hdr = |pixels: [[u8; 4]; 8]| {
        let header = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
        [header.as_slice(), pixels.as_flattened()].concat()
    };
    let folder = Folder::new();
    folder.write("b.obj", SQUARE);
    let mut pixels = [[128, 128, 128, 129]; 8];
    pixels[5] = [128, 0, 0, 131];
    folder.write("sky.hdr", hdr(pixels));
    let scene = Scene::load(&folder.write("s.json", with_map("sky.hdr")));
    let scene = scene.expect("the scene is valid");
    let Environment::Map(map) = &scene.environment else {
        panic!("the environment is {:?}", scene.environment);
    };
    assert_eq!(map.size(), glam::uvec2(4, 2));
    assert_eq!(map.pixels()[4], glam::Vec3::splat(2.0));
    assert_eq!(map.pixels()[5], glam::vec3(8.0, 0.0, 0.0));

    folder.write("black.hdr", hdr([[0; 4]; 8]));
    folder.write("short.hdr", &hdr(pixels)[..50]);
    folder.write("sky.png", [0; 4]);
    for (map, why) in [
        ("black.hdr", "black.hdr: the map is completely black"),
        ("short.hdr", "short.hdr: the file is damaged"),
        ("sky.png", "sky.png: a map must be an HDR or EXR file"),
        ("none.hdr", "none.hdr: cannot read the file"),
    ] {
        let scene = folder.write("s.json", with_map(map));
        check(&scene, &format!("s.json:3:27: {why}"));
    }
}
