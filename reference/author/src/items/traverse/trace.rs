//! The item about all quantities of a hit.

use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::{Ray, Shape};

use super::placed::is_exact_elsewhere;
use super::{TRAVERSAL, question_without_decoys, ray_from_around};
use crate::domains::fields;
use crate::items::{Declaration, groups, hits_key, meshes};
use crate::oracle::Ray64;
use crate::seed::Rng;
use crate::tree::{Tree, construction};

/// The quantities of a hit.
pub(super) const QUANTITIES: [&str; 6] =
    ["distance", "position", "normal", "uv", "origin", "shape"];

pub(super) const TRACE: Declaration = Declaration {
    id: "traverse.trace",
    title: "the trace is the one that Primitive::hit returns for the given ray",
    look: "Primitive::hit returns the trace, and you can return it unchanged. Its origin is the origin of \
        the given ray, and its normal does not depend on where the ray comes from.",
    look_fits: &[
        Symptom::of("position"),
        Symptom::of("normal"),
        Symptom::of("uv"),
        Symptom::of("origin"),
        Symptom::of("shape"),
    ],
    section: "traversal.md#the-algorithm",
    tests: &["Returns the ray's…"],
    questions: |rng| {
        let counts = [(1, 1), (3, 3), (60, 1), (33, 6)];
        let question =
            |(index, (count, max_leaf_size))| question(rng, index % 2, count, max_leaf_size);
        counts.into_iter().enumerate().map(question).collect()
    },
    needs: &[
        groups::TRIANGLE_HITS,
        groups::BOXES,
        groups::TRIANGLE_SURFACE,
    ],
    ..TRAVERSAL
};

/// Creates a question about a tree of randomly numbered primitives of this kind.
pub(super) fn question(
    rng: &mut Rng,
    kind: usize,
    count: usize,
    max_leaf_size: usize,
) -> ExamQuestion {
    let shapes = shapes(rng, kind, count);
    let tree = construction::median_split(shapes, max_leaf_size);
    let mut asked = question_without_decoys(rng, tree, [24, 10], ray_with_range);
    let (tree, rays) = Tree::in_question(&asked.question).expect("it is about a tree");
    let rays = rays.to_vec();
    asked.key = hits_key(&QUANTITIES, &rays, |ray64| tree.expected_hit(ray64));
    asked
}

/// Returns primitives of this kind: triangles, flat triangles, spheres, or a mix of all three.
pub(super) fn shapes(rng: &mut Rng, kind: usize, count: usize) -> Vec<Shape> {
    let shapes: Vec<Shape> = (0..count)
        .map(|index| {
            let center = rng.point(2.0);
            match if kind < 3 { kind } else { index % 3 } {
                0 => meshes::random_triangle(rng, center, 1.0),
                1 => meshes::random_flat_triangle(rng, center, 1.0),
                _ => meshes::sphere(center, rng.uniform(0.3, 0.7)),
            }
        })
        .collect();
    let numbers = fields::numbers(rng, count);
    meshes::with_numbers(shapes, numbers)
}

/// Picks a random ray whose range may end before ∞ and start after 0. All correct formulas agree on
/// its hit.
pub(super) fn ray_with_range(rng: &mut Rng, tree: &Tree) -> Ray {
    rng.retry(|rng| {
        let ray = ray_from_around(rng, tree);
        let is_limited = ray.range.min > 0.0 || rng.coin();
        let range = if is_limited {
            ray.range
        } else {
            fields::range(rng, 2.0 * tree.bounds(tree.root).diagonal())
        };
        let ray = Ray { range, ..ray };
        let hit = tree.expected_hit(&Ray64::from(&ray));
        let is_exact = hit.is_none_or(|hit| is_exact_elsewhere(&tree.shapes, &ray, &hit));
        is_exact.then_some(ray)
    })
}
