/// Builds the tree from the root down. `split` orders the primitives of a node and returns the size
/// of its left side.
fn build_top_down(
    mut primitives: Vec<Primitive>,
    max_leaf_size: usize,
    split: impl Fn(&mut [Primitive]) -> usize,
) -> Bvh {
    let mut nodes = Vec::new();
    if !primitives.is_empty() {
        let max_leaf_size = max_leaf_size.max(1);
        build_node(&mut primitives, 0, max_leaf_size, &split, &mut nodes);
    }
    Bvh::from_nodes(primitives, nodes, 0)
}

/// Builds the subtree over `primitives`, the first of which is at index `start` in the tree's list.
/// Returns the index of the subtree's root.
fn build_node(
    primitives: &mut [Primitive],
    start: usize,
    max_leaf_size: usize,
    split: &impl Fn(&mut [Primitive]) -> usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let bbox = bounds_of(primitives);
    let index = nodes.len();
    nodes.push(Node::leaf(bbox, start, primitives.len()));
    if primitives.len() > max_leaf_size {
        let middle = split(primitives);
        let (left, right) = primitives.split_at_mut(middle);
        let l = build_node(left, start, max_leaf_size, split, nodes);
        let r = build_node(right, start + middle, max_leaf_size, split, nodes);
        nodes[index] = Node::interior(bbox, l, r);
    }
    index
}
