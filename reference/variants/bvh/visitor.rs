// Separates the traversal from what happens in a leaf: the traversal calls a closure, which returns
// the new end of the ray. A counter of visited leaves, which nothing depends on, shows why.

use std::sync::atomic::{AtomicUsize, Ordering};

/// The number of leaves that all rays have visited.
static VISITED: AtomicUsize = AtomicUsize::new(0);

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
        self.visit_leaves(ray, &mut |leaf, end| {
            VISITED.fetch_add(1, Ordering::Relaxed);
            let rest = ray.within(ray.range.min, end);
            for primitive in &self.primitives[leaf.start..leaf.start + leaf.size] {
                closest = Trace::nearer(closest, primitive.hit(&rest));
            }
            closest.map_or(end, |closest| closest.distance)
        });
        closest
    }

    /// Calls a function with each leaf that the ray enters before its end, and with the end. The
    /// function returns the new end.
    fn visit_leaves(&self, ray: &Ray, visit: &mut impl FnMut(&Node, f32) -> f32) {
        let mut end = ray.range.max;
        let mut open = Vec::new();
        if let Some(root) = self.nodes.get(self.root) {
            open.extend(
                root.bbox
                    .hit(ray, ray.range)
                    .map(|inside| (inside.min, root)),
            );
        }
        while let Some((entry, node)) = open.pop() {
            if entry > end {
                continue;
            }
            if node.is_leaf() {
                end = visit(node, end);
                continue;
            }
            let children = [node.l, node.r].map(|index| &self.nodes[index]);
            let height = open.len();
            open.extend(children.into_iter().filter_map(|child| {
                let inside = child.bbox.hit(ray, ray.range)?;
                (inside.min <= end).then_some((inside.min, child))
            }));
            // The last one is popped first.
            open[height..].sort_by(|a, b| b.0.total_cmp(&a.0));
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
    let (mut least, mut best) = (f32::INFINITY, (0, primitives.len() / 2));
    for axis in 0..3 {
        sort(primitives, axis);
        let left = areas(primitives.iter());
        let mut right = areas(primitives.iter().rev());
        right.reverse();
        let sides = left.into_iter().zip(right).enumerate();
        for (first, (left, right)) in sides.take(primitives.len()).skip(1) {
            let second = primitives.len() - first;
            let cost = left * first as f32 + right * second as f32;
            if cost < least {
                (least, best) = (cost, (axis, first));
            }
        }
    }
    let (axis, first) = best;
    sort(primitives, axis);
    first
}

fn sort(primitives: &mut [Primitive], axis: usize) {
    let center = |primitive: &Primitive| primitive.bbox().center()[axis];
    primitives.sort_by(|a, b| center(a).total_cmp(&center(b)));
}

/// Returns the area of the box around the first n primitives, for each n from 0.
fn areas<'a>(primitives: impl Iterator<Item = &'a Primitive>) -> Vec<f32> {
    let mut bbox = BBox::EMPTY;
    let boxes = primitives.map(|primitive| {
        bbox.enclose(primitive.bbox());
        bbox.surface_area()
    });
    std::iter::once(0.0).chain(boxes).collect()
}

fn bounds_of(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose(primitive.bbox());
    }
    all
}
