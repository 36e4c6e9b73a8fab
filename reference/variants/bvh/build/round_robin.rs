// Applies the surface area heuristic along only one axis per level: x, y and z in turn. If all
// centres coincide along that axis, the next axis is used.

impl Bvh {
    /// Builds the tree with the surface area heuristic (SAH), one axis at a time.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }
}

/// Builds the subtree over `primitives`, the first of which is at index `start` in the tree's list.
/// Returns the index of the subtree's root.
fn build_node(
    primitives: &mut [Primitive],
    start: usize,
    level: usize,
    max_leaf_size: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let bbox = bounds_of(primitives);
    let index = nodes.len();
    nodes.push(Node::leaf(bbox, start, primitives.len()));
    if primitives.len() > max_leaf_size {
        let axes = [level, level + 1, level + 2].map(|axis| axis % 3);
        let middle = axes.into_iter().find_map(|axis| split(primitives, axis));
        let middle = middle.unwrap_or(primitives.len() / 2);
        let (left, right) = primitives.split_at_mut(middle);
        let l = build_node(left, start, level + 1, max_leaf_size, nodes);
        let r = build_node(right, start + middle, level + 1, max_leaf_size, nodes);
        nodes[index] = Node::interior(bbox, l, r);
    }
    index
}

/// Partitions the primitives in place by the cheapest split along the axis. Returns the size of the
/// left side, or `None` if all centres coincide along the axis.
fn split(primitives: &mut [Primitive], axis: usize) -> Option<usize> {
    sort_along(primitives, axis);
    let center = |primitive: &Primitive| primitive.bbox().center()[axis];
    let min = center(primitives.first()?);
    let size = center(primitives.last()?) - min;
    let planes = (1..BUCKETS).map(|i| min + size * i as f32 / BUCKETS as f32);
    let middles = planes.map(|plane| primitives.partition_point(|p| center(p) < plane));
    middles
        .filter(|&middle| 0 < middle && middle < primitives.len())
        .map(|middle| {
            let (left, right) = primitives.split_at(middle);
            (area_times_count(left) + area_times_count(right), middle)
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, middle)| middle)
}

/// The number of buckets along the axis.
const BUCKETS: usize = 16;
