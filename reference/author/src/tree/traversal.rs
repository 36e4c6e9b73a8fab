//! Traversals of a tree: the correct one, and the slides' pseudo-code taken literally.

use super::Tree;
use crate::oracle::bbox::Bounds;
use crate::oracle::{Intersection, Ray64, scan};

/// The choices that the contract leaves open to a correct traversal, and those that depend on
/// rounding in single precision.
#[derive(Clone, Copy, Debug)]
pub struct TraversalRule {
    /// Whether the left child goes first if the ray enters both at nearly the same distance.
    pub left_first: bool,
    /// Whether a node's box is tested when the node is entered, instead of by its parent.
    pub tests_on_entry: bool,
    /// Whether to enter every node that cannot be skipped by a clear margin.
    pub conservative: bool,
}

impl TraversalRule {
    /// All combinations of the choices.
    pub const ALL: [TraversalRule; 8] = {
        const fn from_bits(bits: usize) -> TraversalRule {
            TraversalRule {
                left_first: bits & 1 != 0,
                tests_on_entry: bits & 2 != 0,
                conservative: bits & 4 != 0,
            }
        }
        [
            from_bits(0),
            from_bits(1),
            from_bits(2),
            from_bits(3),
            from_bits(4),
            from_bits(5),
            from_bits(6),
            from_bits(7),
        ]
    };
}

/// The margin by which decoys are out of reach, as a fraction of a box's diagonal.
pub const MARGIN: f64 = 0.01;

/// The result and the record of a traversal.
#[derive(Clone, Debug, Default)]
pub struct Traversal {
    /// The closest hit.
    pub closest: Option<Intersection>,
    /// The indices of all primitives that were tested.
    pub tested_primitives: Vec<usize>,
    /// The indices of all nodes that were reached, in order, and whether they were entered.
    pub reached_nodes: Vec<(usize, bool)>,
}

impl Traversal {
    /// Traverses the tree correctly: nodes that the ray misses are not entered, the nearer child
    /// goes first, and nodes that begin beyond the closest hit are not entered.
    pub fn correct(tree: &Tree, ray64: &Ray64, rule: TraversalRule) -> Traversal {
        let mut traversal = Traversal::default();
        if !tree.nodes.is_empty() {
            match traversal.entry_distance(tree, tree.root, ray64, rule) {
                Some(entry) => traversal.traverse(tree, tree.root, entry, ray64, rule),
                None => traversal.reached_nodes.push((tree.root, false)),
            }
        }
        traversal
    }

    fn traverse(
        &mut self,
        tree: &Tree,
        index: usize,
        entry: f64,
        ray64: &Ray64,
        rule: TraversalRule,
    ) {
        let node = &tree.nodes[index];
        let is_entered = !self.is_beyond(entry, tree.bounds(index), rule);
        self.reached_nodes.push((index, is_entered));
        if !is_entered {
            return;
        }
        if node.is_leaf() {
            tree.primitives(index)
                .for_each(|primitive| self.test_primitive(tree, primitive, ray64));
            return;
        }
        let children = [node.l as usize, node.r as usize];
        let mut candidates: Vec<(usize, f64)> = children
            .into_iter()
            .filter_map(|child| Some((child, self.entry_distance(tree, child, ray64, rule)?)))
            .collect();
        let is_candidate = |child: &usize| candidates.iter().any(|(other, _)| other == child);
        let missed = children.iter().filter(|child| !is_candidate(child));
        self.reached_nodes
            .extend(missed.map(|&child| (child, false)));
        if let [(_, l), (_, r)] = candidates[..] {
            let is_tie = (l - r).abs() < MARGIN * tree.bounds(index).diagonal();
            if (is_tie && !rule.left_first) || (!is_tie && r < l) {
                candidates.reverse();
            }
        }
        for (child, entry) in candidates {
            // A test on entry uses the ray's current range, which ends at the closest hit so far.
            let entry = if rule.tests_on_entry {
                self.entry_distance(tree, child, ray64, rule)
            } else {
                Some(entry)
            };
            match entry {
                Some(entry) => self.traverse(tree, child, entry, ray64, rule),
                None => self.reached_nodes.push((child, false)),
            }
        }
    }

    /// Returns the distance at which the ray enters a node's box, or `None` if the node is skipped.
    fn entry_distance(
        &self,
        tree: &Tree,
        index: usize,
        ray64: &Ray64,
        rule: TraversalRule,
    ) -> Option<f64> {
        let exact = tree.bounds(index);
        // Conservative traversal tests the whole ray; otherwise the closest hit limits the ray.
        if rule.conservative {
            let grown = exact.grown(MARGIN * exact.diagonal());
            let entry = exact.span(&ray64.ahead()).map(|(entry, _)| entry);
            return grown
                .span(&ray64.ahead())
                .map(|(grazed, _)| entry.unwrap_or(grazed));
        }
        let shortened = Ray64 {
            max: self.closest.map_or(ray64.max, |closest| closest.distance),
            ..*ray64
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

    fn test_primitive(&mut self, tree: &Tree, primitive: usize, ray64: &Ray64) {
        self.tested_primitives.push(primitive);
        if let Some(hit) = scan::intersect(ray64, &tree.shapes[primitive])
            && self
                .closest
                .is_none_or(|closest| hit.distance < closest.distance)
        {
            self.closest = Some(hit);
        }
    }

    /// Traverses the tree by the slides' pseudo-code, taken literally: it enters `first` even if
    /// both boxes are missed, and compares `hit2.t` even if child 2 is `first`. The `t` of a miss
    /// is ∞.
    pub fn by_the_slides(tree: &Tree, ray64: &Ray64) -> Traversal {
        let mut traversal = Traversal::default();
        if !tree.nodes.is_empty() {
            traversal.traverse_by_the_slides(tree, tree.root, ray64);
        }
        traversal
    }

    fn traverse_by_the_slides(&mut self, tree: &Tree, index: usize, ray64: &Ray64) {
        let node = &tree.nodes[index];
        if node.is_leaf() {
            tree.primitives(index)
                .for_each(|primitive| self.test_primitive(tree, primitive, ray64));
            return;
        }
        let time = |child: usize| {
            let span = tree.bounds(child).span(ray64);
            span.map_or(f64::INFINITY, |(entry, _)| entry)
        };
        let (child1, child2) = (node.l as usize, node.r as usize);
        let (hit1, hit2) = (time(child1), time(child2));
        let (first, second) = if hit1 <= hit2 {
            (child1, child2)
        } else {
            (child2, child1)
        };
        self.traverse_by_the_slides(tree, first, ray64);
        let best = self
            .closest
            .map_or(f64::INFINITY, |closest| closest.distance);
        if hit2 < best {
            self.traverse_by_the_slides(tree, second, ray64);
        }
    }
}
