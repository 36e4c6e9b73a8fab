//! Decoys: primitives outside their leaf's box that a correct traversal never tests. A traversal
//! that tests a decoy returns a wrong hit.

use protocol::{Ray, Shape, TreeNode};

use super::Tree;
use super::traversal::{MARGIN, Traversal, TraversalRule};
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;

/// Why a correct traversal never enters a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkipReason {
    /// The ray misses the leaf's own box.
    Missed,
    /// The leaf is below a node whose box begins beyond the closest hit, and the leaf that contains
    /// that hit is below the node's sibling.
    SubtreePruned,
    /// The leaf's own box begins beyond the closest hit, and the leaf that contains that hit is
    /// entered before the subtree that leads to this leaf.
    LeafPruned,
}

/// Returns one of the two children of a node.
pub type Child = fn(&TreeNode) -> u32;

/// Returns true if the leaf is the given child of a node that every correct traversal enters and
/// the ray clearly misses the leaf's box. In that case, only the boxes of the node's two children
/// decide whether the leaf is entered.
pub fn is_missed_child(tree: &Tree, leaf: usize, ray64: &Ray64, child: Child) -> bool {
    let Some(parent) = tree.parent(leaf) else {
        return false;
    };
    let is_entered = |rule| {
        let traversal = Traversal::correct(tree, ray64, rule);
        traversal.reached_nodes.contains(&(parent, true))
    };
    child(&tree.nodes[parent]) as usize == leaf
        && skip_reason(tree, leaf, ray64) == Some(SkipReason::Missed)
        && TraversalRule::all().into_iter().all(is_entered)
}

/// Returns whether the ray misses the box of the leaf's sibling.
pub fn misses_sibling(tree: &Tree, leaf: usize, ray64: &Ray64) -> bool {
    let sibling = tree.sibling(leaf);
    sibling.is_some_and(|sibling| tree.bounds(sibling).span(ray64).is_none())
}

/// Returns whether the ray hits a primitive below the leaf's sibling.
pub fn hits_below_sibling(tree: &Tree, leaf: usize, ray64: &Ray64) -> bool {
    let below = |other: &usize| {
        let sibling = tree.sibling(leaf);
        sibling.is_some_and(|sibling| tree.path(*other).contains(&sibling))
    };
    let leaves = tree.leaves().into_iter().filter(below);
    let mut primitives = leaves.flat_map(|leaf| tree.primitives(leaf));
    primitives.any(|primitive| scan::hit_distance(ray64, &tree.shapes[primitive]).is_some())
}

/// Returns why no correct traversal with this ray enters the leaf, or `None` if a correct traversal
/// may enter it. The reason must hold by a clear margin: [`MARGIN`] times the diagonal of a box.
pub fn skip_reason(tree: &Tree, leaf: usize, ray64: &Ray64) -> Option<SkipReason> {
    let bounds = tree.bounds(leaf);
    let grown = bounds.grown(MARGIN * bounds.diagonal());
    if grown.span(&ray64.ahead()).is_none() {
        return Some(SkipReason::Missed);
    }

    let fork = find_fork(tree, leaf, ray64)?;
    let entry = |index: usize| entry_distance(tree, index, ray64);
    let is_beyond = |index: usize| {
        let margin = MARGIN * tree.bounds(index).diagonal();
        entry(index).is_some_and(|entry| fork.hit_distance + margin <= entry)
    };
    let margin = MARGIN * tree.bounds(fork.parent).diagonal();
    if entry(fork.toward_hit)? + margin <= entry(fork.toward_leaf)? && is_beyond(fork.toward_leaf) {
        return Some(SkipReason::SubtreePruned);
    }
    // A traversal that opens several levels at once, or always takes the nearest open node, may
    // enter the side with `leaf` before it has finished the side with the hit. It still enters the
    // leaf with the hit first if that leaf's box begins first.
    (entry(fork.hit_leaf)? + margin <= entry(fork.toward_leaf)? && is_beyond(leaf))
        .then_some(SkipReason::LeafPruned)
}

/// The node where the paths to a leaf and to the closest hit diverge.
#[derive(Clone, Copy, Debug)]
pub struct PathFork {
    /// The last node on both paths.
    pub parent: usize,
    /// The child of `parent` on the path to the leaf.
    pub toward_leaf: usize,
    /// The child of `parent` on the path to the closest hit.
    pub toward_hit: usize,
    /// The leaf of the closest hit.
    pub hit_leaf: usize,
    /// The distance of the closest hit.
    pub hit_distance: f64,
}

impl PathFork {
    /// Returns whether the ray leaves the box of `toward_hit` clearly later than the box of
    /// `toward_leaf`.
    pub fn exits_hit_side_last(&self, tree: &Tree, ray64: &Ray64) -> bool {
        let exit = |index: usize| tree.bounds(index).span(&ray64.ahead()).map(|(_, end)| end);
        let margin = MARGIN * tree.bounds(self.parent).diagonal();
        exit(self.toward_hit) > exit(self.toward_leaf).map(|end| end + margin)
    }
}

/// Finds where the path to a leaf diverges from the path to the closest hit. Returns `None` if the
/// ray hits nothing, if the hit is in the leaf itself, or if the ray misses the leaf's box.
pub fn find_fork(tree: &Tree, leaf: usize, ray64: &Ray64) -> Option<PathFork> {
    entry_distance(tree, leaf, ray64)?;
    let expected = tree.expected_hit(ray64)?;
    let hit_leaf = tree.leaf_of_hit(ray64)?;
    let (leaf_path, hit_path) = (tree.path(leaf), tree.path(hit_leaf));
    let both = leaf_path.iter().zip(&hit_path);
    let shared = both.take_while(|(x, y)| x == y).count();
    Some(PathFork {
        parent: *leaf_path.get(shared - 1)?,
        toward_leaf: *leaf_path.get(shared)?,
        toward_hit: *hit_path.get(shared)?,
        hit_leaf,
        hit_distance: expected.distance,
    })
}

/// Returns the distance at which the ray enters a node's box, or `None` if it misses the box.
pub fn entry_distance(tree: &Tree, index: usize, ray64: &Ray64) -> Option<f64> {
    Some(tree.bounds(index).span(&ray64.ahead())?.0)
}

/// Checks the nodes below the fork's child, on the path down to the leaf, whose boxes begin beyond
/// the closest hit. Returns whether the ray misses the sibling of every such node. The node is then
/// the only child that the ray hits, so the slides' pseudocode, taken literally, enters it without
/// comparing distances.
pub fn siblings_beyond_are_missed(tree: &Tree, leaf: usize, ray64: &Ray64) -> bool {
    let Some(fork) = find_fork(tree, leaf, ray64) else {
        return false;
    };
    let path = tree.path(leaf);
    let entry = |index: usize| entry_distance(tree, index, ray64);
    let below = path.iter();
    let below = below.skip_while(|index| **index != fork.toward_leaf);
    let mut beyond = below
        .skip(1)
        .filter(|&&index| entry(index).is_some_and(|at| at > fork.hit_distance));
    beyond.all(|&index| {
        let sibling = tree.sibling(index);
        sibling.is_some_and(|sibling| entry(sibling).is_none())
    })
}

/// Returns whether every correct traversal gives the correct answer for every ray: decoys are out
/// of reach, traversal is correct under every [`TraversalRule`], and no answer depends on rounding.
pub fn is_fair(tree: &Tree, rays: &[Ray]) -> bool {
    rays.iter().all(|ray| {
        let ray64 = Ray64::from(ray);
        decoys_are_out_of_reach(tree, &ray64)
            && every_traversal_is_correct(tree, &ray64)
            && answer_is_unambiguous(tree, &ray64)
    })
}

/// Returns whether every decoy that would change the answer for this ray is out of reach.
fn decoys_are_out_of_reach(tree: &Tree, ray64: &Ray64) -> bool {
    /// The minimum distance behind the hit at which a decoy cannot be mistaken for it, as a
    /// multiple of the decoy's size.
    const BEHIND: f64 = 0.03;
    let hit = tree.expected_hit(ray64);
    let expected = hit.map_or(ray64.max, |hit| hit.distance);
    let ordinary = tree.ordinary_primitives();
    let is_dangerous = |index: usize| {
        let shape = &tree.shapes[index];
        let end = expected + BEHIND * scan::bounds(shape).diagonal();
        !ordinary[index] && scan::hit_distance(ray64, shape).is_some_and(|it| it < end)
    };
    tree.leaves().into_iter().all(|leaf| {
        let has_decoy = tree.primitives(leaf).any(is_dangerous);
        !has_decoy || (leaf != tree.root && skip_reason(tree, leaf, ray64).is_some())
    })
}

/// Returns whether the traversal finds the expected hit under every rule.
fn every_traversal_is_correct(tree: &Tree, ray64: &Ray64) -> bool {
    let expected = tree.expected_hit(ray64);
    TraversalRule::all()
        .into_iter()
        .all(|rule| Traversal::correct(tree, ray64, rule).closest == expected)
}

/// Returns whether the expected hit is independent of rounding: all ordinary primitives up to the
/// closest hit are clearly hit or clearly missed, and no two are hit at the same distance.
fn answer_is_unambiguous(tree: &Tree, ray64: &Ray64) -> bool {
    /// The minimum distance from the hit to a shape behind it, as a multiple of the shape's size.
    const BEHIND: f64 = 0.03;
    /// The minimum distance from the ray to a shape that can be ignored, as a multiple of the
    /// shape's size.
    const BESIDE: f64 = 0.07;
    let ordinary = tree.ordinary_primitives();
    let expected = tree.expected_hit(ray64);
    let shapes = tree.shapes.iter().zip(&ordinary);
    shapes.filter(|(_, ordinary)| **ordinary).all(|(shape, _)| {
        let bounds = scan::bounds(shape);
        let size = bounds.diagonal();
        let near = Ray64 {
            max: expected.map_or(ray64.max, |hit| hit.distance + BEHIND * size),
            ..*ray64
        };
        let is_near = bounds.grown(BESIDE * size).span(&near).is_some();
        let is_other = expected.is_none_or(|hit| hit.shape != shape.number());
        !is_near
            || (scan::is_unambiguous(ray64, shape)
                && (!is_other || scan::hit_distance(&near, shape).is_none()))
    })
}

/// Returns a flat triangle perpendicular to the ray at this distance, small enough that other rays
/// rarely hit it.
pub fn triangle_across(rng: &mut Rng, ray: &Ray, distance: f64, size: f64, shape: u32) -> Shape {
    let dir = ray.dir.as_dvec3();
    let middle = ray.origin.as_dvec3() + distance * dir;
    let x = rng.perpendicular_to(dir);
    let y = dir.cross(x);
    let corner = |across: f64, up: f64| (middle + size * (across * x + up * y)).as_vec3();
    let corners = [corner(-1.0, -0.6), corner(1.0, -0.6), corner(0.0, 1.2)];
    Shape::FlatTriangle { corners, shape }
}

/// Returns the tree with a decoy added in front of a ray's closest hit, in a random leaf that
/// `fits` accepts. Returns `None` if no leaf fits, if the ray would enter the leaf's box before the
/// decoy, or if the decoy would make the tree unfair.
pub fn add_decoy(
    rng: &mut Rng,
    tree: &Tree,
    rays: &[Ray],
    ray: usize,
    shape: u32,
    fits: &dyn Fn(&Tree, usize, &Ray64) -> bool,
) -> Option<Tree> {
    let ray64 = Ray64::from(&rays[ray]);
    let mut leaves = tree.leaves();
    leaves.retain(|&leaf| leaf != tree.root && fits(tree, leaf, &ray64));
    if leaves.is_empty() {
        return None;
    }
    let leaf = leaves[rng.index(leaves.len())];

    let end = tree.expected_hit(&ray64).map_or(4.0, |hit| hit.distance);
    let distance = ray64.min + (end - ray64.min) * rng.uniform(0.2, 0.8);
    let decoy = triangle_across(rng, &rays[ray], distance, 0.1, shape);
    if entry_distance(tree, leaf, &ray64).is_some_and(|enter| enter < distance + 0.05) {
        return None;
    }
    let mut with_decoy = tree.clone();
    with_decoy.add_to_leaf(leaf, decoy);
    is_fair(&with_decoy, rays).then_some(with_decoy)
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;
    use crate::items::meshes;

    /// Returns a slanted triangle. If `is_hit`, a ray along the x-axis hits it in the middle of its
    /// box. Otherwise, the ray misses it.
    fn slanted_triangle(from: f64, to: f64, is_hit: bool, shape: u32) -> Shape {
        let y = if is_hit { 0.0 } else { 2.0 };
        let corner = |x: f64, up: f64, z: f64| dvec3(x, y + up, z);
        meshes::flat_triangle(
            [
                corner(from, -1.0, -1.0),
                corner(from, -1.0, 1.0),
                corner(to, 1.5, 0.0),
            ],
            shape,
        )
    }

    /// Returns the skip reason for the last leaf in a tree of three leaves: the root's left child
    /// is a leaf, and its right child has two leaves.
    fn skip_reason_of_last(hit: [f64; 2], middle: [f64; 2], last: [f64; 2]) -> Option<SkipReason> {
        let mut tree = Tree::default();
        let left = tree.add_leaf(vec![slanted_triangle(hit[0], hit[1], true, 0)]);
        let middle = tree.add_leaf(vec![slanted_triangle(middle[0], middle[1], false, 1)]);
        let last = tree.add_leaf(vec![slanted_triangle(last[0], last[1], true, 2)]);
        let right = tree.add_interior(middle, last);
        tree.root = tree.add_interior(left, right);
        let ray64 = Ray64::from(&Ray::new(glam::Vec3::ZERO, glam::Vec3::X));
        assert!(siblings_beyond_are_missed(&tree, last, &ray64));
        skip_reason(&tree, last, &ray64)
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
