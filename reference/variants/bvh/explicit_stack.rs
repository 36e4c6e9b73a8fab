// Builds the tree with an explicit stack, marks a leaf by using its own index for both children,
// and also fills in `start` and `size` of interior nodes. Traverses the tree with a stack of
// indices, and tests a box when its node is popped.

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes: Vec<Node> = Vec::new();
        // The primitives of each node that is still to be created, and the parent in which to store
        // the node's index.
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
                let middle = range.start + split(contents);
                // The left child is popped next, so its index is one more than its parent's. The
                // right child's index is not known yet; it is stored when that child is created.
                nodes[index].l = index + 1;
                open.push((middle..range.end, Some(index)));
                open.push((range.start..middle, None));
            }
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

/// The number of buckets along each axis.
const BUCKETS: usize = 12;

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
