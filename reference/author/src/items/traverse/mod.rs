//! Task 3, step 2: walking trees; the exam's own, so that nothing hangs on a submission's `build`.
//!
//! Before some of the rays stand *orphans*: primitives that are in no leaf. Whoever asks all
//! primitives, without the tree, answers those. See [`crate::tree::trap`] for the traps that tell
//! ways of walking apart. Where the root stands is the idea of one item; in all others whoever
//! begins at the first node or the last begins rightly.

mod end_to_end;
mod needs;
mod unusual_trees;
mod with_decoys;
mod without_decoys;

use grader::exam::{ExamQuestion, HitCheck, Item, Task};
use protocol::Ray;

use super::meshes;
use crate::oracle::Ray64;
use crate::seed::{Rng, Seed};
use crate::tree::{Tree, construction, decoy};

pub use end_to_end::{radiance_item, radiance_question};

/// The items of the task `traverse`, but for [`radiance_item`].
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 15] = [
        without_decoys::closest_hit,
        without_decoys::first_box_empty,
        without_decoys::range,
        unusual_trees::root,
        without_decoys::leaf_of_several,
        without_decoys::deep,
        without_decoys::flat,
        without_decoys::mixed,
        unusual_trees::no_nodes,
        with_decoys::skips_missed,
        with_decoys::prunes,
        with_decoys::nearer_first,
        with_decoys::both_sides,
        end_to_end::own_tree,
        end_to_end::picture,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

fn item(name: &str, points: u32, text: [&str; 2], questions: Vec<ExamQuestion>) -> Item {
    let item = super::item(Task::Traverse, name, points, text, questions);
    needs::add(needs::add(item, &needs::TRIANGLES), &needs::BOXES)
}

/// The materials of orphans begin here, those of the tree's own primitives at 0.
const FIRST_UNREFERENCED: u32 = 10_000;

/// What the rays meet in the tree. Distances tell everything: no two primitives that a ray could
/// answer are at the same.
fn traversal_question(tree: &Tree, rays: Vec<Ray>) -> ExamQuestion {
    let key = super::hits_key(&[HitCheck::Distance], &rays, |beam| tree.expected_hit(beam));
    ExamQuestion::new(tree.question(rays), key)
}

/// A ray from around the tree toward somewhere in it.
fn ray_from_around(draw: &mut Rng, tree: &Tree) -> Ray {
    let bounds = tree.bounds(tree.root);
    let target = bounds.center() + draw.point(0.45) * (bounds.max - bounds.min);
    let away = draw.direction() * draw.uniform(0.6, 1.0) * bounds.diagonal();
    super::ray(target + away, target)
}

/// Rays about which there is no doubt: so many that hit something, and so many that do not.
fn unambiguous_rays(
    draw: &mut Rng,
    tree: &Tree,
    [hits, misses]: [usize; 2],
    mut kind: impl FnMut(&mut Rng, &Tree) -> Ray,
) -> Vec<Ray> {
    let mut rays = Vec::new();
    for (wanted, count) in [(true, hits), (false, misses)] {
        for _ in 0..count {
            rays.push(draw.retry(|draw| {
                let ray = kind(draw, tree);
                let hits = tree.expected_hit(&Ray64::from(&ray)).is_some();
                (hits == wanted && decoy::is_fair(tree, &[ray])).then_some(ray)
            }));
        }
    }
    draw.shuffled(rays)
}

/// Puts orphans before every third ray.
fn add_unreferenced(draw: &mut Rng, tree: &mut Tree, rays: &[Ray]) {
    for (number, ray) in (FIRST_UNREFERENCED..).zip(rays.iter().step_by(3)) {
        let end = tree
            .expected_hit(&Ray64::from(ray))
            .map_or(3.0, |met| met.distance);
        let start = f64::from(ray.range.min);
        let distance = start + (end - start) * draw.uniform(0.3, 0.7);
        let orphan = decoy::triangle_across(draw, ray, distance, 0.1, number);
        tree.shapes.push(orphan);
    }
}

/// A question whose tree tells the truth, but for orphans.
fn question_without_decoys(
    draw: &mut Rng,
    mut tree: Tree,
    counts: [usize; 2],
    kind: impl FnMut(&mut Rng, &Tree) -> Ray,
) -> ExamQuestion {
    let rays = unambiguous_rays(draw, &tree, counts, kind);
    add_unreferenced(draw, &mut tree, &rays);
    traversal_question(&tree.with_roots_at_both_ends(draw), rays)
}

/// A tree over a soup. Leaves of several are the idea of one item: elsewhere they hold one.
fn soup_tree(draw: &mut Rng, count: usize, size: f64, max_leaf_size: usize) -> Tree {
    construction::median_split(meshes::soup(draw, count, 2.0, size), max_leaf_size)
}
