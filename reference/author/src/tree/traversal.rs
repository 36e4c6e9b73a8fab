//! Ways through a tree: the right one, and the one that the slides' pseudo-code takes to the
//! letter.

use super::Tree;
use crate::oracle::bbox::Bounds;
use crate::oracle::{Intersection, Ray64, scan};

/// What the contract leaves open, and what single precision may decide either way.
#[derive(Clone, Copy, Debug)]
pub struct TraversalRule {
    /// Of two children that are entered at nearly the same place, which goes first.
    pub left_first: bool,
    /// Whether a node's box is tested when it is entered, or already by its parent.
    pub tests_on_entry: bool,
    /// Whether to enter all that is not skipped by a clear margin.
    pub conservative: bool,
}

impl TraversalRule {
    /// Every manner in which the contract can be kept.
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

/// The margin by which traps are out of reach, of a box's diagonal.
pub const MARGIN: f64 = 0.01;

/// What became of a walk.
#[derive(Clone, Debug, Default)]
pub struct Traversal {
    /// The closest hit.
    pub closest: Option<Intersection>,
    /// The places of all primitives that were tested.
    pub tested_primitives: Vec<usize>,
    /// The places of all nodes that were come to, in order, and whether they were entered.
    pub reached_nodes: Vec<(usize, bool)>,
}

impl Traversal {
    /// The right way: what is missed is not entered, the nearer child goes first, and what begins
    /// beyond the closest hit is not entered.
    pub fn correct(tree: &Tree, beam: &Ray64, manner: TraversalRule) -> Traversal {
        let mut walk = Traversal::default();
        if !tree.nodes.is_empty() {
            match walk.entry_distance(tree, tree.root, beam, manner) {
                Some(begin) => walk.traverse(tree, tree.root, begin, beam, manner),
                None => walk.reached_nodes.push((tree.root, false)),
            }
        }
        walk
    }

    fn traverse(
        &mut self,
        tree: &Tree,
        place: usize,
        begin: f64,
        beam: &Ray64,
        manner: TraversalRule,
    ) {
        let node = &tree.nodes[place];
        let is_entered = !self.is_beyond(begin, tree.bounds(place), manner);
        self.reached_nodes.push((place, is_entered));
        if !is_entered {
            return;
        }
        if node.is_leaf() {
            tree.primitives(place)
                .for_each(|primitive| self.test_primitive(tree, primitive, beam));
            return;
        }
        let children = [node.l as usize, node.r as usize];
        let mut ahead: Vec<(usize, f64)> = children
            .into_iter()
            .filter_map(|child| Some((child, self.entry_distance(tree, child, beam, manner)?)))
            .collect();
        let is_ahead = |child: &usize| ahead.iter().any(|(other, _)| other == child);
        let missed = children.iter().filter(|child| !is_ahead(child));
        self.reached_nodes
            .extend(missed.map(|&child| (child, false)));
        if let [(_, l), (_, r)] = ahead[..] {
            let tie = (l - r).abs() < MARGIN * tree.bounds(place).diagonal();
            if (tie && !manner.left_first) || (!tie && r < l) {
                ahead.reverse();
            }
        }
        for (child, begin) in ahead {
            // On entry the box is tested against what is left of the ray by then.
            let begin = if manner.tests_on_entry {
                self.entry_distance(tree, child, beam, manner)
            } else {
                Some(begin)
            };
            match begin {
                Some(begin) => self.traverse(tree, child, begin, beam, manner),
                None => self.reached_nodes.push((child, false)),
            }
        }
    }

    /// Where the ray enters a node's box, or surely does not.
    fn entry_distance(
        &self,
        tree: &Tree,
        place: usize,
        beam: &Ray64,
        manner: TraversalRule,
    ) -> Option<f64> {
        let exact = tree.bounds(place);
        // The hesitant look at the whole ray; the others at what is left of it.
        if manner.conservative {
            let grown = exact.grown(MARGIN * exact.diagonal());
            let begin = exact.span(&beam.ahead()).map(|(begin, _)| begin);
            return grown
                .span(&beam.ahead())
                .map(|(grazed, _)| begin.unwrap_or(grazed));
        }
        let left = Ray64 {
            max: self.closest.map_or(beam.max, |closest| closest.distance),
            ..*beam
        };
        exact.span(&left).map(|(begin, _)| begin)
    }

    fn is_beyond(&self, begin: f64, bounds: Bounds, manner: TraversalRule) -> bool {
        let margin = if manner.conservative {
            MARGIN * bounds.diagonal()
        } else {
            0.0
        };
        self.closest
            .is_some_and(|closest| begin > closest.distance + margin)
    }

    fn test_primitive(&mut self, tree: &Tree, primitive: usize, beam: &Ray64) {
        self.tested_primitives.push(primitive);
        if let Some(met) = scan::intersect(beam, &tree.shapes[primitive])
            && self
                .closest
                .is_none_or(|closest| met.distance < closest.distance)
        {
            self.closest = Some(met);
        }
    }

    /// The slides' pseudo-code to the letter: it enters `first` even if both boxes are missed, and
    /// compares `hit2.t` even where child 2 is `first`. A miss has `t` = ∞.
    pub fn by_the_slides(tree: &Tree, beam: &Ray64) -> Traversal {
        let mut walk = Traversal::default();
        if !tree.nodes.is_empty() {
            walk.traverse_by_the_slides(tree, tree.root, beam);
        }
        walk
    }

    fn traverse_by_the_slides(&mut self, tree: &Tree, place: usize, beam: &Ray64) {
        let node = &tree.nodes[place];
        if node.is_leaf() {
            tree.primitives(place)
                .for_each(|primitive| self.test_primitive(tree, primitive, beam));
            return;
        }
        let time = |child: usize| {
            let span = tree.bounds(child).span(beam);
            span.map_or(f64::INFINITY, |(begin, _)| begin)
        };
        let (child1, child2) = (node.l as usize, node.r as usize);
        let (hit1, hit2) = (time(child1), time(child2));
        let (first, second) = if hit1 <= hit2 {
            (child1, child2)
        } else {
            (child2, child1)
        };
        self.traverse_by_the_slides(tree, first, beam);
        let best = self
            .closest
            .map_or(f64::INFINITY, |closest| closest.distance);
        if hit2 < best {
            self.traverse_by_the_slides(tree, second, beam);
        }
    }
}
