//! Boxes, as the judge computes them.

use glam::DVec3;
use protocol::{Shape, TreeNode};

/// A box in f64, so that the judge's own rounding does not matter.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// The corner with the least coordinates.
    pub min: DVec3,
    /// The corner with the greatest.
    pub max: DVec3,
}

impl Bounds {
    /// Holds nothing; enclosing anything makes it that thing's box.
    pub const EMPTY: Bounds = Bounds {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// The box that stands in a node.
    pub fn of_node(node: &TreeNode) -> Self {
        Bounds {
            min: node.min.as_dvec3(),
            max: node.max.as_dvec3(),
        }
    }

    /// The tightest box around a shape.
    pub fn of_shape(shape: &Shape) -> Self {
        let corners = |corners: [glam::Vec3; 3]| {
            let [a, b, c] = corners.map(|corner| corner.as_dvec3());
            Bounds {
                min: a.min(b).min(c),
                max: a.max(b).max(c),
            }
        };
        match *shape {
            Shape::Triangle { vertices, .. } => corners(vertices.map(|vertex| vertex.position)),
            Shape::FlatTriangle {
                corners: points, ..
            } => corners(points),
            Shape::Sphere { center, radius, .. } => Bounds {
                min: center.as_dvec3() - f64::from(radius),
                max: center.as_dvec3() + f64::from(radius),
            },
        }
    }

    /// Grows until it holds `other` as well.
    pub fn enclose(&mut self, other: Bounds) {
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    /// The length of its diagonal.
    pub fn diagonal(self) -> f64 {
        (self.max - self.min).length()
    }

    /// The area of its surface.
    pub fn area(self) -> f64 {
        let size = self.max - self.min;
        2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
    }

    /// How far this box sticks out of `outer`, beyond the last bits of an f32. Never NaN: a box
    /// with one sticks out infinitely.
    pub fn excess_over(self, outer: Bounds) -> f64 {
        let last_bits = self.min.abs().max(self.max.abs()) * 2.0 * f64::from(f32::EPSILON);
        let below = (outer.min - self.min - last_bits).to_array();
        let above = (self.max - outer.max - last_bits).to_array();
        // Each by itself: the largest of numbers with a NaN among them may be a number.
        let out = below.into_iter().chain(above);
        out.map(|out| if out.is_nan() { f64::INFINITY } else { out })
            .fold(0.0, f64::max)
    }
}
