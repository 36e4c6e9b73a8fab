//! Planes spanned by two axes, seen along the third.

use glam::{DVec2, DVec3, dvec2};

/// The names of the axes.
pub(super) const AXIS_NAMES: [&str; 3] = ["x", "y", "z"];

/// The plane spanned by two axes. The first points to the right, the second up.
#[derive(Clone, Copy)]
pub(super) struct Plane(usize, usize);

impl Plane {
    /// Creates the plane spanned by two different axes, in any order.
    pub(super) fn of(a: usize, b: usize) -> Plane {
        Plane(a.min(b), a.max(b))
    }

    /// Projects a point onto the plane.
    pub(super) fn project(self, point: DVec3) -> DVec2 {
        dvec2(point[self.0], point[self.1])
    }

    /// Returns the axis along which the plane is seen.
    pub(super) fn normal_axis(self) -> usize {
        3 - self.0 - self.1
    }

    /// Returns a label that says which axis points where.
    pub(super) fn name(self) -> String {
        let (a, b) = (AXIS_NAMES[self.0], AXIS_NAMES[self.1]);
        format!("{a} to the right, {b} up")
    }
}
