//! The groups of items of the assignment `rays`.

use super::Group;

/// The rays of a picture.
pub(super) const CAMERA_RAYS: Group = Group("camera rays");
/// The distance and the misses of triangles.
pub(super) const TRIANGLE_HITS: Group = Group("triangle hits");
/// The other quantities of a triangle's hit.
pub(super) const TRIANGLE_SURFACE: Group = Group("triangle surface");
/// The distance and the misses of spheres.
pub(super) const SPHERE_HITS: Group = Group("sphere hits");
/// The other quantities of a sphere's hit.
pub(super) const SPHERE_SURFACE: Group = Group("sphere surface");
/// Boxes, which decide which nodes are entered and in which order.
pub(super) const BOXES: Group = Group("boxes");
/// Building a tree that can be traversed, regardless of its cost.
pub(super) const TREES: Group = Group("trees");
