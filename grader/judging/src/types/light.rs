//! Lists of lights as text.

use protocol::light::lights::FlatLight;

use super::point;

/// Describes a single light in full. For several lights, returns only their number.
pub(super) fn text(lights: &[FlatLight]) -> String {
    let [light] = lights else {
        return format!("{} lights", lights.len());
    };
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
