// Uses helpers of this solution's own bbox.rs: boxes can be added and summed, and a function returns
// when a ray enters a box.

use crate::bbox::entry_or_infinity;

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        self.closest_below(root, ray)
    }

    /// Returns the closest hit below `node`.
    fn closest_below(&self, node: &Node, ray: &Ray) -> Option<Trace> {
        if entry_or_infinity(&node.bbox, ray) == f32::INFINITY {
            return None;
        }
        if node.is_leaf() {
            let primitives = &self.primitives[node.start..node.start + node.size];
            let traces = primitives.iter().map(|primitive| primitive.hit(ray));
            return traces.fold(None, Trace::nearer);
        }
        let mut children = [node.l, node.r].map(|index| &self.nodes[index]);
        children.sort_by(|a, b| {
            let entry = |node: &Node| entry_or_infinity(&node.bbox, ray);
            entry(a).total_cmp(&entry(b))
        });
        let [first, second] = children;
        let closest = self.closest_below(first, ray);
        let limit = closest.map_or(ray.range.max, |closest| closest.distance);
        let rest = ray.within(ray.range.min, limit);
        Trace::nearer(closest, self.closest_below(second, &rest))
    }
}

/// Builds the subtree over `primitives`, the first of which has index `start` in the tree's list.
/// Returns the index of the subtree's root.
fn build_node(
    primitives: &mut [Primitive],
    start: usize,
    max_leaf_size: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let bbox = primitives.iter().map(Primitive::bbox).sum();
    let index = nodes.len();
    nodes.push(Node::leaf(bbox, start, primitives.len()));
    if primitives.len() > max_leaf_size {
        let middle = split(primitives);
        let (left, right) = primitives.split_at_mut(middle);
        let l = build_node(left, start, max_leaf_size, nodes);
        let r = build_node(right, start + middle, max_leaf_size, nodes);
        nodes[index] = Node::interior(bbox, l, r);
    }
    index
}

/// The number of buckets along each axis.
const BUCKETS: usize = 16;

/// Partitions the primitives in place by the cheapest split; returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let centers = primitives.iter().map(|primitive| primitive.bbox().center());
    let over: BBox = centers.map(BBox::from).sum();
    let bucket = |primitive: &Primitive, axis: usize| {
        let offset = primitive.bbox().center()[axis] - over.min[axis];
        let part = offset / (over.max[axis] - over.min[axis]);
        ((part * BUCKETS as f32) as usize).min(BUCKETS - 1)
    };

    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in (0..3).filter(|&axis| over.min[axis] < over.max[axis]) {
        primitives.sort_by_key(|primitive| bucket(primitive, axis));
        for plane in 1..BUCKETS {
            let size = primitives.partition_point(|primitive| bucket(primitive, axis) < plane);
            let (left, right) = primitives.split_at(size);
            let cost = cost(left) + cost(right);
            if size > 0 && !right.is_empty() && cost < least {
                (least, best) = (cost, Some((axis, plane)));
            }
        }
    }

    let Some((axis, plane)) = best else {
        return primitives.len() / 2; // No plane separates them.
    };
    primitives.sort_by_key(|primitive| bucket(primitive, axis));
    primitives.partition_point(|primitive| bucket(primitive, axis) < plane)
}

fn cost(side: &[Primitive]) -> f32 {
    let bbox: BBox = side.iter().map(Primitive::bbox).sum();
    bbox.surface_area() * side.len() as f32
}
