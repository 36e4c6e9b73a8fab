//! Trees with traps.

use grader::exam::{Asked, Item};
use protocol::Ray;

use super::{add_orphans, asked, from_around, item, rays, soup_tree};
use crate::oracle::Beam;
use crate::seed::{Draw, Seed};
use crate::tree::Tree;
use crate::tree::trap::{self, Shelter};
use crate::tree::walk::Walk;

/// Whether the slides' pseudo-code, taken literally, answers this ray rightly.
fn slides_are_right(tree: &Tree, ray: &Ray) -> bool {
    let beam = Beam::from(ray);
    Walk::slides(tree, &beam).closest == tree.truth(&beam)
}

/// The materials of traps begin here, those of orphans below.
const FIRST_TRAP: u32 = 20_000;

/// Which leaves shall hold traps for a ray.
type Fits<'a> = &'a dyn Fn(&Tree, usize, &Beam) -> bool;

/// The rays of a question that may get a trap; the others come after them.
const TRAPPED: usize = 10;
const OTHERS: [usize; 2] = [4, 4];
/// So few traps say little.
const FEWEST: usize = 4;

/// A question with traps before most of the rays that hit something, each in a leaf that `fits`.
/// What the slides' pseudo-code makes of them is as given; all other rays it answers rightly.
fn trapped(draw: &mut Draw, fits: Fits, slides: Slides) -> Asked {
    draw.until(|draw| {
        let tree = soup_tree(draw, 48, 0.7, 1);
        let rays = passing_rays(draw, &tree, fits);
        let (mut tree, count) = with_traps(draw, tree, &rays, fits, slides);
        if count < FEWEST {
            return None;
        }
        add_orphans(draw, &mut tree, &rays);
        Some(asked(&tree.with_roots_at_both_ends(draw), rays))
    })
}

/// Rays that have a leaf that fits, and then some others.
fn passing_rays(draw: &mut Draw, tree: &Tree, fits: Fits) -> Vec<Ray> {
    let mut passing = rays(draw, tree, [TRAPPED, 0], |draw, tree| {
        draw.until(|draw| {
            let ray = from_around(draw, tree);
            let beam = Beam::from(&ray);
            let mut leaves = tree.leaves().into_iter();
            leaves.any(|leaf| fits(tree, leaf, &beam)).then_some(ray)
        })
    });
    passing.extend(rays(draw, tree, OTHERS, from_around));
    passing
}

/// Sets a trap for each of the first rays, where that can be done, and counts them.
fn with_traps(
    draw: &mut Draw,
    mut tree: Tree,
    rays: &[Ray],
    fits: Fits,
    slides: Slides,
) -> (Tree, usize) {
    const ATTEMPTS: usize = 30;
    let mut done = Vec::new();
    for ray in 0..TRAPPED {
        let material = FIRST_TRAP + ray as u32;
        let set = (0..ATTEMPTS).find_map(|_| {
            let trapped = trap::set(draw, &tree, rays, ray, material, fits)?;
            let as_wanted = (0..).zip(rays).all(|(place, asked)| {
                let gets_one = place == ray || done.contains(&place);
                let wrong = gets_one && slides == Slides::Wrong;
                slides_are_right(&trapped, asked) != wrong
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
enum Slides {
    /// It is not caught.
    Right,
    /// It is caught.
    Wrong,
}

fn is_sheltered(tree: &Tree, leaf: usize, beam: &Beam, wanted: Shelter) -> bool {
    trap::shelter(tree, leaf, beam) == Some(wanted)
}

/// Whether the ray misses the box of the leaf's sibling as well.
fn misses_sibling(tree: &Tree, leaf: usize, beam: &Beam) -> bool {
    let sibling = tree.sibling(leaf);
    sibling.is_some_and(|sibling| tree.bounds(sibling).span(beam).is_none())
}

pub(super) fn skips_missed(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.skips_missed");
    let fits =
        |tree: &Tree, leaf: usize, beam: &Beam| is_sheltered(tree, leaf, beam, Shelter::Missed);
    item(
        "skips_missed",
        2,
        [
            "a node whose box the ray misses is not entered",
            "That is what the tree is for. In this exam some leaves hold primitives that lie outside \
             of their boxes: who enters a box that is missed, finds them.",
        ],
        vec![
            trapped(&mut draw, &fits, Slides::Right),
            trapped(&mut draw, &fits, Slides::Right),
        ],
    )
}

pub(super) fn prunes(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.prunes");
    let fits =
        |tree: &Tree, leaf: usize, beam: &Beam| is_sheltered(tree, leaf, beam, Shelter::Beyond);
    // The leaf is itself what comes second: nothing is compared any more on the way to it.
    let second = |tree: &Tree, leaf: usize, beam: &Beam| {
        let fork = trap::fork(tree, leaf, beam);
        fork.is_some_and(|fork| fork.here == leaf) && fits(tree, leaf, beam)
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
            trapped(&mut draw, &fits, Slides::Right),
            trapped(&mut draw, &second, Slides::Right),
        ],
    )
}

pub(super) fn nearer_first(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.nearer_first");
    let fits =
        |tree: &Tree, leaf: usize, beam: &Beam| is_sheltered(tree, leaf, beam, Shelter::Beyond);
    let left_last = |tree: &Tree, leaf: usize, beam: &Beam| {
        let fork = trap::fork(tree, leaf, beam);
        fork.is_some_and(|fork| fork.here == leaf && fork.is_left_last(tree, beam))
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
            trapped(&mut draw, &fits, Slides::Wrong),
            trapped(&mut draw, &left_last, Slides::Wrong),
        ],
    )
}

pub(super) fn both_sides(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.both_sides");
    let one = |tree: &Tree, leaf: usize, beam: &Beam| {
        is_sheltered(tree, leaf, beam, Shelter::Missed) && !misses_sibling(tree, leaf, beam)
    };
    let both = |tree: &Tree, leaf: usize, beam: &Beam| {
        is_sheltered(tree, leaf, beam, Shelter::Missed) && misses_sibling(tree, leaf, beam)
    };
    let alone = |tree: &Tree, leaf: usize, beam: &Beam| {
        is_sheltered(tree, leaf, beam, Shelter::BeyondBelow)
            && trap::is_alone_beyond(tree, leaf, beam)
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
            trapped(&mut draw, &one, Slides::Wrong),
            trapped(&mut draw, &both, Slides::Wrong),
            trapped(&mut draw, &alone, Slides::Wrong),
        ],
    )
}
