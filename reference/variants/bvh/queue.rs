// Builds the tree with a queue, level by level, so that the children of a node are always next to
// each other; the buckets divide the box of the centres. Traversal puts the children that the ray
// hits in a sorted list, and never shortens the ray itself.

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
            let middle = split(contents);
            let (l, r) = (nodes.len(), nodes.len() + 1);
            nodes[index] = Node::interior(bbox, l, r);
            let (left, right) = contents.split_at(middle);
            nodes.push(Node::leaf(bounds_of(left), start, middle));
            nodes.push(Node::leaf(bounds_of(right), start + middle, size - middle));
            queue.extend([l, r]);
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

/// The number of buckets along each axis.
const BUCKETS: usize = 16;

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
