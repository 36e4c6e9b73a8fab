// Builds the tree without buckets: for each of 32 planes perpendicular to each axis of the node's
// box, the primitives are partitioned and both boxes are computed. Traversal first lists all
// leaves that the ray hits, and then tests them from near to far.

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut leaves = Vec::new();
        if let Some(root) = self.nodes.get(self.root) {
            self.list_leaves(root, ray, &mut leaves);
        }
        leaves.sort_by(|a, b| a.0.total_cmp(&b.0));

        let mut closest: Option<Trace> = None;
        for (entry, leaf) in leaves {
            if closest.is_some_and(|closest| closest.distance < entry) {
                break;
            }
            for primitive in &self.primitives[leaf.start..leaf.start + leaf.size] {
                closest = Trace::nearer(closest, primitive.hit(ray));
            }
        }
        closest
    }

    /// Lists the leaves below `node` whose boxes the ray hits, with their entry distances.
    fn list_leaves<'a>(&'a self, node: &'a Node, ray: &Ray, leaves: &mut Vec<(f32, &'a Node)>) {
        let Some(inside) = node.bbox.hit(ray, ray.range) else {
            return;
        };
        if node.is_leaf() {
            leaves.push((inside.min, node));
        } else {
            self.list_leaves(&self.nodes[node.l], ray, leaves);
            self.list_leaves(&self.nodes[node.r], ray, leaves);
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

/// The number of planes perpendicular to each axis.
const PLANES: usize = 32;

/// Partitions the primitives in place by the best plane; returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let bbox = bounds_of(primitives);
    let plane = |axis: usize, i: usize| {
        let part = (i + 1) as f32 / (PLANES + 1) as f32;
        bbox.min[axis] + part * (bbox.max[axis] - bbox.min[axis])
    };

    let (mut least, mut best) = (f32::INFINITY, None);
    for axis in 0..3 {
        for i in 0..PLANES {
            let middle = partition(primitives, axis, plane(axis, i));
            let (left, right) = primitives.split_at(middle);
            if left.is_empty() || right.is_empty() {
                continue;
            }
            let cost = cost(left) + cost(right);
            if cost < least {
                (least, best) = (cost, Some((axis, plane(axis, i))));
            }
        }
    }
    // If all centres are on the same side of every plane, split the primitives in half.
    best.map_or(primitives.len() / 2, |(axis, plane)| {
        partition(primitives, axis, plane)
    })
}

/// Moves the primitives before the plane to the front, as C++'s `std::partition` does, and returns
/// their number.
fn partition(primitives: &mut [Primitive], axis: usize, plane: f32) -> usize {
    let mut first = 0;
    for i in 0..primitives.len() {
        if primitives[i].bbox().center()[axis] < plane {
            primitives.swap(first, i);
            first += 1;
        }
    }
    first
}

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
