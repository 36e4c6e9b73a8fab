//! Intersects rays with boxes by clipping the ray to each pair of planes in turn.

use glam::{DVec3, Vec3};

use super::Ray64;

/// A box, in double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// Creates a box from its corners in single precision.
    pub fn new(min: Vec3, max: Vec3) -> Bounds {
        Bounds {
            min: min.as_dvec3(),
            max: max.as_dvec3(),
        }
    }

    /// Returns the tightest box around some points.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Bounds {
        let empty = Bounds {
            min: DVec3::INFINITY,
            max: DVec3::NEG_INFINITY,
        };
        points.into_iter().fold(empty, |bounds, point| Bounds {
            min: bounds.min.min(point),
            max: bounds.max.max(point),
        })
    }

    /// Returns the tightest box around some boxes.
    pub fn enclosing(boxes: impl IntoIterator<Item = Bounds>) -> Bounds {
        let empty = Bounds::around([]);
        boxes.into_iter().fold(empty, |all, next| all.union(&next))
    }

    /// Returns the tightest box around this box and another.
    pub fn union(&self, other: &Bounds) -> Bounds {
        Bounds {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Returns this box with infinite extent along all axes but one.
    pub fn slab(&self, axis: usize) -> Bounds {
        let mut slab = Bounds {
            min: DVec3::NEG_INFINITY,
            max: DVec3::INFINITY,
        };
        slab.min[axis] = self.min[axis];
        slab.max[axis] = self.max[axis];
        slab
    }

    /// Returns the length of the diagonal.
    pub fn diagonal(&self) -> f64 {
        self.min.distance(self.max)
    }

    /// Returns half of the longest side.
    pub fn half_side(&self) -> f64 {
        0.5 * (self.max - self.min).max_element()
    }

    /// Returns the centre.
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Returns the total area of the six faces.
    pub fn area(&self) -> f64 {
        let size = self.max - self.min;
        2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
    }

    /// Returns whether the other box is inside this one.
    pub fn contains(&self, other: &Bounds) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }

    /// Returns a box that is larger by `margin` on every side.
    pub fn grown(&self, margin: f64) -> Bounds {
        Bounds {
            min: self.min - margin,
            max: self.max + margin,
        }
    }

    /// Returns the part of the ray's range that is inside the box, or `None` if the ray misses the
    /// box.
    pub fn span(&self, ray: &Ray64) -> Option<(f64, f64)> {
        let mut inside = (ray.min, ray.max);
        for axis in 0..3 {
            let (from, step) = (ray.origin[axis], ray.dir[axis]);
            if step == 0.0 {
                if from < self.min[axis] || from > self.max[axis] {
                    return None;
                }
                continue;
            }
            let (low, high) = (self.min[axis] - from, self.max[axis] - from);
            let (enter, leave) = if step > 0.0 {
                (low / step, high / step)
            } else {
                (high / step, low / step)
            };
            inside = (inside.0.max(enter), inside.1.min(leave));
        }
        (inside.0 <= inside.1).then_some(inside)
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};
    use protocol::Ray;

    use super::*;

    const BOX: Bounds = Bounds {
        min: DVec3::new(-1.0, -2.0, -3.0),
        max: DVec3::new(1.0, 2.0, 3.0),
    };

    fn span(ray: Ray) -> Option<(f64, f64)> {
        BOX.span(&Ray64::from(&ray))
    }

    #[test]
    fn spans_match_hand_computed_values() {
        let ray = Ray::new(vec3(-5.0, 0.0, 0.0), Vec3::X);
        assert_eq!(span(ray), Some((4.0, 6.0)));
        assert_eq!(span(ray.within(5.0, 5.5)), Some((5.0, 5.5)));
        assert_eq!(span(ray.within(0.0, 3.0)), None);
        assert_eq!(
            span(Ray::new(vec3(0.0, 0.0, 2.0), Vec3::Z)),
            Some((0.0, 1.0))
        );
        assert_eq!(span(Ray::new(vec3(0.0, 0.0, 4.0), Vec3::Z)), None);
        assert_eq!(span(Ray::new(vec3(-5.0, 3.0, 0.0), Vec3::X)), None);
    }

    #[test]
    fn a_flat_box_has_a_span_of_one_point() {
        let flat = Bounds {
            min: DVec3::new(-1.0, 0.0, -1.0),
            max: DVec3::new(1.0, 0.0, 1.0),
        };
        let ray = Ray::new(vec3(0.5, 2.0, 0.5), Vec3::NEG_Y);
        assert_eq!(flat.span(&Ray64::from(&ray)), Some((2.0, 2.0)));
    }
}
