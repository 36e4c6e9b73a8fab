//! What a walk rests on. An item names all that could fail it without the walk being wrong, and no
//! more: whoever fails it and one of these is told to mend that one first.

use grader::exam::Item;

/// What tells how far away a triangle is, or that it is not hit.
pub(super) const TRIANGLES: [&str; 6] = [
    "triangle.inside",
    "triangle.outside",
    "triangle.from_behind",
    "triangle.range_max",
    "triangle.range_min",
    "triangle.behind_the_ray",
];

/// What else is told of a hit.
pub(super) const SURFACES: [&str; 6] = [
    "triangle.position",
    "triangle.normal",
    "triangle.uv",
    "triangle.uv_corners",
    "triangle.normal_from_behind",
    "triangle.origin_and_material",
];

/// What tells how far away a sphere is, or that it is not hit.
pub(super) const SPHERES: [&str; 8] = [
    "sphere.near_side",
    "sphere.beside",
    "sphere.radius",
    "sphere.behind",
    "sphere.from_inside",
    "sphere.far_root",
    "sphere.range_max",
    "sphere.range_within",
];

/// What decides which nodes are entered, and in which order.
pub(super) const BOXES: [&str; 10] = [
    "bbox.through",
    "bbox.slab_after_slab",
    "bbox.octants",
    "bbox.behind",
    "bbox.from_inside",
    "bbox.clipped",
    "bbox.wholly_inside",
    "bbox.times_not_range",
    "bbox.axis_parallel",
    "bbox.flat",
];

/// What makes a tree that can be walked, whatever it costs.
pub(super) const TREES: [&str; 12] = [
    "build.partition",
    "build.contains",
    "build.tight",
    "build.leaf_size",
    "build.stops",
    "build.negative",
    "build.coincident",
    "build.concentric",
    "build.coplanar",
    "build.collinear",
    "build.outlier",
    "build.one_or_none",
];

/// What makes a picture's rays.
pub(super) const CAMERA: [&str; 11] = [
    "camera.corners",
    "camera.field_of_view",
    "camera.aspect_ratio",
    "camera.other_aspect",
    "camera.film",
    "camera.bottom_left",
    "camera.offset",
    "camera.offset_axes",
    "camera.large_film",
    "camera.unit_length",
    "camera.origin_and_range",
];

/// The item, resting on these as well.
pub(super) fn add(mut item: Item, needed: &[&str]) -> Item {
    item.needs.extend(needed.iter().map(|id| (*id).to_owned()));
    item
}
