// Builds the tree with up to 64 chunks of equal numbers of primitives, in the order of their
// centres, instead of slices of equal width. Traverses the tree with a stack of nodes, each with
// the distance at which the ray enters it.

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

/// Sorts the primitives along the axis of the cheapest split; returns the size of the left side.
fn split(primitives: &mut [Primitive]) -> usize {
    let chunk = primitives.len().div_ceil(CHUNKS);
    let (mut least, mut best) = (f32::INFINITY, (0, primitives.len() / 2));
    for axis in 0..3 {
        sort(primitives, axis);
        let chunks: Vec<BBox> = primitives.chunks(chunk).map(bounds_of).collect();
        for i in 1..chunks.len() {
            let first = i * chunk;
            let second = primitives.len() - first;
            let cost = area(&chunks[..i]) * first as f32 + area(&chunks[i..]) * second as f32;
            if cost < least {
                (least, best) = (cost, (axis, first));
            }
        }
    }
    let (axis, first) = best;
    sort(primitives, axis);
    first
}

/// The number of chunks along each axis.
const CHUNKS: usize = 64;

fn sort(primitives: &mut [Primitive], axis: usize) {
    let center = |primitive: &Primitive| primitive.bbox().center()[axis];
    primitives.sort_by(|a, b| center(a).total_cmp(&center(b)));
}

fn area(boxes: &[BBox]) -> f32 {
    let mut all = BBox::EMPTY;
    for bbox in boxes {
        all.enclose(*bbox);
    }
    all.surface_area()
}

fn bounds_of(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose(primitive.bbox());
    }
    all
}
