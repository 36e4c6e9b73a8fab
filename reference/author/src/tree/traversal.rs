//! Traversals of a tree: a correct one and the slides' pseudocode, taken literally.

use super::Tree;
use crate::oracle::bbox::Bounds;
use crate::oracle::{Intersection, Ray64, scan};

/// The choices that the contract leaves to a correct traversal, and the choices that depend on
/// rounding in single precision.
#[derive(Clone, Copy, Debug)]
pub struct TraversalRule {
    /// Whether the left child goes first if the ray enters both children at nearly the same
    /// distance.
    pub left_first: bool,
    /// Whether a node's box is tested when the node is about to be entered, rather than when its
    /// parent is visited.
    pub tests_on_entry: bool,
    /// Whether to enter every node unless it can be skipped by a clear margin.
    pub conservative: bool,
}

impl TraversalRule {
    /// Returns all combinations of the choices.
    pub fn all() -> [TraversalRule; 8] {
        std::array::from_fn(|bits| TraversalRule {
            left_first: bits & 1 != 0,
            tests_on_entry: bits & 2 != 0,
            conservative: bits & 4 != 0,
        })
    }
}

/// The minimum distance by which a decoy is out of reach, as a fraction of a box's diagonal.
pub const MARGIN: f64 = 0.01;

/// The result and the log of a traversal.
#[derive(Clone, Debug)]
pub struct Traversal<'a> {
    tree: &'a Tree,
    ray64: Ray64,
    /// The closest hit.
    pub closest: Option<Intersection>,
    /// The indices of all tested primitives.
    pub tested_primitives: Vec<usize>,
    /// The indices of all reached nodes, in order, and whether each node was entered.
    pub reached_nodes: Vec<(usize, bool)>,
}

impl<'a> Traversal<'a> {
    fn new(tree: &'a Tree, ray64: &Ray64) -> Self {
        Traversal {
            tree,
            ray64: *ray64,
            closest: None,
            tested_primitives: Vec::new(),
            reached_nodes: Vec::new(),
        }
    }

    /// Traverses the tree correctly: visits the nearer child first, and skips nodes that the ray
    /// misses or enters only beyond the closest hit.
    pub fn correct(tree: &'a Tree, ray64: &Ray64, rule: TraversalRule) -> Self {
        let mut traversal = Traversal::new(tree, ray64);
        if !tree.nodes.is_empty() {
            match traversal.entry_distance(tree.root, rule) {
                Some(entry) => traversal.traverse(tree.root, entry, rule),
                None => traversal.reached_nodes.push((tree.root, false)),
            }
        }
        traversal
    }

    fn traverse(&mut self, index: usize, entry: f64, rule: TraversalRule) {
        let node = &self.tree.nodes[index];
        let is_entered = !self.is_beyond(entry, self.tree.bounds(index), rule);
        self.reached_nodes.push((index, is_entered));
        if !is_entered {
            return;
        }
        if node.is_leaf() {
            self.test_primitives(index);
            return;
        }
        let children = [node.l as usize, node.r as usize];
        let mut candidates: Vec<(usize, f64)> = children
            .into_iter()
            .filter_map(|child| Some((child, self.entry_distance(child, rule)?)))
            .collect();
        let is_candidate = |child: &usize| candidates.iter().any(|(other, _)| other == child);
        let missed = children.iter().filter(|child| !is_candidate(child));
        self.reached_nodes
            .extend(missed.map(|&child| (child, false)));
        if let [(_, l), (_, r)] = candidates[..] {
            let is_tie = (l - r).abs() < MARGIN * self.tree.bounds(index).diagonal();
            if (is_tie && !rule.left_first) || (!is_tie && r < l) {
                candidates.reverse();
            }
        }
        for (child, entry) in candidates {
            // A test on entry uses the ray's current range, which ends at the closest hit so far.
            let entry = if rule.tests_on_entry {
                self.entry_distance(child, rule)
            } else {
                Some(entry)
            };
            match entry {
                Some(entry) => self.traverse(child, entry, rule),
                None => self.reached_nodes.push((child, false)),
            }
        }
    }

    /// Returns the distance at which the ray enters a node's box, or `None` if the node is skipped.
    fn entry_distance(&self, index: usize, rule: TraversalRule) -> Option<f64> {
        let exact = self.tree.bounds(index);
        // Conservative traversal tests the whole ray. Otherwise, the closest hit limits the ray.
        if rule.conservative {
            let ahead = self.ray64.ahead();
            let (grazed, _) = exact.grown(MARGIN * exact.diagonal()).span(&ahead)?;
            return Some(exact.span(&ahead).map_or(grazed, |(entry, _)| entry));
        }
        let shortened = Ray64 {
            max: self
                .closest
                .map_or(self.ray64.max, |closest| closest.distance),
            ..self.ray64
        };
        exact.span(&shortened).map(|(entry, _)| entry)
    }

    fn is_beyond(&self, entry: f64, bounds: Bounds, rule: TraversalRule) -> bool {
        let margin = if rule.conservative {
            MARGIN * bounds.diagonal()
        } else {
            0.0
        };
        self.closest
            .is_some_and(|closest| entry > closest.distance + margin)
    }

    fn test_primitives(&mut self, leaf: usize) {
        for primitive in self.tree.primitives(leaf) {
            self.tested_primitives.push(primitive);
            let hit = scan::intersect(&self.ray64, &self.tree.shapes[primitive]);
            let closest = [self.closest, hit].into_iter().flatten();
            self.closest = closest.min_by(|a, b| a.distance.total_cmp(&b.distance));
        }
    }

    /// Traverses the tree with the slides' pseudocode, taken literally: it enters `first` even if
    /// both boxes are missed, and compares `hit2.t` even if child 2 is `first`. The `t` of a miss
    /// is ∞.
    pub fn by_the_slides(tree: &'a Tree, ray64: &Ray64) -> Self {
        let mut traversal = Traversal::new(tree, ray64);
        if !tree.nodes.is_empty() {
            traversal.traverse_by_the_slides(tree.root);
        }
        traversal
    }

    fn traverse_by_the_slides(&mut self, index: usize) {
        let node = &self.tree.nodes[index];
        if node.is_leaf() {
            self.test_primitives(index);
            return;
        }
        let time = |child: usize| {
            let span = self.tree.bounds(child).span(&self.ray64);
            span.map_or(f64::INFINITY, |(entry, _)| entry)
        };
        let (child1, child2) = (node.l as usize, node.r as usize);
        let (hit1, hit2) = (time(child1), time(child2));
        let (first, second) = if hit1 <= hit2 {
            (child1, child2)
        } else {
            (child2, child1)
        };
        self.traverse_by_the_slides(first);
        let best = self.closest.map_or(f64::INFINITY, |hit| hit.distance);
        if hit2 < best {
            self.traverse_by_the_slides(second);
        }
    }
}
