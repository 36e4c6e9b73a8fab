//! Lists of lights and rooms as text.

use glam::Vec3;
use protocol::light::environment::MapImage;
use protocol::light::lights::{FlatLight, ListedLight, SphericalLight};
use protocol::light::transport::Room;
use serde_json::Value as Json;

use super::{number, point};

/// Describes a single light in full. For several lights, returns only their number.
pub(super) fn text(lights: &[ListedLight]) -> String {
    match lights {
        [ListedLight::Flat(light)] => flat_text(light),
        [ListedLight::Sphere(light)] => sphere_text(light),
        _ => many_text(lights),
    }
}

/// Describes a map by its size and says whether it is black.
pub(super) fn map_text(map: &MapImage) -> String {
    let is_black = map.pixels.iter().all(|pixel| *pixel == Vec3::ZERO);
    let kind = if is_black { "a black map" } else { "a map" };
    format!("{kind} of {}×{} pixels", map.size.x, map.size.y)
}

/// The material kinds of scene files, each with the words for one and for several surfaces.
const SURFACES: [(&str, [&str; 2]); 4] = [
    ("lambertian", ["Lambertian surface", "Lambertian surfaces"]),
    ("mirror", ["mirror", "mirrors"]),
    ("glass", ["glass surface", "glass surfaces"]),
    ("emitter", ["light", "lights"]),
];

/// Describes a room by its surfaces and its environment map.
pub(super) fn room_text(room: &Room) -> String {
    let scene: Json = serde_json::from_str(&room.scene).unwrap_or_default();
    let surfaces = scene["shapes"].as_array().map_or(&[][..], Vec::as_slice);
    let materials = surfaces.iter().filter_map(|surface| {
        let name = surface["polygon"]["material"].as_str()?;
        Some(&scene["materials"][name])
    });
    let counted = SURFACES.iter().filter_map(|(kind, [one, several])| {
        let is_kind = |material: &&Json| material.get(kind).is_some();
        match materials.clone().filter(is_kind).count() {
            0 => None,
            1 => Some(format!("1 {one}")),
            count => Some(format!("{count} {several}")),
        }
    });
    let counted: Vec<String> = counted.collect();
    let mut text = "a room".to_owned();
    if !counted.is_empty() {
        text += &format!(" of {}", counted.join(", "));
    }
    if let Some(map) = &room.map {
        text += &format!(" under {}", map_text(map));
    }
    text
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
