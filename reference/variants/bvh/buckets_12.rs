// Builds the tree with twelve buckets over the centres, as in Pharr, Jakob and Humphreys,
// "Physically Based Rendering" (4th edition), section 7.3.2. During traversal, each node returns
// its closest hit, and its parent takes the nearer of the two hits.

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
        root.bbox.hit(ray, ray.range)?;
        self.nearest(root, ray)
    }

    /// Returns the closest hit below `node`.
    fn nearest(&self, node: &Node, ray: &Ray) -> Option<Trace> {
        if node.is_leaf() {
            let primitives = &self.primitives[node.start..node.start + node.size];
            let traces = primitives.iter().map(|primitive| primitive.hit(ray));
            return traces.fold(None, Trace::nearer);
        }

        let enter = |index: usize| {
            let child = &self.nodes[index];
            Some((child, child.bbox.hit(ray, ray.range)?.min))
        };
        let (first, second) = match (enter(node.l), enter(node.r)) {
            (Some(l), Some(r)) if l.1 <= r.1 => (l, Some(r)),
            (Some(l), Some(r)) => (r, Some(l)),
            (l, r) => (l.or(r)?, None),
        };
        let trace = self.nearest(first.0, ray);
        let limit = trace.map_or(ray.range.max, |trace| trace.distance);
        match second {
            Some((second, entry)) if entry <= limit => {
                let rest = ray.within(ray.range.min, limit);
                Trace::nearer(trace, self.nearest(second, &rest))
            }
            _ => trace,
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
const BUCKETS: usize = 12;

/// Partitions the primitives in place by the cheapest split; returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let over = bounds_of_centers(primitives);
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

fn bounds_of_centers(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose_point(primitive.bbox().center());
    }
    all
}
