// Applies the surface area heuristic along only one axis per level: x, y and z in turn. If all
// centres coincide along that axis, the next axis is used. Traversal puts the children that the
// ray hits in a sorted list, and never shortens the ray itself.

impl Bvh {
    /// Builds the tree with the surface area heuristic (SAH), one axis at a time.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        self.nearest(root, ray, None)
    }

    /// Returns the nearer of `closest` and the closest hit below `node`.
    fn nearest(&self, node: &Node, ray: &Ray, mut closest: Option<Trace>) -> Option<Trace> {
        if node.is_leaf() {
            let primitives = &self.primitives[node.start..node.start + node.size];
            let traces = primitives.iter().map(|primitive| primitive.hit(ray));
            return traces.fold(closest, Trace::nearer);
        }

        let children = [node.l, node.r].map(|index| &self.nodes[index]);
        let hit = children
            .into_iter()
            .filter_map(|child| Some((child.bbox.hit(ray, ray.range)?.min, child)));
        let mut ahead: Vec<(f32, &Node)> = hit.collect();
        ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (entry, child) in ahead {
            if closest.is_none_or(|closest| entry < closest.distance) {
                closest = self.nearest(child, ray, closest);
            }
        }
        closest
    }
}

/// Builds the subtree over `primitives`, the first of which has index `start` in the tree's list.
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
    let center = |primitive: &Primitive| primitive.bbox().center()[axis];
    primitives.sort_by(|a, b| center(a).total_cmp(&center(b)));
    let min = center(primitives.first()?);
    let size = center(primitives.last()?) - min;
    let planes = (1..BUCKETS).map(|i| min + size * i as f32 / BUCKETS as f32);
    let middles = planes.map(|plane| primitives.partition_point(|p| center(p) < plane));
    middles
        .filter(|&middle| 0 < middle && middle < primitives.len())
        .map(|middle| {
            (
                cost(&primitives[..middle]) + cost(&primitives[middle..]),
                middle,
            )
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, middle)| middle)
}

/// The number of buckets along the axis.
const BUCKETS: usize = 16;

fn cost(side: &[Primitive]) -> f32 {
    bounds_of(side).surface_area() * side.len() as f32
}

fn bounds_of(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose(primitive.bbox());
    }
    all
}
