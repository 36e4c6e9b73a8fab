// Builds the two subtrees of a large node in two threads. Each returns a list of its own, in which
// the root is first; the parent appends the lists and shifts the indices.

use std::panic::resume_unwind;
use std::thread;

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            nodes = build_subtree(&mut primitives, 0, max_leaf_size.max(1));
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

/// The least number of primitives that is worth a thread.
const WORTH_A_THREAD: usize = 256;

/// Builds the subtree over `primitives`, the first of which has index `start` in the tree's list.
fn build_subtree(primitives: &mut [Primitive], start: usize, max_leaf_size: usize) -> Vec<Node> {
    let bbox = bounds_of(primitives);
    let size = primitives.len();
    if size <= max_leaf_size {
        return vec![Node::leaf(bbox, start, size)];
    }
    let middle = split(primitives);
    let (left, right) = primitives.split_at_mut(middle);
    let mut build_left = || build_subtree(left, start, max_leaf_size);
    let mut build_right = || build_subtree(right, start + middle, max_leaf_size);
    let (left, right) = if size < WORTH_A_THREAD {
        (build_left(), build_right())
    } else {
        thread::scope(|scope| {
            let left = scope.spawn(build_left);
            let right = build_right();
            (
                left.join().unwrap_or_else(|panic| resume_unwind(panic)),
                right,
            )
        })
    };

    let (l, r) = (1, 1 + left.len());
    let mut nodes = vec![Node::interior(bbox, l, r)];
    nodes.extend(left.into_iter().map(|node| shifted(node, l)));
    nodes.extend(right.into_iter().map(|node| shifted(node, r)));
    nodes
}

/// Returns a node whose children are found `by` indices later in the list.
fn shifted(node: Node, by: usize) -> Node {
    if node.is_leaf() {
        node
    } else {
        Node::interior(node.bbox, node.l + by, node.r + by)
    }
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
