//! Ways through a tree: the right one, and the one that the slides' pseudo-code takes to the
//! letter.

use super::Tree;
use crate::oracle::bbox::Bounds;
use crate::oracle::{Beam, Meeting, scan};

/// What the contract leaves open, and what single precision may decide either way.
#[derive(Clone, Copy, Debug)]
pub struct Manner {
    /// Of two children that are entered at nearly the same place, which goes first.
    pub left_first: bool,
    /// Whether a node's box is tested when it is entered, or already by its parent.
    pub on_entry: bool,
    /// Whether to enter all that is not skipped by a clear margin.
    pub hesitant: bool,
}

impl Manner {
    /// Every manner in which the contract can be kept.
    pub const ALL: [Manner; 8] = {
        const fn manner(bits: usize) -> Manner {
            Manner {
                left_first: bits & 1 != 0,
                on_entry: bits & 2 != 0,
                hesitant: bits & 4 != 0,
            }
        }
        [
            manner(0),
            manner(1),
            manner(2),
            manner(3),
            manner(4),
            manner(5),
            manner(6),
            manner(7),
        ]
    };
}

/// The margin by which traps are out of reach, of a box's diagonal.
pub const MARGIN: f64 = 0.01;

/// What became of a walk.
#[derive(Clone, Debug, Default)]
pub struct Walk {
    /// The closest hit.
    pub closest: Option<Meeting>,
    /// The places of all primitives that were tested.
    pub tested: Vec<usize>,
    /// The places of all nodes that were come to, in order, and whether they were entered.
    pub nodes: Vec<(usize, bool)>,
}

impl Walk {
    /// The right way: what is missed is not entered, the nearer child goes first, and what begins
    /// beyond the closest hit is not entered.
    pub fn right(tree: &Tree, beam: &Beam, manner: Manner) -> Walk {
        let mut walk = Walk::default();
        if !tree.nodes.is_empty() {
            match walk.entry(tree, tree.root, beam, manner) {
                Some(begin) => walk.visit(tree, tree.root, begin, beam, manner),
                None => walk.nodes.push((tree.root, false)),
            }
        }
        walk
    }

    fn visit(&mut self, tree: &Tree, place: usize, begin: f64, beam: &Beam, manner: Manner) {
        let node = &tree.nodes[place];
        let is_entered = !self.is_beyond(begin, tree.bounds(place), manner);
        self.nodes.push((place, is_entered));
        if !is_entered {
            return;
        }
        if node.is_leaf() {
            tree.primitives(place)
                .for_each(|primitive| self.test(tree, primitive, beam));
            return;
        }
        let children = [node.l as usize, node.r as usize];
        let mut ahead: Vec<(usize, f64)> = children
            .into_iter()
            .filter_map(|child| Some((child, self.entry(tree, child, beam, manner)?)))
            .collect();
        let is_ahead = |child: &usize| ahead.iter().any(|(other, _)| other == child);
        let missed = children.iter().filter(|child| !is_ahead(child));
        self.nodes.extend(missed.map(|&child| (child, false)));
        if let [(_, l), (_, r)] = ahead[..] {
            let tie = (l - r).abs() < MARGIN * tree.bounds(place).diagonal();
            if (tie && !manner.left_first) || (!tie && r < l) {
                ahead.reverse();
            }
        }
        for (child, begin) in ahead {
            // On entry the box is tested against what is left of the ray by then.
            let begin = if manner.on_entry {
                self.entry(tree, child, beam, manner)
            } else {
                Some(begin)
            };
            match begin {
                Some(begin) => self.visit(tree, child, begin, beam, manner),
                None => self.nodes.push((child, false)),
            }
        }
    }

    /// Where the ray enters a node's box, or surely does not.
    fn entry(&self, tree: &Tree, place: usize, beam: &Beam, manner: Manner) -> Option<f64> {
        let exact = tree.bounds(place);
        // The hesitant look at the whole ray; the others at what is left of it.
        if manner.hesitant {
            let grown = exact.grown(MARGIN * exact.diagonal());
            let begin = exact.span(&beam.ahead()).map(|(begin, _)| begin);
            return grown
                .span(&beam.ahead())
                .map(|(grazed, _)| begin.unwrap_or(grazed));
        }
        let left = Beam {
            max: self.closest.map_or(beam.max, |closest| closest.distance),
            ..*beam
        };
        exact.span(&left).map(|(begin, _)| begin)
    }

    fn is_beyond(&self, begin: f64, bounds: Bounds, manner: Manner) -> bool {
        let margin = if manner.hesitant {
            MARGIN * bounds.diagonal()
        } else {
            0.0
        };
        self.closest
            .is_some_and(|closest| begin > closest.distance + margin)
    }

    fn test(&mut self, tree: &Tree, primitive: usize, beam: &Beam) {
        self.tested.push(primitive);
        if let Some(met) = scan::meet(beam, &tree.shapes[primitive])
            && self
                .closest
                .is_none_or(|closest| met.distance < closest.distance)
        {
            self.closest = Some(met);
        }
    }

    /// The slides' pseudo-code to the letter: it enters `first` even if both boxes are missed, and
    /// compares `hit2.t` even where child 2 is `first`. A miss has `t` = ∞.
    pub fn slides(tree: &Tree, beam: &Beam) -> Walk {
        let mut walk = Walk::default();
        if !tree.nodes.is_empty() {
            walk.visit_by_slides(tree, tree.root, beam);
        }
        walk
    }

    fn visit_by_slides(&mut self, tree: &Tree, place: usize, beam: &Beam) {
        let node = &tree.nodes[place];
        if node.is_leaf() {
            tree.primitives(place)
                .for_each(|primitive| self.test(tree, primitive, beam));
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
        self.visit_by_slides(tree, first, beam);
        let best = self
            .closest
            .map_or(f64::INFINITY, |closest| closest.distance);
        if hit2 < best {
            self.visit_by_slides(tree, second, beam);
        }
    }
}
