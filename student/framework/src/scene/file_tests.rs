//! Scenes and meshes as files: what is wrong is told with the name of the file that must change.

use std::fs;
use std::path::{Path, PathBuf};

use protocol::Shape;

use super::Scene;

/// A folder of our own that goes away with the test.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let name = format!("framework-{test}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).expect("a folder");
        Folder(folder)
    }

    fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, contents).expect("a file");
        path
    }

    /// The scene's error, without the folder's name.
    fn problem(&self, scene: &Path) -> String {
        let error = Scene::load(scene).expect_err("it is refused").to_string();
        error.replace(
            &format!("{}{}", self.0.display(), std::path::MAIN_SEPARATOR),
            "",
        )
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // If it can not be removed, the system does so later.
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
    let folder = Folder::new("placed");
    folder.write("a.obj", SQUARE);
    let put = r#", "scale": 2, "rotate": [90, 0, 0], "translate": [5, 0, 0]"#;
    let scene = Scene::load(&folder.write("s.json", scene_with(put))).expect("a scene");
    assert_eq!(scene.shapes.len(), 2);
    let Shape::Triangle { vertices, .. } = scene.shapes[0] else {
        panic!("meshes are triangles: {:?}", scene.shapes[0]);
    };
    let far = vertices[2];
    assert!(
        far.position.abs_diff_eq(glam::vec3(7.0, 0.0, 2.0), 1e-5),
        "{far:?}"
    );
    // The file gives no normals: the face's own, which was turned as well.
    assert!(far.normal.abs_diff_eq(glam::Vec3::NEG_Y, 1e-5), "{far:?}");
}

#[test]
fn a_subdivided_mesh_has_four_times_the_triangles_and_smooth_normals() {
    let folder = Folder::new("subdivided");
    let tetrahedron =
        "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n";
    folder.write("a.obj", tetrahedron);
    let scene = Scene::load(&folder.write("s.json", scene_with(r#", "subdivide": 3"#)));
    let scene = scene.expect("a scene");
    assert_eq!(scene.shapes.len(), 4 * 64);
    let outward = scene.shapes.iter().all(|shape| match shape {
        Shape::Triangle { vertices, .. } => vertices.iter().all(|vertex| {
            vertex.normal.is_normalized() && vertex.normal.dot(vertex.position) > 0.0
        }),
        Shape::FlatTriangle { .. } | Shape::Sphere { .. } => false,
    });
    assert!(outward);
}

#[test]
fn reports_a_missing_mesh_at_the_line_that_names_it() {
    let folder = Folder::new("missing");
    let told = folder.problem(&folder.write("s.json", scene_with("")));
    assert!(
        told.starts_with("s.json:5:25: mesh: a.obj: can not be read: "),
        "{told}"
    );
}

#[test]
fn reports_a_bad_line_of_a_mesh_in_the_mesh_file() {
    let folder = Folder::new("range");
    folder.write("a.obj", SQUARE.replace("f 1 2 3 4", "f 1 2 9"));
    let told = folder.problem(&folder.write("s.json", scene_with("")));
    let wanted = "mesh: a.obj:5: there is no position 9: they count from 1 to 4\n    5 | f 1 2 9";
    assert!(told.contains(wanted), "{told}");
}

#[test]
fn rejects_a_subdivision_that_would_not_fit_in_memory() {
    let folder = Folder::new("fine");
    folder.write("a.obj", SQUARE);
    let told = folder.problem(&folder.write("s.json", scene_with(r#", "subdivide": 40"#)));
    assert!(
        told.contains("40 subdivisions make") && told.contains("take fewer"),
        "{told}"
    );
}

#[test]
fn reports_the_name_of_an_unreadable_file() {
    let folder = Folder::new("binary");
    let told = folder.problem(&folder.write("s.json", [b'{', 0xff, 0xfe]));
    assert_eq!(
        told,
        "s.json: is not UTF-8 text: byte 1 fits no character; is it the right file?"
    );
    let told = folder.problem(&folder.write("empty.json", ""));
    assert!(told.starts_with("empty.json: is empty"), "{told}");
    let told = folder.problem(&folder.0.join("none.json"));
    assert!(told.starts_with("none.json: can not be read: "), "{told}");
}

#[test]
fn every_scene_in_the_scenes_folder_loads() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    // A submission's bundle may stand without them.
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
    let text = fs::read_to_string(scenes.join("cornell-box.json")).expect("the Cornell box");
    Scene::from_text(&text).expect("it needs no other file");
}
