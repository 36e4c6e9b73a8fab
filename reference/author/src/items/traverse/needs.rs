//! Dependencies of the traversal items. An item depends only on items about mistakes that could
//! make it fail even if the traversal is correct. A student who fails an item and one of its
//! dependencies is advised to fix the dependency first.

use judging::exam::Item;

/// Items about whether a ray hits a triangle, and at which distance.
pub(super) const TRIANGLES: [&str; 6] = [
    "triangle.inside",
    "triangle.outside",
    "triangle.from_behind",
    "triangle.range_max",
    "triangle.range_min",
    "triangle.behind_the_ray",
];

/// Items about the other quantities of a hit on a triangle.
pub(super) const SURFACES: [&str; 6] = [
    "triangle.position",
    "triangle.normal",
    "triangle.uv",
    "triangle.uv_corners",
    "triangle.normal_from_behind",
    "triangle.origin_and_material",
];

/// Items about whether a ray hits a sphere, and at which distance.
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

/// Items about boxes, which decide which nodes are entered and in which order.
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

/// Items about building a tree that can be traversed, whatever its cost.
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

/// Items about the rays of a picture.
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

/// Adds these items to the dependencies of an item.
pub(super) fn add(mut item: Item, needed: &[&str]) -> Item {
    item.needs.extend(needed.iter().map(|id| (*id).to_owned()));
    item
}
