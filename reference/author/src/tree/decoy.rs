//! Traps: primitives that a correct walk never tests, outside of the boxes that hold them. Whoever
//! tests one answers a hit that is not there.

use glam::DVec3;
use protocol::{Ray, Shape};

use super::Tree;
use super::traversal::{MARGIN, Traversal, TraversalRule};
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;

/// Why a correct walk does not come to a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkipReason {
    /// The ray misses the leaf's own box.
    Missed,
    /// The leaf hangs below a node that begins beyond the closest hit, whose own leaf hangs below
    /// that node's sibling.
    SubtreePruned,
    /// The leaf itself begins beyond the closest hit, whose own leaf hangs below another node that
    /// is entered, and left, before the one that leads here.
    LeafPruned,
}

/// Why no correct walk of this ray comes to the leaf, by [`MARGIN`] of the box's diagonal; `None`
/// if one may.
pub fn skip_reason(tree: &Tree, leaf: usize, beam: &Ray64) -> Option<SkipReason> {
    let bounds = tree.bounds(leaf);
    let grown = bounds.grown(MARGIN * bounds.diagonal());
    if grown.span(&beam.ahead()).is_none() {
        return Some(SkipReason::Missed);
    }

    let fork = find_fork(tree, leaf, beam)?;
    let entry = |place: usize| entry_distance(tree, place, beam);
    let beyond = |place: usize| {
        let margin = MARGIN * tree.bounds(place).diagonal();
        entry(place).is_some_and(|entry| fork.hit_distance + margin <= entry)
    };
    let margin = MARGIN * tree.bounds(fork.parent).diagonal();
    if entry(fork.toward_hit)? + margin <= entry(fork.toward_leaf)? && beyond(fork.toward_leaf) {
        return Some(SkipReason::SubtreePruned);
    }
    // Whoever looks at several levels at once, or at the nearest node of all, may ask for what is
    // here before all that is there; but not before the very leaf, if that begins first.
    (entry(fork.hit_leaf)? + margin <= entry(fork.toward_leaf)? && beyond(leaf))
        .then_some(SkipReason::LeafPruned)
}

/// Where the ways to a leaf and to the closest hit part.
#[derive(Clone, Copy, Debug)]
pub struct PathFork {
    /// The last node that both share.
    pub parent: usize,
    /// Its child toward the leaf.
    pub toward_leaf: usize,
    /// Its child toward the closest hit.
    pub toward_hit: usize,
    /// The closest hit's own leaf.
    pub hit_leaf: usize,
    /// How far away the closest hit is.
    pub hit_distance: f64,
}

impl PathFork {
    /// Whether the ray leaves the child toward the closest hit after the other.
    pub fn exits_hit_side_last(&self, tree: &Tree, beam: &Ray64) -> bool {
        let leave = |place: usize| tree.bounds(place).span(&beam.ahead()).map(|(_, end)| end);
        let margin = MARGIN * tree.bounds(self.parent).diagonal();
        leave(self.toward_hit) > leave(self.toward_leaf).map(|end| end + margin)
    }
}

/// Where the way to a leaf parts from that to the closest hit; nowhere if that is in the leaf, or if
/// the ray misses the leaf.
pub fn find_fork(tree: &Tree, leaf: usize, beam: &Ray64) -> Option<PathFork> {
    entry_distance(tree, leaf, beam)?;
    let truth = tree.expected_hit(beam)?;
    let found = tree.leaf_of_hit(beam)?;
    let (here, there) = (tree.path(leaf), tree.path(found));
    let shared = here.iter().zip(&there).take_while(|(x, y)| x == y).count();
    Some(PathFork {
        parent: *here.get(shared - 1)?,
        toward_leaf: *here.get(shared)?,
        toward_hit: *there.get(shared)?,
        hit_leaf: found,
        hit_distance: truth.distance,
    })
}

/// Where the ray enters a node's box.
fn entry_distance(tree: &Tree, place: usize, beam: &Ray64) -> Option<f64> {
    let (begin, _) = tree.bounds(place).span(&beam.ahead())?;
    Some(begin)
}

/// Whether all nodes that begin beyond the closest hit, on the way from the fork down to the leaf,
/// are the only child that is hit: nothing is entered before them that they could come after.
pub fn siblings_beyond_are_missed(tree: &Tree, leaf: usize, beam: &Ray64) -> bool {
    let Some(fork) = find_fork(tree, leaf, beam) else {
        return false;
    };
    let way = tree.path(leaf);
    let below = way
        .iter()
        .skip_while(|place| **place != fork.toward_leaf)
        .skip(1);
    let mut beyond = below.filter(|&&place| {
        entry_distance(tree, place, beam).is_some_and(|at| at > fork.hit_distance)
    });
    beyond.all(|&place| {
        let sibling = tree.sibling(place);
        sibling.is_some_and(|sibling| entry_distance(tree, sibling, beam).is_none())
    })
}

/// Whether every correct walk answers every ray rightly, by the rules of [`shelter`] and by walking
/// in every [`Manner`]; and whether boxes nest, and the answers are beyond doubt.
pub fn is_fair(tree: &Tree, rays: &[Ray]) -> bool {
    rays.iter().all(|ray| {
        let beam = Ray64::from(ray);
        decoys_are_out_of_reach(tree, &beam)
            && every_traversal_is_correct(tree, &beam)
            && answer_is_unambiguous(tree, &beam)
    })
}

/// Whether every trap that would change this ray's answer is out of reach.
fn decoys_are_out_of_reach(tree: &Tree, beam: &Ray64) -> bool {
    let truth = tree.expected_hit(beam).map_or(beam.max, |met| met.distance);
    let honest = tree.ordinary_primitives();
    let dangerous = |place: usize| {
        !honest[place]
            && scan::intersect(beam, &tree.shapes[place])
                .is_some_and(|met| met.distance < truth + 0.01)
    };
    tree.leaves().into_iter().all(|leaf| {
        let is_trap = tree.primitives(leaf).any(dangerous);
        !is_trap || (leaf != tree.root && skip_reason(tree, leaf, beam).is_some())
    })
}

/// Whether every manner of walking finds the truth.
fn every_traversal_is_correct(tree: &Tree, beam: &Ray64) -> bool {
    let truth = tree.expected_hit(beam);
    TraversalRule::ALL
        .into_iter()
        .all(|manner| Traversal::correct(tree, beam, manner).closest == truth)
}

/// Whether the truth is beyond doubt: no primitive as near as the closest hit is met doubtfully,
/// and no two are met at the same place.
fn answer_is_unambiguous(tree: &Tree, beam: &Ray64) -> bool {
    let honest = tree.ordinary_primitives();
    let truth = tree.expected_hit(beam);
    let end = truth.map_or(beam.max, |met| met.distance + 0.02);
    let near = Ray64 { max: end, ..*beam };
    let shapes = tree.shapes.iter().zip(&honest);
    shapes.filter(|(_, honest)| **honest).all(|(shape, _)| {
        let bounds = scan::bounds(shape);
        let is_near = bounds.grown(0.05).span(&near).is_some();
        let is_other = truth.is_none_or(|met| met.material != shape.material());
        !is_near
            || (scan::is_unambiguous(beam, shape)
                && (!is_other || scan::intersect(&near, shape).is_none()))
    })
}

/// A facet across the ray, at this distance, so small that other rays hardly meet it.
pub fn triangle_across(
    draw: &mut Rng,
    ray: &Ray,
    distance: f64,
    size: f64,
    material: u32,
) -> Shape {
    let dir = ray.dir.as_dvec3();
    let middle = ray.origin.as_dvec3() + distance * dir;
    let x = draw.perpendicular_to(dir);
    let y = dir.cross(x);
    let corner = |across: f64, up: f64| -> DVec3 { middle + size * (across * x + up * y) };
    let corners = [corner(-1.0, -0.6), corner(1.0, -0.6), corner(0.0, 1.2)];
    Shape::FlatTriangle {
        corners: corners.map(|corner| corner.as_vec3()),
        material,
    }
}

/// Sets one trap for a ray: before its closest hit, in a leaf sheltered in this way that `fits`.
/// `None` if the leaf or the place that was drawn will not do.
pub fn add_decoy(
    draw: &mut Rng,
    tree: &Tree,
    rays: &[Ray],
    ray: usize,
    material: u32,
    fits: &dyn Fn(&Tree, usize, &Ray64) -> bool,
) -> Option<Tree> {
    let beam = Ray64::from(&rays[ray]);
    let leaves: Vec<usize> = tree
        .leaves()
        .into_iter()
        .filter(|&leaf| leaf != tree.root && fits(tree, leaf, &beam))
        .collect();
    if leaves.is_empty() {
        return None;
    }
    let leaf = leaves[draw.index(leaves.len())];

    let end = tree.expected_hit(&beam).map_or(4.0, |met| met.distance);
    let distance = beam.min + (end - beam.min) * draw.uniform(0.2, 0.8);
    let trap = triangle_across(draw, &rays[ray], distance, 0.1, material);
    let outside = tree.bounds(leaf).span(&Ray64::from(&rays[ray]).ahead());
    if outside.is_some_and(|(enter, _)| enter < distance + 0.05) {
        return None;
    }
    let mut trapped = tree.clone();
    trapped.add_to_leaf(leaf, trap);
    is_fair(&trapped, rays).then_some(trapped)
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;
    use crate::items::meshes;

    /// A slanted facet that a ray along the x-axis meets in the middle of its box, or misses.
    fn slab(from: f64, to: f64, is_met: bool, material: u32) -> Shape {
        let y = if is_met { 0.0 } else { 2.0 };
        let corner = |x: f64, up: f64, z: f64| dvec3(x, y + up, z);
        meshes::flat_triangle(
            [
                corner(from, -1.0, -1.0),
                corner(from, -1.0, 1.0),
                corner(to, 1.5, 0.0),
            ],
            material,
        )
    }

    /// The shelter of the last leaf, of a fork of one leaf and of a fork of two.
    fn skip_reason_of_last(
        found: [f64; 2],
        middle: [f64; 2],
        last: [f64; 2],
    ) -> Option<SkipReason> {
        let mut tree = Tree {
            shapes: Vec::new(),
            nodes: Vec::new(),
            root: 0,
        };
        let there = tree.add_leaf(vec![slab(found[0], found[1], true, 0)]);
        let middle = tree.add_leaf(vec![slab(middle[0], middle[1], false, 1)]);
        let last = tree.add_leaf(vec![slab(last[0], last[1], true, 2)]);
        let here = tree.add_interior(middle, last);
        tree.root = tree.add_interior(there, here);
        let beam = Ray64::from(&Ray::new(glam::Vec3::ZERO, glam::Vec3::X));
        assert!(siblings_beyond_are_missed(&tree, last, &beam));
        skip_reason(&tree, last, &beam)
    }

    #[test]
    fn a_leaf_beyond_the_hit_is_skipped_once_the_hit_is_known() {
        let of = |middle, last| skip_reason_of_last([1.0, 5.0], [middle, 7.0], [last, 9.0]);
        // The closest hit is at 2.6, in a box that begins at 1.
        assert_eq!(of(6.0, 8.0), Some(SkipReason::SubtreePruned));
        assert_eq!(of(2.0, 8.0), Some(SkipReason::LeafPruned));
        assert_eq!(of(0.5, 8.0), None);
        assert_eq!(of(2.0, 2.5), None);
    }
}
