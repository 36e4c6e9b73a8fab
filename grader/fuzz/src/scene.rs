//! Scene files, which students may write themselves.

use framework::scene::Scene;

/// Reads the bytes as a scene. If the scene is valid, it must be possible to render it.
pub fn read(bytes: &[u8]) {
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
