//! Items of task 3, step 2: traversal of the exam's own trees, so that the result does not depend
//! on a submission's `build`.
//!
//! Some rays have an unreferenced primitive (one that isn't in any leaf) in front of the correct
//! hit. A linear scan over all primitives, which ignores the tree, returns this wrong primitive.
//! [`crate::tree::decoy`] describes the decoys, which reveal that a traversal entered a node that
//! it should have skipped. `cells` spreads the decoys over all kinds, leaves, levels and ranges.
//! One item tests the position of the root. In all other items, starting at the first or the last
//! node also gives correct answers.

mod cells;
mod end_to_end;
mod layers;
mod placed;
mod trace;
mod unusual_trees;
mod with_decoys;
mod without_decoys;

use glam::DVec3;
use judging::exam::ExamQuestion;
use protocol::{Question, Ray, Shape};

use self::placed::{Mover, is_clear_of_faces};
use super::meshes;
use crate::domains::fields::{almost_the_same_ray, mirrored};
use crate::domains::traverse::{self, TRAVERSE};
use crate::items::{AuthoredTask, Declaration, groups, paper};
use crate::oracle::Ray64;
use crate::seed::Rng;
use crate::tree::{Tree, construction, decoy};

/// The task `traverse`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        without_decoys::CLOSEST_HIT,
        without_decoys::FIRST_BOX_EMPTY,
        without_decoys::RANGE,
        unusual_trees::ROOT,
        without_decoys::LEAF_OF_SEVERAL,
        without_decoys::DEEP,
        without_decoys::FLAT,
        without_decoys::MIXED,
        trace::TRACE,
        unusual_trees::NO_NODES,
        with_decoys::SKIPS_MISSED,
        with_decoys::PRUNES,
        with_decoys::NEARER_FIRST,
        with_decoys::BOTH_SIDES,
        end_to_end::OWN_TREE,
        end_to_end::PICTURE,
        end_to_end::RADIANCE,
    ],
    domains: &[&TRAVERSE],
    finish: |seed, items| {
        let mut mover = Mover::new(seed);
        for item in items.iter_mut() {
            mover.move_all(item.questions());
        }
        // Moving this question would make its numbers hard to work with.
        let (tree, rays) = paper::tree(&mut seed.rng("traverse.paper"));
        items[0]
            .questions()
            .insert(0, traversal_question(&tree, rays));
    },
    ..AuthoredTask::NEW
};

/// The default fields of an item about traversal. Such an item also fails if triangles or boxes are
/// wrong.
const TRAVERSAL: Declaration = Declaration {
    needs: &[groups::TRIANGLE_HITS, groups::BOXES],
    ..Declaration::ALONE
};

/// The number of the first unreferenced primitive. Primitives in leaves are numbered from 0.
const FIRST_UNREFERENCED: u32 = 10_000;

/// Creates a question that asks for the closest hits of the rays in the tree. Only distances are
/// judged. This suffices, because no two primitives that a ray could hit are at the same distance.
fn traversal_question(tree: &Tree, rays: Vec<Ray>) -> ExamQuestion {
    let key = super::hits_key(&["distance"], &rays, |ray64| tree.expected_hit(ray64));
    ExamQuestion::new(Question::hits(tree.geometry(), rays), key)
}

/// Returns a ray from a point in or around the tree toward a point in the tree.
fn ray_from_around(rng: &mut Rng, tree: &Tree) -> Ray {
    rng.retry(|rng| {
        let ray = match rng.index(8) {
            0 => traverse::ray_from_a_surface(rng, tree),
            _ => Some(traverse::ray(rng, tree)),
        };
        ray.filter(|ray| is_clear_of_faces(tree, ray))
    })
}

/// Returns rays of one kind whose answers are unambiguous, in random order: `hits` rays that hit
/// something, and `misses` rays that do not.
fn unambiguous_rays(
    rng: &mut Rng,
    tree: &Tree,
    [hits, misses]: [usize; 2],
    mut kind: impl FnMut(&mut Rng, &Tree) -> Ray,
) -> Vec<Ray> {
    let mut rays = Vec::new();
    for (expected, count) in [(true, hits), (false, misses)] {
        for _ in 0..count {
            rays.push(rng.retry(|rng| {
                let ray = kind(rng, tree);
                let is_hit = tree.expected_hit(&Ray64::from(&ray)).is_some();
                (is_hit == expected && decoy::is_fair(tree, &[ray])).then_some(ray)
            }));
        }
    }
    rng.shuffled(rays)
}

/// Adds an unreferenced primitive in front of the correct hit of every third ray. Also adds an
/// unreferenced primitive that is almost as large as the tree.
fn add_unreferenced(rng: &mut Rng, tree: &mut Tree, rays: &[Ray]) {
    for (number, ray) in (FIRST_UNREFERENCED..).zip(rays.iter().step_by(3)) {
        let hit = tree.expected_hit(&Ray64::from(ray));
        let end = hit.map_or(3.0, |hit| hit.distance);
        let start = f64::from(ray.range.min);
        let distance = start + (end - start) * rng.uniform(0.3, 0.7);
        let triangle = decoy::triangle_across(rng, ray, distance, 0.1, number);
        tree.shapes.push(triangle);
    }
    if tree.nodes.len() > 1 {
        let number = FIRST_UNREFERENCED + rays.len() as u32;
        let wall = wall(rng, tree, number);
        tree.shapes.push(wall);
    }
}

/// Returns a triangle that is perpendicular to an axis, almost as large as the tree and inside its
/// box.
fn wall(rng: &mut Rng, tree: &Tree, number: u32) -> Shape {
    let bounds = tree.bounds(tree.root);
    let axis = rng.index(3);
    let half = 0.485 * (bounds.max - bounds.min);
    let at = |[along, x, y]: [f64; 3]| {
        let mut corner = DVec3::ZERO;
        for (next, part) in [along, x, y].into_iter().enumerate() {
            corner[(axis + next) % 3] = part;
        }
        bounds.center() + corner * half
    };
    let (along, x, y) = (rng.uniform(-0.6, 0.6), rng.sign(), rng.sign());
    let corners = [[-x, -y], [x, -y], [-x, y]].map(|[x, y]| at([along, x, y]));
    meshes::flat_triangle(corners, number)
}

/// Returns the rays, followed by up to six groups of additional rays. In each group, consecutive
/// rays are closely related, but their answers clearly differ.
fn with_related_rays(rng: &mut Rng, tree: &Tree, mut rays: Vec<Ray>) -> Vec<Ray> {
    /// The maximum number of attempts to find the two rays of a group.
    const ATTEMPTS: usize = 2000;
    /// The minimum difference between the distances of the two hits, relative to the larger
    /// distance.
    const LEAST: f64 = 7e-4;
    for group in 0..6 {
        let found = rng.attempt(ATTEMPTS, |rng| {
            let ray = ray_from_around(rng, tree);
            let other = match group {
                0..3 => almost_the_same_ray(rng, &ray),
                3 | 4 => mirrored(rng, &ray)?,
                _ => Ray {
                    dir: -ray.dir,
                    ..ray
                },
            };
            let distance = |ray: &Ray| Some(tree.expected_hit(&Ray64::from(ray))?.distance);
            let is_clear = is_clear_of_faces(tree, &other) && decoy::is_fair(tree, &[ray, other]);
            let is_other = match (distance(&ray), distance(&other)) {
                (Some(first), Some(second)) => {
                    (first - second).abs() > LEAST * first.max(second) && group % 2 == 0
                }
                (first, second) => first.is_some() != second.is_some(),
            };
            (is_other && is_clear).then_some([ray, other])
        });
        if let Some([first, second]) = found {
            rays.extend([first, second, first]);
        }
    }
    rays
}

/// Creates a question about a tree without decoys, but with unreferenced primitives.
fn question_without_decoys(
    rng: &mut Rng,
    mut tree: Tree,
    counts: [usize; 2],
    kind: impl FnMut(&mut Rng, &Tree) -> Ray,
) -> ExamQuestion {
    let rays = unambiguous_rays(rng, &tree, counts, kind);
    with_unreferenced(rng, &mut tree, rays)
}

/// Adds unreferenced primitives to a tree and creates a question about it.
fn with_unreferenced(rng: &mut Rng, tree: &mut Tree, rays: Vec<Ray>) -> ExamQuestion {
    add_unreferenced(rng, tree, &rays);
    // A tree with a single node doesn't get any more nodes.
    if tree.nodes.len() > 1 {
        *tree = tree.with_roots_at_both_ends(rng);
    }
    traversal_question(tree, rays)
}

/// Creates a small question that a linear scan gets wrong and every correct traversal gets right.
fn linear_scan_control(rng: &mut Rng) -> ExamQuestion {
    let tree = soup_tree(rng, 12, 0.9, 1);
    question_without_decoys(rng, tree, [8, 4], ray_from_around)
}

/// Returns a tree over random triangles. Most items use leaves of one primitive, because a separate
/// item tests larger leaves.
fn soup_tree(rng: &mut Rng, count: usize, size: f64, max_leaf_size: usize) -> Tree {
    construction::median_split(meshes::soup(rng, count, 2.0, size), max_leaf_size)
}
