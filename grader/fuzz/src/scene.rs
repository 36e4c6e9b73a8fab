//! Scene files, which students may write themselves, and OBJ files.

use std::fs;
use std::sync::LazyLock;

use framework::scene::Scene;
use tempfile::TempDir;

/// A scene that shows a mesh.
const SCENE: &str = r#"{
    "camera": { "vertical_fov": 40, "film": [2, 2], "position": [0, 0, 4], "look_at": [0, 0, 0], "up": [0, 1, 0] },
    "materials": { "clay": { "lambertian": { "albedo": [0.5, 0.5, 0.5] } } },
    "shapes": [{ "mesh": { "file": "any.obj", "material": "clay" } }]
}"#;

/// The folder that contains the scene and its mesh.
static FOLDER: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = TempDir::new().expect("temporary folder");
    fs::write(folder.path().join("scene.json"), SCENE).expect("the file can be written");
    folder
});

/// Reads the bytes as the mesh of a scene. Meshes may come from anywhere on the Internet.
pub fn read_mesh(bytes: &[u8]) {
    let folder = FOLDER.path();
    fs::write(folder.join("any.obj"), bytes).expect("the file can be written");
    match Scene::load(&folder.join("scene.json")) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(scene) => {
            let _ = scene.extent();
        }
    }
}

/// Reads the bytes as a scene. If the scene is valid, it must be possible to render it.
pub fn read_scene(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match Scene::from_text(&text) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(scene) => {
            let film = scene.camera.pinhole.film;
            assert!(film.x > 0 && film.y > 0, "{film}");
            for (index, shape) in (0..).zip(&scene.shapes) {
                assert_eq!(shape.number(), index, "{shape:?}");
                assert!(scene.material_of(index).is_some(), "{shape:?}");
            }
            let _ = (scene.extent(), scene.on_film(film));
        }
    }
}
