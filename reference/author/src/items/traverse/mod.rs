//! Task 3, step 2: walking trees; the exam's own, so that nothing hangs on a submission's `build`.
//!
//! Before some of the rays stand *orphans*: primitives that are in no leaf. Whoever asks all
//! primitives, without the tree, answers those. See [`crate::tree::trap`] for the traps that tell
//! ways of walking apart. Where the root stands is the idea of one item; in all others whoever
//! begins at the first node or the last begins rightly.

mod honest;
mod needs;
mod trapped;
mod unusual;
mod whole;

use grader::exam::{Asked, Item, Part, Task};
use protocol::Ray;

use super::meshes;
use crate::oracle::Beam;
use crate::seed::{Draw, Seed};
use crate::tree::{Tree, plant, trap};

pub use whole::{radiance_item, radiance_question};

/// The items of the task `traverse`, but for [`radiance_item`].
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 15] = [
        honest::closest_hit,
        honest::first_box_empty,
        honest::range,
        unusual::root,
        honest::leaf_of_several,
        honest::deep,
        honest::flat,
        honest::mixed,
        unusual::no_nodes,
        trapped::skips_missed,
        trapped::prunes,
        trapped::nearer_first,
        trapped::both_sides,
        whole::own_tree,
        whole::picture,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

fn item(name: &str, points: u32, text: [&str; 2], questions: Vec<Asked>) -> Item {
    let item = super::item(Task::Traverse, name, points, text, questions);
    needs::on(needs::on(item, &needs::TRIANGLES), &needs::BOXES)
}

/// The materials of orphans begin here, those of the tree's own primitives at 0.
const FIRST_ORPHAN: u32 = 10_000;

/// What the rays meet in the tree. Distances tell everything: no two primitives that a ray could
/// answer are at the same.
fn asked(tree: &Tree, rays: Vec<Ray>) -> Asked {
    let key = super::hits(&[Part::Distance], &rays, |beam| tree.truth(beam));
    Asked::new(tree.question(rays), key)
}

/// A ray from around the tree toward somewhere in it.
fn from_around(draw: &mut Draw, tree: &Tree) -> Ray {
    let bounds = tree.bounds(tree.root);
    let target = bounds.center() + draw.point(0.45) * (bounds.max - bounds.min);
    let away = draw.direction() * draw.uniform(0.6, 1.0) * bounds.diagonal();
    super::ray(target + away, target)
}

/// Rays about which there is no doubt: so many that hit something, and so many that do not.
fn rays(
    draw: &mut Draw,
    tree: &Tree,
    [hits, misses]: [usize; 2],
    mut kind: impl FnMut(&mut Draw, &Tree) -> Ray,
) -> Vec<Ray> {
    let mut rays = Vec::new();
    for (wanted, count) in [(true, hits), (false, misses)] {
        for _ in 0..count {
            rays.push(draw.until(|draw| {
                let ray = kind(draw, tree);
                let hits = tree.truth(&Beam::from(&ray)).is_some();
                (hits == wanted && trap::is_fair(tree, &[ray])).then_some(ray)
            }));
        }
    }
    draw.shuffled(rays)
}

/// Puts orphans before every third ray.
fn add_orphans(draw: &mut Draw, tree: &mut Tree, rays: &[Ray]) {
    for (number, ray) in (FIRST_ORPHAN..).zip(rays.iter().step_by(3)) {
        let end = tree.truth(&Beam::from(ray)).map_or(3.0, |met| met.distance);
        let start = f64::from(ray.range.min);
        let distance = start + (end - start) * draw.uniform(0.3, 0.7);
        let orphan = trap::facet(draw, ray, distance, 0.1, number);
        tree.shapes.push(orphan);
    }
}

/// A question whose tree tells the truth, but for orphans.
fn honest(
    draw: &mut Draw,
    mut tree: Tree,
    counts: [usize; 2],
    kind: impl FnMut(&mut Draw, &Tree) -> Ray,
) -> Asked {
    let rays = rays(draw, &tree, counts, kind);
    add_orphans(draw, &mut tree, &rays);
    asked(&tree.with_roots_at_both_ends(draw), rays)
}

/// A tree over a soup. Leaves of several are the idea of one item: elsewhere they hold one.
fn soup_tree(draw: &mut Draw, count: usize, size: f64, max_leaf_size: usize) -> Tree {
    plant::halves(meshes::soup(draw, count, 2.0, size), max_leaf_size)
}
