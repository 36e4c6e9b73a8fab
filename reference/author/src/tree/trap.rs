//! Traps: primitives that a correct walk never tests, outside of the boxes that hold them. Whoever
//! tests one answers a hit that is not there.

use glam::DVec3;
use protocol::{Ray, Shape};

use super::Tree;
use super::walk::{MARGIN, Manner, Walk};
use crate::oracle::{Beam, scan};
use crate::seed::Draw;

/// Why a correct walk does not come to a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shelter {
    /// The ray misses the leaf's own box.
    Missed,
    /// The leaf hangs below a node that begins beyond the closest hit, whose own leaf hangs below
    /// that node's sibling.
    Beyond,
}

/// Why no correct walk of this ray comes to the leaf, by [`MARGIN`] of the box's diagonal; `None`
/// if one may.
pub fn shelter(tree: &Tree, leaf: usize, beam: &Beam) -> Option<Shelter> {
    let ahead = beam.ahead();
    let grown = |place: usize| {
        let bounds = tree.bounds(place);
        bounds.grown(MARGIN * bounds.diagonal())
    };
    if grown(leaf).span(&ahead).is_none() {
        return Some(Shelter::Missed);
    }

    let truth = tree.truth(beam)?;
    let holds = |&leaf: &usize| {
        let mut shapes = tree.primitives(leaf).map(|place| &tree.shapes[place]);
        shapes.any(|shape| shape.material() == truth.material)
    };
    let found = tree.leaves().into_iter().find(holds)?;
    let (here, there) = (tree.path(leaf), tree.path(found));
    // Below the last node that both paths share: `a` toward the closest hit, `b` toward the leaf.
    let shared = here.iter().zip(&there).take_while(|(x, y)| x == y).count();
    let (&a, &b, &parent) = (there.get(shared)?, here.get(shared)?, here.get(shared - 1)?);
    let entry = |place: usize| Some(tree.bounds(place).span(&ahead)?.0);
    let (enter_a, enter_b) = (entry(a)?, entry(b)?);
    let in_order = enter_a + MARGIN * tree.bounds(parent).diagonal() <= enter_b;
    let beyond = truth.distance + MARGIN * tree.bounds(b).diagonal() <= enter_b;
    (in_order && beyond).then_some(Shelter::Beyond)
}

/// Whether every correct walk answers every ray rightly, by the rules of [`shelter`] and by walking
/// in every [`Manner`]; and whether boxes nest, and the answers are beyond doubt.
pub fn is_fair(tree: &Tree, rays: &[Ray]) -> bool {
    rays.iter().all(|ray| {
        let beam = Beam::from(ray);
        is_sheltered(tree, &beam) && is_walkable(tree, &beam) && is_clear(tree, &beam)
    })
}

/// Whether every trap that would change this ray's answer is out of reach.
fn is_sheltered(tree: &Tree, beam: &Beam) -> bool {
    let truth = tree.truth(beam).map_or(beam.max, |met| met.distance);
    let honest = tree.honest();
    let dangerous = |place: usize| {
        !honest[place]
            && scan::meet(beam, &tree.shapes[place]).is_some_and(|met| met.distance < truth + 0.01)
    };
    tree.leaves().into_iter().all(|leaf| {
        let is_trap = tree.primitives(leaf).any(dangerous);
        !is_trap || (leaf != tree.root && shelter(tree, leaf, beam).is_some())
    })
}

/// Whether every manner of walking finds the truth.
fn is_walkable(tree: &Tree, beam: &Beam) -> bool {
    let truth = tree.truth(beam);
    Manner::ALL
        .into_iter()
        .all(|manner| Walk::right(tree, beam, manner).closest == truth)
}

/// Whether the truth is beyond doubt: no primitive as near as the closest hit is met doubtfully,
/// and no two are met at the same place.
fn is_clear(tree: &Tree, beam: &Beam) -> bool {
    let honest = tree.honest();
    let truth = tree.truth(beam);
    let end = truth.map_or(beam.max, |met| met.distance + 0.02);
    let near = Beam { max: end, ..*beam };
    let shapes = tree.shapes.iter().zip(&honest);
    shapes.filter(|(_, honest)| **honest).all(|(shape, _)| {
        let bounds = scan::bounds(shape);
        let is_near = bounds.grown(0.05).span(&near).is_some();
        let is_other = truth.is_none_or(|met| met.material != shape.material());
        !is_near
            || (scan::is_clear(beam, shape) && (!is_other || scan::meet(&near, shape).is_none()))
    })
}

/// A facet across the ray, at this distance, so small that other rays hardly meet it.
pub fn facet(draw: &mut Draw, ray: &Ray, distance: f64, size: f64, material: u32) -> Shape {
    let dir = ray.dir.as_dvec3();
    let middle = ray.origin.as_dvec3() + distance * dir;
    let x = draw.across(dir);
    let y = dir.cross(x);
    let corner = |across: f64, up: f64| -> DVec3 { middle + size * (across * x + up * y) };
    let corners = [corner(-1.0, -0.6), corner(1.0, -0.6), corner(0.0, 1.2)];
    Shape::Facet {
        corners: corners.map(|corner| corner.as_vec3()),
        material,
    }
}

/// Sets one trap for a ray: before its closest hit, in a leaf sheltered in this way that `fits`.
/// `None` if the leaf or the place that was drawn will not do.
pub fn set(
    draw: &mut Draw,
    tree: &Tree,
    rays: &[Ray],
    ray: usize,
    material: u32,
    fits: &dyn Fn(&Tree, usize, &Beam) -> bool,
) -> Option<Tree> {
    let beam = Beam::from(&rays[ray]);
    let leaves: Vec<usize> = tree
        .leaves()
        .into_iter()
        .filter(|&leaf| leaf != tree.root && fits(tree, leaf, &beam))
        .collect();
    if leaves.is_empty() {
        return None;
    }
    let leaf = leaves[draw.index(leaves.len())];

    let end = tree.truth(&beam).map_or(4.0, |met| met.distance);
    let distance = beam.min + (end - beam.min) * draw.uniform(0.2, 0.8);
    let trap = facet(draw, &rays[ray], distance, 0.1, material);
    let outside = tree.bounds(leaf).span(&Beam::from(&rays[ray]).ahead());
    if outside.is_some_and(|(enter, _)| enter < distance + 0.05) {
        return None;
    }
    let mut trapped = tree.clone();
    trapped.add(leaf, trap);
    is_fair(&trapped, rays).then_some(trapped)
}
