//! Renders with the reference's code, as a user would.

use std::process::Command;

use framework::render::rectangles::GivenRectangles;
use framework::render::renderer::{self, Lighting, PathSettings, RenderStats};
use framework::scene::Scene;
use framework::submission::{Submission, World};
use glam::UVec2;
use reference::world::Student;
use reference_light::integrator::Light;

/// A note saying that a picture takes a long time would be wrong, because the reference's traversal
/// uses the tree.
#[test]
fn the_reference_renders_every_scene_without_a_note() {
    let workspace = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let out = std::env::temp_dir().join(format!("render-{}.png", std::process::id()));
    for scene in [
        "cornell-box",
        "checkered-teapot",
        "flat",
        "lamp",
        "lantern",
        "lights",
        "open-sky",
        "spheres",
        "wide",
    ] {
        let command = Command::new(env!("CARGO_BIN_EXE_reference-light"))
            .current_dir(workspace)
            .args([scene, "--size", "16x16", "--samples", "1", "--out"])
            .arg(&out)
            .output()
            .expect("the program can be started");
        let messages = String::from_utf8_lossy(&command.stderr);
        assert!(command.status.success(), "{scene}: {messages}");
        assert!(!messages.contains("note:"), "{scene}: {messages}");
    }
    std::fs::remove_file(out).expect("the picture exists");
}

#[test]
fn a_pixel_shows_what_its_first_path_asks_and_gets() {
    let command = Command::new(env!("CARGO_BIN_EXE_reference-light"))
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .args([
            "lamp",
            "--pixel",
            "8,3",
            "--size",
            "16x12",
            "--bounces",
            "1",
        ])
        .output()
        .expect("the program can be started");
    let text = String::from_utf8_lossy(&command.stdout);
    let steps = text.lines().skip_while(|line| !line.starts_with("path of"));
    let kinds: Vec<&str> = steps
        .filter_map(|line| line.split_once(':'))
        .map(|(kind, _)| kind.trim())
        .collect();
    let path = [
        "path of the first sample, whose radiance is",
        "bounce 0, throughput [1.0000, 1.0000, 1.0000]",
        "hit",
        "light",
        "light pdf",
    ];
    assert!(kinds[0].starts_with(path[0]), "{text}");
    assert_eq!(kinds[1..5], path[1..], "{text}");
    assert!(kinds.contains(&"scatter"), "{text}");
    assert!(text.contains("hit: a matte surface at"), "{text}");
}

/// With rectangles that the framework intersects, only the camera comes from part one.
#[test]
fn given_rectangles_give_the_same_picture_without_part_one() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/lamp.json");
    let scene = Scene::load(path.as_ref()).expect("the scene is valid");
    let scene = scene.on_film(UVec2::new(16, 12));
    let settings = PathSettings {
        bounces: 3,
        seed: 1,
    };
    let means = [&Student as &dyn Submission, &GivenRectangles(&Student)].map(|submission| {
        let world = World::new(submission, &scene);
        let path_tracer = Light.path_tracer(&scene, &world, settings);
        let film = scene.camera.pinhole.film;
        let pixels = renderer::render(path_tracer.as_ref(), film, 16);
        pixels.iter().map(|pixel| pixel.y).sum::<f32>() / pixels.len() as f32
    });
    let [own, given] = means;
    assert!(
        (own - given).abs() < 1e-3 * own && own > 0.0,
        "{own} {given}"
    );
}

/// If only points on the light were sampled, some points next to the floor would contribute
/// thousands of times the light's radiance. The balance heuristic combines two samples and limits
/// the contribution of each sample to the amount of light that the floor can reflect.
#[test]
fn the_floor_beside_a_light_has_no_bright_specks() {
    let scene = r#"{
        "camera": { "vertical_fov": 20, "film": [16, 16],
            "position": [0, 1.5, 0], "look_at": [0, 0, -2.95], "up": [0, 1, 0] },
        "materials": {
            "floor": { "lambertian": { "albedo": [0.5, 0.5, 0.5] } },
            "panel": { "emitter": { "radiance": [1, 1, 1] } }
        },
        "shapes": [
            { "polygon": { "material": "floor", "points": [[-4, 0, 4], [4, 0, 4], [4, 0, -4], [-4, 0, -4]] } },
            { "polygon": { "material": "panel", "points": [[-1, 0, -3], [1, 0, -3], [1, 1, -3], [-1, 1, -3]] } }
        ]
    }"#;
    let scene = Scene::from_text(scene).expect("the scene is valid");
    let world = World::new(&Student, &scene);
    let settings = PathSettings {
        bounces: 1,
        seed: 1,
    };
    let path_tracer = Light.path_tracer(&scene, &world, settings);
    let mut stats = RenderStats::default();
    // The lower half of the picture shows only the floor.
    let pixels = (0..8).flat_map(|y| (0..16).map(move |x| UVec2::new(x, y)));
    let samples = pixels.flat_map(|pixel| (0..64).map(move |sample| (pixel, sample)));
    let light =
        samples.map(|(pixel, sample)| path_tracer.sample_radiance(pixel, sample, &mut stats).x);
    let light: Vec<f32> = light.collect();
    let brightest = light.iter().copied().fold(0.0, f32::max);
    let mean = light.iter().sum::<f32>() / light.len() as f32;
    assert!(
        brightest <= 1.0 && mean > 0.1,
        "{brightest}, on average {mean}"
    );
}
