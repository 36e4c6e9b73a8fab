//! Decoys in calls to `Bvh::hit`: primitives that are in front of the answer but must not be
//! tested.

use protocol::{Ray, Shape};

use crate::oracle::bbox::Bounds;
use crate::oracle::{Ray64, scan};
use crate::tree::Tree;
use crate::tree::decoy::{self, SkipReason, entry_distance};
use crate::tree::traversal::MARGIN;

/// A decoy in front of the answer to a call. Its leaf is a child of a node that must be entered, so
/// only the leaf's own box decides whether the decoy is tested.
#[derive(Clone, Copy, Debug)]
pub(super) struct Decoy {
    pub(super) reason: usize,
    pub(super) is_sphere: bool,
    pub(super) leaf_size: usize,
    /// The decoy's index in its leaf.
    pub(super) place: usize,
    pub(super) level: usize,
    /// The number of axes along which the box of the decoy's leaf is flat.
    pub(super) flat_axes: u32,
    /// Whether the decoy's leaf and that leaf's sibling each have four or more primitives, all of
    /// which are contiguous in the list.
    pub(super) is_beside_a_large_leaf: bool,
    /// Whether the ray starts in the box of the leaf's sibling and hits something there.
    pub(super) is_from_siblings_box: bool,
    /// Whether the ray enters another leaf before the leaf with the hit, and its closest hit in
    /// that other leaf is beyond the entry into the decoy's leaf.
    pub(super) is_after_a_farther_hit: bool,
    pub(super) history: usize,
}

impl Decoy {
    /// Returns the first decoy in front of the answer to a call.
    pub(super) fn of(
        tree: &Tree,
        outside: &[Outside],
        ray: &Ray,
        previous: Option<&Ray>,
    ) -> Option<Decoy> {
        let ray64 = Ray64::from(ray);
        let distance = |it: &Outside| scan::hit_distance(&ray64, &tree.shapes[it.primitive]);
        let hits = outside.iter().filter_map(|it| Some((it, distance(it)?)));
        let mut hits = hits.peekable();
        hits.peek()?;
        let expected = tree.expected_hit(&ray64);
        let end = expected.map_or(ray64.max, |hit| hit.distance);
        let mut in_front = hits.filter(|(_, distance)| *distance < end);
        in_front.find_map(|(it, _)| Decoy::in_leaf(tree, *it, &ray64, previous))
    }

    fn in_leaf(
        tree: &Tree,
        Outside { leaf, primitive }: Outside,
        ray64: &Ray64,
        previous: Option<&Ray>,
    ) -> Option<Decoy> {
        let primitives = tree.primitives(leaf);
        let bounds = tree.bounds(leaf);
        Some(Decoy {
            reason: reason(tree, leaf, ray64)?,
            is_sphere: matches!(tree.shapes[primitive], Shape::Sphere { .. }),
            leaf_size: primitives.len(),
            place: primitive - primitives.start,
            level: tree.path(leaf).len(),
            flat_axes: bounds.min.cmpeq(bounds.max).bitmask().count_ones(),
            is_beside_a_large_leaf: is_beside_a_large_leaf(tree, leaf),
            is_from_siblings_box: is_from_siblings_box(tree, leaf, ray64),
            is_after_a_farther_hit: is_after_a_farther_hit(tree, leaf, ray64).unwrap_or(false),
            history: history(tree, leaf, ray64, previous),
        })
    }
}

/// Classifies the reason a leaf isn't entered. Returns `None` if the reason is a node above the
/// leaf.
fn reason(tree: &Tree, leaf: usize, ray64: &Ray64) -> Option<usize> {
    let reason = decoy::skip_reason(tree, leaf, ray64)?;
    let sibling = tree.sibling(leaf)?;
    let children: [decoy::Child; 2] = [|node| node.l, |node| node.r];
    let mut children = children.into_iter();
    if reason == SkipReason::Missed {
        let is_decided_here =
            children.any(|child| decoy::is_missed_child(tree, leaf, ray64, child));
        let class = usize::from(decoy::misses_sibling(tree, leaf, ray64));
        return is_decided_here.then_some(class);
    }
    let hit = tree.expected_hit(ray64)?.distance;
    if entry_distance(tree, tree.parent(leaf)?, ray64)? > hit {
        return None;
    }
    Some(match entry_distance(tree, sibling, ray64) {
        Some(other) if other > hit => 3 + usize::from(other < entry_distance(tree, leaf, ray64)?),
        _ => 2,
    })
}

/// Returns whether a leaf and its sibling each have four or more primitives, and the left leaf's
/// primitives come directly before the right leaf's.
fn is_beside_a_large_leaf(tree: &Tree, leaf: usize) -> bool {
    const LARGE: usize = 4;
    let Some(parent) = tree.parent(leaf) else {
        return false;
    };
    let parent = &tree.nodes[parent];
    let children = [parent.l as usize, parent.r as usize];
    let are_leaves = children.iter().all(|&child| tree.nodes[child].is_leaf());
    let [l, r] = children.map(|child| tree.primitives(child));
    are_leaves && l.len() >= LARGE && r.len() >= LARGE && l.end == r.start
}

/// Returns whether the ray starts in the box of a leaf's sibling and hits something there.
fn is_from_siblings_box(tree: &Tree, leaf: usize, ray64: &Ray64) -> bool {
    let start = Bounds::around([ray64.origin]);
    let holds_start = |sibling: &usize| tree.bounds(*sibling).contains(&start);
    let sibling = tree.sibling(leaf).filter(holds_start);
    sibling.is_some() && tree.leaf_of_hit(ray64) == sibling
}

/// Returns whether the ray enters another leaf before the leaf with the hit, and its closest hit in
/// that other leaf is beyond the entry into the decoy's leaf. Returns `None` if the ray hits
/// nothing or misses the box of the decoy's leaf.
fn is_after_a_farther_hit(tree: &Tree, leaf: usize, ray64: &Ray64) -> Option<bool> {
    let hit_leaf = tree.leaf_of_hit(ray64)?;
    let (enters, enters_hit) = (
        entry_distance(tree, leaf, ray64)?,
        entry_distance(tree, hit_leaf, ray64)?,
    );
    let distance = |primitive: usize| scan::hit_distance(ray64, &tree.shapes[primitive]);
    let mut others = tree.leaves().into_iter();
    Some(others.any(|other| {
        let is_earlier = entry_distance(tree, other, ray64).is_some_and(|it| it < enters_hit);
        let nearest = tree.primitives(other).filter_map(distance);
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        other != leaf && is_earlier && nearest.is_finite() && nearest > enters
    }))
}

/// Classifies the call before the one with the decoy.
fn history(tree: &Tree, leaf: usize, ray64: &Ray64, previous: Option<&Ray>) -> usize {
    let Some(previous) = previous.map(Ray64::from) else {
        return 0;
    };
    if tree.leaf_of_hit(&previous) == Some(leaf) {
        return 1;
    }
    // How much earlier the ray enters the leaf than its sibling, as a distance.
    let earlier = |ray64: &Ray64| {
        let sibling = tree.sibling(leaf)?;
        Some(entry_distance(tree, sibling, ray64)? - entry_distance(tree, leaf, ray64)?)
    };
    let margin = MARGIN * tree.bounds(tree.root).diagonal();
    let is_swapped = |before: f64, now: f64| before.min(-now) > 0.1 * margin;
    let orders = earlier(&previous).zip(earlier(ray64));
    let is_swapped = orders.is_some_and(|(before, now)| is_swapped(before, now));
    2 * usize::from(previous.dir == ray64.dir && is_swapped)
}

/// A primitive outside the box of its leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outside {
    leaf: usize,
    primitive: usize,
}

impl Outside {
    /// Returns all primitives of a tree that are outside the box of their leaf.
    pub(super) fn all(tree: &Tree) -> Vec<Outside> {
        let ordinary = tree.ordinary_primitives();
        let leaves = tree.leaves().into_iter();
        let all = leaves.flat_map(|leaf| {
            let primitives = tree.primitives(leaf);
            primitives.map(move |primitive| Outside { leaf, primitive })
        });
        all.filter(|it| !ordinary[it.primitive]).collect()
    }
}
