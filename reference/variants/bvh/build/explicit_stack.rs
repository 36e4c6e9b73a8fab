// Builds the tree with an explicit stack. Marks a leaf by using its own index for both children,
// and also fills in `start` and `size` of interior nodes.

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes: Vec<Node> = Vec::new();
        // For each node that hasn't been created yet: its primitives and the parent, if any, in
        // which the node's index will be stored.
        let mut open = Vec::new();
        if !primitives.is_empty() {
            open.push((0..primitives.len(), None::<usize>));
        }
        while let Some((range, parent)) = open.pop() {
            let contents = &mut primitives[range.clone()];
            let index = nodes.len();
            nodes.push(Node {
                bbox: bounds_of(contents),
                start: range.start,
                size: range.len(),
                l: index,
                r: index,
            });
            if let Some(parent) = parent {
                nodes[parent].r = index;
            }
            if range.len() > max_leaf_size.max(1) {
                let middle = range.start + split_by_buckets(contents, bounds_of(contents), 12);
                // The left child is popped next, so its index is one more than its parent's. The
                // right child's index isn't known yet. It is stored when that child is created.
                nodes[index].l = index + 1;
                open.push((middle..range.end, Some(index)));
                open.push((range.start..middle, None));
            }
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }
}
