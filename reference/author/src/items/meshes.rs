//! Lists of shapes for trees. A primitive's material is its place in the list.

use glam::{DVec3, dvec3};
use protocol::Shape;

use crate::seed::Rng;

/// The facet with these corners.
pub fn flat_triangle(corners: [DVec3; 3], material: u32) -> Shape {
    Shape::FlatTriangle {
        corners: corners.map(|corner| corner.as_vec3()),
        material,
    }
}

/// The same shapes with their places as materials.
pub fn number_shapes(shapes: impl IntoIterator<Item = Shape>) -> Vec<Shape> {
    let number = |(place, shape): (u32, Shape)| match shape {
        Shape::Triangle { vertices, .. } => Shape::Triangle {
            vertices,
            material: place,
        },
        Shape::FlatTriangle { corners, .. } => Shape::FlatTriangle {
            corners,
            material: place,
        },
        Shape::Sphere { center, radius, .. } => Shape::Sphere {
            center,
            radius,
            material: place,
        },
    };
    (0..).zip(shapes).map(number).collect()
}

/// A facet around a point, not thin, within a ball of this radius.
pub fn random_flat_triangle(draw: &mut Rng, center: DVec3, size: f64) -> Shape {
    let across = draw.direction();
    let up = draw.perpendicular_to(across);
    let corner = |x: f64, y: f64| center + size * (x * across + y * up);
    flat_triangle([corner(-0.8, -0.5), corner(0.8, -0.5), corner(0.0, 0.9)], 0)
}

/// Facets of this size, anywhere within `half` of the origin.
pub fn soup(draw: &mut Rng, count: usize, half: f64, size: f64) -> Vec<Shape> {
    let chips = (0..count).map(|_| {
        let center = draw.point(half);
        let size = size * draw.uniform(0.5, 1.0);
        random_flat_triangle(draw, center, size)
    });
    number_shapes(chips)
}

/// Long, thin facets along x in one region, along y and along z in two others: partitions along the
/// strands are of little use, and the strands' direction is where a node is longest.
pub fn strands(draw: &mut Rng, count: usize) -> Vec<Shape> {
    let strands = (0..count).map(|i| {
        let axis = i % 3;
        let region = dvec3(6.0, 0.0, 0.0) * (axis as f64 - 1.0);
        let mut place = draw.point(0.9);
        place[axis] *= 1.2;
        strand(draw, region + place, axis, 2.0)
    });
    number_shapes(strands)
}

/// A thin facet along an axis.
fn strand(draw: &mut Rng, center: DVec3, axis: usize, length: f64) -> Shape {
    let along = 0.5 * length * DVec3::AXES[axis];
    let across = 0.02 * draw.perpendicular_to(DVec3::AXES[axis]);
    flat_triangle([center - along, center + along, center + along + across], 0)
}

/// Stacked sheets that are longer than the stack is high, each of long strips: only partitions
/// between sheets, or between strips, are any good.
pub fn sheets(draw: &mut Rng, count: usize) -> Vec<Shape> {
    let sheets = (0..count).map(|i| {
        let level = (i % 12) as f64;
        let center = dvec3(
            draw.uniform(-3.0, 3.0),
            0.35 * level + draw.uniform(-0.01, 0.01),
            draw.uniform(-2.5, 2.5),
        );
        let along = dvec3(draw.uniform(1.5, 2.5), 0.0, draw.uniform(-0.1, 0.1));
        let across = dvec3(0.0, draw.uniform(-0.01, 0.01), draw.uniform(0.05, 0.15));
        flat_triangle([center - along, center + along, center + along + across], 0)
    });
    number_shapes(sheets)
}

/// A few large facets of ground, and most of all facets in some crowded spots.
pub fn town(draw: &mut Rng, count: usize) -> Vec<Shape> {
    let spots: Vec<DVec3> = (0..7)
        .map(|_| draw.point(10.0) * dvec3(1.0, 0.1, 1.0))
        .collect();
    let facets = (0..count).map(|i| {
        if i % 10 == 0 {
            let center = draw.point(10.0) * dvec3(1.0, 0.02, 1.0);
            random_flat_triangle(draw, center, 1.5)
        } else {
            let spot = spots[draw.index(spots.len())];
            let place = draw.point(0.4);
            random_flat_triangle(draw, spot + place, 0.05)
        }
    });
    number_shapes(facets)
}
