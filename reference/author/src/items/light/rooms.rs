//! Random rooms of parallelograms, and random rays in them.

use glam::{DVec3, Vec3, uvec2};
use protocol::Ray;
use protocol::light::environment::MapImage;
use protocol::light::transport as functions;

use super::{MARGIN, color};
use crate::oracle::light::environment::Map64;
use crate::oracle::light::light_sources::Environment64;
use crate::oracle::light::quad::{Material64, Quad};
use crate::oracle::light::room::Room;
use crate::seed::Rng;

/// Half the size of most rooms.
pub(super) const HALF: DVec3 = DVec3::new(2.5, 2.0, 3.0);

/// Returns a random colour. In some colours, one of the channels is black.
fn tint(rng: &mut Rng) -> DVec3 {
    let mut tint = color(rng);
    if rng.index(3) == 0 {
        tint[rng.index(3)] = 0.0;
    }
    tint
}

/// Returns a matte material with a random colour.
pub(super) fn matte(rng: &mut Rng) -> Material64 {
    Material64::Lambertian { albedo: tint(rng) }
}

/// Returns a light with a random colour. Some lights are very dim, and some are very bright.
pub(super) fn emitter(rng: &mut Rng) -> Material64 {
    let brightness = match rng.index(4) {
        0 => rng.log_uniform(1e-6, 0.05),
        1 => rng.log_uniform(5e3, 2e6),
        _ => rng.log_uniform(0.05, 500.0),
    };
    Material64::Emitter {
        radiance: tint(rng) * brightness,
    }
}

/// Returns the six walls of a box between −[`HALF`] and [`HALF`]. Their fronts face inward.
pub(super) fn walls(materials: impl IntoIterator<Item = Material64>) -> Vec<Quad> {
    sides(DVec3::ZERO, HALF, -1.0, materials)
}

/// Returns a closed room with these walls and a light just below the ceiling.
pub(super) fn closed_room(rng: &mut Rng, walls: impl IntoIterator<Item = Material64>) -> Room {
    let mut quads = self::walls(walls);
    quads.push(light_below_the_ceiling(rng, 1.0));
    Room::new(quads, DARK)
}

/// Returns a square light just below the ceiling. `half` is half of its width.
pub(super) fn light_below_the_ceiling(rng: &mut Rng, half: f64) -> Quad {
    let light = emitter(rng);
    panel(1.8 * DVec3::Y, 1, -1.0, DVec3::splat(half), light)
}

/// Returns a rectangle around a point, perpendicular to an axis. `half` is half of its size along
/// the other axes, and `facing` the sign of its normal.
pub(super) fn panel(
    center: DVec3,
    axis: usize,
    facing: f64,
    half: DVec3,
    material: Material64,
) -> Quad {
    let mut edges = [DVec3::ZERO; 2];
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    edges[0][u] = 2.0 * half[u];
    edges[1][v] = 2.0 * half[v];
    // The cross product of the two edges points along the axis.
    if facing < 0.0 {
        edges.swap(0, 1);
    }
    let corner = center - 0.5 * (edges[0] + edges[1]);
    Quad::new(corner, edges, material)
}

/// Returns a tilted rectangle around a point.
pub(super) fn tilted(rng: &mut Rng, center: DVec3, size: f64, material: Material64) -> Quad {
    let first = rng.direction();
    let second = rng.perpendicular_to(first);
    let edges = [first * size, second * size];
    Quad::new(center - 0.5 * (edges[0] + edges[1]), edges, material)
}

/// Returns a room that is open at +z, under a uniform sky. The ceiling is a light, so most directions
/// soon find it or the sky.
pub(super) fn with_shining_ceiling(rng: &mut Rng) -> Room {
    let mut quads = walls(rng.list(6, matte));
    quads.pop();
    let light = emitter(rng);
    quads[3] = panel(HALF.y * DVec3::Y, 1, -1.0, HALF, light);
    let sky = sky(rng);
    Room::new(quads, sky)
}

/// Returns a room without a ceiling and without the wall at +z, under an environment map. `left` is
/// the material of the wall at −x, whose frame isn't that of the world. `lights` is the number of
/// lights above the floor, at most two.
pub(super) fn under_a_map(rng: &mut Rng, left: Material64, lights: usize) -> Room {
    let all = walls(rng.list(6, matte));
    let left = panel(DVec3::new(-HALF.x, 0.0, 0.0), 0, 1.0, HALF, left);
    let mut quads = vec![left, all[1], all[2], all[4]];
    let places = [DVec3::new(-0.5, 1.0, -0.4), DVec3::new(1.4, 0.2, -1.6)];
    for center in places.into_iter().take(lights) {
        let radiance = color(rng) * rng.log_uniform(0.5, 20.0);
        let light = Material64::Emitter { radiance };
        quads.push(panel(center, 1, -1.0, DVec3::splat(0.8), light));
    }
    let map = map(rng);
    Room::new(quads, map)
}

/// Returns the six sides of a box around a point. Their fronts face outward.
pub(super) fn block(center: DVec3, half: DVec3, material: Material64) -> Vec<Quad> {
    sides(center, half, 1.0, [material; 6])
}

/// Returns the six sides of a box around a point. `facing` is 1 if their fronts face outward, and −1
/// if they face inward.
fn sides(
    center: DVec3,
    half: DVec3,
    facing: f64,
    materials: impl IntoIterator<Item = Material64>,
) -> Vec<Quad> {
    let sides = (0..3).flat_map(|axis| [(axis, -1.0), (axis, 1.0)]);
    let sides = sides.zip(materials).map(|((axis, sign), material)| {
        let center = center + sign * half * DVec3::AXES[axis];
        panel(center, axis, facing * sign, half, material)
    });
    sides.collect()
}

/// Returns an environment with the same random radiance from all directions. Some are very dim, and
/// some are very bright.
pub(super) fn sky(rng: &mut Rng) -> Environment64 {
    let brightness = match rng.index(3) {
        0 => rng.log_uniform(1e-6, 1e-3),
        1 => rng.log_uniform(1e3, 1e6),
        _ => 2.0,
    };
    Environment64::Constant(color(rng) * brightness)
}

/// Returns an environment map with random pixels, whose brightness is very uneven. Some are black.
/// Some maps are very bright as a whole.
fn map(rng: &mut Rng) -> Environment64 {
    let brightness = if rng.coin() {
        rng.log_uniform(1e2, 2e3)
    } else {
        1.0
    };
    let pixels = rng.list(8 * 4, |rng| match rng.index(5) {
        0 => Vec3::ZERO,
        _ => (tint(rng) * rng.log_uniform(0.02, 50.0) * brightness).as_vec3(),
    });
    Environment64::Map(Map64::new(uvec2(8, 4), &pixels))
}

/// Converts a room to the one in a question.
pub(super) fn subject(room: &Room) -> functions::Room {
    let map = match &room.sources().environment {
        Environment64::Constant(_) => None,
        Environment64::Map(map) => Some(MapImage {
            size: map.size(),
            pixels: map.pixels().iter().map(|pixel| pixel.as_vec3()).collect(),
        }),
    };
    functions::Room {
        scene: room.text(),
        map,
    }
}

/// Returns whether light arrives.
pub(super) fn is_lit(light: DVec3) -> bool {
    light.max_element() > 1e-12
}

/// An environment without light.
pub(super) const DARK: Environment64 = Environment64::Constant(DVec3::ZERO);

/// Returns a floor with a low light at its edge, like a glowing skirting board. The floor is at y = 0,
/// so heights above it are hardly rounded.
pub(super) fn beside_a_light(rng: &mut Rng, environment: Environment64) -> Room {
    let half = DVec3::new(8.0, 0.1, 8.0);
    let floor = Material64::Lambertian { albedo: color(rng) };
    let radiance = color(rng) * rng.log_uniform(0.5, 50.0);
    let light = Material64::Emitter { radiance };
    let quads = vec![
        panel(DVec3::ZERO, 1, 1.0, half, floor),
        panel(DVec3::new(half.x, half.y, 0.0), 0, -1.0, half, light),
    ];
    Room::new(quads, environment)
}

/// Returns the room with matte surfaces whose albedo is multiplied by a factor.
pub(super) fn repainted(room: &Room, factor: f64) -> Room {
    changed(room, |quad| {
        let mut material = *quad.material();
        if let Material64::Lambertian { albedo } = &mut material {
            *albedo *= factor;
        }
        Quad::new(quad.shape().corner, quad.shape().edges, material)
    })
}

/// Returns the room with a different size and position.
pub(super) fn moved(room: &Room, factor: f64, shift: DVec3) -> Room {
    changed(room, |quad| {
        let shape = quad.shape();
        let edges = shape.edges.map(|edge| factor * edge);
        Quad::new(factor * shape.corner + shift, edges, *quad.material())
    })
}

/// Returns the room with each quad replaced.
fn changed(room: &Room, change: impl Fn(&Quad) -> Quad) -> Room {
    let quads = room.quads().iter().map(change).collect();
    Room::new(quads, room.sources().environment.clone())
}

/// Returns the margin that calls in a room must have. Margins are relative to the largest coordinate,
/// so in a room that is far from the origin, all are small.
pub(super) fn margin(room: &Room) -> f64 {
    MARGIN / remoteness(room)
}

/// Returns the smallest cosine of the angle at which a ray in a call of `direct` may hit its surface.
/// At smaller angles, rounding moves the hit along the surface.
pub(super) fn least_cosine(room: &Room) -> f64 {
    1e-3 * remoteness(room)
}

/// Returns how far from the origin a room extends, relative to its size. Rounding errors are
/// proportional to this number, which is about 1 for rooms around the origin.
fn remoteness(room: &Room) -> f64 {
    let (center, half) = room.extent();
    1.0 + center.length() / half.max_element()
}

/// Returns a ray from a random point near the middle of a room in a random direction.
pub(super) fn random_ray(rng: &mut Rng, room: &Room) -> Ray {
    let (center, half) = room.extent();
    let origin = center + half * rng.point(0.5);
    Ray::new(origin.as_vec3(), rng.direction().as_vec3())
}
