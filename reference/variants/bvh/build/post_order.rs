// Pushes a node after both of its children, so that the root comes last and interior nodes don't
// need placeholders.

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_subtree(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        let root = nodes.len().saturating_sub(1);
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
    let node = if primitives.len() <= max_leaf_size {
        Node::leaf(bounds_of(primitives), start, primitives.len())
    } else {
        let middle = split_by_buckets(primitives, bounds_of_centers(primitives), 16);
        let (left, right) = primitives.split_at_mut(middle);
        let l = build_subtree(left, start, max_leaf_size, nodes);
        let r = build_subtree(right, start + middle, max_leaf_size, nodes);
        let mut bbox = nodes[l].bbox;
        bbox.enclose(nodes[r].bbox);
        Node::interior(bbox, l, r)
    };
    nodes.push(node);
    nodes.len() - 1
}
