// Builds a complete tree: all leaves but one are full, and the children of node i are at 2i + 1
// and 2i + 2, as in a binary heap. The number of leaves determines how many primitives are in the
// left subtree; areas are not considered. Traversal tests the box of a node when it reaches the
// node; by then, the closest hit so far has shortened the ray.

impl Bvh {
    /// Builds a complete tree.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let max_leaf_size = max_leaf_size.max(1);
        let leaves = primitives.len().div_ceil(max_leaf_size);
        let empty = Node::leaf(BBox::EMPTY, 0, 0);
        let mut nodes = vec![empty; (2 * leaves).saturating_sub(1)];
        if leaves > 0 {
            fill(&mut nodes, 0, &mut primitives, 0, max_leaf_size);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        if self.root < self.nodes.len() {
            self.traverse(self.root, &mut ray.clone(), &mut closest);
        }
        closest
    }

    fn traverse(&self, index: usize, ray: &mut Ray, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.bbox.hit(ray, ray.range).is_none() {
            return;
        }
        if node.is_leaf() {
            return self.test_leaf(node, ray, closest);
        }

        // A missed box counts as infinitely far away. Even if its node is visited first, the box
        // test there fails.
        let entry = |child: usize| {
            let inside = self.nodes[child].bbox.hit(ray, ray.range);
            inside.map_or(f32::INFINITY, |inside| inside.min)
        };
        let (first, second) = if entry(node.l) <= entry(node.r) {
            (node.l, node.r)
        } else {
            (node.r, node.l)
        };
        self.traverse(first, ray, closest);
        self.traverse(second, ray, closest);
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

/// Builds the subtree over `primitives` at `index`. The first of them has index `start` in the
/// tree's list.
fn fill(
    nodes: &mut [Node],
    index: usize,
    primitives: &mut [Primitive],
    start: usize,
    max_leaf_size: usize,
) {
    let bbox = bounds_of(primitives);
    let leaves = primitives.len().div_ceil(max_leaf_size);
    if leaves == 1 {
        nodes[index] = Node::leaf(bbox, start, primitives.len());
        return;
    }

    let centers = bounds_of_centers(primitives);
    let axis = (centers.max - centers.min).max_position();
    let center = |primitive: &Primitive| primitive.bbox().center()[axis];
    primitives.sort_by(|a, b| center(a).total_cmp(&center(b)));

    let (left, right) = primitives.split_at_mut(max_leaf_size * left_leaves(leaves));
    let (l, r) = (2 * index + 1, 2 * index + 2);
    nodes[index] = Node::interior(bbox, l, r);
    fill(nodes, l, left, start, max_leaf_size);
    fill(nodes, r, right, start + left.len(), max_leaf_size);
}

/// Returns the number of leaves in the left subtree of a complete tree with this many leaves, whose
/// last level is filled from the left.
fn left_leaves(leaves: usize) -> usize {
    let full = 1 << leaves.ilog2();
    full / 2 + (leaves - full).min(full / 2)
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
