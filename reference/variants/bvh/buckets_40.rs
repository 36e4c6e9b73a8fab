//! Forty buckets over the node's own box. The walk: without a stack, by pointers from each node to
//! its parent (Hapala et al., "Efficient Stack-less BVH Traversal for Ray Tracing", 2011).

use protocol::{Ray, Trace};

use crate::bbox::BBox;
use crate::primitive::Primitive;

/// One box of the tree. A leaf if and only if `l == r`.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Holds everything below this node.
    pub bbox: BBox,
    /// In a leaf, the place of its first primitive; elsewhere not read.
    pub start: usize,
    /// In a leaf, the number of its primitives; elsewhere not read.
    pub size: usize,
    /// In an interior node, the place of one child in `Bvh::nodes`.
    pub l: usize,
    /// In an interior node, the place of the other.
    pub r: usize,
}

impl Node {
    /// A node that holds primitives.
    pub fn leaf(bbox: BBox, start: usize, size: usize) -> Self {
        Node {
            bbox,
            start,
            size,
            l: 0,
            r: 0,
        }
    }

    /// A node that holds two others.
    pub fn interior(bbox: BBox, l: usize, r: usize) -> Self {
        Node {
            bbox,
            start: 0,
            size: 0,
            l,
            r,
        }
    }

    /// Whether the node holds primitives.
    pub fn is_leaf(&self) -> bool {
        self.l == self.r
    }
}

/// A bounding volume hierarchy: a binary tree of boxes around primitives.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// All primitives; those of one leaf stand side by side.
    pub primitives: Vec<Primitive>,
    /// All nodes, in any order. None at all if there is nothing to hold.
    pub nodes: Vec<Node>,
    /// The place of the node where everything starts: need be neither first nor last.
    pub root: usize,
    /// For each node but the root, its parent.
    parents: Vec<Option<usize>>,
}

impl Bvh {
    /// A tree from its parts.
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let mut parents = vec![None; nodes.len()];
        for (place, node) in nodes.iter().enumerate().filter(|(_, node)| !node.is_leaf()) {
            parents[node.l] = Some(place);
            parents[node.r] = Some(place);
        }
        Bvh {
            primitives,
            nodes,
            root,
            parents,
        }
    }

    /// Builds the tree by the surface area heuristic.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        let mut rest = *ray;
        let (mut at, mut from) = (self.root, None);
        while let Some(node) = self.nodes.get(at) {
            let parent = self.parents[at];
            let next = if from == parent {
                // From above: the box decides whether there is anything to do down here.
                if node.bbox.hit(&rest, rest.range).is_none() {
                    parent
                } else if node.is_leaf() {
                    self.ask(node, &mut rest, &mut closest);
                    parent
                } else {
                    let [near, _] = self.in_order(node, ray);
                    near.map_or(parent, |(near, _)| Some(near))
                }
            } else {
                // From below: after the near child comes the far one, after that the parent.
                match self.in_order(node, ray) {
                    [Some((near, _)), Some((far, _))] if from == Some(near) => Some(far),
                    _ => parent,
                }
            };
            from = Some(at);
            let Some(next) = next else { break };
            at = next;
        }
        closest
    }

    /// The children of an interior node whose boxes the whole ray meets, with the times at which
    /// it enters them, the earlier first. Always the same for the same ray.
    fn in_order(&self, node: &Node, ray: &Ray) -> [Option<(usize, f32)>; 2] {
        let enter = |place: usize| Some((place, self.nodes[place].bbox.hit(ray, ray.range)?.min));
        match (enter(node.l), enter(node.r)) {
            (Some(l), Some(r)) if r.1 < l.1 => [Some(r), Some(l)],
            (None, r) => [r, None],
            (l, r) => [l, r],
        }
    }

    /// Asks the primitives of a leaf. A hit shortens the ray, so that only nearer ones follow.
    fn ask(&self, leaf: &Node, ray: &mut Ray, closest: &mut Option<Trace>) {
        for primitive in &self.primitives[leaf.start..leaf.start + leaf.size] {
            if let Some(trace) = primitive.hit(ray) {
                ray.range.max = trace.distance;
                *closest = Some(trace);
            }
        }
    }
}

/// Builds the node over some primitives, which stand from `start` on; returns its place.
fn build_node(
    primitives: &mut [Primitive],
    start: usize,
    max_leaf_size: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let bbox = around(primitives);
    let place = nodes.len();
    nodes.push(Node::leaf(bbox, start, primitives.len()));
    if primitives.len() > max_leaf_size {
        let middle = split(primitives);
        let (left, right) = primitives.split_at_mut(middle);
        let l = build_node(left, start, max_leaf_size, nodes);
        let r = build_node(right, start + middle, max_leaf_size, nodes);
        nodes[place] = Node::interior(bbox, l, r);
    }
    place
}

/// Slices along each axis.
const BUCKETS: usize = 40;

/// Brings the primitives of the cheapest partition's one side to the front; returns their number.
fn split(primitives: &mut [Primitive]) -> usize {
    let over = around(primitives);
    let bucket = |primitive: &Primitive, axis: usize| {
        let place = primitive.bbox().center()[axis] - over.min[axis];
        let part = place / (over.max[axis] - over.min[axis]);
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

/// Several buckets together.
fn side(buckets: &[Bucket]) -> Bucket {
    buckets.iter().fold(Bucket::EMPTY, |mut all, bucket| {
        all.bbox.enclose(bucket.bbox);
        all.size += bucket.size;
        all
    })
}

fn around(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose(primitive.bbox());
    }
    all
}
