// Builds the tree with eight buckets over the centres. Traverses the tree with a stack of nodes,
// each with the distance at which the ray enters it.

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
        let mut ray = *ray;
        let mut closest = None;
        let mut open = vec![(root, root.bbox.hit(&ray, ray.range)?.min)];
        while let Some((node, entry)) = open.pop() {
            // A closer hit may have been found after the node was pushed.
            if entry > ray.range.max {
                continue;
            }
            if node.is_leaf() {
                self.test_leaf(node, &mut ray, &mut closest);
                continue;
            }
            let entered = |index: usize| {
                let child = &self.nodes[index];
                Some((child, child.bbox.hit(&ray, ray.range)?.min))
            };
            match (entered(node.l), entered(node.r)) {
                // The nearer child is pushed last, so that it is popped first.
                (Some(l), Some(r)) if l.1 <= r.1 => open.extend([r, l]),
                (Some(l), Some(r)) => open.extend([l, r]),
                (l, r) => open.extend(l.or(r)),
            }
        }
        closest
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
const BUCKETS: usize = 8;

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
