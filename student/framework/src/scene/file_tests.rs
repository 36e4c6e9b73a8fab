//! Tests of scene and mesh files. Error messages must begin with the name of the file to fix.

use std::fs;
use std::path::{Path, PathBuf};

use protocol::Shape;

use super::Scene;

/// A temporary folder that is removed at the end of the test.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let name = format!("framework-{test}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).expect("the folder can be created");
        Folder(folder)
    }

    fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, contents).expect("the file can be written");
        path
    }

    /// Returns the error message for a scene, without the name of the folder.
    fn problem(&self, scene: &Path) -> String {
        let error = Scene::load(scene).expect_err("the scene is invalid");
        error.to_string().replace(
            &format!("{}{}", self.0.display(), std::path::MAIN_SEPARATOR),
            "",
        )
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // If this fails, the system removes the temporary folder later.
        let _ = fs::remove_dir_all(&self.0);
    }
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
    let folder = Folder::new("transformed");
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
    // The file has no normals, so the normal is that of the rotated face.
    assert!(far.normal.abs_diff_eq(glam::Vec3::NEG_Y, 1e-5), "{far:?}");
}

#[test]
fn names_in_a_mesh_can_have_any_encoding() {
    let folder = Folder::new("latin-1");
    let mesh = [b"o Kugelfl\xe4che\n# \xfc\n", SQUARE.as_bytes()].concat();
    folder.write("a.obj", mesh);
    let scene = Scene::load(&folder.write("s.json", scene_with("")));
    assert_eq!(scene.expect("the scene is valid").shapes.len(), 2);
}

#[test]
fn reports_a_missing_mesh_at_the_line_that_names_it() {
    let folder = Folder::new("missing");
    let message = folder.problem(&folder.write("s.json", scene_with("")));
    assert!(
        message.starts_with("s.json:5:25: mesh: a.obj: cannot read the file: "),
        "{message}"
    );
}

#[test]
fn reports_a_bad_line_of_a_mesh_in_the_mesh_file() {
    let folder = Folder::new("range");
    folder.write("a.obj", SQUARE.replace("f 1 2 3 4", "f 1 2 9"));
    let message = folder.problem(&folder.write("s.json", scene_with("")));
    let expected = "mesh: a.obj:5: there is no position 9: the indices are 1 to 4\n    5 | f 1 2 9";
    assert!(message.contains(expected), "{message}");
}

#[test]
fn reports_the_name_of_an_unreadable_file() {
    let folder = Folder::new("binary");
    let message = folder.problem(&folder.write("s.json", [b'{', 0xff, 0xfe]));
    assert_eq!(
        message,
        "s.json: the file is not UTF-8 text (invalid byte at offset 1); is it the right file?"
    );
    let message = folder.problem(&folder.write("empty.json", ""));
    let expected = "empty.json: the scene is empty";
    assert!(message.starts_with(expected), "{message}");
    let message = folder.problem(&folder.0.join("none.json"));
    let expected = "none.json: cannot read the file: ";
    assert!(message.starts_with(expected), "{message}");
}

#[test]
fn reads_files_with_a_byte_order_mark() {
    let folder = Folder::new("marks");
    folder.write("a.obj", format!("\u{feff}{SQUARE}"));
    let text = scene_with("");
    let little: Vec<u8> = format!("\u{feff}{text}")
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let big: Vec<u8> = format!("\u{feff}{text}")
        .encode_utf16()
        .flat_map(u16::to_be_bytes)
        .collect();
    for bytes in [format!("\u{feff}{text}").into_bytes(), little, big] {
        let scene = Scene::load(&folder.write("s.json", bytes)).expect("the scene is valid");
        assert_eq!(scene.shapes.len(), 2);
    }
}

#[test]
fn a_mesh_is_not_a_scene() {
    let folder = Folder::new("mesh-as-scene");
    let message = folder.problem(&folder.write("a.obj", SQUARE));
    assert!(
        message.starts_with("a.obj: this is a mesh, not a scene") && message.contains("\"a.obj\""),
        "{message}"
    );
}

#[test]
fn rejects_a_mesh_that_no_ray_can_hit() {
    let folder = Folder::new("no-area");
    folder.write("a.obj", SQUARE);
    let message = folder.problem(&folder.write("s.json", scene_with(r#", "scale": 1e-30"#)));
    assert!(
        message.starts_with("s.json:5:25: no triangle of the mesh has an area"),
        "{message}"
    );
    folder.write("a.obj", SQUARE.replace('1', "1e5").replace("f 1e5", "f 1"));
    let message = folder.problem(&folder.write("s.json", scene_with(r#", "scale": 1e6"#)));
    assert!(
        message.starts_with("s.json:5:25: the mesh has a coordinate beyond 1e9"),
        "{message}"
    );
}

#[test]
fn every_scene_in_the_scenes_folder_loads() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    // A bundle of this repository may have no scenes.
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
