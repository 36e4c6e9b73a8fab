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
pub(super) fn slides_are_right(tree: &Tree, ray: &Ray) -> bool {
    let beam = Beam::from(ray);
    Walk::slides(tree, &beam).closest == tree.truth(&beam)
}

/// The materials of traps begin here, those of orphans below.
const FIRST_TRAP: u32 = 20_000;

/// A question with traps before most of the rays that hit something, each in a leaf that `fits`.
/// The slides' pseudo-code shall be `right` about the rays that got one, and is about the others.
pub(super) fn trapped(
    draw: &mut Draw,
    fits: &dyn Fn(&Tree, usize, &Beam) -> bool,
    slides: Slides,
) -> Asked {
    const TRAPPED: usize = 10;
    const OTHERS: [usize; 2] = [4, 4];
    let mut tree = soup_tree(draw, 48, 0.7, 1);
    let others = rays(draw, &tree, OTHERS, from_around);
    let passing = rays(draw, &tree, [TRAPPED, 0], |draw, tree| {
        draw.until(|draw| {
            let ray = from_around(draw, tree);
            let beam = Beam::from(&ray);
            let any = tree
                .leaves()
                .into_iter()
                .any(|leaf| fits(tree, leaf, &beam));
            any.then_some(ray)
        })
    });
    let rays: Vec<Ray> = passing.into_iter().chain(others).collect();

    let mut trapped_rays = Vec::new();
    for ray in 0..TRAPPED {
        const ATTEMPTS: usize = 30;
        let material = FIRST_TRAP + ray as u32;
        let set = (0..ATTEMPTS).find_map(|_| {
            let trapped = trap::set(draw, &tree, &rays, ray, material, fits)?;
            let as_wanted = (0..).zip(&rays).all(|(place, asked)| {
                let gets_one = place == ray || trapped_rays.contains(&place);
                let wrong = gets_one && slides == Slides::Wrong;
                slides_are_right(&trapped, asked) != wrong
            });
            as_wanted.then_some(trapped)
        });
        // Not every leaf that fits is on the side that the slides treat as wanted.
        if let Some(trapped) = set {
            tree = trapped;
            trapped_rays.push(ray);
        }
    }
    add_orphans(draw, &mut tree, &rays);
    asked(&tree.with_roots_at_both_ends(draw), rays)
}

/// What the slides' pseudo-code, taken literally, makes of a trap.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Slides {
    /// It is not caught.
    Right,
    /// It is caught.
    Wrong,
}

pub(super) fn is_sheltered(tree: &Tree, leaf: usize, beam: &Beam, wanted: Shelter) -> bool {
    trap::shelter(tree, leaf, beam) == Some(wanted)
}

/// Whether the ray misses the box of the leaf's sibling as well.
pub(super) fn misses_sibling(tree: &Tree, leaf: usize, beam: &Beam) -> bool {
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
            trapped(&mut draw, &fits, Slides::Right),
        ],
    )
}

pub(super) fn nearer_first(seed: Seed) -> Item {
    let mut draw = seed.draw("traverse.nearer_first");
    let fits =
        |tree: &Tree, leaf: usize, beam: &Beam| is_sheltered(tree, leaf, beam, Shelter::Beyond);
    item(
        "nearer_first",
        1,
        [
            "the nearer child goes first, be it l or r, and the other is pruned",
            "Where r goes first, it is l that may begin beyond the closest hit. The slides compare \
             hit2.t in both cases: compare the entry of whichever child comes second.",
        ],
        vec![trapped(&mut draw, &fits, Slides::Wrong)],
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
    item(
        "both_sides",
        1,
        [
            "of two children each is entered only if its own box is hit",
            "If one box is missed only the other child is entered; if both are, neither. The slides \
             enter `first` in any case, and after it the child whose box was missed.",
        ],
        vec![
            trapped(&mut draw, &one, Slides::Wrong),
            trapped(&mut draw, &both, Slides::Wrong),
        ],
    )
}
