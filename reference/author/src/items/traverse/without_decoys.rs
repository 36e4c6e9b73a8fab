//! Items whose trees contain no decoys: every primitive in a leaf is inside the leaf's box.

use glam::DVec3;
use judging::exam::ExamQuestion;

use super::{TRAVERSAL, question_without_decoys, ray_from_around, soup_tree};
use crate::items::place::dust;
use crate::items::{Declaration, groups, meshes, ray};
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;
use crate::tree::traversal::{Traversal, TraversalRule};
use crate::tree::{Tree, construction};

pub(super) const CLOSEST_HIT: Declaration = Declaration {
    id: "traverse.closest_hit",
    title: "the closest hit counts, not the first one found",
    look: "Follow the ray shown through the tree from its root, box by box: which primitives need \
           to be tested, and which of their hits is the closest? Then see which primitives your \
           code tests, and which hit it keeps after each.",
    section: "traversal.md#the-first-hit-need-not-be-the-closest",
    questions: |rng| {
        // At least half of the hits are found after a farther one.
        let kind = |rng: &mut Rng, tree: &Tree| {
            let any = rng.coin();
            rng.retry(|rng| {
                let ray = ray_from_around(rng, tree);
                (any || replaces_a_hit(tree, &Ray64::from(&ray))).then_some(ray)
            })
        };
        // With large triangles, the boxes of siblings overlap considerably.
        let mut question = || {
            let tree = soup_tree(rng, 40, 1.6, 1);
            question_without_decoys(rng, tree, [24, 8], kind)
        };
        vec![question(), dust(question())]
    },
    ..TRAVERSAL
};

/// Returns whether every correct traversal finds a farther hit before the closest one.
fn replaces_a_hit(tree: &Tree, ray64: &Ray64) -> bool {
    let closest = tree.expected_hit(ray64);
    TraversalRule::all().into_iter().all(|rule| {
        let tested = Traversal::correct(tree, ray64, rule).tested_primitives;
        let mut hits = tested
            .into_iter()
            .filter_map(|primitive| scan::intersect(ray64, &tree.shapes[primitive]));
        hits.next().is_some_and(|first| Some(first) != closest)
    })
}

pub(super) const FIRST_BOX_EMPTY: Declaration = Declaration {
    id: "traverse.first_box_empty",
    title: "a ray may hit a box without hitting anything inside it",
    look: "Work out by hand what the two boxes and the primitives in them give for the ray shown. \
           Until something is hit, there is no closest hit to compare with, and no child may be \
           skipped because of one.",
    section: "traversal.md#no-hit-yet-is-not-a-hit-at-distance-zero",
    questions: |rng| {
        // Small triangles leave most of a node's box empty.
        let tree = soup_tree(rng, 40, 0.5, 1);
        let counts = [16, 16];
        vec![question_without_decoys(rng, tree, counts, ray_from_around)]
    },
    ..TRAVERSAL
};

pub(super) const RANGE: Declaration = Declaration {
    id: "traverse.range",
    title: "only hits within the ray's range count",
    look: "A hit counts if it is within ray.range, which need not start at 0 or end at ∞, and the \
           closest such hit is the answer. Find all hits of the ray shown, and see where your code \
           takes another one or none.",
    section: "traversal.md#only-a-hit-shortens-the-ray",
    questions: range,
    ..TRAVERSAL
};

fn range(rng: &mut Rng) -> Vec<ExamQuestion> {
    let tree = soup_tree(rng, 40, 1.4, 1);
    // The range starts between the first two hits, or ends before the first or the second.
    let kind = |rng: &mut Rng, tree: &Tree| {
        rng.retry(|rng| {
            let ray = ray_from_around(rng, tree);
            let ray64 = Ray64::from(&ray);
            let first = tree.expected_hit(&ray64)?.distance;
            let rest = Ray64 {
                min: first + 0.05,
                ..ray64
            };
            let second = tree.expected_hit(&rest)?.distance;
            let (min, max) = match rng.index(3) {
                0 => (rng.uniform(first, second), second + 9.0),
                1 => (0.0, rng.uniform(first * 0.5, first)),
                _ => (0.0, rng.uniform(first, second)),
            };
            Some(ray.within(min as f32, max as f32))
        })
    };
    vec![question_without_decoys(rng, tree, [20, 8], kind)]
}

pub(super) const LEAF_OF_SEVERAL: Declaration = Declaration {
    id: "traverse.leaf_of_several",
    title: "every primitive of a leaf is tested",
    look: "A leaf holds primitives[start..start + size]. The closest of all their hits counts, be \
           it that of the first primitive, of the last one or of one in between.",
    section: "traversal.md#test-exactly-the-primitives-of-the-leaf",
    questions: leaf_of_several,
    ..TRAVERSAL
};

fn leaf_of_several(rng: &mut Rng) -> Vec<ExamQuestion> {
    let tree = soup_tree(rng, 48, 1.0, 8);
    // The closest of several hits in a leaf belongs in turn to the first primitive, to the last
    // one, and to one in between.
    let mut count = 0;
    let kind = |rng: &mut Rng, tree: &Tree| {
        rng.retry(|rng| {
            let ray = ray_from_around(rng, tree);
            let ray64 = Ray64::from(&ray);
            let Some(leaf) = tree.leaf_of_hit(&ray64) else {
                return Some(ray);
            };
            let indices = tree.primitives(leaf);
            let hits = indices.clone().filter_map(|index| {
                let hit = scan::intersect(&ray64, &tree.shapes[index])?;
                Some((hit.distance, index))
            });
            let hits: Vec<(f64, usize)> = hits.collect();
            let &(_, closest) = hits.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
            let is_in_turn = match count % 3 {
                0 => closest == indices.start,
                1 => closest + 1 == indices.end,
                _ => closest != indices.start && closest + 1 != indices.end,
            };
            if hits.len() < 2 || !is_in_turn {
                return None;
            }
            count += 1;
            Some(ray)
        })
    };
    vec![question_without_decoys(rng, tree, [24, 8], kind)]
}

pub(super) const DEEP: Declaration = Declaration {
    id: "traverse.deep",
    title: "a tree of 60 levels is traversed to the end",
    look: "A stack of fixed size must be large enough, and every node that is pushed must be \
           popped again.",
    section: "traversal.md#deep-trees",
    questions: deep,
    ..TRAVERSAL
};

fn deep(rng: &mut Rng) -> Vec<ExamQuestion> {
    const LEVELS: usize = 60;
    let triangles = (0..LEVELS).map(|i| {
        let center = DVec3::X * (0.5 * i as f64) + rng.point(0.3);
        meshes::random_flat_triangle(rng, center, 0.5)
    });
    let tree = construction::chain(meshes::number_shapes(triangles));
    // Rays along the chain, from both ends, and across it.
    let kind = |rng: &mut Rng, _: &Tree| {
        let target = DVec3::X * rng.uniform(0.0, 30.0) + rng.point(0.4);
        let away = match rng.index(3) {
            0 => DVec3::X + rng.point(0.2),
            1 => DVec3::NEG_X + rng.point(0.2),
            _ => rng.direction(),
        };
        ray(target + 6.0 * away, target)
    };
    vec![question_without_decoys(rng, tree, [24, 8], kind)]
}

pub(super) const FLAT: Declaration = Declaration {
    id: "traverse.flat",
    title: "leaves with flat boxes are entered",
    look: "A ray enters and leaves a flat box at the same time. If your box test is correct, check \
           how you use its result: an interval of one point is not empty.",
    section: "traversal.md#a-flat-box-has-equal-entry-and-exit",
    questions: |rng| {
        // Axis-parallel triangles, one per leaf.
        let triangles = (0..36).map(|i| {
            let axis = i % 3;
            let (x, y) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
            let corner = rng.point(2.0);
            let size = rng.uniform(0.6, 1.4) * rng.sign();
            meshes::flat_triangle([corner, corner + size * x, corner + size * y], 0)
        });
        let tree = construction::median_split(meshes::number_shapes(triangles), 1);
        vec![question_without_decoys(rng, tree, [24, 8], ray_from_around)]
    },
    ..TRAVERSAL
};

pub(super) const MIXED: Declaration = Declaration {
    id: "traverse.mixed",
    title: "a tree can hold spheres and triangles",
    look: "Primitive::hit tests either kind, and their distances are compared in the same way.",
    section: "traversal.md#the-first-hit-need-not-be-the-closest",
    questions: |rng| {
        let shapes = (0..36).map(|i| {
            let center = rng.point(2.0);
            if i % 2 == 0 {
                meshes::random_flat_triangle(rng, center, 0.9)
            } else {
                meshes::sphere(center, rng.uniform(0.2, 0.5))
            }
        });
        let tree = construction::median_split(meshes::number_shapes(shapes), 1);
        vec![question_without_decoys(rng, tree, [24, 8], ray_from_around)]
    },
    needs: &[groups::TRIANGLE_HITS, groups::BOXES, groups::SPHERE_HITS],
    ..TRAVERSAL
};
