//! Items about whether a ray hits, and at which distance.

use glam::{Vec2, Vec3, vec3};
use judging::exam::ExamQuestion;
use protocol::{Ray, Shape, Vertex};

use super::aim::{
    Side, hitting_ray, random_triangle, ray_through, shape, weights_beyond_edge,
    weights_beyond_edge_by, weights_inside,
};
use super::{distance_question, table_questions};
use crate::items::place::{Place, dust};
use crate::items::{Declaration, groups, ray, reversed_if, shape_question};
use crate::oracle::{Ray64, triangle};
use crate::seed::Rng;

pub(super) const INSIDE: Declaration = Declaration {
    id: "triangle.inside",
    points: 2,
    title: "a ray through the inside hits the triangle at distance t",
    look: "Work out u, v and t by hand for the ray shown, and compare them with those in your \
           code. It is a hit if u, v and 1 − u − v are all at least 0 and t is in ray.range, and \
           then t is the distance.",
    section: "triangle.md#three-equations-for-three-unknowns",
    questions: |rng| table_questions(rng, &["distance"], Side::Front),
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

pub(super) const OUTSIDE: Declaration = Declaration {
    id: "triangle.outside",
    points: 2,
    title: "a ray that crosses the plane beyond an edge misses",
    look: "u, v and w = 1 − u − v each belong to one corner. Beyond any of the three edges, the \
           weight of the opposite corner is negative.",
    section: "triangle.md#test-the-third-weight-too",
    questions: outside,
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

fn outside(rng: &mut Rng) -> Vec<ExamQuestion> {
    let mut table = || {
        let vertices = random_triangle(rng);
        let mut rays: Vec<Ray> = (0..12)
            .map(|i| {
                // A third of the rays pass close to the edge.
                let beyond = if i < 4 { (0.022, 0.06) } else { (0.06, 0.6) };
                let beyond = rng.uniform(beyond.0, beyond.1);
                let weights = weights_beyond_edge_by(rng, i % 3, beyond);
                ray_through(rng, &vertices, weights, Side::Front)
            })
            .collect();
        rays.extend((0..4).map(|_| hitting_ray(rng, &vertices, Side::Front)));
        (shape(&vertices, 0), rng.shuffled(rays))
    };
    let [first, second, third] = [table(), table(), table()];
    let third = Place::room(rng).table(&third);
    let question = |(shape, rays)| shape_question(&[], shape, rays);
    [first, second, third].map(question).to_vec()
}

pub(super) const FROM_BEHIND: Declaration = Declaration {
    id: "triangle.from_behind",
    title: "a triangle is hit from behind as well",
    look: "Seen from behind, the determinant has the other sign, which is no reason for a miss.",
    section: "triangle.md#a-ray-from-behind-has-a-negative-denominator",
    questions: |rng| table_questions(rng, &["distance"], Side::Back),
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

/// Returns the distance of a triangle along a ray that is aimed at it.
fn distance(ray: &Ray, vertices: &[Vertex; 3]) -> f64 {
    let hit = triangle::intersect(&Ray64::from(ray), vertices, 0);
    hit.expect("the ray was aimed at the triangle").distance
}

/// Creates questions with rays through a triangle, where only the range decides between hit and
/// miss.
fn range_questions(
    rng: &mut Rng,
    range: impl Fn(&mut Rng, f64) -> (f64, f64),
) -> Vec<ExamQuestion> {
    let mut table = || {
        let vertices = random_triangle(rng);
        let rays = (0..12).map(|_| {
            let ray = hitting_ray(rng, &vertices, Side::Either);
            let (min, max) = range(rng, distance(&ray, &vertices));
            ray.within(min as f32, max as f32)
        });
        distance_question(&vertices, rays)
    };
    vec![table(), table(), dust(table())]
}

pub(super) const RANGE_MAX: Declaration = Declaration {
    id: "triangle.range_max",
    title: "there is no hit beyond the end of the ray's range",
    look: "A ray through the triangle hits it if and only if t is in ray.range, however small the \
           triangle is. Which comparison in your code decides about the ray shown?",
    section: "triangle.md#check-both-ends-of-the-range",
    questions: |rng| {
        let range = |rng: &mut Rng, t: f64| (0.0, t + rng.sign() * rng.uniform(0.03, 0.6));
        range_questions(rng, range)
    },
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

/// Creates a question with rays that start on the triangle, as after a bounce, and with some that
/// start before it.
fn rays_from_the_surface(rng: &mut Rng) -> ExamQuestion {
    let vertices = random_triangle(rng);
    let rays = (0..12).map(|i| {
        let ray = hitting_ray(rng, &vertices, Side::Either);
        let start = if i % 3 == 0 {
            0.0
        } else {
            distance(&ray, &vertices)
        };
        let origin = Ray64::from(&ray).at(start).as_vec3();
        Ray { origin, ..ray }.within(0.05, f32::INFINITY)
    });
    distance_question(&vertices, rays)
}

pub(super) const RANGE_MIN: Declaration = Declaration {
    id: "triangle.range_min",
    title: "there is no hit before the start of the ray's range",
    look: "The range has two ends, and its start need not be 0. Compare t with these two, and with \
           no constant, however small.",
    section: "triangle.md#check-both-ends-of-the-range",
    questions: |rng| {
        let range = |rng: &mut Rng, t: f64| (t + rng.sign() * rng.uniform(0.03, 0.6), t + 9.0);
        let from_the_surface = &mut rng.sequence("triangle.rays_from_the_surface");
        let mut questions = range_questions(rng, range);
        questions.push(rays_from_the_surface(from_the_surface));
        questions
    },
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

pub(super) const BEHIND_THE_RAY: Declaration = Declaration {
    id: "triangle.behind_the_ray",
    title: "a triangle behind the ray is missed",
    look: "Work out t for the ray shown. Behind the ray it is negative, although the weights look \
           like those of a hit; ahead of the ray it is in ray.range.",
    section: "triangle.md#hits-behind-the-origin-do-not-count",
    questions: |rng| {
        let mut table = || {
            let vertices = random_triangle(rng);
            let rays =
                (0..12).map(|i| reversed_if(i % 2 == 1, hitting_ray(rng, &vertices, Side::Either)));
            distance_question(&vertices, rays)
        };
        vec![table(), table()]
    },
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

pub(super) const TINY: Declaration = Declaration {
    id: "triangle.tiny",
    title: "a triangle with edges of 1e-3 is hit like any other",
    look: "The determinant is small for small triangles too, not only for parallel rays: compare \
           it with zero, not with a small number.",
    section: "triangle.md#do-not-use-an-epsilon-instead-of-zero",
    questions: tiny,
    ..Declaration::ALONE
};

fn tiny(rng: &mut Rng) -> Vec<ExamQuestion> {
    let mut table = || {
        // The corners come from a cube of side 4, so scaled edges are about 1e-3 long.
        let mut vertices = random_triangle(rng);
        for vertex in &mut vertices {
            vertex.position *= 4e-4;
        }
        let [p0, p1, p2] = triangle::corners(&vertices);
        let front = (p1 - p0).cross(p2 - p0).normalize();
        let rays = (0..16).map(|i| {
            let weights = if i % 2 == 0 {
                weights_inside(rng, 0.1)
            } else {
                weights_beyond_edge(rng, i % 3).map(|w| w * 2.0 - 1.0 / 3.0)
            };
            let target = weights[0] * p0 + weights[1] * p1 + weights[2] * p2;
            rng.retry(|rng| {
                let away = rng.direction();
                let ray = ray(target + rng.uniform(0.1, 0.5) * away, target);
                let intersection = triangle::intersect_plane(&Ray64::from(&ray), [p0, p1, p2])?;
                let is_steep = away.dot(front).abs() > 0.5;
                (is_steep && intersection.least_weight().abs() > 0.05).then_some(ray)
            })
        });
        distance_question(&vertices, rays)
    };
    vec![table(), table()]
}

/// A coordinate system along the axes, with small integers as its origin: the axes are permuted, and
/// some are reversed.
struct Frame {
    origin: Vec3,
    axes: [Vec3; 3],
}

impl Frame {
    fn random(rng: &mut Rng) -> Self {
        let mut coordinate = || rng.integer(0, 8) as f32 - 4.0;
        let origin = vec3(coordinate(), coordinate(), coordinate());
        let axes = rng.shuffled(vec![Vec3::X, Vec3::Y, Vec3::Z]);
        let axes = [axes[0], axes[1], axes[2]].map(|axis| axis * rng.sign() as f32);
        Frame { origin, axes }
    }

    fn dir(&self, x: f32, y: f32, z: f32) -> Vec3 {
        x * self.axes[0] + y * self.axes[1] + z * self.axes[2]
    }

    fn point(&self, x: f32, y: f32, z: f32) -> Vec3 {
        self.origin + self.dir(x, y, z)
    }
}

/// Returns the item about degenerate triangles. Its coordinates are small integers, so that the
/// determinant is exactly zero in every correct formula.
pub(super) const DEGENERATE: Declaration = Declaration {
    id: "triangle.degenerate",
    title: "a triangle that has no area or is parallel to the ray is missed",
    look: "The determinant is then zero, and dividing by it gives no usable number: return a miss.",
    section: "triangle.md#when-the-denominator-is-zero",
    questions: degenerate,
    ..Declaration::ALONE
};

fn degenerate(rng: &mut Rng) -> Vec<ExamQuestion> {
    let frame = Frame::random(rng);
    let flat = |corners: [[f32; 2]; 3]| {
        let vertex = |[x, y]: [f32; 2]| {
            Vertex::new(frame.point(x, y, 0.0), frame.dir(0.0, 0.0, 1.0), Vec2::ZERO)
        };
        shape(&corners.map(vertex), 0)
    };
    let vertices = random_triangle(rng);
    let control = (0..4).map(|_| hitting_ray(rng, &vertices, Side::Either));
    let down = |x: f32, y: f32| Ray::new(frame.point(x, y, 4.0), frame.dir(0.0, 0.0, -1.0));
    let along = |y: f32, z: f32| Ray::new(frame.point(-4.0, y, z), frame.dir(1.0, 0.0, 0.0));

    let line = flat([[0.0, 1.0], [1.0, 1.0], [3.0, 1.0]]);
    let point = flat([[1.0, 1.0]; 3]);
    let coinciding_corners = flat([[1.0, 2.0], [1.0, 2.0], [3.0, 2.0]]);
    let half_square = flat([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]);
    // Parallel to the plane at several distances, over the triangle and beside it.
    let beside = [1.0, 2.0, 3.0, -1.0, 5.0].into_iter();
    let parallel = beside.flat_map(|y| [2.0, -2.0, 1.0, -1.0].map(|z| along(y, z)));
    let parallel = parallel.collect();
    let question = |shape: Shape, rays: Vec<Ray>| shape_question(&[], shape, rays);
    vec![
        question(line, vec![down(1.0, 1.0), down(2.0, 1.0), down(2.0, 3.0)]),
        question(point, vec![down(1.0, 1.0), down(0.0, 0.0)]),
        question(coinciding_corners, vec![down(2.0, 2.0), down(1.0, 2.0)]),
        question(half_square, vec![along(1.0, 0.0), along(-1.0, 0.0)]),
        // On both sides of the plane, as t = z / 0 is +∞ on one of them and −∞ on the other.
        question(half_square, parallel),
        distance_question(&vertices, control),
    ]
}
