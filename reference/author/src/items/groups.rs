//! The groups of items in the assignment `rays`.

use super::Group;

/// The rays of a picture.
pub(super) const CAMERA_RAYS: Group = Group("camera rays");
/// Whether a triangle is hit, and at what distance.
pub(super) const TRIANGLE_HITS: Group = Group("triangle hits");
/// The other quantities of a hit on a triangle.
pub(super) const TRIANGLE_SURFACE: Group = Group("triangle surface");
/// Whether a sphere is hit, and at what distance.
pub(super) const SPHERE_HITS: Group = Group("sphere hits");
/// The other quantities of a hit on a sphere.
pub(super) const SPHERE_SURFACE: Group = Group("sphere surface");
/// Boxes. They decide which nodes are entered, and in what order.
pub(super) const BOXES: Group = Group("boxes");
/// Building a tree that can be traversed, regardless of its cost.
pub(super) const TREES: Group = Group("trees");
