//! The shapes of lights and the sampling of points on them.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use protocol::Shape;

use crate::math::sin_cos;
use crate::render::frame::Frame;

/// The shape of a light.
pub(super) enum LightShape {
    /// A triangle that only emits light on the side its unit `normal` points to.
    Triangle {
        corners: [Vec3; 3],
        normal: Vec3,
        area: f32,
    },
    /// A sphere that only emits light outward.
    Sphere { center: Vec3, radius: f32 },
}

impl LightShape {
    /// Creates the light's shape from a shape of the scene.
    pub(super) fn of(shape: &Shape) -> Self {
        match *shape {
            Shape::Triangle { vertices, .. } => {
                let outward = vertices.iter().map(|vertex| vertex.normal).sum();
                LightShape::triangle(vertices.map(|vertex| vertex.position), outward)
            }
            Shape::FlatTriangle { corners, .. } => LightShape::triangle(corners, Vec3::ZERO),
            Shape::Sphere { center, radius, .. } => LightShape::Sphere { center, radius },
        }
    }

    /// Creates a triangle that emits light on the side `outward` points to. If `outward` is zero,
    /// the order of the corners determines the side.
    fn triangle(corners: [Vec3; 3], outward: Vec3) -> Self {
        let [p0, p1, p2] = corners;
        let cross = (p1 - p0).cross(p2 - p0);
        let normal = cross.normalize_or_zero();
        LightShape::Triangle {
            corners,
            normal: if normal.dot(outward) < 0.0 {
                -normal
            } else {
                normal
            },
            area: 0.5 * cross.length(),
        }
    }

    /// Returns the area of the emitting surface.
    pub(super) fn area(&self) -> f32 {
        match *self {
            LightShape::Triangle { area, .. } => area,
            LightShape::Sphere { radius, .. } => 2.0 * TAU * radius * radius,
        }
    }

    /// Samples a direction from `from` toward the light, using two random numbers in `[0, 1)`.
    /// Returns the direction and the distance to the light. Returns `None` if the light doesn't
    /// emit in that direction.
    pub(super) fn sample(&self, from: Vec3, random: Vec2) -> Option<(Vec3, f32)> {
        match *self {
            LightShape::Triangle {
                corners: [p0, p1, p2],
                normal,
                ..
            } => {
                // See Turk, "Generating Random Points in Triangles", Graphics Gems, 1990.
                let root = random.x.sqrt();
                let on_light = p0 * (1.0 - root) + (p1 * (1.0 - random.y) + p2 * random.y) * root;
                let distance = from.distance(on_light);
                let direction = (on_light - from) / distance;
                (direction.dot(normal) < 0.0).then_some((direction, distance))
            }
            LightShape::Sphere { center, radius } => {
                let (to_center, span) = cone(center, radius, from)?;
                let (direction, sine) = sample_cone(to_center, span, random);
                // Half of the chord that the ray cuts from the sphere. It is 0 at the silhouette.
                let squared = from.distance_squared(center);
                let half_chord = (radius * radius - squared * sine * sine).max(0.0).sqrt();
                Some((direction, direction.dot(center - from) - half_chord))
            }
        }
    }

    /// Returns the probability density, per solid angle, with which [`LightShape::sample`] returns
    /// this direction, which must be a unit vector toward the light. `distance` is the distance to
    /// the light.
    pub(super) fn pdf(&self, from: Vec3, direction: Vec3, distance: f32) -> f32 {
        match *self {
            LightShape::Triangle { normal, area, .. } => {
                let cosine = -direction.dot(normal);
                if cosine > 0.0 {
                    distance * distance / (cosine * area)
                } else {
                    0.0
                }
            }
            LightShape::Sphere { center, radius } => {
                cone(center, radius, from).map_or(0.0, |(_, span)| 1.0 / (TAU * span))
            }
        }
    }
}

/// Returns the cone that a sphere subtends: the direction to the sphere's centre, and one minus the
/// cosine of the cone's half-angle. Returns `None` inside the sphere, since spheres emit outward.
fn cone(center: Vec3, radius: f32, from: Vec3) -> Option<(Vec3, f32)> {
    let to_center = center - from;
    let squared = to_center.length_squared();
    if squared <= radius * radius {
        return None;
    }
    let sine_squared = (radius * radius / squared).min(1.0);
    // Computed without cancellation for a sphere far away.
    let span = sine_squared / (1.0 + (1.0 - sine_squared).sqrt());
    Some((to_center / squared.sqrt(), span))
}

/// Samples a direction in a cone. Also returns the sine of the angle between that direction and the
/// axis. See Shirley, Wang and Zimmerman, "Monte Carlo Techniques for Direct Lighting
/// Calculations", ACM TOG 15(1), 1996.
fn sample_cone(axis: Vec3, span: f32, random: Vec2) -> (Vec3, f32) {
    let rise = random.x * span;
    let sine = (rise * (2.0 - rise)).max(0.0).sqrt();
    let (sin, cos) = sin_cos(TAU * random.y);
    let in_cone = Vec3::new(sine * cos, sine * sin, 1.0 - rise);
    (Frame::from_z(axis).to_world(in_cone), sine)
}

#[cfg(test)]
mod tests {
    use glam::{vec2, vec3};

    use super::*;
    use crate::render::sampler::{Purpose, Sampler};

    /// Returns the irradiance at the origin on a floor that faces up, from many samples of one
    /// light.
    fn irradiance(shape: &LightShape) -> f32 {
        let count = 20_000;
        let light = (0..count).map(|n| {
            let random = Sampler::new(0, Default::default(), n).pair(0, Purpose::PointOnLight);
            let sample = shape.sample(Vec3::ZERO, random);
            sample.map_or(0.0, |(direction, distance)| {
                direction.y.max(0.0) / shape.pdf(Vec3::ZERO, direction, distance)
            })
        });
        light.sum::<f32>() / count as f32
    }

    #[test]
    fn the_irradiance_of_a_triangle_matches_lamberts_formula() {
        let corners = [
            vec3(1.0, 2.0, -1.0),
            vec3(0.0, 1.0, 1.0),
            vec3(-1.0, 1.5, -0.5),
        ];
        let shape = LightShape::triangle(corners, Vec3::NEG_Y);
        // Lambert, 1760: half of the sum, over all edges, of the angle that the edge subtends times
        // its normal.
        let d = corners.map(Vec3::normalize);
        let edge = |a: Vec3, b: Vec3| a.angle_between(b) * a.cross(b).normalize().y;
        let expected = 0.5 * (edge(d[0], d[1]) + edge(d[1], d[2]) + edge(d[2], d[0])).abs();
        let ratio = irradiance(&shape) / expected;
        assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    }

    #[test]
    fn lights_do_not_emit_backwards() {
        let corners = [
            vec3(1.0, 2.0, -1.0),
            vec3(0.0, 2.0, 1.0),
            vec3(-1.0, 2.0, -1.0),
        ];
        let upward = LightShape::triangle(corners, Vec3::Y);
        assert!(upward.sample(Vec3::ZERO, vec2(0.5, 0.5)).is_none());
        assert_eq!(upward.pdf(Vec3::ZERO, Vec3::Y, 2.0), 0.0);
        let around = LightShape::Sphere {
            center: Vec3::ZERO,
            radius: 1.0,
        };
        assert!(around.sample(Vec3::ZERO, vec2(0.5, 0.5)).is_none());
        assert!(around.sample(vec3(0.5, 0.0, 0.0), vec2(0.5, 0.5)).is_none());
        assert_eq!(around.pdf(vec3(0.5, 0.0, 0.0), Vec3::X, 0.5), 0.0);
    }
}
