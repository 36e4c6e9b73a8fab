//! The line of a ray that passes through a sphere or beside it, and the accuracy of the roots in
//! single precision.

use protocol::Shape;

use crate::domains::fields::{EPSILON, FURTHEST_SIZES};
use crate::domains::shape::ShapeCall;
use crate::oracle::Ray64;
use crate::oracle::sphere::Sphere;

/// The line along a call's ray, together with the call's sphere.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// The sphere.
    pub sphere: Sphere,
    /// The ray.
    pub ray64: Ray64,
    /// The smallest distance between the line and the centre, in radii.
    pub approach: f64,
    /// The distances at which the line enters and leaves the sphere, or NaN if it misses.
    pub roots: [f64; 2],
}

impl Line {
    /// Returns the line of a call, or `None` if its shape isn't a sphere.
    pub fn of(call: &ShapeCall) -> Option<Line> {
        let Shape::Sphere { center, radius, .. } = call.shape else {
            return None;
        };
        let sphere = Sphere {
            center: center.as_dvec3(),
            radius: radius.into(),
        };
        let ray64 = Ray64::from(&call.ray);
        let line = sphere.intersect_line(&ray64);
        Some(Line {
            sphere,
            ray64,
            approach: line.closest_approach,
            roots: line.roots,
        })
    }

    /// Returns the distance of the ray's start from the centre, in radii.
    pub(super) fn start(&self) -> f64 {
        self.ray64.origin.distance(self.sphere.center) / self.sphere.radius
    }

    /// Returns the distance, in radii, between the axis through the poles and the point where the
    /// ray hits the sphere. `distance` is measured along the ray.
    pub(super) fn pole_distance(&self, distance: f64) -> f64 {
        let radial = (self.ray64.at(distance) - self.sphere.center) / self.sphere.radius;
        radial.x.hypot(radial.z)
    }

    /// Returns whether the line misses the sphere.
    pub fn misses(&self) -> bool {
        self.approach > 1.0
    }

    /// Returns whether the range of the ray is from 0 to ∞.
    pub fn is_unlimited(&self) -> bool {
        self.ray64.min == 0.0 && self.ray64.max == f64::INFINITY
    }

    /// Returns the roots that are in the ray's range.
    pub fn hits(&self) -> impl Iterator<Item = f64> + '_ {
        self.roots
            .into_iter()
            .filter(|&root| self.ray64.is_in_range(root))
    }

    /// Returns whether all correct single-precision formulas agree on whether the sphere is hit.
    pub fn is_clear(&self) -> bool {
        /// The minimum difference between the square of the approach and 1.
        const TANGENT_MARGIN: f64 = 0.01;
        /// The minimum difference between a distance and an end of the range, in radii.
        const END_MARGIN: f64 = 0.01;
        let distance = self.start();
        let squared = (self.approach * self.approach - 1.0).abs();
        if distance > FURTHEST_SIZES
            || squared < TANGENT_MARGIN.max(64.0 * EPSILON * distance * distance)
        {
            return false;
        }
        let margin = (END_MARGIN * self.sphere.radius).max(2.0 * self.distance_error());
        let ends = [self.ray64.min, self.ray64.max];
        let is_away = |root: f64| ends.iter().all(|end| (root - end).abs() >= margin);
        self.misses() || self.roots.into_iter().all(is_away)
    }

    /// Returns whether every correct single-precision formula computes `quantity` well within its
    /// tolerance.
    pub fn is_exact(&self, quantity: &str) -> bool {
        /// The largest fraction of a tolerance that errors may use up.
        const PART: f64 = 0.3;
        let Some(distance) = self.hits().next() else {
            return true;
        };
        let coordinates = self.coordinates();
        let error = self.distance_error();
        let position = error + 2.0 * EPSILON * coordinates;
        let normal = position / self.sphere.radius;
        let from_pole = self.pole_distance(distance);
        match quantity {
            "distance" => error <= PART * 1e-4 * coordinates.max(distance),
            "position" => position <= PART * 1e-4 * coordinates.max(distance),
            "normal" | "unit_normal" => normal <= PART * 1e-3,
            "uv" => from_pole > 0.012 && normal / from_pole <= PART * 2e-3,
            _ => true,
        }
    }

    /// Returns a bound on the error of a distance that a common formula computes in single
    /// precision. The difference b² − c loses digits as the square of the distance from the centre
    /// grows, and the square root passes on more of that loss the closer the ray is to a tangent.
    fn distance_error(&self) -> f64 {
        let from_center = self
            .ray64
            .origin
            .distance(self.sphere.center)
            .max(self.sphere.radius);
        let half_chord = 0.5 * (self.roots[1] - self.roots[0]);
        EPSILON * (4.0 * from_center * from_center / half_chord + 2.0 * self.coordinates())
    }

    /// Returns the largest absolute coordinate of the ray's origin and of any point on the sphere.
    pub(super) fn coordinates(&self) -> f64 {
        let sphere = self.sphere.center.abs().max_element() + self.sphere.radius;
        sphere.max(self.ray64.origin.abs().max_element())
    }
}

#[cfg(test)]
mod tests {
    use protocol::Ray;

    use super::*;
    use crate::domains::Call;

    #[test]
    fn tangents_and_ends_of_ranges_are_not_clear() {
        let shape = Shape::Sphere {
            center: glam::vec3(0.0, 0.0, -5.0),
            radius: 1.0,
            shape: 0,
        };
        let is_clear = |x: f32, max: f32| {
            let ray = Ray::new(glam::vec3(x, 0.0, 0.0), glam::Vec3::NEG_Z).within(0.0, max);
            Line::of(&ShapeCall::new(shape, ray))
                .expect("a sphere")
                .is_clear()
        };
        assert!(is_clear(0.0, 9.0) && is_clear(0.9, 9.0) && is_clear(1.1, 9.0));
        assert!(!is_clear(0.999, 9.0) && !is_clear(1.001, 9.0));
        assert!(!is_clear(0.0, 4.005) && !is_clear(0.0, 6.005) && is_clear(0.0, 5.0));
    }
}
