//! The formula in full, C = C_trav + S_A/S_N · N_A · C_isect + S_B/S_N · N_B · C_isect, though one
//! node's partitions do not differ in most of it. The walk: a parent tests both boxes and passes
//! the limit down.

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
}

impl Bvh {
    /// A tree from its parts.
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        Bvh {
            primitives,
            nodes,
            root,
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
        if let Some(root) = self.nodes.get(self.root) {
            let entry = root.bbox.hit(ray, ray.range).map(|inside| inside.min);
            self.visit(root, entry, ray, &mut closest);
        }
        closest
    }

    /// Looks for a nearer hit below `node`, which the ray enters at `entry`, if at all.
    fn visit(&self, node: &Node, entry: Option<f32>, ray: &Ray, closest: &mut Option<Trace>) {
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

        let mut children = [node.l, node.r].map(|place| {
            let child = &self.nodes[place];
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
            self.visit(child, entry, ray, closest);
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

/// What it costs to go through a node, and to ask a primitive.
const C_TRAV: f32 = 1.0;
const C_ISECT: f32 = 2.0;

/// Slices along each axis.
const BUCKETS: usize = 16;

/// Brings the primitives of the cheapest partition's one side to the front; returns their number.
fn split(primitives: &mut [Primitive]) -> usize {
    let over = around_centers(primitives);
    // A row of points has no area; any divisor will do then.
    let node_area = around(primitives).surface_area().max(f32::MIN_POSITIVE);
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
            let cost = C_TRAV + (left.cost() + right.cost()) * C_ISECT / node_area;
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

    /// Before it is divided by the area of the node and multiplied by the cost of a test.
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

fn around_centers(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose_point(primitive.bbox().center());
    }
    all
}
