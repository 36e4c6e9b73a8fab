//! Lists of lights and rooms as text.

use glam::Vec3;
use protocol::light::environment::MapImage;
use protocol::light::lights::{FlatLight, ListedLight, SphericalLight};
use protocol::light::transport::Room;

use super::{number, point};

/// Describes a single light in full. For several lights, returns only their number.
pub(super) fn text(lights: &[ListedLight]) -> String {
    match lights {
        [ListedLight::Flat(light)] => flat_text(light),
        [ListedLight::Sphere(light)] => sphere_text(light),
        _ => many_text(lights),
    }
}

/// Describes a map by its size, and says whether it is black.
pub(super) fn map_text(map: &MapImage) -> String {
    let is_black = map.pixels.iter().all(|pixel| *pixel == Vec3::ZERO);
    let kind = if is_black { "a black map" } else { "a map" };
    format!("{kind} of {}×{} pixels", map.size.x, map.size.y)
}

/// Describes a room by its environment.
pub(super) fn room_text(room: &Room) -> String {
    match &room.map {
        Some(map) => format!("a room under {}", map_text(map)),
        None => "a room".to_owned(),
    }
}

/// Returns the number of lights, and how many of them are spheres, if any.
fn many_text(lights: &[ListedLight]) -> String {
    let is_sphere = |light: &&ListedLight| matches!(light, ListedLight::Sphere(_));
    let all = lights.len();
    match lights.iter().filter(is_sphere).count() {
        0 => format!("{all} lights"),
        1 => format!("{all} lights, 1 of them a sphere"),
        spheres => format!("{all} lights, {spheres} of them spheres"),
    }
}

fn sphere_text(light: &SphericalLight) -> String {
    let [center, radiance] = [light.center, light.radiance].map(point::text);
    let radius = number(light.radius);
    format!("spherical light at {center} with radius {radius}, radiance {radiance}")
}

fn flat_text(light: &FlatLight) -> String {
    let FlatLight {
        corner,
        edges: [first, second],
        is_triangle,
        radiance,
    } = *light;
    let kind = if is_triangle {
        "triangular light"
    } else {
        "parallelogram light"
    };
    let [corner, first, second, radiance] = [corner, first, second, radiance].map(point::text);
    format!("{kind} at {corner} with edges {first} and {second}, radiance {radiance}")
}
