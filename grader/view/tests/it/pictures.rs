//! Checks that the viewer and `cargo render` produce the same pixels for any camera.

use framework::render::film::{Film, Tone};
use framework::render::renderer::{Lighting, PathSettings, render};
use framework::scene::Scene;
use framework::submission::World;
use glam::{UVec2, uvec2};
use reference::world::Student;
use reference_light::integrator::Light;
use serde_json::json;

use crate::harness::{Submission, Viewer, view_of, workspace};

/// Renders a scene the way `cargo render` does.
fn rendered(scene: &str, film: UVec2, samples: u32, seed: u64, stops: f32) -> Vec<[u8; 3]> {
    let scene = Scene::load(&workspace().join("scenes").join(scene)).unwrap();
    let scene = scene.on_film(film);
    let world = World::new(&Student, &scene);
    let settings = PathSettings { bounces: 8, seed };
    let path_tracer = Light.path_tracer(&scene, &world, settings);
    let pixels = render(&*path_tracer, film, samples);
    let film = Film { size: film, pixels };
    let tone = Tone::Light { stops };
    film.pixels_top_down()
        .map(|pixel| tone.to_bytes(pixel))
        .collect()
}

#[test]
fn a_picture_is_that_of_the_render_command_pixel_for_pixel() {
    let arguments = "spheres --size 70x66 --samples 5 --seed 7";
    let viewer = Viewer::start(&Submission::reference(), arguments);
    viewer.wait_for_picture();
    let film = uvec2(70, 66);
    assert!(viewer.picture() == rendered("spheres.json", film, 5, 7, 0.0));

    // More samples are added to the existing ones.
    viewer.command(&json!({ "samples": 9 }));
    viewer.command(&json!({ "exposure": -1.5 }));
    viewer.wait_for(|state| state["is_picture_complete"] == true && state["complete_samples"] == 9);
    assert!(viewer.picture() == rendered("spheres.json", film, 9, 7, -1.5));
}

#[test]
fn until_part_two_is_written_the_picture_is_drawn_in_clay() {
    let submission = Submission::reference();
    let arguments = "flat --size 40x30 --samples 2";
    // The workspace's own part two has stubs.
    let viewer = Viewer::run(view_of(&submission).args(arguments.split(' '))).unwrap();
    let state = viewer.wait_for_picture();
    let notes = state["notes"].to_string();
    assert!(notes.contains("Part two: not written yet"), "{notes}");
    let shaded = viewer.picture();
    let state = viewer.show("clay");
    assert!(!state["notes"].to_string().contains("Part two"), "{state}");
    assert!(viewer.picture() == shaded);
}

#[test]
fn returning_to_the_scenes_camera_gives_the_same_picture() {
    let viewer = Viewer::start(&Submission::reference(), "flat --size 40x30 --samples 2");
    viewer.wait_for_picture();
    let before = viewer.picture();
    viewer.command(&json!({ "move": { "orbit": [0.5, 0.2] } }));
    let state = viewer.wait_for_picture();
    assert_eq!(state["camera"]["is_own"], false);
    assert!(viewer.picture() != before);
    viewer.command(&json!("own_camera"));
    let state = viewer.wait_for_picture();
    assert_eq!(state["camera"]["is_own"], true);
    assert!(viewer.picture() == before);
}

#[test]
fn every_view_has_a_picture_of_its_own() {
    let arguments = "checkered-teapot --size 64x48 --samples 1";
    let viewer = Viewer::start(&Submission::reference(), arguments);
    let mut pictures = Vec::new();
    for view in [
        "shaded", "clay", "normals", "depth", "uv", "bvh", "tests", "mistakes",
    ] {
        viewer.show(view);
        let picture = viewer.picture();
        assert!(!pictures.contains(&picture), "{view}");
        pictures.push(picture);
    }
}

#[test]
fn the_tree_is_that_of_the_submission() {
    let viewer = Viewer::start(&Submission::reference(), "flat --size 8x8");
    assert_eq!(viewer.get("/tree").status, 404);
    let state = viewer.wait_for(|state| state["has_tree"] == true);
    let tree = viewer.get_json("/tree");
    let scene = Scene::load(&workspace().join("scenes/flat.json")).unwrap();
    use framework::submission::Submission as _;
    let expected = Student.build(&scene.shapes, scene.max_leaf_size).tree();
    assert_eq!(tree["nodes"], expected.nodes.len());
    assert_eq!(tree["primitives"], expected.order.len());
    assert_eq!(tree["levels"], state["tree_levels"]);
    let boxes = viewer.get_json("/boxes?level=0&below=true");
    assert_eq!(boxes["count"], expected.nodes.len());
    let root = &boxes["boxes"][0];
    assert_eq!((&root["level"], &root["area"]), (&json!(0), &json!(1.0)));
}
