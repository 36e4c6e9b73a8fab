//! Builds from a stack, marks a leaf by children that are the leaf itself, and says of interior
//! nodes as well which primitives are below them. The walk: a stack of places; a box is tested
//! when it is taken off.

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
        let mut nodes: Vec<Node> = Vec::new();
        // What a node is to hold, and the parent that waits for its place.
        let mut open = Vec::new();
        if !primitives.is_empty() {
            open.push((0..primitives.len(), None::<usize>));
        }
        while let Some((range, parent)) = open.pop() {
            let held = &mut primitives[range.clone()];
            let place = nodes.len();
            nodes.push(Node {
                bbox: around(held),
                start: range.start,
                size: range.len(),
                l: place,
                r: place,
            });
            if let Some(parent) = parent {
                nodes[parent].r = place;
            }
            if range.len() > max_leaf_size.max(1) {
                let middle = range.start + split(held);
                // The left child comes off the stack next, and so stands right behind its parent;
                // the right one tells its parent when it has a place.
                nodes[place].l = place + 1;
                open.push((middle..range.end, Some(place)));
                open.push((range.start..middle, None));
            }
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest: Option<Trace> = None;
        let mut open = Vec::from_iter((self.root < self.nodes.len()).then_some(self.root));
        while let Some(place) = open.pop() {
            let node = &self.nodes[place];
            // What is left of the ray, for boxes and primitives alike.
            let mut rest = *ray;
            rest.range.max = closest.map_or(ray.range.max, |closest| closest.distance);
            let entry = |node: &Node| Some(node.bbox.hit(ray, rest.range)?.min);
            if entry(node).is_none() {
                continue;
            }
            if node.is_leaf() {
                let primitives = &self.primitives[node.start..node.start + node.size];
                let traces = primitives.iter().map(|primitive| primitive.hit(&rest));
                closest = traces.fold(closest, Trace::nearer);
                continue;
            }
            // None counts as less than any number here: what is missed goes on top, and off again.
            if entry(&self.nodes[node.l]) < entry(&self.nodes[node.r]) {
                open.extend([node.r, node.l]);
            } else {
                open.extend([node.l, node.r]);
            }
        }
        closest
    }
}

/// Slices along each axis.
const BUCKETS: usize = 12;

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
