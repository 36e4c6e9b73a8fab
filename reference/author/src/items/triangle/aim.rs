//! Random triangles, and rays aimed at points that are defined by barycentric weights.

use glam::{DVec3, Vec2, vec2};
use protocol::{Ray, Shape, Vertex};

use crate::items::ray;
use crate::oracle::{Ray64, scan, triangle};
use crate::seed::Rng;

/// The side of a triangle from which a ray comes. (p1 − p0) × (p2 − p0) points to the front.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    Front,
    Back,
    Either,
}

/// Returns a triangle that is neither small nor thin, with different normals and texture
/// coordinates at its corners.
pub(super) fn random_triangle(rng: &mut Rng) -> [Vertex; 3] {
    rng.retry(|rng| {
        let corners = [rng.point(2.0), rng.point(2.0), rng.point(2.0)];
        let [p0, p1, p2] = corners;
        let normal = (p1 - p0).cross(p2 - p0);
        let longest = p0.distance(p1).max(p1.distance(p2)).max(p2.distance(p0));
        // Twice the area divided by the longest side is the smallest altitude.
        (normal.length() / longest > 1.0).then(|| {
            let mut vertex = |corner: DVec3, uv: Vec2| {
                let tilted = normal.normalize() + 0.7 * rng.direction();
                Vertex::new(corner.as_vec3(), tilted.normalize().as_vec3(), uv)
            };
            let uvs = [vec2(0.1, 0.2), vec2(0.9, 0.35), vec2(0.3, 0.85)];
            [vertex(p0, uvs[0]), vertex(p1, uvs[1]), vertex(p2, uvs[2])]
        })
    })
}

/// Returns the weights of a point inside the triangle, all of them at least `least`.
pub(super) fn weights_inside(rng: &mut Rng, least: f64) -> [f64; 3] {
    let mut cuts = [rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0)];
    cuts.sort_by(f64::total_cmp);
    let parts = [cuts[0], cuts[1] - cuts[0], 1.0 - cuts[1]];
    parts.map(|part| least + (1.0 - 3.0 * least) * part)
}

/// Returns the weights of a point beyond the edge opposite this corner.
pub(super) fn weights_beyond_edge(rng: &mut Rng, corner: usize) -> [f64; 3] {
    let beyond = rng.uniform(0.06, 0.6);
    weights_beyond_edge_by(rng, corner, beyond)
}

/// Returns the weights of a point at distance `beyond` from the edge opposite this corner, on the
/// outer side of that edge. The unit is the distance of the corner from the edge.
pub(super) fn weights_beyond_edge_by(rng: &mut Rng, corner: usize, beyond: f64) -> [f64; 3] {
    let along = rng.uniform(0.05, 0.95);
    let mut weights = [0.0; 3];
    weights[corner] = -beyond;
    weights[(corner + 1) % 3] = (1.0 + beyond) * along;
    weights[(corner + 2) % 3] = (1.0 + beyond) * (1.0 - along);
    weights
}

/// Returns a ray through the point with these weights. It does not hit the triangle at a grazing
/// angle.
pub(super) fn ray_through(
    rng: &mut Rng,
    vertices: &[Vertex; 3],
    weights: [f64; 3],
    side: Side,
) -> Ray {
    let [p0, p1, p2] = triangle::corners(vertices);
    let target = weights[0] * p0 + weights[1] * p1 + weights[2] * p2;
    let front = (p1 - p0).cross(p2 - p0).normalize();
    rng.retry(|rng| {
        let away = rng.direction();
        let slope = away.dot(front);
        let is_on_side = match side {
            Side::Front => slope > 0.35,
            Side::Back => slope < -0.35,
            Side::Either => slope.abs() > 0.35,
        };
        let ray = ray(target + rng.uniform(1.0, 4.0) * away, target);
        let shape = shape(vertices, 0);
        (is_on_side && scan::is_unambiguous(&Ray64::from(&ray), &shape)).then_some(ray)
    })
}

pub(super) fn shape(vertices: &[Vertex; 3], shape: u32) -> Shape {
    Shape::Triangle {
        vertices: *vertices,
        shape,
    }
}

pub(super) fn hitting_ray(rng: &mut Rng, vertices: &[Vertex; 3], side: Side) -> Ray {
    let weights = weights_inside(rng, 0.06);
    ray_through(rng, vertices, weights, side)
}

pub(super) fn missing_ray(rng: &mut Rng, vertices: &[Vertex; 3], side: Side) -> Ray {
    let corner = rng.index(3);
    let weights = weights_beyond_edge(rng, corner);
    ray_through(rng, vertices, weights, side)
}
