//! Analytic checks that any correct path tracer passes. The reference's solution of part one finds
//! the hits.

use framework::render::renderer::{self, Lighting, PathSettings, RenderStats};
use framework::scene::{Environment, EnvironmentMap, Scene};
use framework::submission::{CameraRays, Submission, World};
use glam::{UVec2, Vec2, Vec3, uvec2};
use protocol::Ray;
use reference::world::Student;
use reference_light::integrator::Light;

/// Returns a scene with a camera at the origin that looks down −z, on a film of 8 × 8 pixels.
fn scene(environment: f32, materials: &str, shapes: &str) -> Scene {
    let text = format!(
        r#"{{
            "camera": {{ "vertical_fov": 90, "film": [8, 8],
                "position": [0, 0, 0], "look_at": [0, 0, -1], "up": [0, 1, 0] }},
            "environment": [{environment}, {environment}, {environment}],
            "materials": {{ {materials} }},
            "shapes": [ {shapes} ]
        }}"#
    );
    Scene::from_text(&text).expect("the scene is valid")
}

fn settings(bounces: u32) -> PathSettings {
    PathSettings { bounces, seed: 1 }
}

/// Renders a scene.
fn render(scene: &Scene, samples: u32, bounces: u32) -> Vec<Vec3> {
    let world = World::new(&Student, scene);
    let path_tracer = Light.path_tracer(scene, &world, settings(bounces));
    renderer::render(&*path_tracer, scene.camera.pinhole.film, samples)
}

/// Returns the mean red radiance of a picture.
fn mean(pixels: &[Vec3]) -> f32 {
    pixels.iter().map(|pixel| pixel.x).sum::<f32>() / pixels.len() as f32
}

/// Returns the red radiance of the central pixel of a large film, which sees only a small area.
fn central_pixel(scene: &Scene, samples: u32, bounces: u32) -> f32 {
    let scene = &scene.on_film(uvec2(101, 101));
    let world = World::new(&Student, scene);
    let path_tracer = Light.path_tracer(scene, &world, settings(bounces));
    let mut stats = RenderStats::default();
    path_tracer
        .pixel_radiance(uvec2(50, 50), samples, &mut stats)
        .x
}

/// Asserts that a value equals the expected value to within this relative error.
#[track_caller]
fn assert_near(got: f32, expected: f32, error: f32) {
    assert!(
        (got / expected - 1.0).abs() < error,
        "expected {expected}, got {got}"
    );
}

const GREY: &str = r#""grey": { "lambertian": { "albedo": [0.5, 0.5, 0.5] } }"#;
const WHITE: &str = r#""white": { "lambertian": { "albedo": [1, 1, 1] } }"#;
const GLASS: &str = r#""glass": { "glass": { "ior": 1.5 } }"#;
const EMITTER: &str = r#""light": { "emitter": { "radiance": [1, 1, 1] } }"#;

fn sphere(z: f32, radius: f32, material: &str) -> String {
    format!(
        r#"{{ "sphere": {{ "center": [0, 0, {z}], "radius": {radius}, "material": "{material}" }} }}"#
    )
}

#[test]
fn a_sphere_that_absorbs_nothing_is_invisible_in_a_white_furnace() {
    // Light of radiance 1 arrives from every direction and nothing is absorbed, so every pixel is
    // 1. Inside glass, some paths end by chance, and the others make up for it.
    for (name, material, error) in [("white", WHITE, 1e-6), ("glass", GLASS, 0.01)] {
        let scene = scene(1.0, material, &sphere(-3.0, 2.0, name));
        assert_near(mean(&render(&scene, 64, 200)), 1.0, error);
    }
}

#[test]
fn a_map_lights_a_sphere_like_the_same_light_from_all_directions() {
    // One of the maps has a bright area straight behind the camera, which adds more light than the
    // constant radiance of all directions.
    let grey = scene(0.0, GREY, &sphere(-3.0, 1.0, "grey"));
    let middle = |environment: Environment| {
        let scene = Scene {
            environment,
            ..grey.clone()
        };
        central_pixel(&scene, 4000, 1)
    };
    let map = |bright: f32| {
        let mut pixels = vec![Vec3::splat(0.2); 512];
        // The map has 16 rows and 32 columns. These four pixels surround +z, on both sides of the
        // horizon.
        for index in [7 * 32 + 7, 7 * 32 + 8, 8 * 32 + 7, 8 * 32 + 8] {
            pixels[index] = Vec3::splat(bright);
        }
        EnvironmentMap::new(uvec2(32, 16), pixels).expect("the map is usable")
    };
    let constant = middle(Environment::Constant(Vec3::splat(0.2)));
    assert_near(middle(Environment::Map(map(0.2))), constant, 0.02);
    // The four pixels cover about (π/8)² head-on, and the albedo divided by π is 0.5 / π.
    let added = 0.5 * (100.0 - 0.2) * std::f32::consts::PI / 64.0;
    assert_near(middle(Environment::Map(map(100.0))), constant + added, 0.03);
}

#[test]
fn a_light_inside_glass_is_seen_at_a_fraction_of_its_radiance() {
    let shapes = [sphere(-3.0, 1.0, "glass"), sphere(-3.0, 0.2, "light")].join(",");
    let scene = scene(0.0, &format!("{GLASS}, {EMITTER}"), &shapes);
    // Head-on, 4% of the light is reflected. Outside, the light spreads over a solid angle that is
    // 1.5² times as large.
    assert_near(central_pixel(&scene, 4000, 8), 0.96 / 2.25, 0.01);
}

/// A camera at the origin that looks down −z and sees `half_width` to each side at distance 1.
struct Zoomed {
    half_width: f32,
    film: UVec2,
}

impl CameraRays for Zoomed {
    fn ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let position = (pixel.as_vec2() + offset) / self.film.as_vec2() * 2.0 - 1.0;
        let dir = (self.half_width * position).extend(-1.0).normalize();
        Ray::new(Vec3::ZERO, dir)
    }
}

/// Returns the mean radiance around the point where a white ball and a white sphere touch, in a
/// white furnace. They touch at `distance` in front of the camera.
fn contact_in_a_furnace(ball: f32, ground: f32, distance: f32) -> f32 {
    let side = |radius: f32| {
        format!(
            r#"{{ "sphere": {{ "center": [{radius}, 0, {}], "radius": {}, "material": "white" }} }}"#,
            -distance,
            radius.abs()
        )
    };
    let shapes = [side(ball), side(-ground)].join(",");
    let scene = scene(1.0, WHITE, &shapes);
    let film = uvec2(32, 32);
    let zoomed = Zoomed {
        half_width: 0.5 * ball / distance,
        film,
    };
    let world = World {
        camera: Box::new(zoomed),
        bvh: Student.build(&scene.shapes, 1),
    };
    let path_tracer = Light.path_tracer(&scene, &world, settings(200));
    mean(&renderer::render(&*path_tracer, film, 64))
}

#[test]
fn a_ball_on_a_large_sphere_is_invisible_in_a_white_furnace() {
    // Rays that start too far from a surface start inside the other sphere and are lost there. With
    // an offset of 1e-4 of the scene's size, a ball of radius 0.5 on a sphere of radius 1000 loses
    // 41%.
    for (ball, ground, distance) in [(0.5, 1000.0, 3.0), (0.1, 1000.0, 1.0), (0.5, 0.5, 30.0)] {
        assert_near(contact_in_a_furnace(ball, ground, distance), 1.0, 0.01);
    }
}

#[test]
fn a_grey_sphere_shows_its_albedo_in_a_white_furnace() {
    let scene = scene(1.0, GREY, &sphere(-3.0, 2.0, "grey"));
    let pixels = render(&scene, 4, 4);
    // Through the central pixel, only the sphere is visible, and rays scattered by it hit nothing
    // else.
    assert_eq!(pixels[8 * 4 + 4], Vec3::splat(0.5));
}

#[test]
fn light_inside_a_grey_shell_is_a_geometric_series() {
    // All light hits the shell, which scatters half of it at each bounce. From the second bounce
    // on, the radiance of the shell is the same everywhere, except in the small shadow of the light
    // itself.
    let shapes = [sphere(0.0, 10.0, "grey"), sphere(5.0, 0.1, "light")].join(",");
    let scene = scene(0.0, &format!("{GREY}, {EMITTER}"), &shapes);
    let mean = |bounces| mean(&render(&scene, 400, bounces));
    // Inside a sphere, scattering spreads the light evenly over the shell. So from the second
    // bounce on, the terms are power · albedoⁿ / (π · area of the shell).
    let term = |n: i32| {
        let power_over_pi = 4.0 * std::f32::consts::PI * 0.01;
        power_over_pi * 0.5_f32.powi(n) / (4.0 * std::f32::consts::PI * 100.0)
    };
    let second = mean(2) - mean(1);
    assert_near(second, term(2), 0.03);
    let rest = mean(12) - mean(2);
    let expected: f32 = (3..=12).map(term).sum();
    assert_near(rest, expected, 0.03);
}

#[test]
fn a_large_light_on_a_sphere_matches_the_closed_form() {
    let shapes = [sphere(-3.0, 1.0, "grey"), sphere(7.0, 5.0, "light")].join(",");
    let scene = scene(0.0, &format!("{GREY}, {EMITTER}"), &shapes);
    // Albedo · sin² of the half-angle that the light subtends at z = −2.
    let expected = 0.5 * (5.0_f32 / 9.0).powi(2);
    assert_near(central_pixel(&scene, 2000, 1), expected, 0.01);
}

#[test]
fn a_mirror_shows_a_light_at_its_radiance_times_the_reflectance() {
    let mirror = r#""mirror": { "mirror": { "reflectance": [0.5, 0.5, 0.5] } }"#;
    let shapes = [sphere(-3.0, 1.0, "mirror"), sphere(30.0, 25.0, "light")].join(",");
    let scene = scene(0.0, &format!("{mirror}, {EMITTER}"), &shapes);
    assert_eq!(central_pixel(&scene, 4, 1), 0.5);
}

#[test]
fn without_bounces_only_emitters_and_the_environment_are_visible() {
    let shapes = [sphere(-3.0, 1.0, "grey"), sphere(7.0, 5.0, "light")].join(",");
    let scene = scene(0.25, &format!("{GREY}, {EMITTER}"), &shapes);
    let pixels = render(&scene, 1, 0);
    assert_eq!(pixels[8 * 4 + 4], Vec3::ZERO);
    assert_eq!(pixels[0], Vec3::splat(0.25));
}
