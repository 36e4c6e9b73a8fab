//! Computes bounding boxes for the judge.

use glam::DVec3;
use protocol::{Shape, TreeNode};

/// A bounding box in f64, so that the judge adds no rounding of its own.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The empty box, which contains nothing. Extending it by another box gives that box.
    pub const EMPTY: Bounds = Bounds {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// Returns the box that is stored in a node.
    pub fn of_node(node: &TreeNode) -> Self {
        Bounds {
            min: node.min.as_dvec3(),
            max: node.max.as_dvec3(),
        }
    }

    /// Returns the tightest box around a shape.
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

    /// Extends the box to contain `other`.
    pub fn enclose(&mut self, other: Bounds) {
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    /// Returns the centre.
    pub fn center(self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Returns the length of the diagonal.
    pub fn diagonal(self) -> f64 {
        (self.max - self.min).length()
    }

    /// Returns the surface area, which is 0 for an empty box.
    pub fn area(self) -> f64 {
        let size = (self.max - self.min).max(DVec3::ZERO);
        2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
    }

    /// Returns how far this box extends beyond `outer`, ignoring f32 rounding errors. A box with a
    /// NaN extends infinitely far, so the result is never NaN.
    pub fn excess_over(self, outer: Bounds) -> f64 {
        let last_bits = self.min.abs().max(self.max.abs()) * 2.0 * f64::from(f32::EPSILON);
        let below = (outer.min - self.min - last_bits).to_array();
        let above = (self.max - outer.max - last_bits).to_array();
        // Replace NaN in each number separately, because `f64::max` ignores NaN.
        let out = below.into_iter().chain(above);
        out.map(|out| if out.is_nan() { f64::INFINITY } else { out })
            .fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn sizes_of_a_box_come_from_its_three_sides() {
        let bounds = Bounds {
            min: DVec3::new(-1.0, 2.0, 5.0),
            max: DVec3::new(1.0, 5.0, 11.0),
        };
        assert_eq!(bounds.area(), 2.0 * (2.0 * 3.0 + 3.0 * 6.0 + 6.0 * 2.0));
        assert_eq!(bounds.diagonal(), 7.0);
        assert_eq!(Bounds::EMPTY.area(), 0.0);
    }

    #[test]
    fn the_box_of_a_shape_touches_it_on_every_side() {
        // Each corner determines two of the box's sides.
        let corners = [
            Vec3::new(-4.0, 7.0, 1.0),
            Vec3::new(2.0, -5.0, 3.0),
            Vec3::new(0.0, 6.0, -8.0),
        ];
        let shape = 0;
        for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
            let bounds = Bounds::of_shape(&Shape::FlatTriangle {
                corners: order.map(|corner| corners[corner]),
                shape,
            });
            assert_eq!(bounds.min, DVec3::new(-4.0, -5.0, -8.0));
            assert_eq!(bounds.max, DVec3::new(2.0, 7.0, 3.0));
        }
        let bounds = Bounds::of_shape(&Shape::Sphere {
            center: Vec3::new(1.0, 2.0, 3.0),
            radius: 0.5,
            shape,
        });
        assert_eq!(bounds.min, DVec3::new(0.5, 1.5, 2.5));
        assert_eq!(bounds.max, DVec3::new(1.5, 2.5, 3.5));
    }

    #[test]
    fn an_excess_of_the_last_bits_is_rounding() {
        let bit = 1000.0 * f64::from(f32::EPSILON);
        // The tolerance depends on the coordinate farther from 0, which can be either of the two.
        for (min, max) in [(-1000.0, 1000.0), (-1000.0, -1.0), (1.0, 1000.0)] {
            let (min, max) = (DVec3::splat(min), DVec3::splat(max));
            let outer = Bounds { min, max };
            for side in [DVec3::X, DVec3::Y, DVec3::Z] {
                let excess = |by: f64| {
                    let (mut above, mut below) = (outer, outer);
                    above.max += by * side;
                    below.min -= by * side;
                    [above.excess_over(outer), below.excess_over(outer)]
                };
                assert_eq!(excess(bit), [0.0, 0.0]);
                assert!(excess(3.0 * bit).iter().all(|&excess| excess > 0.0));
                assert!(excess(1.0).iter().all(|excess| (excess - 1.0).abs() < 1e-3));
            }
        }
    }
}
