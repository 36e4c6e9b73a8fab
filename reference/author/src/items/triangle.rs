//! Task 2, step 1: triangles.

use glam::{DVec3, Vec2, Vec3, dvec3, vec2, vec3};
use grader::exam::{Asked, Item, Part, Task};
use protocol::{Ray, Shape, Vertex};

use super::picture;
use crate::oracle::{Beam, scan, triangle};
use crate::seed::{Draw, Seed};

/// The items of the task `triangle`.
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 15] = [
        inside,
        outside,
        position,
        normal,
        uv,
        uv_corners,
        from_behind,
        normal_from_behind,
        range_max,
        range_min,
        behind_the_ray,
        tiny,
        degenerate,
        origin_and_material,
        picture,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

fn item(name: &str, points: u32, text: [&str; 2], questions: Vec<Asked>) -> Item {
    super::item(Task::Triangle, name, points, text, questions)
}

/// Which side of a triangle a ray comes from: the one that (p1 − p0) × (p2 − p0) points to, or not.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Front,
    Back,
    Either,
}

/// A triangle that is neither small nor thin, with three normals and texture coordinates that have
/// little in common.
fn triangle(draw: &mut Draw) -> [Vertex; 3] {
    draw.until(|draw| {
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
fn weights_inside(draw: &mut Draw, least: f64) -> [f64; 3] {
    let mut cuts = [draw.uniform(0.0, 1.0), draw.uniform(0.0, 1.0)];
    cuts.sort_by(f64::total_cmp);
    let parts = [cuts[0], cuts[1] - cuts[0], 1.0 - cuts[1]];
    parts.map(|part| least + (1.0 - 3.0 * least) * part)
}

/// Weights of a point beyond the edge that lies opposite this corner.
fn weights_beyond(draw: &mut Draw, corner: usize) -> [f64; 3] {
    let beyond = draw.uniform(0.06, 0.6);
    let along = draw.uniform(0.05, 0.95);
    let mut weights = [0.0; 3];
    weights[corner] = -beyond;
    weights[(corner + 1) % 3] = (1.0 + beyond) * along;
    weights[(corner + 2) % 3] = (1.0 + beyond) * (1.0 - along);
    weights
}

/// A ray through the point of these weights, not at a flat angle.
fn ray_through(draw: &mut Draw, vertices: &[Vertex; 3], weights: [f64; 3], side: Side) -> Ray {
    let [p0, p1, p2] = triangle::corners(vertices);
    let target = weights[0] * p0 + weights[1] * p1 + weights[2] * p2;
    let front = (p1 - p0).cross(p2 - p0).normalize();
    draw.until(|draw| {
        let away = draw.direction();
        let slope = away.dot(front);
        let wanted = match side {
            Side::Front => slope > 0.35,
            Side::Back => slope < -0.35,
            Side::Either => slope.abs() > 0.35,
        };
        let ray = super::ray(target + draw.uniform(1.0, 4.0) * away, target);
        let shape = shape(vertices, 0);
        (wanted && scan::is_clear(&Beam::from(&ray), &shape)).then_some(ray)
    })
}

fn shape(vertices: &[Vertex; 3], material: u32) -> Shape {
    Shape::Triangle {
        vertices: *vertices,
        material,
    }
}

fn hit(draw: &mut Draw, vertices: &[Vertex; 3], side: Side) -> Ray {
    let weights = weights_inside(draw, 0.06);
    ray_through(draw, vertices, weights, side)
}

fn miss(draw: &mut Draw, vertices: &[Vertex; 3], side: Side) -> Ray {
    let corner = draw.index(3);
    let weights = weights_beyond(draw, corner);
    ray_through(draw, vertices, weights, side)
}

/// Questions about four triangles: for each, rays that hit it from this side, and some that miss.
fn tables(name: &str, seed: Seed, judged: &[Part], side: Side) -> Vec<Asked> {
    let mut draw = seed.draw(name);
    let mut table = || {
        let vertices = triangle(&mut draw);
        let mut rays: Vec<Ray> = (0..8).map(|_| hit(&mut draw, &vertices, side)).collect();
        rays.extend((0..4).map(|_| miss(&mut draw, &vertices, side)));
        super::shapes(judged, vec![shape(&vertices, 0)], draw.shuffled(rays))
    };
    (0..4).map(|_| table()).collect()
}

fn inside(seed: Seed) -> Item {
    item(
        "inside",
        2,
        [
            "a ray through the inside hits, at the distance t",
            "Solve the three equations for u, v and t. Mind the signs in Cramer's rule, and that the \
             last column of the matrix is −d.",
        ],
        tables("triangle.inside", seed, &[Part::Distance], Side::Front),
    )
}

fn outside(seed: Seed) -> Item {
    let mut draw = seed.draw("triangle.outside");
    let mut table = || {
        let vertices = triangle(&mut draw);
        let mut rays: Vec<Ray> = (0..12)
            .map(|i| {
                let weights = weights_beyond(&mut draw, i % 3);
                ray_through(&mut draw, &vertices, weights, Side::Front)
            })
            .collect();
        rays.extend((0..4).map(|_| hit(&mut draw, &vertices, Side::Front)));
        super::shapes(&[], vec![shape(&vertices, 0)], draw.shuffled(rays))
    };
    item(
        "outside",
        2,
        [
            "a ray that crosses the plane beyond an edge misses",
            "u, v and w = 1 − u − v belong to one corner each. Beyond an edge the weight of the \
             corner opposite is negative: there are three edges.",
        ],
        vec![table(), table(), table()],
    )
}

fn position(seed: Seed) -> Item {
    item(
        "position",
        1,
        [
            "position is the point of the meeting",
            "It is the ray's point at t, or the weighted sum of the corners: both are the same.",
        ],
        tables("triangle.position", seed, &[Part::Position], Side::Front),
    )
}

fn normal(seed: Seed) -> Item {
    item(
        "normal",
        1,
        [
            "the normal is interpolated between the corners' normals",
            "Smooth shading: each corner has a normal of its own, and the face's normal is not asked. \
             w belongs to p0, u to p1, v to p2.",
        ],
        tables("triangle.normal", seed, &[Part::Normal], Side::Front),
    )
}

fn uv(seed: Seed) -> Item {
    item(
        "uv",
        1,
        [
            "uv is interpolated between the corners' texture coordinates",
            "u and v of the barycentric coordinates are weights; the uv of the Trace is the weighted \
             sum of the corners' uv.",
        ],
        tables("triangle.uv", seed, &[Part::Uv], Side::Front),
    )
}

fn uv_corners(seed: Seed) -> Item {
    let mut draw = seed.draw("triangle.uv_corners");
    let mut table = || {
        let vertices = triangle(&mut draw);
        let mut rays = Vec::new();
        for corner in 0..3 {
            for _ in 0..3 {
                let mut weights = weights_inside(&mut draw, 0.25).map(|w| 0.2 * w);
                weights[corner] += 0.8;
                rays.push(ray_through(&mut draw, &vertices, weights, Side::Front));
            }
            rays.push(miss(&mut draw, &vertices, Side::Front));
        }
        super::shapes(&[Part::Uv], vec![shape(&vertices, 0)], rays)
    };
    item(
        "uv_corners",
        1,
        [
            "near a corner, that corner's texture coordinates count most",
            "If two corners' are exchanged, so are two of the weights: w is p0's, u is p1's, v is \
             p2's.",
        ],
        vec![table(), table()],
    )
}

fn from_behind(seed: Seed) -> Item {
    item(
        "from_behind",
        1,
        [
            "a triangle is hit from behind as well",
            "Seen from behind the determinant has the other sign. That is no reason for a miss.",
        ],
        tables("triangle.from_behind", seed, &[Part::Distance], Side::Back),
    )
}

fn normal_from_behind(seed: Seed) -> Item {
    item(
        "normal_from_behind",
        1,
        [
            "seen from behind, the normal stays as it is",
            "The normal belongs to the surface, not to the ray: it is never flipped toward it.",
        ],
        tables(
            "triangle.normal_from_behind",
            seed,
            &[Part::Normal],
            Side::Either,
        ),
    )
}

/// Hits and misses through the same triangle that differ by their range alone.
fn ranges(name: &str, seed: Seed, range: impl Fn(&mut Draw, f64) -> (f64, f64)) -> Vec<Asked> {
    let mut draw = seed.draw(name);
    let mut table = || {
        let vertices = triangle(&mut draw);
        let rays = (0..12).map(|_| {
            let ray = hit(&mut draw, &vertices, Side::Either);
            let met = triangle::meet(&Beam::from(&ray), &vertices, 0).expect("it was aimed at it");
            let (min, max) = range(&mut draw, met.distance);
            ray.within(min as f32, max as f32)
        });
        let rays = rays.collect();
        super::shapes(&[Part::Distance], vec![shape(&vertices, 0)], rays)
    };
    vec![table(), table()]
}

fn range_max(seed: Seed) -> Item {
    let range = |draw: &mut Draw, t: f64| (0.0, t + draw.sign() * draw.uniform(0.03, 0.6));
    item(
        "range_max",
        1,
        [
            "beyond the end of the ray's range there is no hit",
            "Compare t with ray.range before you answer: a shadow ray ends at the light.",
        ],
        ranges("triangle.range_max", seed, range),
    )
}

fn range_min(seed: Seed) -> Item {
    let range = |draw: &mut Draw, t: f64| (t + draw.sign() * draw.uniform(0.03, 0.6), t + 9.0);
    item(
        "range_min",
        1,
        [
            "before the start of the ray's range there is no hit",
            "The range has two ends. Its start need not be 0.",
        ],
        ranges("triangle.range_min", seed, range),
    )
}

fn behind_the_ray(seed: Seed) -> Item {
    let mut draw = seed.draw("triangle.behind_the_ray");
    let mut table = || {
        let vertices = triangle(&mut draw);
        let rays = (0..12).map(|i| {
            let ray = hit(&mut draw, &vertices, Side::Either);
            if i % 2 == 0 {
                ray
            } else {
                Ray::new(ray.origin, -ray.dir)
            }
        });
        let rays = rays.collect();
        super::shapes(&[Part::Distance], vec![shape(&vertices, 0)], rays)
    };
    item(
        "behind_the_ray",
        1,
        [
            "a triangle behind the ray is missed",
            "There t is negative, and the weights look as if all were well.",
        ],
        vec![table(), table()],
    )
}

fn tiny(seed: Seed) -> Item {
    let mut draw = seed.draw("triangle.tiny");
    let mut table = || {
        // Half of its edges' length is the side of the cube that they are drawn from.
        let mut vertices = triangle(&mut draw);
        for vertex in &mut vertices {
            vertex.position *= 4e-4;
        }
        let [p0, p1, p2] = triangle::corners(&vertices);
        let front = (p1 - p0).cross(p2 - p0).normalize();
        let rays = (0..16).map(|i| {
            let weights = if i % 2 == 0 {
                weights_inside(&mut draw, 0.1)
            } else {
                weights_beyond(&mut draw, i % 3).map(|w| w * 2.0 - 1.0 / 3.0)
            };
            let target = weights[0] * p0 + weights[1] * p1 + weights[2] * p2;
            draw.until(|draw| {
                let away = draw.direction();
                let ray = super::ray(target + draw.uniform(0.1, 0.5) * away, target);
                let crossing = triangle::crossing(&Beam::from(&ray), [p0, p1, p2])?;
                let steep = away.dot(front).abs() > 0.5;
                (steep && crossing.depth().abs() > 0.05).then_some(ray)
            })
        });
        let rays = rays.collect();
        super::shapes(&[Part::Distance], vec![shape(&vertices, 0)], rays)
    };
    item(
        "tiny",
        1,
        [
            "a triangle of edge 1e-3 is as good as any",
            "The determinant shrinks with the area: it is small for small triangles, not only for \
             parallel rays. Compare it with zero, not with a small number.",
        ],
        vec![table(), table()],
    )
}

/// Small whole numbers, so that every correct formula's determinant is exactly zero.
fn degenerate(seed: Seed) -> Item {
    let mut draw = seed.draw("triangle.degenerate");
    let flat = |corners: [Vec3; 3]| {
        let vertices = corners.map(|corner| Vertex::new(corner, Vec3::Z, Vec2::ZERO));
        shape(&vertices, 0)
    };
    let control = |draw: &mut Draw| {
        let vertices = triangle(draw);
        let rays = (0..4).map(|_| hit(draw, &vertices, Side::Either)).collect();
        super::shapes(&[Part::Distance], vec![shape(&vertices, 0)], rays)
    };
    let down = |x: f32, y: f32| Ray::new(vec3(x, y, 4.0), Vec3::NEG_Z);
    let along = |y: f32, z: f32| Ray::new(vec3(-4.0, y, z), Vec3::X);

    let line = flat([
        vec3(0.0, 1.0, 0.0),
        vec3(1.0, 1.0, 0.0),
        vec3(3.0, 1.0, 0.0),
    ]);
    let point = flat([vec3(1.0, 1.0, 0.0); 3]);
    let edge_of_none = flat([
        vec3(1.0, 2.0, 0.0),
        vec3(1.0, 2.0, 0.0),
        vec3(3.0, 2.0, 0.0),
    ]);
    let half_square = flat([
        vec3(0.0, 0.0, 0.0),
        vec3(4.0, 0.0, 0.0),
        vec3(0.0, 4.0, 0.0),
    ]);
    let ask = |shape: Shape, rays: Vec<Ray>| super::shapes(&[], vec![shape], rays);
    item(
        "degenerate",
        1,
        [
            "a triangle without area, or parallel to the ray, is missed",
            "Then the determinant is zero, and 1/0 is no number to go on with: such a triangle can \
             not be hit.",
        ],
        vec![
            ask(line, vec![down(1.0, 1.0), down(2.0, 1.0), down(2.0, 3.0)]),
            ask(point, vec![down(1.0, 1.0), down(0.0, 0.0)]),
            ask(edge_of_none, vec![down(2.0, 2.0), down(1.0, 2.0)]),
            ask(
                half_square,
                vec![along(1.0, 0.0), along(1.0, 2.0), along(-1.0, 0.0)],
            ),
            control(&mut draw),
        ],
    )
}

fn origin_and_material(seed: Seed) -> Item {
    let mut draw = seed.draw("triangle.origin_and_material");
    let mut table = |material: u32| {
        let vertices = triangle(&mut draw);
        let mut rays: Vec<Ray> = (0..6)
            .map(|_| hit(&mut draw, &vertices, Side::Front))
            .collect();
        rays.extend((0..3).map(|_| miss(&mut draw, &vertices, Side::Front)));
        let judged = [Part::Origin, Part::Material];
        super::shapes(&judged, vec![shape(&vertices, material)], rays)
    };
    item(
        "origin_and_material",
        1,
        [
            "the answer names the ray's origin and the triangle's material",
            "Both are copied: origin from the ray that was asked, material from the triangle.",
        ],
        vec![table(0), table(7), table(42)],
    )
}

fn picture(seed: Seed) -> Item {
    let shapes = picture_shapes(&mut seed.draw("triangle.picture"));
    item(
        "picture",
        4,
        [
            "a picture of triangles is right in hit, depth, normal and uv",
            "A smooth hill, a square of two halves, triangles from behind, and some tiny ones. Look \
             where it is wrong: along edges, on one side, or in the small ones?",
        ],
        vec![picture::shapes(picture::from_origin(64), shapes)],
    )
}

/// What stands before a camera at the origin that looks down −z at 90 degrees.
fn picture_shapes(draw: &mut Draw) -> Vec<Shape> {
    let mut shapes = Vec::new();
    let mut add = |vertices: [Vertex; 3]| shapes.push(shape(&vertices, 0));

    // A square whose diagonal passes exactly through the middles of pixels.
    let corner = |x: f32, y: f32| {
        let uv = vec2(0.3 + 0.15 * x, 0.4 + 0.15 * y);
        Vertex::new(vec3(x - 2.0, y - 2.0, -4.0), Vec3::Z, uv)
    };
    let corners = [
        corner(-1.0, -1.0),
        corner(1.0, -1.0),
        corner(1.0, 1.0),
        corner(-1.0, 1.0),
    ];
    add([corners[0], corners[1], corners[2]]);
    add([corners[0], corners[2], corners[3]]);

    // A smooth hill of 5 × 4 squares.
    let height = draw.uniform(0.5, 0.8);
    let hill = |i: usize, j: usize| {
        let (x, y) = (i as f64 / 5.0, j as f64 / 4.0);
        let (u, v) = (2.0 * x - 1.0, 2.0 * y - 1.0);
        let up = height * (1.0 - u * u) * (1.0 - v * v);
        let slope_x = -2.0 * height * u * (1.0 - v * v);
        let slope_y = -2.0 * height * v * (1.0 - u * u);
        let normal = dvec3(-slope_x / 2.2, -slope_y / 1.6, 1.0).normalize();
        let position = dvec3(1.3 + 2.2 * u, 1.7 + 1.6 * v, -5.0 + up);
        let uv = vec2(0.05 + 0.9 * x as f32, 0.05 + 0.9 * y as f32);
        Vertex::new(position.as_vec3(), normal.as_vec3(), uv)
    };
    for i in 0..5 {
        for j in 0..4 {
            let square = [
                hill(i, j),
                hill(i + 1, j),
                hill(i + 1, j + 1),
                hill(i, j + 1),
            ];
            add([square[0], square[1], square[2]]);
            add([square[0], square[2], square[3]]);
        }
    }

    // Some that are seen from behind, among others that are not, at all distances.
    for _ in 0..6 {
        let mut vertices = triangle(draw);
        let middle = dvec3(draw.uniform(0.5, 3.0), draw.uniform(-3.0, -1.0), -4.5);
        for vertex in &mut vertices {
            vertex.position = (0.45 * vertex.position.as_dvec3() + middle).as_vec3();
        }
        add(vertices);
    }

    // Tiny ones, close to the camera.
    for i in 0..6 {
        let mut vertices = triangle(draw);
        let middle = dvec3(-0.016 + 0.004 * f64::from(i), 0.013, -0.02);
        for vertex in &mut vertices {
            vertex.position = (6e-4 * vertex.position.as_dvec3() + middle).as_vec3();
        }
        add(vertices);
    }
    shapes
}
