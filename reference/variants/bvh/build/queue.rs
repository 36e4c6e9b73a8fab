// Builds the tree with a queue, level by level, so that the children of a node are always adjacent.
// The buckets divide the box of the centres.

use std::collections::VecDeque;

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        // The indices of the nodes that may still have to be split.
        let mut queue = VecDeque::new();
        if !primitives.is_empty() {
            nodes.push(Node::leaf(bounds_of(&primitives), 0, primitives.len()));
            queue.push_back(0);
        }
        while let Some(index) = queue.pop_front() {
            let Node {
                bbox, start, size, ..
            } = nodes[index];
            if size <= max_leaf_size.max(1) {
                continue;
            }
            let contents = &mut primitives[start..start + size];
            let middle = split_by_buckets(contents, bounds_of_centers(contents), 16);
            let (l, r) = (nodes.len(), nodes.len() + 1);
            nodes[index] = Node::interior(bbox, l, r);
            let (left, right) = contents.split_at(middle);
            nodes.push(Node::leaf(bounds_of(left), start, middle));
            nodes.push(Node::leaf(bounds_of(right), start + middle, size - middle));
            queue.extend([l, r]);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }
}
