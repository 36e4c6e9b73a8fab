// Tests no primitive twice for one ray, even if a tree had it in several leaves. A mailbox holds the
// number of the last ray that tested its primitive. Every call has a number of its own, and boxes that
// are too few are added, so that no answer depends on earlier rays or other trees. See Amanatides and
// Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987.

use std::cell::RefCell;

/// The mailboxes, and the number of the current ray.
struct Mail {
    boxes: Vec<u64>,
    ray: u64,
}

thread_local! {
    static MAIL: RefCell<Mail> = const {
        RefCell::new(Mail {
            boxes: Vec::new(),
            ray: 0,
        })
    };
}

impl Mail {
    fn begin_ray(&mut self, primitives: usize) {
        self.ray += 1;
        let count = self.boxes.len().max(primitives);
        self.boxes.resize(count, 0);
    }

    /// Returns whether the ray has not tested this primitive, and marks it as tested.
    fn is_new(&mut self, primitive: usize) -> bool {
        std::mem::replace(&mut self.boxes[primitive], self.ray) != self.ray
    }
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
        MAIL.with_borrow_mut(|mail| {
            mail.begin_ray(self.primitives.len());
            let mut closest = None;
            if self.root < self.nodes.len() {
                self.traverse(self.root, &mut ray.clone(), mail, &mut closest);
            }
            closest
        })
    }

    fn traverse(&self, index: usize, ray: &mut Ray, mail: &mut Mail, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.bbox.hit(ray, ray.range).is_none() {
            return;
        }
        if node.is_leaf() {
            for primitive in node.start..node.start + node.size {
                let hit = mail
                    .is_new(primitive)
                    .then(|| self.primitives[primitive].hit(ray));
                if let Some(Some(trace)) = hit {
                    ray.range.max = trace.distance;
                    *closest = Some(trace);
                }
            }
            return;
        }
        let entry = |child: usize| {
            let inside = self.nodes[child].bbox.hit(ray, ray.range);
            inside.map_or(f32::INFINITY, |inside| inside.min)
        };
        let mut children = [node.l, node.r];
        if entry(node.r) < entry(node.l) {
            children.reverse();
        }
        for child in children {
            self.traverse(child, ray, mail, closest);
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
