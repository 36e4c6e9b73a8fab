// Builds the tree with eight to 32 buckets over the centres: the more primitives, the more
// buckets. Traverses the tree with a stack of indices, and tests a box when its node is popped.

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest: Option<Trace> = None;
        let mut open = Vec::from_iter((self.root < self.nodes.len()).then_some(self.root));
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            // The ray, shortened to the closest hit so far. Used for boxes and for primitives.
            let mut rest = *ray;
            rest.range.max = closest.map_or(ray.range.max, |closest| closest.distance);
            let entry = |node: &Node| Some(node.bbox.hit(ray, rest.range)?.min);
            if entry(node).is_none() {
                continue;
            }
            if node.is_leaf() {
                let primitives = &self.primitives[node.start..node.start + node.size];
                let traces = primitives.iter().map(|primitive| primitive.hit(&rest));
                closest = traces.fold(closest, Trace::nearer);
                continue;
            }
            // `None` is less than any number, so a missed child is pushed last. When it is popped,
            // its box test fails.
            if entry(&self.nodes[node.l]) < entry(&self.nodes[node.r]) {
                open.extend([node.r, node.l]);
            } else {
                open.extend([node.l, node.r]);
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

/// Partitions the primitives in place by the cheapest split; returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    // One bucket for every four primitives, within limits.
    let count = (primitives.len() / 4).clamp(8, 32);
    let over = bounds_of_centers(primitives);
    let bucket = |primitive: &Primitive, axis: usize| {
        let offset = primitive.bbox().center()[axis] - over.min[axis];
        let part = offset / (over.max[axis] - over.min[axis]);
        ((part * count as f32) as usize).min(count - 1)
    };

    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in (0..3).filter(|&axis| over.min[axis] < over.max[axis]) {
        let mut buckets = vec![Bucket::EMPTY; count];
        for primitive in primitives.iter() {
            let bucket = &mut buckets[bucket(primitive, axis)];
            bucket.bbox.enclose(primitive.bbox());
            bucket.size += 1;
        }
        for plane in 1..count {
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
