// Computes the full formula, C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect,
// although parts of the formula are the same for all partitions of a node. During traversal, a
// parent tests the boxes of both children and passes the entry distances down.

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        if let Some(root) = self.nodes.get(self.root) {
            let entry = root.bbox.hit(ray, ray.range).map(|inside| inside.min);
            self.traverse(root, entry, ray, &mut closest);
        }
        closest
    }

    /// Looks for a closer hit below `node`. `entry` is the distance at which the ray enters the
    /// node's box, or `None` if the ray misses it.
    fn traverse(&self, node: &Node, entry: Option<f32>, ray: &Ray, closest: &mut Option<Trace>) {
        let limit = closest.map_or(f32::INFINITY, |closest| closest.distance);
        if entry.is_none_or(|entry| entry >= limit) {
            return;
        }
        if node.is_leaf() {
            for primitive in &self.primitives[node.start..node.start + node.size] {
                *closest = Trace::nearer(primitive.hit(ray), *closest);
            }
            return;
        }

        let mut children = [node.l, node.r].map(|index| {
            let child = &self.nodes[index];
            (
                child,
                child.bbox.hit(ray, ray.range).map(|inside| inside.min),
            )
        });
        if let [(_, Some(l)), (_, Some(r))] = children
            && r < l
        {
            children.swap(0, 1);
        }
        for (child, entry) in children {
            self.traverse(child, entry, ray, closest);
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

/// The cost of traversing a node.
const C_TRAV: f32 = 1.0;

/// The cost of testing a primitive.
const C_ISECT: f32 = 2.0;

/// The number of buckets along each axis.
const BUCKETS: usize = 16;

/// Partitions the primitives in place by the cheapest split; returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let over = bounds_of_centers(primitives);
    // If all primitives are points on a line, the area is 0. Any positive divisor will do in that
    // case.
    let node_area = bounds_of(primitives).surface_area().max(f32::MIN_POSITIVE);
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
            let cost = C_TRAV + (left.cost() + right.cost()) * C_ISECT / node_area;
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

    /// Returns the cost before division by the node's area and multiplication by the cost of a
    /// test.
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
