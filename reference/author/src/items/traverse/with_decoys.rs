//! Trees with traps.

use grader::exam::{ExamQuestion, Item};
use protocol::Ray;

use super::{
    add_unreferenced, item, ray_from_around, soup_tree, traversal_question, unambiguous_rays,
};
use crate::oracle::Ray64;
use crate::seed::{Rng, Seed};
use crate::tree::Tree;
use crate::tree::decoy::{self, SkipReason};
use crate::tree::traversal::Traversal;

/// Whether the slides' pseudo-code, taken literally, answers this ray rightly.
fn slides_are_correct(tree: &Tree, ray: &Ray) -> bool {
    let beam = Ray64::from(ray);
    Traversal::by_the_slides(tree, &beam).closest == tree.expected_hit(&beam)
}

/// The materials of traps begin here, those of orphans below.
const FIRST_DECOY: u32 = 20_000;

/// Which leaves shall hold traps for a ray.
type LeafFilter<'a> = &'a dyn Fn(&Tree, usize, &Ray64) -> bool;

/// The rays of a question that may get a trap; the others come after them.
const RAYS_WITH_DECOYS: usize = 10;
const OTHER_RAYS: [usize; 2] = [4, 4];
/// So few traps say little.
const MIN_DECOYS: usize = 4;

/// A question with traps before most of the rays that hit something, each in a leaf that `fits`.
/// What the slides' pseudo-code makes of them is as given; all other rays it answers rightly.
fn question_with_decoys(draw: &mut Rng, fits: LeafFilter, slides: SlidesAnswer) -> ExamQuestion {
    draw.retry(|draw| {
        let tree = soup_tree(draw, 48, 0.7, 1);
        let rays = rays_with_candidate_leaves(draw, &tree, fits);
        let (mut tree, count) = add_decoys(draw, tree, &rays, fits, slides);
        if count < MIN_DECOYS {
            return None;
        }
        add_unreferenced(draw, &mut tree, &rays);
        Some(traversal_question(
            &tree.with_roots_at_both_ends(draw),
            rays,
        ))
    })
}

/// Rays that have a leaf that fits, and then some others.
fn rays_with_candidate_leaves(draw: &mut Rng, tree: &Tree, fits: LeafFilter) -> Vec<Ray> {
    let mut passing = unambiguous_rays(draw, tree, [RAYS_WITH_DECOYS, 0], |draw, tree| {
        draw.retry(|draw| {
            let ray = ray_from_around(draw, tree);
            let beam = Ray64::from(&ray);
            let mut leaves = tree.leaves().into_iter();
            leaves.any(|leaf| fits(tree, leaf, &beam)).then_some(ray)
        })
    });
    passing.extend(unambiguous_rays(draw, tree, OTHER_RAYS, ray_from_around));
    passing
}

/// Sets a trap for each of the first rays, where that can be done, and counts them.
fn add_decoys(
    draw: &mut Rng,
    mut tree: Tree,
    rays: &[Ray],
    fits: LeafFilter,
    slides: SlidesAnswer,
) -> (Tree, usize) {
    const ATTEMPTS: usize = 30;
    let mut done = Vec::new();
    for ray in 0..RAYS_WITH_DECOYS {
        let material = FIRST_DECOY + ray as u32;
        let set = (0..ATTEMPTS).find_map(|_| {
            let trapped = decoy::add_decoy(draw, &tree, rays, ray, material, fits)?;
            let as_wanted = (0..).zip(rays).all(|(place, asked)| {
                let gets_one = place == ray || done.contains(&place);
                let wrong = gets_one && slides == SlidesAnswer::Wrong;
                slides_are_correct(&trapped, asked) != wrong
            });
            as_wanted.then_some(trapped)
        });
        // Not every leaf that fits is on the side where the slides do as wanted.
        if let Some(trapped) = set {
            tree = trapped;
            done.push(ray);
        }
    }
    (tree, done.len())
}

/// What the slides' pseudo-code, taken literally, makes of a trap.
#[derive(Clone, Copy, PartialEq, Eq)]
enum SlidesAnswer {
    /// It is not caught.
    Correct,
    /// It is caught.
    Wrong,
}

fn is_skipped_for(tree: &Tree, leaf: usize, beam: &Ray64, wanted: SkipReason) -> bool {
    decoy::skip_reason(tree, leaf, beam) == Some(wanted)
}

/// Whether the ray misses the box of the leaf's sibling as well.
fn misses_sibling(tree: &Tree, leaf: usize, beam: &Ray64) -> bool {
    let sibling = tree.sibling(leaf);
    sibling.is_some_and(|sibling| tree.bounds(sibling).span(beam).is_none())
}

pub(super) fn skips_missed(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.skips_missed");
    let fits = |tree: &Tree, leaf: usize, beam: &Ray64| {
        is_skipped_for(tree, leaf, beam, SkipReason::Missed)
    };
    item(
        "skips_missed",
        2,
        [
            "a node whose box the ray misses is not entered",
            "That is what the tree is for. In this exam some leaves hold primitives that lie outside \
             of their boxes: who enters a box that is missed, finds them.",
        ],
        vec![
            question_with_decoys(&mut draw, &fits, SlidesAnswer::Correct),
            question_with_decoys(&mut draw, &fits, SlidesAnswer::Correct),
        ],
    )
}

pub(super) fn prunes(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.prunes");
    let fits = |tree: &Tree, leaf: usize, beam: &Ray64| {
        is_skipped_for(tree, leaf, beam, SkipReason::SubtreePruned)
    };
    // The leaf is itself what comes second: nothing is compared any more on the way to it.
    let second = |tree: &Tree, leaf: usize, beam: &Ray64| {
        let fork = decoy::find_fork(tree, leaf, beam);
        fork.is_some_and(|fork| fork.toward_leaf == leaf) && fits(tree, leaf, beam)
    };
    item(
        "prunes",
        2,
        [
            "a node that begins beyond the closest hit is not entered",
            "The nearer child goes first. If what it finds is nearer than the other's box, nothing \
             in there can be nearer still.",
        ],
        vec![
            question_with_decoys(&mut draw, &fits, SlidesAnswer::Correct),
            question_with_decoys(&mut draw, &second, SlidesAnswer::Correct),
        ],
    )
}

pub(super) fn nearer_first(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.nearer_first");
    let fits = |tree: &Tree, leaf: usize, beam: &Ray64| {
        is_skipped_for(tree, leaf, beam, SkipReason::SubtreePruned)
    };
    let left_last = |tree: &Tree, leaf: usize, beam: &Ray64| {
        let fork = decoy::find_fork(tree, leaf, beam);
        fork.is_some_and(|fork| fork.toward_leaf == leaf && fork.exits_hit_side_last(tree, beam))
            && fits(tree, leaf, beam)
    };
    item(
        "nearer_first",
        1,
        [
            "the nearer child goes first, be it l or r, and the other is pruned",
            "Where r goes first, it is l that may begin beyond the closest hit. The slides compare \
             hit2.t in both cases: compare the entry of whichever child comes second.",
        ],
        vec![
            question_with_decoys(&mut draw, &fits, SlidesAnswer::Wrong),
            question_with_decoys(&mut draw, &left_last, SlidesAnswer::Wrong),
        ],
    )
}

pub(super) fn both_sides(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.both_sides");
    let one = |tree: &Tree, leaf: usize, beam: &Ray64| {
        is_skipped_for(tree, leaf, beam, SkipReason::Missed) && !misses_sibling(tree, leaf, beam)
    };
    let both = |tree: &Tree, leaf: usize, beam: &Ray64| {
        is_skipped_for(tree, leaf, beam, SkipReason::Missed) && misses_sibling(tree, leaf, beam)
    };
    let alone = |tree: &Tree, leaf: usize, beam: &Ray64| {
        is_skipped_for(tree, leaf, beam, SkipReason::LeafPruned)
            && decoy::siblings_beyond_are_missed(tree, leaf, beam)
    };
    item(
        "both_sides",
        1,
        [
            "each child is entered only if its own box is hit, before the closest hit",
            "If one box is missed only the other child is entered, unless it begins beyond the \
             closest hit; if both are, neither. The slides enter `first` in any case, and after it \
             the child whose box was missed.",
        ],
        vec![
            question_with_decoys(&mut draw, &one, SlidesAnswer::Wrong),
            question_with_decoys(&mut draw, &both, SlidesAnswer::Wrong),
            question_with_decoys(&mut draw, &alone, SlidesAnswer::Wrong),
        ],
    )
}
