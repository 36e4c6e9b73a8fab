//! The shape of a lamp, and which directions it fills.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use protocol::Shape;

use crate::frame::Frame;
use crate::math::sin_cos;

/// The shape of a lamp.
pub(super) enum Form {
    /// Shines to the side of `normal`, which has length one.
    Triangle {
        corners: [Vec3; 3],
        normal: Vec3,
        area: f32,
    },
    /// Shines outward.
    Sphere { center: Vec3, radius: f32 },
}

/// A place on a lamp, seen from a point.
pub(super) struct Seen {
    pub(super) direction: Vec3,
    pub(super) distance: f32,
    /// One over the density of having picked this direction.
    pub(super) solid_angle: f32,
}

impl Form {
    /// That of a shape of the scene.
    pub(super) fn of(shape: &Shape) -> Self {
        match *shape {
            Shape::Triangle { vertices, .. } => {
                let outward = vertices.iter().map(|vertex| vertex.normal).sum();
                Form::triangle(vertices.map(|vertex| vertex.position), outward)
            }
            Shape::Facet { corners, .. } => Form::triangle(corners, Vec3::ZERO),
            Shape::Sphere { center, radius, .. } => Form::Sphere { center, radius },
        }
    }

    /// The side that shines is that of `outward`, whichever way the corners turn.
    fn triangle(corners: [Vec3; 3], outward: Vec3) -> Self {
        let [p0, p1, p2] = corners;
        let cross = (p1 - p0).cross(p2 - p0);
        let normal = cross.normalize_or_zero();
        Form::Triangle {
            corners,
            normal: if normal.dot(outward) < 0.0 {
                -normal
            } else {
                normal
            },
            area: 0.5 * cross.length(),
        }
    }

    /// All of its surface that shines.
    pub(super) fn area(&self) -> f32 {
        match *self {
            Form::Triangle { area, .. } => area,
            Form::Sphere { radius, .. } => 2.0 * TAU * radius * radius,
        }
    }

    /// A place on the lamp, picked by `place` in `[0, 1)`, if it shines on `point`.
    pub(super) fn pick(&self, point: Vec3, place: Vec2) -> Option<Seen> {
        match *self {
            Form::Triangle {
                corners: [p0, p1, p2],
                normal,
                area,
            } => {
                // Turk, "Generating Random Points in Triangles", Graphics Gems, 1990.
                let root = place.x.sqrt();
                let on_lamp = p0 * (1.0 - root) + (p1 * (1.0 - place.y) + p2 * place.y) * root;
                let way = on_lamp - point;
                let distance = way.length();
                let direction = way / distance;
                let cosine = -direction.dot(normal);
                (cosine > 0.0 && distance > 0.0).then_some(Seen {
                    direction,
                    distance,
                    solid_angle: area * cosine / (distance * distance),
                })
            }
            Form::Sphere { center, radius } => cone(center, radius, point, place),
        }
    }
}

/// A direction of the cone that a sphere fills, seen from outside: Shirley, Wang and Zimmerman,
/// "Monte Carlo Techniques for Direct Lighting Calculations", ACM TOG 15(1), 1996.
fn cone(center: Vec3, radius: f32, point: Vec3, place: Vec2) -> Option<Seen> {
    let way = center - point;
    let squared = way.length_squared();
    // From inside nothing shines: spheres shine outward.
    if squared <= radius * radius {
        return None;
    }
    let sine_squared = (radius * radius / squared).min(1.0);
    // 1 − cos of the cone's half angle, without cancellation for a sphere far away.
    let span = sine_squared / (1.0 + (1.0 - sine_squared).sqrt());
    let rise = place.x * span;
    let cosine = 1.0 - rise;
    let sine = (rise * (2.0 - rise)).max(0.0).sqrt();
    let (sin, cos) = sin_cos(TAU * place.y);
    let far = squared.sqrt();
    let direction = Frame::around(way / far).to_world(Vec3::new(sine * cos, sine * sin, cosine));

    // How deep the ray's closest approach to the centre lies in the sphere; at the rim, 0.
    let depth = (radius * radius - squared * sine * sine).max(0.0).sqrt();
    Some(Seen {
        direction,
        distance: far * cosine - depth,
        solid_angle: TAU * span,
    })
}

#[cfg(test)]
mod tests {
    use glam::{vec2, vec3};

    use super::*;
    use crate::sampler::{Purpose, Sampler};

    /// The irradiance on a floor at the origin that faces up, from many places of one lamp.
    fn irradiance(form: &Form) -> f32 {
        let count = 20_000;
        let light = (0..count).map(|n| {
            let place = Sampler::new(0, Default::default(), n).pair(0, Purpose::PlaceOnLight);
            let seen = form.pick(Vec3::ZERO, place);
            seen.map_or(0.0, |seen| seen.direction.y.max(0.0) * seen.solid_angle)
        });
        light.sum::<f32>() / count as f32
    }

    #[test]
    fn a_sphere_overhead_lights_as_the_closed_form_says() {
        // π sin² of the half angle, for a sphere of radiance 1 wholly above the horizon.
        let form = Form::Sphere {
            center: vec3(0.0, 2.0, 0.0),
            radius: 1.0,
        };
        let truth = std::f32::consts::PI * 0.25;
        assert!((irradiance(&form) / truth - 1.0).abs() < 0.01);
    }

    #[test]
    fn a_triangle_overhead_lights_as_lamberts_formula_says() {
        let corners = [
            vec3(1.0, 2.0, -1.0),
            vec3(0.0, 1.0, 1.0),
            vec3(-1.0, 1.5, -0.5),
        ];
        let form = Form::triangle(corners, Vec3::NEG_Y);
        // Lambert 1760: half the sum, over the edges, of the angle times the edge's normal.
        let d = corners.map(Vec3::normalize);
        let edge = |a: Vec3, b: Vec3| a.angle_between(b) * a.cross(b).normalize().y;
        let truth = 0.5 * (edge(d[0], d[1]) + edge(d[1], d[2]) + edge(d[2], d[0])).abs();
        assert!((irradiance(&form) / truth - 1.0).abs() < 0.01, "{truth}");
    }

    #[test]
    fn lamps_do_not_shine_backwards() {
        let corners = [
            vec3(1.0, 2.0, -1.0),
            vec3(0.0, 2.0, 1.0),
            vec3(-1.0, 2.0, -1.0),
        ];
        let upward = Form::triangle(corners, Vec3::Y);
        assert!(upward.pick(Vec3::ZERO, vec2(0.5, 0.5)).is_none());
        let around = Form::Sphere {
            center: Vec3::ZERO,
            radius: 1.0,
        };
        assert!(around.pick(Vec3::ZERO, vec2(0.5, 0.5)).is_none());
        assert!(around.pick(vec3(0.5, 0.0, 0.0), vec2(0.5, 0.5)).is_none());
    }
}
