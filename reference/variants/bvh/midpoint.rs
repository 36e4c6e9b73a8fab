// Splits at the midpoint of the longest axis, however the primitives are distributed. Areas are
// not considered. During traversal, a parent tests the boxes of both children and passes the entry
// distances down.

impl Bvh {
    /// Builds the tree by splitting at midpoints.
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

/// Partitions the primitives in place at the midpoint of the axis along which their centres extend
/// farthest; returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let centers = bounds_of_centers(primitives);
    let axis = (centers.max - centers.min).max_position();
    let is_right =
        |primitive: &Primitive| primitive.bbox().center()[axis] >= centers.center()[axis];
    primitives.sort_by_key(is_right);
    match primitives.partition_point(|primitive| !is_right(primitive)) {
        0 => primitives.len() / 2, // All centres coincide.
        middle => middle,
    }
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
