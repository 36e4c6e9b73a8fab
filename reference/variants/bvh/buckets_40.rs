// Builds the tree with forty buckets over the node's own box. Traverses the tree without a stack,
// using the index of each node's parent (Hapala et al., "Efficient Stack-less BVH Traversal for
// Ray Tracing", 2011).

#[derive(Clone, Debug)]
pub struct Bvh {
    pub primitives: Vec<Primitive>,
    pub nodes: Vec<Node>,
    pub root: usize,
    /// The parent of each node except the root.
    parents: Vec<Option<usize>>,
}

impl Bvh {
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let mut parents = vec![None; nodes.len()];
        for (index, node) in nodes.iter().enumerate().filter(|(_, node)| !node.is_leaf()) {
            parents[node.l] = Some(index);
            parents[node.r] = Some(index);
        }
        Bvh {
            primitives,
            nodes,
            root,
            parents,
        }
    }

    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        let mut rest = *ray;
        let (mut at, mut from) = (self.root, None);
        while let Some(node) = self.nodes.get(at) {
            let parent = self.parents[at];
            let next = if from == parent {
                // Arriving from the parent: visit the node only if the ray hits its box.
                if node.bbox.hit(&rest, rest.range).is_none() {
                    parent
                } else if node.is_leaf() {
                    self.test_leaf(node, &mut rest, &mut closest);
                    parent
                } else {
                    let [near, _] = self.in_order(node, ray);
                    near.map_or(parent, |(near, _)| Some(near))
                }
            } else {
                // Arriving from a child: the far child follows the near child, and the parent
                // follows the far child.
                match self.in_order(node, ray) {
                    [Some((near, _)), Some((far, _))] if from == Some(near) => Some(far),
                    _ => parent,
                }
            };
            from = Some(at);
            let Some(next) = next else { break };
            at = next;
        }
        closest
    }

    /// Returns those children of an interior node whose boxes the ray hits, with their entry
    /// distances, the nearer child first. `ray` must not be shortened by hits, so that the result
    /// stays the same for the whole traversal.
    fn in_order(&self, node: &Node, ray: &Ray) -> [Option<(usize, f32)>; 2] {
        let enter = |index: usize| Some((index, self.nodes[index].bbox.hit(ray, ray.range)?.min));
        match (enter(node.l), enter(node.r)) {
            (Some(l), Some(r)) if r.1 < l.1 => [Some(r), Some(l)],
            (None, r) => [r, None],
            (l, r) => [l, r],
        }
    }

    /// Tests the primitives of a leaf. A hit shortens the ray, so later hits must be closer.
    fn test_leaf(&self, leaf: &Node, ray: &mut Ray, closest: &mut Option<Trace>) {
        for primitive in &self.primitives[leaf.start..leaf.start + leaf.size] {
            if let Some(trace) = primitive.hit(ray) {
                ray.range.max = trace.distance;
                *closest = Some(trace);
            }
        }
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
    let bbox = bounds_of(primitives);
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
const BUCKETS: usize = 40;

/// Partitions the primitives in place by the cheapest split; returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let over = bounds_of(primitives);
    let bucket = |primitive: &Primitive, axis: usize| {
        let offset = primitive.bbox().center()[axis] - over.min[axis];
        let part = offset / (over.max[axis] - over.min[axis]);
        ((part * BUCKETS as f32) as usize).min(BUCKETS - 1)
    };

    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in (0..3).filter(|&axis| over.min[axis] < over.max[axis]) {
        let mut buckets = [Bucket::EMPTY; BUCKETS];
        for primitive in primitives.iter() {
            let bucket = &mut buckets[bucket(primitive, axis)];
            bucket.bbox.enclose(primitive.bbox());
            bucket.size += 1;
        }
        for plane in 1..BUCKETS {
            let (left, right) = (side(&buckets[..plane]), side(&buckets[plane..]));
            let cost = left.cost() + right.cost();
            if left.size > 0 && right.size > 0 && cost < least {
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

#[derive(Clone, Copy)]
struct Bucket {
    bbox: BBox,
    size: usize,
}

impl Bucket {
    const EMPTY: Bucket = Bucket {
        bbox: BBox::EMPTY,
        size: 0,
    };

    fn cost(self) -> f32 {
        self.bbox.surface_area() * self.size as f32
    }
}

/// Merges several buckets into one.
fn side(buckets: &[Bucket]) -> Bucket {
    buckets.iter().fold(Bucket::EMPTY, |mut all, bucket| {
        all.bbox.enclose(bucket.bbox);
        all.size += bucket.size;
        all
    })
}

fn bounds_of(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose(primitive.bbox());
    }
    all
}
