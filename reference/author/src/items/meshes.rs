//! Lists of shapes for trees. The number of each shape is its index in the list.

use glam::{DVec3, dvec3};
use protocol::{Shape, Vertex};

use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

/// Returns the flat triangle with these corners.
pub fn flat_triangle(corners: [DVec3; 3], shape: u32) -> Shape {
    Shape::FlatTriangle {
        corners: corners.map(|corner| corner.as_vec3()),
        shape,
    }
}

/// Returns a triangle with these corners and random normals and texture coordinates.
pub fn triangle(rng: &mut Rng, corners: [DVec3; 3]) -> Shape {
    let across = rng.direction();
    let vertices = corners.map(|corner| {
        let normal = (across + rng.point(0.4)).normalize();
        let uv = glam::dvec2(rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0));
        Vertex::new(corner.as_vec3(), normal.as_vec3(), uv.as_vec2())
    });
    Shape::Triangle { vertices, shape: 0 }
}

/// Returns a triangle around `center` in a random orientation, with random normals and texture
/// coordinates. It doesn't have sharp angles and fits in a ball of radius `size` around `center`.
pub fn random_triangle(rng: &mut Rng, center: DVec3, size: f64) -> Shape {
    let corners = random_corners(rng, size);
    triangle(rng, corners.map(|corner| center + corner))
}

/// Returns the sphere around this centre.
pub fn sphere(center: DVec3, radius: f64) -> Shape {
    Shape::Sphere {
        center: center.as_vec3(),
        radius: radius as f32,
        shape: 0,
    }
}

/// Returns the shapes, numbered in order.
pub fn number_shapes(shapes: impl IntoIterator<Item = Shape>) -> Vec<Shape> {
    with_numbers(shapes, 0..)
}

/// Returns the shapes, with these numbers assigned to them in order.
pub fn with_numbers(
    shapes: impl IntoIterator<Item = Shape>,
    numbers: impl IntoIterator<Item = u32>,
) -> Vec<Shape> {
    let number = |(mut numbered, number): (Shape, u32)| {
        let (Shape::Triangle { shape, .. }
        | Shape::FlatTriangle { shape, .. }
        | Shape::Sphere { shape, .. }) = &mut numbered;
        *shape = number;
        numbered
    };
    shapes.into_iter().zip(numbers).map(number).collect()
}

/// Returns a flat triangle around `center` in a random orientation. It doesn't have sharp angles
/// and fits in a ball of radius `size` around `center`.
pub fn random_flat_triangle(rng: &mut Rng, center: DVec3, size: f64) -> Shape {
    let corners = random_corners(rng, size);
    flat_triangle(corners.map(|corner| center + corner), 0)
}

/// Returns a triangle like those from [`random_flat_triangle`], except that `center` is the centre
/// of its bounding box.
pub fn random_triangle_with_box_around(rng: &mut Rng, center: DVec3, size: f64) -> Shape {
    let corners = random_corners(rng, size);
    let middle = Bounds::around(corners).center();
    flat_triangle(corners.map(|corner| center + corner - middle), 0)
}

fn random_corners(rng: &mut Rng, size: f64) -> [DVec3; 3] {
    let across = rng.direction();
    let up = rng.perpendicular_to(across);
    let corner = |x: f64, y: f64| size * (x * across + y * up);
    [corner(-0.8, -0.5), corner(0.8, -0.5), corner(0.0, 0.9)]
}

/// Returns `count` flat triangles with random sizes between half of `size` and `size`. Their
/// centres are random points in the cube from −`half` to `half`.
pub fn soup(rng: &mut Rng, count: usize, half: f64, size: f64) -> Vec<Shape> {
    number_shapes(rng.list(count, |rng| {
        let center = rng.point(half);
        let size = size * rng.uniform(0.5, 1.0);
        random_flat_triangle(rng, center, size)
    }))
}

/// Returns a thin triangle along an axis.
pub fn strand(rng: &mut Rng, center: DVec3, axis: usize, length: f64) -> Shape {
    let along = 0.5 * length * DVec3::AXES[axis];
    let across = 0.02 * rng.perpendicular_to(DVec3::AXES[axis]);
    flat_triangle([center - along, center + along, center + along + across], 0)
}

/// Returns long, thin triangles: along x in one region, along y in another, and along z in a third.
/// Splitting along the strands' direction gains little. Within a region, however, the longest axis
/// of a node is in that direction, so a builder that splits only along the longest axis builds a
/// poor tree.
pub fn strands(rng: &mut Rng, count: usize) -> Vec<Shape> {
    let strands = (0..count).map(|i| {
        let axis = i % 3;
        let region = dvec3(6.0, 0.0, 0.0) * (axis as f64 - 1.0);
        let mut offset = rng.point(0.9);
        offset[axis] *= 1.2;
        strand(rng, region + offset, axis, 2.0)
    });
    number_shapes(strands)
}

/// Returns a stack of sheets made of long strips. The sheets are longer than the stack is high, but
/// only partitions between sheets or between strips are good.
pub fn sheets(rng: &mut Rng, count: usize) -> Vec<Shape> {
    let sheets = (0..count).map(|i| {
        let level = (i % 12) as f64;
        let center = dvec3(
            rng.uniform(-3.0, 3.0),
            0.35 * level + rng.uniform(-0.01, 0.01),
            rng.uniform(-2.5, 2.5),
        );
        let along = dvec3(rng.uniform(1.5, 2.5), 0.0, rng.uniform(-0.1, 0.1));
        let across = dvec3(0.0, rng.uniform(-0.01, 0.01), rng.uniform(0.05, 0.15));
        flat_triangle([center - along, center + along, center + along + across], 0)
    });
    number_shapes(sheets)
}

/// Returns spheres in three parallel lanes along an axis. Each lane is much longer than the spaces
/// between the lanes.
pub fn lanes(rng: &mut Rng, count: usize) -> Vec<Shape> {
    let axis = rng.index(3);
    let [x, y] = [1, 2].map(|next| DVec3::AXES[(axis + next) % 3]);
    let places = [(-1.0, 0.6), (-0.5, -0.7), (1.0, 0.0)];
    let places = places.map(|(along_x, along_y)| {
        let space = rng.uniform(0.7, 1.3);
        space * (along_x * x + along_y * y)
    });
    let spheres = (0..count).map(|i| {
        let at = rng.uniform(-3.0, 3.0);
        let center = places[i % 3] + rng.point(0.02) + at * DVec3::AXES[axis];
        sphere(center, 0.01)
    });
    number_shapes(spheres)
}

/// Returns spheres in a few clumps. Some clumps contain far more spheres than others.
pub fn clumps(rng: &mut Rng, count: usize) -> Vec<Shape> {
    let number = rng.integer(7, 9) as usize;
    let clumps = rng.list(number, |rng| (rng.point(10.0), rng.log_uniform(1.0, 12.0)));
    let all: f64 = clumps.iter().map(|(_, weight)| weight).sum();
    let mut spheres = Vec::new();
    for (center, weight) in &clumps {
        let in_clump = (count as f64 * weight / all).max(1.0) as usize;
        spheres.extend((0..in_clump).map(|_| sphere(*center + rng.point(0.3), 0.1)));
    }
    while spheres.len() < count {
        spheres.push(sphere(clumps[0].0 + rng.point(0.3), 0.1));
    }
    spheres.truncate(count);
    number_shapes(spheres)
}

/// Returns pairs of triangles that form axis-aligned rectangles. Both triangles of a pair have the
/// same box.
pub fn rectangles(rng: &mut Rng, count: usize) -> Vec<Shape> {
    let rectangles = (0..count).flat_map(|index| {
        let [x, y] = [1, 2].map(|next| rng.uniform(0.4, 1.2) * DVec3::AXES[(index + next) % 3]);
        let corner = rng.point(4.0);
        let [second, third, fourth] = [corner + x, corner + x + y, corner + y];
        [[corner, second, third], [corner, third, fourth]]
    });
    number_shapes(rectangles.map(|corners| flat_triangle(corners, 0)))
}

/// Returns spheres of one size in a cube. Their coordinates have few digits, so that even many
/// spheres take up little space in an exam.
pub fn many_spheres(rng: &mut Rng, count: usize) -> Vec<Shape> {
    let spheres = (0..count).map(|_| sphere((16.0 * rng.point(9.0)).round() / 16.0, 0.25));
    number_shapes(spheres)
}

/// Returns spheres in a cube as large as the largest scene. Half of the spheres are in a few
/// clusters. Their coordinates have few digits, so that even many spheres take up little space in
/// an exam.
pub fn galaxy(rng: &mut Rng, count: usize) -> Vec<Shape> {
    let spots = rng.list(7, |rng| rng.point(900.0));
    let spheres = (0..count).map(|i| {
        let center = if i % 2 == 0 {
            rng.point(950.0)
        } else {
            spots[rng.index(spots.len())] + rng.point(40.0)
        };
        sphere(center.round(), 4.0)
    });
    number_shapes(spheres)
}

/// Returns a few large triangles on the ground and several clusters of many small primitives.
pub fn town(rng: &mut Rng, count: usize) -> Vec<Shape> {
    let spots = rng.list(7, |rng| rng.point(10.0) * dvec3(1.0, 0.1, 1.0));
    let triangles = (0..count).map(|i| {
        if i % 10 == 0 {
            let center = rng.point(10.0) * dvec3(1.0, 0.02, 1.0);
            random_flat_triangle(rng, center, 1.5)
        } else {
            let spot = spots[rng.index(spots.len())];
            let offset = rng.point(0.4);
            // Spheres take up less space in an exam than triangles.
            match rng.index(3) {
                0 => random_flat_triangle(rng, spot + offset, 0.05),
                _ => sphere(spot + offset, 0.03),
            }
        }
    });
    number_shapes(triangles)
}
