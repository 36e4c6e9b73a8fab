//! Spheres that emit light, and the sampling of directions toward them.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::math::sin_cos;
use crate::render::film::luminance;
use crate::render::frame::Frame;
use crate::render::offset::coordinate_error;

/// A sphere that emits light outward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereLight {
    /// The centre.
    pub center: Vec3,
    /// The radius.
    pub radius: f32,
    /// The radiance that the sphere emits in every direction.
    pub radiance: Vec3,
}

impl SphereLight {
    /// Returns the power up to a constant factor: the area times the luminance.
    pub fn power(&self) -> f32 {
        2.0 * TAU * self.radius * self.radius * luminance(self.radiance)
    }

    /// Samples a direction from `from` toward the sphere, evenly among all directions that hit it.
    /// Returns `None` inside the sphere, since it emits outward.
    pub fn sample(&self, from: Vec3, random: Vec2) -> Option<Vec3> {
        let (axis, span) = self.cone(from)?;
        Some(sample_cone(axis, span, random))
    }

    /// Returns the probability density, per solid angle, with which [`SphereLight::sample`] returns
    /// this direction, which must be a unit vector.
    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let cone = self.intersect(from, direction).and(self.cone(from));
        cone.map_or(0.0, |(_, span)| 1.0 / (TAU * span))
    }

    /// Returns the distance to the sphere from a point outside it, along a direction that must be a
    /// unit vector.
    pub fn intersect(&self, from: Vec3, direction: Vec3) -> Option<f32> {
        let to_center = self.center - from;
        let along = to_center.dot(direction);
        let miss = (to_center - along * direction).length();
        // A sampled direction must hit the sphere even where rounding makes it miss.
        let reach = self.radius + coordinate_error(from, self.center);
        let is_outside = to_center.length_squared() > self.radius * self.radius;
        let half_chord = (self.radius * self.radius - miss * miss).max(0.0).sqrt();
        (is_outside && along > 0.0 && miss <= reach).then_some(along - half_chord)
    }

    /// Returns the cone that the sphere subtends: the direction to its centre, and one minus the
    /// cosine of the cone's half-angle. Returns `None` inside the sphere.
    fn cone(&self, from: Vec3) -> Option<(Vec3, f32)> {
        let to_center = self.center - from;
        let (squared, radius) = (to_center.length_squared(), self.radius);
        if squared <= radius * radius {
            return None;
        }
        let sine_squared = (radius * radius / squared).min(1.0);
        // Computed without cancellation for a sphere far away.
        let span = sine_squared / (1.0 + (1.0 - sine_squared).sqrt());
        Some((to_center / squared.sqrt(), span))
    }
}

/// Samples a direction in a cone. See Shirley, Wang and Zimmerman, "Monte Carlo Techniques for
/// Direct Lighting Calculations", ACM TOG 15(1), 1996.
fn sample_cone(axis: Vec3, span: f32, random: Vec2) -> Vec3 {
    let rise = random.x * span;
    let sine = (rise * (2.0 - rise)).max(0.0).sqrt();
    let (sin, cos) = sin_cos(TAU * random.y);
    let in_cone = Vec3::new(sine * cos, sine * sin, 1.0 - rise);
    Frame::from_z(axis).to_world(in_cone)
}

#[cfg(test)]
mod tests {
    use glam::{vec2, vec3};

    use super::*;

    fn light(center: Vec3, radius: f32) -> SphereLight {
        SphereLight {
            center,
            radius,
            radiance: Vec3::ONE,
        }
    }

    #[test]
    fn every_sampled_direction_has_the_density_of_the_cone() {
        // The cone of a sphere that subtends a half-angle of 30° covers 2π · (1 − cos 30°), and
        // that of a tiny one, π times its squared radius over its squared distance.
        let solid_angle = [
            (2.0, 1.0, TAU * (1.0 - 0.75_f32.sqrt())),
            (1000.0, 0.01, 0.5 * TAU * 1e-10),
        ];
        for (distance, radius, solid_angle) in solid_angle {
            let center = distance * vec3(0.6, 0.0, 0.8);
            let light = light(center, radius);
            for (i, j) in (0..=50).flat_map(|i| (0..50).map(move |j| (i, j))) {
                let random = vec2(i as f32, j as f32) / 50.0;
                let direction = light.sample(Vec3::ZERO, random).expect("the light is seen");
                let pdf = light.pdf(Vec3::ZERO, direction);
                assert!((pdf * solid_angle - 1.0).abs() < 1e-4, "{random}: {pdf}");
            }
            assert_eq!(light.pdf(Vec3::ZERO, -center / distance), 0.0);
            assert_eq!(light.pdf(Vec3::ZERO, Vec3::Y), 0.0);
        }
    }

    #[test]
    fn the_inside_is_dark() {
        let around = light(Vec3::ZERO, 1.0);
        assert!(around.sample(vec3(0.5, 0.0, 0.0), vec2(0.5, 0.5)).is_none());
        assert_eq!(around.pdf(vec3(0.5, 0.0, 0.0), Vec3::X), 0.0);
    }
}
