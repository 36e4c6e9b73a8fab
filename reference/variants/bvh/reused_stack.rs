// Keeps the memory of the traversal's stack from one call to the next, so that a ray allocates
// nothing. The stack is emptied at the beginning of a call, and only its capacity is kept.

use std::cell::RefCell;

thread_local! {
    static STACK: RefCell<Vec<usize>> = const { RefCell::new(Vec::new()) };
}

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        STACK.with_borrow_mut(|open| {
            open.clear();
            open.extend((self.root < self.nodes.len()).then_some(self.root));
            self.closest_hit(*ray, open)
        })
    }

    /// Returns the closest hit below the nodes on the stack.
    fn closest_hit(&self, mut ray: Ray, open: &mut Vec<usize>) -> Option<Trace> {
        let mut closest = None;
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            if node.bbox.hit(&ray, ray.range).is_none() {
                continue;
            }
            if node.is_leaf() {
                for primitive in &self.primitives[node.start..node.start + node.size] {
                    if let Some(trace) = primitive.hit(&ray) {
                        ray.range.max = trace.distance;
                        closest = Some(trace);
                    }
                }
                continue;
            }
            let entry = |child: usize| Some(self.nodes[child].bbox.hit(&ray, ray.range)?.min);
            match (entry(node.l), entry(node.r)) {
                (Some(in_l), Some(in_r)) if in_l < in_r => open.extend([node.r, node.l]),
                (Some(_), Some(_)) => open.extend([node.l, node.r]),
                (Some(_), None) => open.push(node.l),
                (None, Some(_)) => open.push(node.r),
                (None, None) => {}
            }
        }
        closest
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
