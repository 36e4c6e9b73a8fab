//! The item with a picture of triangles.

use glam::{DVec3, Vec2, Vec3, dvec3, vec2, vec3};
use protocol::{Shape, Vertex};

use crate::items::{Declaration, picture};
use crate::seed::Rng;

pub(super) const PICTURE: Declaration = Declaration {
    id: "triangle.picture",
    points: 3,
    title: "a picture of triangles has the correct hits, depth, normals and uv",
    look: "The picture shows a smooth hill, a square made of two triangles, triangles seen from \
        behind and some tiny ones. Where is it wrong: along edges, on one side, or in the tiny \
        triangles?",
    section: "grading.md#reading-a-wrong-picture",
    tests: &["Returns the ray's…"],
    questions: |rng| {
        let shapes = picture_shapes(&mut rng.sequence("triangle.picture"));
        let camera = picture::camera_at_origin(64);
        vec![picture::picture_question(camera, shapes)]
    },
    ..Declaration::ALONE
};

/// Returns the triangles in front of a camera at the origin that looks down −z with a field of view
/// of 90 degrees.
fn picture_shapes(rng: &mut Rng) -> Vec<Shape> {
    // Quarter turns around the camera's axis are exact in single precision.
    let quarter_turns = rng.index(4);
    let turned = |vector: Vec3| {
        (0..quarter_turns).fold(vector, |vector, _| vec3(-vector.y, vector.x, vector.z))
    };
    let mut shapes = Vec::new();
    let mut add = |vertices: [Vertex; 3]| {
        let turned = vertices.map(|it| Vertex::new(turned(it.position), turned(it.normal), it.uv));
        shapes.push(shape(&turned, 0));
    };

    // A square whose diagonal misses the centres of the pixels, which are 1/8 apart.
    let mut eighths = || rng.integer(0, 6) as f32 / 8.0;
    let middle = vec2(-2.25 + 1.0 / 64.0 + eighths(), -2.25 + eighths());
    let corner = |x: f32, y: f32| {
        let uv = vec2(0.3 + 0.15 * x, 0.4 + 0.15 * y);
        Vertex::new(vec3(middle.x + x, middle.y + y, -4.0), Vec3::Z, uv)
    };
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corners = corners.map(|(x, y)| corner(x, y));
    add([corners[0], corners[1], corners[2]]);
    add([corners[0], corners[2], corners[3]]);

    // A smooth hill of 5 × 4 squares.
    let height = rng.uniform(0.5, 0.8);
    let foot = dvec3(rng.uniform(1.0, 1.6), rng.uniform(1.5, 2.2), -5.0);
    let hill = |i: usize, j: usize| {
        let (x, y) = (i as f64 / 5.0, j as f64 / 4.0);
        let (u, v) = (2.0 * x - 1.0, 2.0 * y - 1.0);
        let up = height * (1.0 - u * u) * (1.0 - v * v);
        let slope_x = -2.0 * height * u * (1.0 - v * v);
        let slope_y = -2.0 * height * v * (1.0 - u * u);
        let normal = dvec3(-slope_x / 2.2, -slope_y / 1.6, 1.0).normalize();
        let position = foot + dvec3(2.2 * u, 1.6 * v, up);
        let uv = vec2(0.05 + 0.9 * x as f32, 0.05 + 0.9 * y as f32);
        Vertex::new(position.as_vec3(), normal.as_vec3(), uv)
    };
    for i in 0..5 {
        for j in 0..4 {
            let square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let square = square.map(|(i, j)| hill(i, j));
            add([square[0], square[1], square[2]]);
            add([square[0], square[2], square[3]]);
        }
    }

    // Random triangles, some of them seen from behind.
    for _ in 0..6 {
        let mut vertices = random_triangle(rng);
        let middle = dvec3(rng.uniform(0.5, 3.0), rng.uniform(-3.0, -1.0), -4.5);
        for vertex in &mut vertices {
            vertex.position = (0.45 * vertex.position.as_dvec3() + middle).as_vec3();
        }
        add(vertices);
    }

    // Tiny triangles, close to the camera.
    for i in 0..6 {
        let mut vertices = random_triangle(rng);
        let middle = dvec3(-0.016 + 0.004 * f64::from(i), 0.013, -0.02);
        for vertex in &mut vertices {
            vertex.position = (6e-4 * vertex.position.as_dvec3() + middle).as_vec3();
        }
        add(vertices);
    }
    shapes
}

/// Returns a triangle that isn't small or thin, with different normals and texture coordinates at
/// its corners.
fn random_triangle(rng: &mut Rng) -> [Vertex; 3] {
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

fn shape(vertices: &[Vertex; 3], shape: u32) -> Shape {
    Shape::Triangle {
        vertices: *vertices,
        shape,
    }
}
