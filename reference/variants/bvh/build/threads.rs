// Builds the two subtrees of a large node in two threads. Each thread returns a list of nodes that
// begins with the root of its subtree. The parent appends the lists and shifts the indices.

use std::panic::resume_unwind;
use std::thread;

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            nodes = build_subtree(&mut primitives, 0, max_leaf_size.max(1));
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }
}

/// The minimum number of primitives for which starting a thread is worthwhile.
const WORTH_A_THREAD: usize = 1024;

/// Builds the subtree over `primitives`, the first of which is at index `start` in the tree's list.
fn build_subtree(primitives: &mut [Primitive], start: usize, max_leaf_size: usize) -> Vec<Node> {
    let bbox = bounds_of(primitives);
    let size = primitives.len();
    if size <= max_leaf_size {
        return vec![Node::leaf(bbox, start, size)];
    }
    let middle = split_by_sweep(primitives);
    let (left, right) = primitives.split_at_mut(middle);
    let mut build_left = || build_subtree(left, start, max_leaf_size);
    let mut build_right = || build_subtree(right, start + middle, max_leaf_size);
    let (left, right) = if size < WORTH_A_THREAD {
        (build_left(), build_right())
    } else {
        thread::scope(|scope| {
            let left = scope.spawn(build_left);
            let right = build_right();
            (
                left.join().unwrap_or_else(|panic| resume_unwind(panic)),
                right,
            )
        })
    };

    let (l, r) = (1, 1 + left.len());
    let mut nodes = vec![Node::interior(bbox, l, r)];
    nodes.extend(left.into_iter().map(|node| shifted(node, l)));
    nodes.extend(right.into_iter().map(|node| shifted(node, r)));
    nodes
}

/// Returns the node with the indices of its children, if any, increased by `by`.
fn shifted(node: Node, by: usize) -> Node {
    if node.is_leaf() {
        node
    } else {
        Node::interior(node.bbox, node.l + by, node.r + by)
    }
}
