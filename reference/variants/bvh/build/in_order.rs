// Pushes the left subtree of a node, then the node, then the right subtree, so that the root is in
// the middle. The buckets divide the node's own box.

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        let root = if primitives.is_empty() {
            0
        } else {
            build_subtree(&mut primitives, 0, max_leaf_size.max(1), &mut nodes)
        };
        Bvh::from_nodes(primitives, nodes, root)
    }
}

/// Builds the subtree over `primitives`, the first of which is at index `start` in the tree's list.
/// Returns the index of the subtree's root.
fn build_subtree(
    primitives: &mut [Primitive],
    start: usize,
    max_leaf_size: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let bbox = bounds_of(primitives);
    if primitives.len() <= max_leaf_size {
        nodes.push(Node::leaf(bbox, start, primitives.len()));
        return nodes.len() - 1;
    }
    let middle = split_by_buckets(primitives, bbox, 20);
    let (left, right) = primitives.split_at_mut(middle);
    let l = build_subtree(left, start, max_leaf_size, nodes);
    let index = nodes.len();
    nodes.push(Node::leaf(bbox, start, 0));
    let r = build_subtree(right, start + middle, max_leaf_size, nodes);
    nodes[index] = Node::interior(bbox, l, r);
    index
}
