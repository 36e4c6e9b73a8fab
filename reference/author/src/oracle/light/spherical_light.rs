//! Spheres that emit light, and sampling directions toward them.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec3};

use super::frame::Frame64;
use super::{WithMargin, luminance};

/// A sphere that emits light outward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalLight64 {
    /// The centre.
    pub center: DVec3,
    /// The radius.
    pub radius: f64,
    /// The radiance that is emitted in every direction.
    pub radiance: DVec3,
}

/// The directions from a point to a sphere.
struct Cone {
    /// The direction to the sphere's centre.
    axis: DVec3,
    /// The cosine of the angle between the axis and the directions that touch the sphere.
    cosine: f64,
}

impl SphericalLight64 {
    /// Returns the power up to a constant factor: the area times the luminance.
    pub fn power(&self) -> f64 {
        4.0 * PI * self.radius * self.radius * luminance(self.radiance)
    }

    /// Samples a direction to the sphere, evenly among all directions that hit it. `random.x` is
    /// the fraction of the cone's solid angle that is closer to the axis, and `random.y` the angle
    /// around the axis, in turns. Returns `None` inside the sphere.
    ///
    /// The margin is the relative distance from the sphere, or from the plane in which the frame
    /// around the axis is reversed.
    pub fn sample(&self, from: DVec3, random: DVec2) -> WithMargin<Option<DVec3>> {
        let Some(cone) = self.cone(from) else {
            return WithMargin {
                value: None,
                margin: self.height(from).abs(),
            };
        };
        // The solid angle of a cone is 2π times one minus the cosine of its half-angle.
        let cosine = 1.0 - random.x * (1.0 - cone.cosine);
        let sine = libm::sqrt(1.0 - cosine * cosine);
        let (sin_around, cos_around) = libm::sincos(TAU * random.y);
        let in_cone = dvec3(sine * cos_around, sine * sin_around, cosine);
        WithMargin {
            value: Some(Frame64::around(cone.axis).to_world(in_cone)),
            margin: self.height(from).min(cone.axis.z.abs()),
        }
    }

    /// Returns the probability density, per solid angle, of a direction if all directions that hit
    /// the sphere are sampled evenly. It is zero if the direction misses the sphere, and inside.
    ///
    /// The margin is how far the ray would have to move sideways to touch the sphere, relative to
    /// the largest coordinate.
    pub fn pdf(&self, from: DVec3, direction: DVec3) -> WithMargin<f64> {
        let to_center = self.center - from;
        let along = to_center.dot(direction);
        let beside = to_center.cross(direction).length();
        let extent = self.extent().max(from.abs().max_element());
        let clearance = (beside - self.radius).abs() / extent;
        let is_ahead = along > 0.0;
        let margin = if is_ahead {
            clearance
        } else {
            clearance.max(-along / extent)
        };
        let cone = self.cone(from);
        let cone = cone.filter(|_| is_ahead && beside < self.radius);
        WithMargin {
            value: cone.map_or(0.0, |cone| 1.0 / (TAU * (1.0 - cone.cosine))),
            margin: margin.min(self.height(from).abs()),
        }
    }

    /// Returns the cone of all directions that hit the sphere, or `None` inside the sphere.
    fn cone(&self, from: DVec3) -> Option<Cone> {
        let to_center = self.center - from;
        let distance = to_center.length();
        (distance > self.radius).then(|| {
            let sine = self.radius / distance;
            Cone {
                axis: to_center / distance,
                cosine: libm::sqrt(1.0 - sine * sine),
            }
        })
    }

    /// Returns the distance of a point from the sphere's surface, relative to the radius. Negative
    /// inside.
    fn height(&self, from: DVec3) -> f64 {
        from.distance(self.center) / self.radius - 1.0
    }

    /// Returns the largest absolute value of a point's coordinate.
    fn extent(&self) -> f64 {
        self.center.abs().max_element() + self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::light::grid;
    use crate::oracle::light::uniform_sphere;

    /// A light of radius 1 that is 2 away from the origin, so that its cone's half-angle is 30°.
    const LIGHT: SphericalLight64 = SphericalLight64 {
        center: DVec3::new(1.2, 0.0, -1.6),
        radius: 1.0,
        radiance: DVec3::ONE,
    };

    #[test]
    fn the_density_is_one_over_the_solid_angle() {
        let expected = 1.0 / (TAU * (1.0 - libm::cos(PI / 6.0)));
        let toward_center = LIGHT.center / 2.0;
        let pdf = LIGHT.pdf(DVec3::ZERO, toward_center);
        assert!((pdf.value / expected - 1.0).abs() < 1e-14);
        assert_eq!(pdf.margin, 1.0 / 2.6);
        assert_eq!(LIGHT.pdf(DVec3::ZERO, -toward_center).value, 0.0);
        assert_eq!(LIGHT.pdf(DVec3::ZERO, DVec3::Y).value, 0.0);
    }

    #[test]
    fn the_density_integrates_to_one_over_all_directions() {
        let side = 800;
        let densities = grid(side).map(|at| LIGHT.pdf(DVec3::ZERO, uniform_sphere(at)).value);
        let total = densities.sum::<f64>() * 4.0 * PI / f64::from(side * side);
        assert!((total - 1.0).abs() < 2e-3, "{total}");
    }

    #[test]
    fn samples_fill_the_cone_evenly() {
        // The mean of all directions in a cone is along its axis, with the length (1 + cos α) / 2.
        let side = 200;
        let mut mean = DVec3::ZERO;
        for random in grid(side) {
            let direction = LIGHT.sample(DVec3::ZERO, random).value.unwrap();
            assert!(LIGHT.pdf(DVec3::ZERO, direction).value > 0.0);
            mean += direction / f64::from(side * side);
        }
        let length = 0.5 * (1.0 + libm::cos(PI / 6.0));
        assert!(
            mean.abs_diff_eq(length * LIGHT.center / 2.0, 1e-12),
            "{mean}"
        );
    }

    #[test]
    fn the_inside_is_dark() {
        let inside = LIGHT.center + 0.5 * DVec3::X;
        let sample = LIGHT.sample(inside, DVec2::splat(0.5));
        assert_eq!((sample.value, sample.margin), (None, 0.5));
        assert_eq!(LIGHT.pdf(inside, DVec3::X).value, 0.0);
    }
}
