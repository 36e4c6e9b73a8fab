// Builds the tree with 32 buckets over the centres. Traversal visits up to four children at once;
// the build determines these children (Wald, Benthin and Boulos, "Getting Rid of Packets", 2008).

#[derive(Clone, Debug)]
pub struct Bvh {
    pub primitives: Vec<Primitive>,
    pub nodes: Vec<Node>,
    pub root: usize,
    /// For each interior node, up to four descendants that replace its children.
    wide: Vec<Vec<usize>>,
}

impl Bvh {
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let wide = nodes.iter().map(|node| up_to_four(&nodes, node)).collect();
        Bvh {
            primitives,
            nodes,
            root,
            wide,
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
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        let mut closest = None;
        self.traverse(self.root, &mut ray.clone(), &mut closest);
        closest
    }

    /// Looks for a closer hit below the node at `index`, whose box the ray is known to hit.
    fn traverse(&self, index: usize, ray: &mut Ray, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.is_leaf() {
            return self.test_leaf(node, ray, closest);
        }
        let hit = self.wide[index]
            .iter()
            .filter_map(|&child| Some((self.nodes[child].bbox.hit(ray, ray.range)?.min, child)));
        let mut ahead: Vec<(f32, usize)> = hit.collect();
        ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (entry, child) in ahead {
            if entry <= ray.range.max {
                self.traverse(child, ray, closest);
            }
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

/// Returns up to four descendants of a node: as long as there are fewer, the interior node with the
/// largest box is replaced with its children.
fn up_to_four(nodes: &[Node], node: &Node) -> Vec<usize> {
    if node.is_leaf() {
        return Vec::new();
    }
    let mut children = vec![node.l, node.r];
    while children.len() < 4 {
        let area = |index: &usize| nodes[*index].bbox.surface_area();
        let interior = (0..children.len()).filter(|&i| !nodes[children[i]].is_leaf());
        let largest = interior.max_by(|&a, &b| area(&children[a]).total_cmp(&area(&children[b])));
        let Some(i) = largest else { break };
        let opened = &nodes[children.swap_remove(i)];
        children.extend([opened.l, opened.r]);
    }
    children
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
const BUCKETS: usize = 32;

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
