//! Random rooms of parallelograms, and cases in them whose answers don't depend on rounding.

use std::f64::consts::TAU;

use glam::{DVec3, UVec2, Vec2, Vec3, dvec2, uvec2};
use protocol::Ray;
use protocol::light::environment::MapImage;
use protocol::light::transport::{self as functions, DirectSample, PathStart};
use protocol::sampler::Sampler;

use super::{MARGIN, color, random, random_pair};
use crate::oracle::Ray64;
use crate::oracle::light::environment::Map64;
use crate::oracle::light::light_sources::Environment64;
use crate::oracle::light::quad::{Material64, Quad};
use crate::oracle::light::room::{Room, Surface64};
use crate::oracle::light::{Numbers64, WithMargin, numbers_of_path, transport};
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

/// Returns the six walls of a box between −`half` and `half`. Their fronts face inward.
pub(super) fn walls(half: DVec3, mut material: impl FnMut() -> Material64) -> Vec<Quad> {
    let mut walls = Vec::new();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let mut center = DVec3::ZERO;
            center[axis] = sign * half[axis];
            walls.push(panel(center, axis, -sign, half, material()));
        }
    }
    walls
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
    let mut quads = walls(HALF, || matte(rng));
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
    let all = walls(HALF, || matte(rng));
    let left = panel(DVec3::new(-HALF.x, 0.0, 0.0), 0, 1.0, HALF, left);
    let mut quads = vec![left, all[1], all[2], all[4]];
    let places = [DVec3::new(-0.5, 1.0, -0.4), DVec3::new(1.4, 0.2, -1.6)];
    for center in places.into_iter().take(lights) {
        let radiance = color(rng) * rng.log_uniform(0.5, 20.0);
        let size = DVec3::new(0.8, 0.0, 0.8);
        quads.push(panel(
            center,
            1,
            -1.0,
            size,
            Material64::Emitter { radiance },
        ));
    }
    let map = map(rng);
    Room::new(quads, map)
}

/// Returns the six sides of a box around a point. Their fronts face outward.
pub(super) fn block(center: DVec3, half: DVec3, material: Material64) -> Vec<Quad> {
    let mut sides = Vec::new();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let mut at = center;
            at[axis] += sign * half[axis];
            sides.push(panel(at, axis, sign, half, material));
        }
    }
    sides
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
    let size = uvec2(8, 4);
    let brightness = if rng.coin() {
        rng.log_uniform(1e2, 2e3)
    } else {
        1.0
    };
    let pixel = |_| match rng.index(5) {
        0 => Vec3::ZERO,
        _ => (tint(rng) * rng.log_uniform(0.02, 50.0) * brightness).as_vec3(),
    };
    let pixels: Vec<Vec3> = (0..size.element_product()).map(pixel).collect();
    Environment64::Map(Map64::new(size, &pixels))
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

/// Returns a call for which `wanted` is true of the surface that a random ray hits, of the random
/// numbers and of the surface's direct light. In some calls, the scattered direction leads to a
/// point on a light, since it would hardly ever find a small light by chance.
#[track_caller]
pub(super) fn direct_case(
    rng: &mut Rng,
    room: &Room,
    wanted: impl Fn(&Surface64, &Numbers64, DVec3) -> bool,
) -> DirectSample {
    let direct = |rng: &mut Rng, surface: &Surface64| match rng.index(4) {
        0 => toward_a_light(rng, room, surface),
        _ => Some(random_pair(rng)),
    };
    let pairs = |rng: &mut Rng, surface: &Surface64| {
        let direct = direct(rng, surface)?;
        Some([random_pair(rng), direct])
    };
    direct_case_with(rng, room, margin(room), pairs, wanted)
}

/// Like [`direct_case`], but the lights can look so small that all directions toward them are close
/// to their edges.
#[track_caller]
pub(super) fn far_case(
    rng: &mut Rng,
    room: &Room,
    wanted: impl Fn(&Surface64, &Numbers64, DVec3) -> bool,
) -> DirectSample {
    let pairs = |rng: &mut Rng, _: &Surface64| Some([random_pair(rng), random_pair(rng)]);
    direct_case_with(rng, room, 1e-4, pairs, wanted)
}

/// Like [`direct_case`], but the scattered direction is almost along the surface.
#[track_caller]
pub(super) fn grazing_case(
    rng: &mut Rng,
    room: &Room,
    wanted: impl Fn(&Surface64, &Numbers64, DVec3) -> bool,
) -> DirectSample {
    let pairs = |rng: &mut Rng, _: &Surface64| Some([random_pair(rng), along_the_surface(rng)]);
    direct_case_with(rng, room, 1e-4, pairs, wanted)
}

/// Like [`grazing_case`], but the direction toward the light is almost along the surface, too. The
/// room is one of those that [`beside_a_light`] returns.
#[track_caller]
pub(super) fn both_grazing_case(
    rng: &mut Rng,
    room: &Room,
    wanted: impl Fn(&Surface64, &Numbers64, DVec3) -> bool,
) -> DirectSample {
    let pairs = |rng: &mut Rng, _: &Surface64| {
        // Small numbers lead to the lower edge of the light.
        let low = rng.log_uniform(2e-3, 0.2) as f32;
        Some([random_pair(rng).with_y(low), along_the_surface(rng)])
    };
    direct_case_with(rng, room, 1e-5, pairs, |surface, numbers, light| {
        let sample = room.sources().sample(surface.position, numbers).value;
        let is_low = |direction| (4e-4..9e-4).contains(&surface.frame.to_local(direction).z);
        sample.is_some_and(is_low) && wanted(surface, numbers, light)
    })
}

/// Returns random numbers for which a surface scatters almost along itself.
fn along_the_surface(rng: &mut Rng) -> Vec2 {
    let below_one = 1.0 - rng.log_uniform(6e-8, 9e-7) as f32;
    random_pair(rng).with_x(below_one)
}

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

/// Returns the random numbers for which a surface scatters toward a random point on a light. Returns
/// `None` if that point is below the surface.
fn toward_a_light(rng: &mut Rng, room: &Room, surface: &Surface64) -> Option<Vec2> {
    let quads = room.quads().iter();
    let is_light = |quad: &&Quad| matches!(quad.material(), Material64::Emitter { .. });
    let lights: Vec<&Quad> = quads.filter(is_light).collect();
    let light = lights.get(rng.index(lights.len().max(1)))?;
    let to = light.shape().at(random_pair(rng).as_dvec2()) - surface.position;
    let direction = surface.frame.to_local(to.normalize());
    // The inverse of `sample_cosine_hemisphere`.
    let turn = libm::atan2(direction.y, direction.x) / TAU;
    let x = 1.0 - direction.z * direction.z;
    (direction.z > 0.0).then(|| dvec2(x, turn - turn.floor()).as_vec2())
}

/// Returns a case with at least this margin. `pairs` returns the random numbers for the point on the
/// light and for the scattered direction.
#[track_caller]
fn direct_case_with(
    rng: &mut Rng,
    room: &Room,
    margin: f64,
    pairs: impl Fn(&mut Rng, &Surface64) -> Option<[Vec2; 2]>,
    wanted: impl Fn(&Surface64, &Numbers64, DVec3) -> bool,
) -> DirectSample {
    rng.retry(|rng| {
        let ray = random_ray(rng, room);
        let surface = room.hit(&Ray64::from(&ray), None).value?;
        let light = random(rng);
        let [on_light, direct] = pairs(rng, &surface)?;
        let call = DirectSample {
            ray,
            light,
            on_light,
            direct,
        };
        let light = clear_direct(room, &call, margin)?;
        wanted(&surface, &Numbers64::from(&call), light).then_some(call)
    })
}

/// Returns the answer to a call of `direct`, whose ray hits a surface.
pub(super) fn direct_light(room: &Room, call: &DirectSample) -> DVec3 {
    let surface = room.hit(&Ray64::from(&call.ray), None).value;
    let surface = surface.expect("the ray of every call hits a surface");
    transport::direct(room, &surface, &Numbers64::from(call)).value
}

/// Returns whether a call's answer keeps the margin that the room requires.
pub(super) fn is_clear_direct(room: &Room, call: &DirectSample) -> bool {
    clear_direct(room, call, margin(room)).is_some()
}

/// Returns the answer to a call of `direct` if it has at least this margin.
fn clear_direct(room: &Room, call: &DirectSample, margin: f64) -> Option<DVec3> {
    let hit = room.hit(&Ray64::from(&call.ray), None);
    let is_clear = hit.margin > self::margin(room);
    let surface = hit.value?;
    let light = transport::direct(room, &surface, &Numbers64::from(call));
    let is_clear = is_clear && surface.out.z.abs() > least_cosine(room) && light.margin > margin;
    is_clear.then_some(light.value)
}

/// Returns a case in which `wanted` is true of the surface that a random ray hits first, if any, and
/// of the radiance along the ray.
#[track_caller]
pub(super) fn path_case(
    rng: &mut Rng,
    room: &Room,
    bounces: u32,
    wanted: impl Fn(Option<&Surface64>, &[Numbers64], DVec3) -> bool,
) -> PathStart {
    path_case_along(rng, room, bounces, |ray, numbers, light| {
        wanted(room.hit(ray, None).value.as_ref(), numbers, light)
    })
}

/// Returns a case in which `wanted` is true of a random ray, of the random numbers and of the
/// radiance along the ray.
#[track_caller]
pub(super) fn path_case_along(
    rng: &mut Rng,
    room: &Room,
    bounces: u32,
    wanted: impl Fn(&Ray64, &[Numbers64], DVec3) -> bool,
) -> PathStart {
    let seed = |rng: &mut Rng| rng.integer(0, 1 << 30);
    path_case_with(rng, room, bounces, margin(room), seed, wanted)
}

/// Like [`path_case_along`], but the first surface, if it is matte, scatters almost along itself.
#[track_caller]
pub(super) fn grazing_path_case(
    rng: &mut Rng,
    room: &Room,
    bounces: u32,
    wanted: impl Fn(&Ray64, &[Numbers64], DVec3) -> bool,
) -> PathStart {
    path_case_with(rng, room, bounces, 1e-4, grazing_seed, wanted)
}

/// Returns a seed that makes a matte first surface scatter almost along itself, at a cosine between
/// 2.4e-4 and 2.8e-3. Only about one in 120,000 seeds does.
fn grazing_seed(rng: &mut Rng) -> u32 {
    let start = rng.integer(0, 1 << 30);
    let is_grazing = |seed: &u32| {
        let numbers = Sampler::new((*seed).into(), UVec2::ZERO, 0).numbers(0);
        numbers.scatter.x > 1.0 - 8e-6
    };
    (start..).find(is_grazing).unwrap_or(start)
}

/// Returns a case with at least this margin. `seed` returns the seed of the random numbers.
#[track_caller]
fn path_case_with(
    rng: &mut Rng,
    room: &Room,
    bounces: u32,
    margin: f64,
    seed: impl Fn(&mut Rng) -> u32,
    wanted: impl Fn(&Ray64, &[Numbers64], DVec3) -> bool,
) -> PathStart {
    rng.retry(|rng| {
        let ray = random_ray(rng, room);
        let ray64 = Ray64::from(&ray);
        let seed = seed(rng);
        let call = PathStart { ray, seed, bounces };
        let radiance = path_light(room, &call);
        let hit = room.hit(&ray64, None);
        let is_clear = hit.margin > self::margin(room) && radiance.margin > margin;
        let is_wanted = is_clear && wanted(&ray64, &numbers_of_path(&call), radiance.value);
        is_wanted.then_some(call)
    })
}

/// Returns the answer to a call of `radiance`.
pub(super) fn path_light(room: &Room, call: &PathStart) -> WithMargin<DVec3> {
    transport::radiance(room, &Ray64::from(&call.ray), &numbers_of_path(call))
}

/// Returns whether a call's answer keeps the margin that the room requires.
pub(super) fn is_clear_path(room: &Room, call: &PathStart) -> bool {
    let hit = room.hit(&Ray64::from(&call.ray), None);
    hit.margin.min(path_light(room, call).margin) > margin(room)
}

/// Returns the room with matte surfaces whose albedo is multiplied by a factor.
pub(super) fn repainted(room: &Room, factor: f64) -> Room {
    let quads = room.quads().iter().map(|quad| {
        let material = match *quad.material() {
            Material64::Lambertian { albedo } => Material64::Lambertian {
                albedo: factor * albedo,
            },
            other @ (Material64::Mirror { .. }
            | Material64::Glass { .. }
            | Material64::Emitter { .. }) => other,
        };
        let shape = quad.shape();
        Quad::new(shape.corner, shape.edges, material)
    });
    Room::new(quads.collect(), room.sources().environment.clone())
}

/// Returns the room with a different size and position.
pub(super) fn moved(room: &Room, factor: f64, shift: DVec3) -> Room {
    let quads = room.quads().iter().map(|quad| {
        let shape = quad.shape();
        let edges = shape.edges.map(|edge| factor * edge);
        Quad::new(factor * shape.corner + shift, edges, *quad.material())
    });
    Room::new(quads.collect(), room.sources().environment.clone())
}

/// Returns the margin that calls in a room must have. Margins are relative to the largest coordinate,
/// so in a room that is far from the origin, all are small.
fn margin(room: &Room) -> f64 {
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
fn random_ray(rng: &mut Rng, room: &Room) -> Ray {
    let (center, half) = room.extent();
    let origin = center + half * rng.point(0.5);
    Ray::new(origin.as_vec3(), rng.direction().as_vec3())
}
