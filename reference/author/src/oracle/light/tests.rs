//! Rooms whose light is known: furnaces, mirrors and a rectangular light.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, dvec3};

use super::light_sources::Environment64;
use super::quad::{Material64, Quad};
use super::room::Room;
use super::transport::{direct, radiance};
use super::{Numbers64, grid};
use crate::oracle::Ray64;

const NUMBERS: Numbers64 = Numbers64 {
    light: 0.3,
    on_light: DVec2::new(0.4, 0.7),
    direct: DVec2::new(0.2, 0.6),
    scatter: DVec2::new(0.2, 0.6),
    reflect: 0.9,
    survive: 0.5,
};

const GREY: Material64 = Material64::Lambertian {
    albedo: DVec3::splat(0.5),
};

/// The reflectance is exact in single precision.
const MIRROR: Material64 = Material64::Mirror {
    reflectance: DVec3::splat(0.875),
};

fn ray(origin: DVec3, toward: DVec3) -> Ray64 {
    Ray64 {
        origin,
        dir: (toward - origin).normalize(),
        min: 0.0,
        max: f64::INFINITY,
    }
}

/// A square parallel to the floor with its middle on the y-axis. Its front is up or down.
fn square(height: f64, half: f64, is_up: bool, material: Material64) -> Quad {
    let (x, z) = (2.0 * half * DVec3::X, 2.0 * half * DVec3::Z);
    let edges = if is_up { [z, x] } else { [x, z] };
    Quad::new(dvec3(-half, height, -half), edges, material)
}

/// A room with an even environment.
fn room(quads: Vec<Quad>, environment: f64) -> Room {
    let radiance = DVec3::splat(environment);
    Room::new(quads, Environment64::Constant(radiance))
}

#[test]
fn the_first_hit_and_its_sides_are_found() {
    let glass = Material64::Glass { ior: 1.5 };
    let quads = vec![square(0.0, 2.0, true, glass), square(1.0, 1.0, true, GREY)];
    let room = room(quads, 0.0);
    let above = room.hit(&ray(4.0 * DVec3::Y, DVec3::ZERO), None);
    let surface = above.value.expect("the upper square is hit");
    assert_eq!((surface.position, surface.material), (DVec3::Y, GREY));
    assert!(surface.out.abs_diff_eq(DVec3::Z, 1e-15));
    // The edges are at a distance of 1, relative to the largest coordinate.
    assert!((above.margin - 0.25).abs() < 1e-15, "{}", above.margin);

    // The normal of glass points out of the glass, and any other normal is on the side of the ray.
    let below = room.hit(&ray(-4.0 * DVec3::Y, DVec3::ZERO), None);
    let lower = below.value.expect("the lower square is hit");
    assert_eq!((lower.position, lower.material), (DVec3::ZERO, glass));
    assert!(lower.out.abs_diff_eq(DVec3::NEG_Z, 1e-15));
    let upward = room.hit(&ray(lower.position, DVec3::Y), Some(&lower));
    let upper = upward.value.expect("the upper square is hit");
    assert!(upper.out.abs_diff_eq(DVec3::Z, 1e-15));
    let away = room.hit(&ray(lower.position, DVec3::NEG_Y), Some(&lower));
    assert!(away.value.is_none() && away.margin > 0.1, "{}", away.margin);
}

#[test]
fn in_an_even_environment_a_surface_has_the_radiance_of_its_albedo() {
    for (material, expected) in [(GREY, 0.5), (MIRROR, 0.875)] {
        let room = room(vec![square(0.0, 9.0, true, material)], 1.0);
        for (bounces, is_seen) in [(0, 0.0), (1, 1.0), (3, 1.0)] {
            let ray = ray(dvec3(1.0, 2.0, 0.0), dvec3(0.0, 0.0, 1.0));
            let found = radiance(&room, &ray, &vec![NUMBERS; bounces]).value.x;
            // A path that ends at a mirror doesn't see what is behind it.
            assert!((found - is_seen * expected).abs() < 1e-14, "{found}");
        }
    }
}

#[test]
fn in_an_even_environment_glass_is_invisible() {
    let glass = Material64::Glass { ior: 1.5 };
    let mut quads = vec![
        square(1.0, 1.0, true, glass),
        square(-1.0, 1.0, false, glass),
    ];
    // The four sides, whose corners run counterclockwise when seen from outside.
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    for (index, (x, z)) in corners.into_iter().enumerate() {
        let (to_x, to_z) = corners[(index + 1) % 4];
        let edges = [dvec3(to_x - x, 0.0, to_z - z), 2.0 * DVec3::Y];
        quads.push(Quad::new(dvec3(x, -1.0, z), edges, glass));
    }
    let room = room(quads, 1.0);
    for at in grid(5) {
        let from = 6.0 * dvec3(at.x - 0.5, 1.0, at.y - 0.5);
        let found = radiance(&room, &ray(from, DVec3::ZERO), &[NUMBERS; 3]);
        assert!(found.value.abs_diff_eq(DVec3::ONE, 1e-14), "{found:?}");
        // From bounce 3 on, the path would be divided by its probability of survival.
        assert!(found.margin > 1e-3, "{found:?}");
    }
}

#[test]
fn the_mean_of_direct_light_matches_the_irradiance_of_a_rectangle() {
    // A rectangle with sides a and b at height c above a corner, parallel to the floor. See Howell,
    // "A Catalog of Radiation Heat Transfer Configuration Factors", B-3.
    let (a, b, c) = (2.0, 1.0, 1.5);
    let factor = |a: f64, b: f64| {
        let (x, y) = (libm::sqrt(a * a + c * c), libm::sqrt(b * b + c * c));
        (a / x * libm::atan(b / x) + b / y * libm::atan(a / y)) / (2.0 * PI)
    };
    let light = Material64::Emitter {
        radiance: DVec3::splat(8.0),
    };
    let edges = [a * DVec3::X, b * DVec3::Z];
    let lamp = Quad::new(c * DVec3::Y, edges, light);
    // A blocker that hides the part with x < 1 from the origin.
    let blocker = Quad::new(
        dvec3(0.0, 0.75, 0.0),
        [0.5 * DVec3::X, 0.5 * DVec3::Z],
        GREY,
    );
    let floor = square(0.0, 9.0, true, GREY);
    for (quads, expected) in [
        (vec![floor, lamp], factor(a, b)),
        (vec![floor, lamp, blocker], factor(a, b) - factor(1.0, b)),
    ] {
        let room = room(quads, 0.0);
        let hit = room.hit(&ray(0.5 * DVec3::Y, DVec3::ZERO), None);
        let surface = hit.value.expect("the floor is hit");
        let side = 300;
        let values = grid(side).flat_map(|random| {
            // The light's two triangles have the same power.
            [0.25, 0.75].map(|light| {
                let numbers = Numbers64 {
                    light,
                    on_light: random,
                    direct: random,
                    ..NUMBERS
                };
                direct(&room, &surface, &numbers).value.x
            })
        });
        let mean = values.sum::<f64>() / f64::from(2 * side * side);
        let expected = 0.5 * 8.0 * expected;
        assert!((mean / expected - 1.0).abs() < 5e-3, "{mean} {expected}");
    }
}

#[test]
fn light_is_counted_once_after_a_matte_surface_and_after_a_mirror() {
    let light = Material64::Emitter {
        radiance: DVec3::ONE,
    };
    let lamp = square(2.0, 9.0, false, light);
    let view = ray(dvec3(0.5, 1.0, 0.0), DVec3::ZERO);
    let on = |floor, bounces| {
        let room = room(vec![square(0.0, 9.0, true, floor), lamp], 0.0);
        radiance(&room, &view, &vec![NUMBERS; bounces]).value.x
    };
    assert_eq!(
        (on(MIRROR, 0), on(MIRROR, 1), on(MIRROR, 2)),
        (0.0, 0.875, 0.875)
    );
    let once = on(GREY, 1);
    assert!(once > 0.0 && on(GREY, 2) == once);
}

#[test]
fn roulette_keeps_the_mean() {
    // Five reflections between two mirrors, then the environment.
    let mirrors = vec![
        square(0.0, 5.0, true, MIRROR),
        square(2.0, 5.0, false, MIRROR),
    ];
    let room = room(mirrors, 1.0);
    let view = ray(dvec3(-4.0, 1.0, 0.0), dvec3(-3.0, 0.0, 0.0));
    let path = |survive: [f64; 2]| {
        let mut numbers = [NUMBERS; 9];
        numbers[3].survive = survive[0];
        numbers[4].survive = survive[1];
        radiance(&room, &view, &numbers).value.x
    };
    let side = 200;
    let mean = grid(side).map(|DVec2 { x, y }| path([x, y])).sum::<f64>();
    let mean = mean / f64::from(side * side);
    let expected = 0.875_f64.powi(5);
    assert!((mean / expected - 1.0).abs() < 5e-3, "{mean} {expected}");
    // The path survives if the number is less than the throughput after the bounce.
    let q = 0.875_f64.powi(4);
    assert_eq!(path([q + 1e-9, 0.0]), 0.0);
    assert!(path([q - 1e-9, 0.0]) > 0.0);
    let mut numbers = [NUMBERS; 9];
    numbers[3].survive = q + 1e-3;
    assert!((radiance(&room, &view, &numbers).margin - 1e-3).abs() < 1e-12);
}
