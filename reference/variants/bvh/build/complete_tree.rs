// Builds a complete tree: all leaves but one are full, and the children of node i are at 2i + 1 and
// 2i + 2, as in a binary heap. The number of leaves determines how many primitives are in the left
// subtree. Areas are ignored.

impl Bvh {
    /// Builds a complete tree.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let max_leaf_size = max_leaf_size.max(1);
        let leaves = primitives.len().div_ceil(max_leaf_size);
        let empty = Node::leaf(BBox::EMPTY, 0, 0);
        let mut nodes = vec![empty; (2 * leaves).saturating_sub(1)];
        if leaves > 0 {
            fill(&mut nodes, 0, &mut primitives, 0, max_leaf_size);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }
}

/// Builds the subtree over `primitives`, with its root at `index`. The first primitive is at index
/// `start` in the tree's list.
fn fill(
    nodes: &mut [Node],
    index: usize,
    primitives: &mut [Primitive],
    start: usize,
    max_leaf_size: usize,
) {
    let bbox = bounds_of(primitives);
    let leaves = primitives.len().div_ceil(max_leaf_size);
    if leaves == 1 {
        nodes[index] = Node::leaf(bbox, start, primitives.len());
        return;
    }

    let centers = bounds_of_centers(primitives);
    let axis = (centers.max - centers.min).max_position();
    sort_along(primitives, axis);

    let (left, right) = primitives.split_at_mut(max_leaf_size * left_leaves(leaves));
    let (l, r) = (2 * index + 1, 2 * index + 2);
    nodes[index] = Node::interior(bbox, l, r);
    fill(nodes, l, left, start, max_leaf_size);
    fill(nodes, r, right, start + left.len(), max_leaf_size);
}

/// Returns the number of leaves in the left subtree of a complete tree with this many leaves. The
/// tree's last level is filled from the left.
fn left_leaves(leaves: usize) -> usize {
    let full = 1 << leaves.ilog2();
    full / 2 + (leaves - full).min(full / 2)
}
