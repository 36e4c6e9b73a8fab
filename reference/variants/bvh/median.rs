// Splits at the median of the primitives' centres along the longest axis, so that each side gets
// half of the primitives. Areas are not considered. Traverses the tree without a stack, restarting
// from the root along a trail of bits (Laine, "Restart Trail for Stackless BVH Traversal", 2010).

impl Bvh {
    /// Builds the tree by splitting at the median.
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
        let mut rest = *ray;

        // One bit for each level, with the root's bit at the top. A bit is 1 if the child being
        // traversed on that level is the last to be visited.
        let mut trail = 0_u64;
        while trail < DONE {
            let mut node = root;
            let mut parent_bit = DONE;
            while !node.is_leaf() {
                let bit = parent_bit >> 1;
                let [near, far] = self.in_order(node, ray);
                if far.is_none() {
                    trail |= bit;
                }
                let next = if trail & bit == 0 { near } else { far.or(near) };
                parent_bit = bit;
                match next.filter(|(_, entry)| *entry <= rest.range.max) {
                    Some((child, _)) => node = &self.nodes[child],
                    None => break,
                }
            }
            if node.is_leaf() {
                self.test_leaf(node, &mut rest, &mut closest);
            }

            // Move to the next child: adding a one carries up past all finished levels.
            trail = (trail & !(parent_bit - 1)) + parent_bit;
        }
        closest
    }

    /// Returns those children of an interior node whose boxes the ray hits, with their entry
    /// distances, the nearer child first. `ray` must not be shortened by hits, so that the result
    /// stays the same for the whole traversal.
    fn in_order(&self, node: &Node, ray: &Ray) -> [Option<(usize, f32)>; 2] {
        let enter = |index: usize| Some((index, self.nodes[index].bbox.hit(ray, ray.range)?.min));
        match (enter(node.l), enter(node.r)) {
            (Some(l), Some(r)) if r.1 < l.1 => [Some(r), Some(l)],
            (None, r) => [r, None],
            (l, r) => [l, r],
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

/// The bit above the root's bit. The bits below it are enough for trees of 62 levels.
const DONE: u64 = 1 << 63;

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

/// Partitions the primitives in place at the median of their centres along the longest axis;
/// returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let centers = bounds_of_centers(primitives);
    let axis = (centers.max - centers.min).max_position();
    let center = |primitive: &Primitive| primitive.bbox().center()[axis];
    let middle = primitives.len() / 2;
    primitives.select_nth_unstable_by(middle, |a, b| center(a).total_cmp(&center(b)));
    middle
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
