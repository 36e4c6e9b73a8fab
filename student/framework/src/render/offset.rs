//! How far from a surface rays must start so that they don't hit it again.
//!
//! Rounding moves a computed hit position slightly off the surface. How far depends on the shape
//! and the viewpoint, but not on the size of the scene: a ball gets the same offset even if it lies
//! on a sphere that is a thousand times as large. The estimates follow the error terms in Pharr,
//! Jakob and Humphreys, *Physically Based Rendering*, 4th edition, section 6.8 "Managing Rounding
//! Error", and, for spheres seen from far away, Haines et al., "Precision Improvements for
//! Ray/Sphere Intersection", *Ray Tracing Gems*, 2019.

use glam::Vec3;
use protocol::Shape;

/// The error of a formula, relative to its largest term. It allows for 16 roundings of an `f32`.
const RELATIVE_ERROR: f32 = 8.0 * f32::EPSILON;

/// The smallest cosine to divide by. A ray along the surface itself, with a cosine of 0, would
/// start infinitely far away.
const MIN_COSINE: f32 = 1e-3;

/// Returns how far from `position` a ray that leaves `shape` in direction `dir` must start, or how
/// far before `position` a ray that arrives in this direction must end. If the ray started or ended
/// closer to `position`, rounding could put that point on either side of the surface. `eye` is the
/// origin of the ray that found `position`.
pub fn along_ray(shape: &Shape, eye: Vec3, position: Vec3, dir: Vec3) -> f32 {
    let (normal, term) = match *shape {
        Shape::Triangle { vertices, .. } => {
            triangle(vertices.map(|vertex| vertex.position), eye, position)
        }
        Shape::FlatTriangle { corners, .. } => triangle(corners, eye, position),
        Shape::Sphere { center, radius, .. } => {
            // The formula subtracts r² from the squared distance to the centre, and the result
            // changes by 2r for each unit of distance.
            let distance = eye.distance(center).max(radius);
            let normal = (position - center) / radius;
            (normal, distance * distance / radius)
        }
    };
    let error = coordinate_error(eye, position) + RELATIVE_ERROR * term;
    error / normal.dot(dir).abs().max(MIN_COSINE)
}

/// Returns how far rounding can move a point on a ray from `eye` to `position`.
#[inline]
pub fn coordinate_error(eye: Vec3, position: Vec3) -> f32 {
    RELATIVE_ERROR * eye.abs().max(position.abs()).max_element()
}

/// Returns the normal of a triangle and the largest term in the formulas for its hits.
fn triangle(corners: [Vec3; 3], eye: Vec3, position: Vec3) -> (Vec3, f32) {
    let [p0, p1, p2] = corners;
    let cross = (p1 - p0).cross(p2 - p0);
    // The determinants are products of the edges and of the vector to a corner. In a narrow
    // triangle, they are larger than the area they are divided by.
    let edges = (p1 - p0).length() * (p2 - p0).length();
    let reach = corners.map(|corner| corner.distance(eye).max(corner.distance(position)));
    let reach = reach.into_iter().fold(0.0, f32::max);
    let area = cross.length();
    if area > 0.0 {
        (cross / area, reach * edges / area)
    } else {
        (Vec3::ZERO, reach)
    }
}
