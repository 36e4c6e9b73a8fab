//! Items about whether a ray hits a triangle, and at what distance.

use glam::{Vec2, Vec3, vec3};
use judging::exam::ExamQuestion;
use judging::symptom::{PRESENCE, Symptom};
use protocol::{Ray, Shape, Vertex};

use super::{is_steep, is_well_inside, questions};
use crate::domains::fields::{EVERY_SIZE, SMALL, USUAL};
use crate::domains::triangle::Plane;
use crate::items::{Declaration, groups, paper, shape_question};
use crate::seed::Rng;

/// Returns whether the hit depends only on the point where the ray crosses the plane.
fn is_ahead(plane: &Plane) -> bool {
    plane.is_unlimited() && plane.distance > 0.0
}

/// Returns whether the hit depends only on the range.
fn is_through(plane: &Plane) -> bool {
    is_steep(plane) && plane.is_inside() && is_well_inside(plane)
}

pub(super) const INSIDE: Declaration = Declaration {
    id: "triangle.inside",
    points: 2,
    title: "a ray through the interior of the triangle hits it at distance t",
    look: "Work out u, v and t by hand for the ray shown, and compare them with the values in your code. It \
        is a hit if u, v and 1 − u − v are all at least 0 and t is in ray.range, and \
           then t is the distance.",
    section: "triangle.md#three-equations-for-three-unknowns",
    tests: &[
        "Returns the ray's…",
        "The triangle can…",
        "`distance` is the…",
    ],
    questions: |rng| {
        let drawn = questions(rng, &["distance"], USUAL, |plane| {
            is_ahead(plane) && plane.slope < 0.0 && is_steep(plane) && is_well_inside(plane)
        });
        [vec![paper::triangle(rng)], drawn].concat()
    },
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

pub(super) const OUTSIDE: Declaration = Declaration {
    id: "triangle.outside",
    points: 2,
    title: "a ray hits the triangle within its three edges, and misses it beyond them",
    look: "u, v and w = 1 − u − v each belong to one corner. Beyond any of the three edges, the \
           weight of the opposite corner is negative.",
    look_fits: &[Symptom::HIT],
    section: "triangle.md#test-the-third-weight-too",
    tests: &["Returns the ray's…", "The triangle can…"],
    questions: |rng| {
        questions(rng, &[], EVERY_SIZE, |plane| {
            is_ahead(plane) && is_steep(plane)
        })
    },
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

pub(super) const FROM_BEHIND: Declaration = Declaration {
    id: "triangle.from_behind",
    title: "a triangle can be hit from behind too",
    look: "If the triangle is seen from behind, the determinant has the opposite sign, but that \
        doesn't make it a miss.",
    look_fits: &[Symptom::MISS],
    section: "triangle.md#a-ray-from-behind-has-a-negative-denominator",
    tests: &["The triangle can…"],
    questions: |rng| {
        questions(rng, &["distance"], USUAL, |plane| {
            is_ahead(plane) && plane.slope > 0.0 && is_steep(plane) && is_well_inside(plane)
        })
    },
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

pub(super) const RANGE_MAX: Declaration = Declaration {
    id: "triangle.range_max",
    title: "t must be at most the end of the ray's range",
    look: "A ray through the triangle hits it if and only if t is in ray.range, even if the \
        triangle is tiny. Which comparison in your code decides this for the ray shown?",
    look_fits: &[Symptom::of(PRESENCE)],
    section: "triangle.md#check-both-ends-of-the-range",
    tests: &["`ray.range` includes both…"],
    questions: |rng| {
        questions(rng, &["distance"], EVERY_SIZE, |plane| {
            is_through(plane) && plane.ray64.min == 0.0 && plane.ray64.max.is_finite()
        })
    },
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

pub(super) const RANGE_MIN: Declaration = Declaration {
    id: "triangle.range_min",
    title: "t must be at least the start of the ray's range",
    look: "The range has two ends, and it doesn't have to start at 0. Compare t with these two \
        ends, not with a constant, even a small one.",
    look_fits: &[Symptom::of(PRESENCE)],
    section: "triangle.md#check-both-ends-of-the-range",
    tests: &["`ray.range` includes both…"],
    questions: |rng| {
        questions(rng, &["distance"], EVERY_SIZE, |plane| {
            is_through(plane) && plane.ray64.min > 0.0
        })
    },
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

pub(super) const BEHIND_THE_RAY: Declaration = Declaration {
    id: "triangle.behind_the_ray",
    title: "a triangle ahead of the ray is hit, and one behind it is missed",
    look: "Work out t for the ray shown. If the triangle is behind the ray, t is negative, even though the \
        weights look like those of a hit. If it is ahead, t is in ray.range.",
    section: "triangle.md#hits-behind-the-origin-do-not-count",
    tests: &["Returns the ray's…"],
    questions: |rng| {
        questions(rng, &["distance"], USUAL, |plane| {
            is_through(plane) && plane.is_unlimited()
        })
    },
    ..Declaration::in_group(groups::TRIANGLE_HITS)
};

pub(super) const TINY: Declaration = Declaration {
    id: "triangle.tiny",
    title: "a triangle with edges of 1e-3 is hit like any other",
    look: "The determinant is small for small triangles too, not only for rays that are almost \
        parallel: compare it with zero, not with a small number.",
    look_fits: &[Symptom::MISS],
    section: "triangle.md#do-not-use-an-epsilon-instead-of-zero",
    tests: &["Triangles can be any…"],
    questions: |rng| {
        let all = ["distance", "position", "normal", "uv", "origin", "shape"];
        questions(rng, &all, &[SMALL; 3].concat(), |plane| {
            is_steep(plane) && is_well_inside(plane)
        })
    },
    ..Declaration::ALONE
};

/// A coordinate system that uses the world's axes in random order, some of them reversed. The
/// coordinates of its origin are small integers.
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

pub(super) const GRAZING: Declaration = Declaration {
    id: "triangle.grazing",
    title: "a ray that grazes a triangle hits it like any other",
    look: "The determinant is small if the ray is almost parallel to the triangle. That doesn't make it a \
        miss, unless it is exactly zero.",
    look_fits: &[Symptom::MISS],
    section: "triangle.md#do-not-use-an-epsilon-instead-of-zero",
    tests: &["Triangles can be any…"],
    questions: |rng| {
        let all = ["distance", "position", "origin", "shape", "normal", "uv"];
        // At the smallest cosines, rounding spoils the weights.
        let hits = questions(rng, &all[..4], EVERY_SIZE, |plane| !is_steep(plane));
        let sizes = [SMALL, USUAL].concat();
        let weights = questions(rng, &all, &sizes, |plane| !is_steep(plane));
        [hits, weights].concat()
    },
    ..Declaration::ALONE
};

/// The item about degenerate triangles. Its coordinates are small integers, so that the determinant
/// is exactly zero in every correct formula.
pub(super) const DEGENERATE: Declaration = Declaration {
    id: "triangle.degenerate",
    title: "a triangle that has no area or is parallel to the ray is missed",
    look: "If the triangle has no area or is parallel to the ray, the determinant is zero, and dividing by it \
        gives no usable number: return a miss.",
    look_fits: &[Symptom::HIT],
    section: "triangle.md#when-the-denominator-is-zero",
    tests: &["A triangle without…"],
    questions: degenerate,
    ..Declaration::ALONE
};

fn degenerate(rng: &mut Rng) -> Vec<ExamQuestion> {
    let frame = Frame::random(rng);
    let flat = |corners: [[f32; 2]; 3]| {
        let vertex = |[x, y]: [f32; 2]| {
            Vertex::new(frame.point(x, y, 0.0), frame.dir(0.0, 0.0, 1.0), Vec2::ZERO)
        };
        Shape::Triangle {
            vertices: corners.map(vertex),
            shape: 0,
        }
    };
    let down = |x: f32, y: f32| Ray::new(frame.point(x, y, 4.0), frame.dir(0.0, 0.0, -1.0));
    let along = |y: f32, z: f32| Ray::new(frame.point(-4.0, y, z), frame.dir(1.0, 0.0, 0.0));

    let line = flat([[0.0, 1.0], [1.0, 1.0], [3.0, 1.0]]);
    let point = flat([[1.0, 1.0]; 3]);
    let coinciding_corners = flat([[1.0, 2.0], [1.0, 2.0], [3.0, 2.0]]);
    let half_square = flat([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]);
    // These rays are parallel to the plane at several distances, both over the triangle and beside
    // it.
    let beside = [1.0, 2.0, 3.0, -1.0, 5.0].into_iter();
    let parallel = beside.flat_map(|y| [2.0, -2.0, 1.0, -1.0].map(|z| along(y, z)));
    let parallel = parallel.collect();
    let question = |shape: Shape, rays: Vec<Ray>| shape_question(&[], shape, rays);
    let control = questions(rng, &["distance"], USUAL, |plane| {
        is_steep(plane) && is_well_inside(plane)
    });
    let degenerate = vec![
        question(line, vec![down(1.0, 1.0), down(2.0, 1.0), down(2.0, 3.0)]),
        question(point, vec![down(1.0, 1.0), down(0.0, 0.0)]),
        question(coinciding_corners, vec![down(2.0, 2.0), down(1.0, 2.0)]),
        question(half_square, vec![along(1.0, 0.0), along(-1.0, 0.0)]),
        // Use rays on both sides of the plane, because t = z / 0 is +∞ on one side and −∞ on the
        // other.
        question(half_square, parallel),
    ];
    [degenerate, control].concat()
}
