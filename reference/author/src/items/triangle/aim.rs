//! Triangles, and rays at places of them that are given by weights.

use glam::{DVec3, Vec2, vec2};
use protocol::{Ray, Shape, Vertex};

use crate::items::ray;
use crate::oracle::{Ray64, scan, triangle};
use crate::seed::Rng;

/// Which side of a triangle a ray comes from: the one that (p1 − p0) × (p2 − p0) points to, or not.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    Front,
    Back,
    Either,
}

/// A triangle that is neither small nor thin, with three normals and texture coordinates that have
/// little in common.
pub(super) fn random_triangle(draw: &mut Rng) -> [Vertex; 3] {
    draw.retry(|draw| {
        let corners = [draw.point(2.0), draw.point(2.0), draw.point(2.0)];
        let [p0, p1, p2] = corners;
        let normal = (p1 - p0).cross(p2 - p0);
        let longest = p0.distance(p1).max(p1.distance(p2)).max(p2.distance(p0));
        // Twice the area by the longest side is the least altitude.
        (normal.length() / longest > 1.0).then(|| {
            let mut vertex = |corner: DVec3, uv: Vec2| {
                let tilted = normal.normalize() + 0.7 * draw.direction();
                Vertex::new(corner.as_vec3(), tilted.normalize().as_vec3(), uv)
            };
            let uvs = [vec2(0.1, 0.2), vec2(0.9, 0.35), vec2(0.3, 0.85)];
            [vertex(p0, uvs[0]), vertex(p1, uvs[1]), vertex(p2, uvs[2])]
        })
    })
}

/// Weights of a point inside, none below `least`.
pub(super) fn weights_inside(draw: &mut Rng, least: f64) -> [f64; 3] {
    let mut cuts = [draw.uniform(0.0, 1.0), draw.uniform(0.0, 1.0)];
    cuts.sort_by(f64::total_cmp);
    let parts = [cuts[0], cuts[1] - cuts[0], 1.0 - cuts[1]];
    parts.map(|part| least + (1.0 - 3.0 * least) * part)
}

/// Weights of a point beyond the edge that lies opposite this corner.
pub(super) fn weights_beyond_edge(draw: &mut Rng, corner: usize) -> [f64; 3] {
    let beyond = draw.uniform(0.06, 0.6);
    weights_beyond_edge_by(draw, corner, beyond)
}

/// The same of a point so far beyond: as far as the corner is on this side, it would be 1.
pub(super) fn weights_beyond_edge_by(draw: &mut Rng, corner: usize, beyond: f64) -> [f64; 3] {
    let along = draw.uniform(0.05, 0.95);
    let mut weights = [0.0; 3];
    weights[corner] = -beyond;
    weights[(corner + 1) % 3] = (1.0 + beyond) * along;
    weights[(corner + 2) % 3] = (1.0 + beyond) * (1.0 - along);
    weights
}

/// A ray through the point of these weights, not at a flat angle.
pub(super) fn ray_through(
    draw: &mut Rng,
    vertices: &[Vertex; 3],
    weights: [f64; 3],
    side: Side,
) -> Ray {
    let [p0, p1, p2] = triangle::corners(vertices);
    let target = weights[0] * p0 + weights[1] * p1 + weights[2] * p2;
    let front = (p1 - p0).cross(p2 - p0).normalize();
    draw.retry(|draw| {
        let away = draw.direction();
        let slope = away.dot(front);
        let wanted = match side {
            Side::Front => slope > 0.35,
            Side::Back => slope < -0.35,
            Side::Either => slope.abs() > 0.35,
        };
        let ray = ray(target + draw.uniform(1.0, 4.0) * away, target);
        let shape = shape(vertices, 0);
        (wanted && scan::is_unambiguous(&Ray64::from(&ray), &shape)).then_some(ray)
    })
}

pub(super) fn shape(vertices: &[Vertex; 3], material: u32) -> Shape {
    Shape::Triangle {
        vertices: *vertices,
        material,
    }
}

pub(super) fn hitting_ray(draw: &mut Rng, vertices: &[Vertex; 3], side: Side) -> Ray {
    let weights = weights_inside(draw, 0.06);
    ray_through(draw, vertices, weights, side)
}

pub(super) fn missing_ray(draw: &mut Rng, vertices: &[Vertex; 3], side: Side) -> Ray {
    let corner = draw.index(3);
    let weights = weights_beyond_edge(draw, corner);
    ray_through(draw, vertices, weights, side)
}
