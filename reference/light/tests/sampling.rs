//! Estimates with many samples match closed forms. This shows that the samples of lights and
//! environment maps really have the densities that are reported for them.

use std::f32::consts::{PI, TAU};

use framework::math::sin_cos;
use framework::render::sampler::{Purpose, Sampler};
use framework::render::sphere_light::SphereLight;
use framework::scene::EnvironmentMap;
use glam::{UVec2, Vec2, Vec3, uvec2, vec2, vec3};
use reference_light::environment::{Environment, uniform_sphere};
use reference_light::lights::{AreaLight, Light, Lights};

/// Returns random numbers to pick a light and a point on it.
fn random(n: u32) -> (f32, Vec2) {
    let sampler = Sampler::new(0, UVec2::ZERO, n);
    let (light, point) = (Purpose::Light, Purpose::PointOnLight);
    (sampler.one(0, light), sampler.pair(0, point))
}

/// Returns the integral of a function over the directions in which it isn't zero, estimated from
/// samples of the lights at the origin.
fn integral(lights: &Lights, function: impl Fn(Vec3) -> f32) -> f32 {
    let count = 40_000;
    let samples = (0..count).filter_map(|n| {
        let (choice, point) = random(n);
        let direction = lights.sample(Vec3::ZERO, choice, point)?;
        Some(function(direction) / lights.pdf(Vec3::ZERO, direction))
    });
    samples.sum::<f32>() / count as f32
}

#[track_caller]
fn assert_near(got: f32, expected: f32, error: f32) {
    assert!(
        (got / expected - 1.0).abs() < error,
        "expected {expected}, got {got}"
    );
}

#[test]
fn the_irradiance_of_a_triangle_and_a_parallelogram_matches_lamberts_formula() {
    let corners = [
        vec3(1.0, 2.0, -1.0),
        vec3(0.0, 1.0, 1.0),
        vec3(-1.0, 1.5, -0.5),
    ];
    let [p0, p1, p2] = corners;
    let triangle = AreaLight::triangle([p0, p1, p2], Vec3::ONE);
    let parallelogram = AreaLight::parallelogram(p0, [p1 - p0, p2 - p0], Vec3::ONE);
    let four_corners = [p0, p1, p1 + p2 - p0, p2];
    for (light, corners) in [(triangle, &corners[..]), (parallelogram, &four_corners)] {
        // Lambert, 1760: half of the sum, over all edges, of the angle that the edge subtends times
        // its normal.
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        let edge = |(a, b): (&Vec3, &Vec3)| a.angle_between(*b) * a.cross(*b).normalize().y;
        let expected = 0.5 * edges.map(edge).sum::<f32>().abs();
        let lights = Lights::new(vec![Light::Area(light)]);
        assert_near(integral(&lights, |direction| direction.y), expected, 0.01);
    }
}

#[test]
fn lights_are_sampled_by_power_with_the_density_of_the_sample() {
    let sphere = |center, radius, radiance| {
        let radiance = Vec3::splat(radiance);
        Light::Sphere(SphereLight {
            center,
            radius,
            radiance,
        })
    };
    let overhead = sphere(vec3(0.0, 2.0, 0.0), 1.0, 1.0);
    let aside = sphere(vec3(4.0, 3.0, 0.0), 1.0, 9.0);
    let dark = sphere(vec3(0.0, 9.0, 0.0), 5.0, 0.0);
    let lights = Lights::new(vec![overhead, aside, dark]);
    // The cones that the two spheres subtend, whose half-angles have sines of 1/2 and 1/5.
    let cone = |sine: f32| TAU * (1.0 - (1.0 - sine * sine).sqrt());
    assert_near(integral(&lights, |_| 1.0), cone(0.5) + cone(0.2), 0.02);
    assert!(
        Lights::new(vec![dark])
            .sample(Vec3::ZERO, 0.5, vec2(0.5, 0.5))
            .is_none()
    );
    assert_eq!(Lights::new(vec![dark]).pdf(Vec3::ZERO, Vec3::Y), 0.0);
}

#[test]
fn every_point_of_a_light_has_a_density_however_small_and_far_the_light_is() {
    // If a sample at the very edge of a small light had no density, the light would be divided by
    // the density of scattering alone, which is millions of times as small.
    let center = vec3(300.0, 500.0, 100.0);
    for size in [1e-2, 1.0] {
        let edges = [size * vec3(1.0, -0.6, 0.0), size * vec3(0.1, 0.0, 1.0)];
        let light = AreaLight::parallelogram(center, edges, Vec3::ONE);
        for n in 0..1000 {
            let along = n as f32 / 1000.0;
            for point in [vec2(0.0, along), vec2(along, 0.0), vec2(along, 1.0)] {
                let direction = light.point(point).normalize();
                let pdf = light.pdf(Vec3::ZERO, direction);
                assert!(pdf > 1000.0, "{point} of the light of size {size}: {pdf}");
            }
        }
    }
}

/// Returns the pixels of a map of 16 × 8 pixels: one is bright, a row is black, and the others are
/// dim.
fn pixels() -> Vec<Vec3> {
    let pixel = |index| match index {
        37 => Vec3::splat(100.0),
        48..64 => Vec3::ZERO,
        _ => Vec3::splat(0.1 + 0.01 * index as f32),
    };
    (0..128).map(pixel).collect()
}

fn environment(pixels: Vec<Vec3>) -> Environment {
    let map = EnvironmentMap::new(uvec2(16, 8), pixels);
    Environment::new(map.expect("the map is usable"))
}

/// Returns the direction at a position in a map, in pixels from the top left, and the sine of θ.
fn direction(position: Vec2) -> (Vec3, f32) {
    let (sin_phi, cos_phi) = sin_cos(TAU * position.x / 16.0);
    let (sin_theta, cos_theta) = sin_cos(PI * position.y / 8.0);
    let direction = vec3(sin_theta * cos_phi, cos_theta, sin_theta * sin_phi);
    (direction, sin_theta)
}

#[test]
fn each_pixel_shows_the_directions_within_it() {
    let environment = environment(pixels());
    for (x, y) in (0..16).flat_map(|x| (0..8).map(move |y| (x, y))) {
        for inside in [0.01, 0.5, 0.99] {
            let (direction, _) = direction(vec2(x as f32 + inside, y as f32 + inside));
            assert_eq!(environment.index(direction), 16 * y + x);
        }
    }
    let row = |direction| environment.index(direction) / 16;
    assert_eq!([row(Vec3::Y), row(Vec3::NEG_Y)], [0, 7]);
    assert_eq!(environment.index(Vec3::Z) % 16, 4);
}

#[test]
fn the_density_of_a_map_integrates_to_one() {
    let environment = environment(pixels());
    let (width, height) = (640, 320);
    let cell = 2.0 * PI * PI / (width * height) as f32;
    let mut integral = 0.0;
    for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
        let (direction, sine) = direction(vec2(x as f32 + 0.5, y as f32 + 0.5) / 40.0);
        integral += environment.pdf(direction) * sine * cell;
    }
    assert_near(integral, 1.0, 1e-3);
}

#[test]
fn samples_of_a_map_estimate_its_mean_radiance() {
    let environment = environment(pixels());
    let count = 20_000;
    let mut mean = 0.0;
    for n in 0..count {
        let (choice, position) = random(n);
        let direction = environment.sample(choice, position);
        let pdf = environment.pdf(direction);
        mean += environment.radiance(direction).x / pdf / (4.0 * PI * count as f32);
    }
    // Each pixel's radiance times its share of the sphere.
    let shares = pixels().into_iter().enumerate().map(|(index, pixel)| {
        let edge = |row: usize| sin_cos(PI * row as f32 / 8.0).1;
        let row = index / 16;
        pixel.x * (edge(row) - edge(row + 1)) / 32.0
    });
    assert_near(mean, shares.sum(), 0.01);
}

#[test]
fn black_pixels_are_never_sampled() {
    let some = environment(pixels());
    for n in 0..1000 {
        let direction = some.sample(n as f32 / 1000.0, Vec2::splat(0.5));
        assert!(some.pdf(direction) > 0.0);
    }
    let (in_black_row, _) = direction(vec2(3.5, 3.5));
    assert_eq!(some.pdf(in_black_row), 0.0);
    assert_eq!(environment(vec![Vec3::ZERO; 128]).pdf(Vec3::X), 0.0);
}

#[test]
fn uniform_directions_fill_cells_of_equal_area_evenly() {
    let mut cells = [0_u32; 64];
    for n in 0..8192 {
        let direction = uniform_sphere(random(n).1);
        let phi = direction.z.atan2(direction.x).rem_euclid(TAU);
        let cell = |fraction: f32| ((8.0 * fraction) as usize).min(7);
        cells[8 * cell(0.5 * (direction.y + 1.0)) + cell(phi / TAU)] += 1;
    }
    // Expected: 128 per cell. The χ² of 63 degrees of freedom is above the limit once in a billion.
    let squares = cells.iter().map(|&count| (count as f32 - 128.0).powi(2));
    let chi_squared = squares.sum::<f32>() / 128.0;
    assert!(chi_squared < 155.07, "{chi_squared}: {cells:?}");
}
