// Traverses the tree best first: the nodes to visit are kept in a heap, which returns the node
// whose box the ray enters first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        let mut ray = *ray;
        let mut closest = None;
        let mut open = BinaryHeap::from_iter(OpenNode::new(root, &ray));
        while let Some(OpenNode { node, entry }) = open.pop() {
            // The ray enters the boxes of all other open nodes at this distance or later.
            if entry > ray.range.max {
                break;
            }
            if node.is_leaf() {
                self.test_leaf(node, &mut ray, &mut closest);
            } else {
                let children = [node.l, node.r].map(|index| &self.nodes[index]);
                let children = children.into_iter();
                open.extend(children.filter_map(|child| OpenNode::new(child, &ray)));
            }
        }
        closest
    }
}

/// A node to visit. In comparisons, the node whose box the ray enters first is the greatest,
/// because a `BinaryHeap` returns the greatest element first.
struct OpenNode<'a> {
    node: &'a Node,
    entry: f32,
}

impl<'a> OpenNode<'a> {
    /// Creates the heap entry for a node, or returns `None` if the ray misses the node's box.
    fn new(node: &'a Node, ray: &Ray) -> Option<Self> {
        let entry = node.bbox.hit(ray, ray.range)?.min;
        Some(OpenNode { node, entry })
    }
}

impl Ord for OpenNode<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.entry.total_cmp(&self.entry)
    }
}

impl PartialOrd for OpenNode<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for OpenNode<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for OpenNode<'_> {}
