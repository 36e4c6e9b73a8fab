// Traverses the tree with a stack of fixed size, in an array: the size is a parameter of its type,
// and so is the number of buckets of the builder.

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // A level needs one entry: the farther child, while the nearer one is visited.
        let mut open = Stack::<(usize, f32), 64>::new((0, 0.0));
        let mut closest: Option<Trace> = None;
        let root = self.nodes.get(self.root)?;
        open.push((self.root, root.bbox.hit(ray, ray.range)?.min));
        while let Some((index, entry)) = open.pop() {
            let limit = closest.map_or(ray.range.max, |closest| closest.distance);
            if entry > limit {
                continue;
            }
            let rest = ray.within(ray.range.min, limit);
            let node = &self.nodes[index];
            if node.is_leaf() {
                for primitive in &self.primitives[node.start..node.start + node.size] {
                    closest = Trace::nearer(closest, primitive.hit(&rest));
                }
                continue;
            }
            let enter = |child: usize| {
                let inside = self.nodes[child].bbox.hit(&rest, rest.range);
                inside.map(|inside| (child, inside.min))
            };
            let mut children = [enter(node.l), enter(node.r)];
            if let [Some(l), Some(r)] = children
                && l.1 < r.1
            {
                children.reverse();
            }
            for child in children.into_iter().flatten() {
                open.push(child);
            }
        }
        closest
    }
}

/// A stack of at most N elements.
struct Stack<T, const N: usize> {
    elements: [T; N],
    size: usize,
}

impl<T: Copy, const N: usize> Stack<T, N> {
    fn new(unused: T) -> Self {
        Stack {
            elements: [unused; N],
            size: 0,
        }
    }

    fn push(&mut self, element: T) {
        self.elements[self.size] = element;
        self.size += 1;
    }

    fn pop(&mut self) -> Option<T> {
        self.size = self.size.checked_sub(1)?;
        Some(self.elements[self.size])
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
    // A bucket takes time, whether it is empty or not.
    if primitives.len() < 32 {
        split_by_buckets::<8>(primitives)
    } else {
        split_by_buckets::<24>(primitives)
    }
}

fn split_by_buckets<const COUNT: usize>(primitives: &mut [Primitive]) -> usize {
    let over = bounds_of_centers(primitives);
    let bucket = |primitive: &Primitive, axis: usize| {
        let offset = primitive.bbox().center()[axis] - over.min[axis];
        let part = offset / (over.max[axis] - over.min[axis]);
        ((part * COUNT as f32) as usize).min(COUNT - 1)
    };

    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in (0..3).filter(|&axis| over.min[axis] < over.max[axis]) {
        let mut buckets = [Bucket::EMPTY; COUNT];
        for primitive in primitives.iter() {
            let bucket = &mut buckets[bucket(primitive, axis)];
            bucket.bbox.enclose(primitive.bbox());
            bucket.size += 1;
        }
        for plane in 1..COUNT {
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
