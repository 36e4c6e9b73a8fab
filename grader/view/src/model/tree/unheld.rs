//! A set of primitives, for finding the leaf of each in time `n log n`.

use protocol::TreeNode;

/// The primitives that no leaf holds so far. A leaf asks only for these, so that leaves that hold the
/// same primitives take no more time than leaves that share them out.
pub(super) struct Unheld {
    /// For each primitive, one from it on before which all are held. The last entry is the end.
    next: Vec<u32>,
}

impl Unheld {
    pub(super) fn new(count: usize) -> Self {
        Unheld {
            next: (0..=TreeNode::saturating_index(count)).collect(),
        }
    }

    /// Returns the first primitive from this one on.
    pub(super) fn first_from(&mut self, mut primitive: usize) -> usize {
        while self.next[primitive] as usize != primitive {
            // Halves the path for the next search.
            let next = self.next[primitive] as usize;
            self.next[primitive] = self.next[next];
            primitive = next;
        }
        primitive
    }

    pub(super) fn remove(&mut self, primitive: usize) {
        self.next[primitive] += 1;
    }
}
