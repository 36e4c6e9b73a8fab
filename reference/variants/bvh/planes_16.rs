//! No buckets: sixteen planes across each axis of the node's box, and for each the primitives are
//! parted and the two boxes made. The walk: a parent tests both boxes and passes the limit down.

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

/// Planes across each axis.
const PLANES: usize = 16;

/// Brings the primitives on one side of the best plane to the front; returns their number.
fn split(primitives: &mut [Primitive]) -> usize {
    let bbox = around(primitives);
    let plane = |axis: usize, i: usize| {
        let part = (i + 1) as f32 / (PLANES + 1) as f32;
        bbox.min[axis] + part * (bbox.max[axis] - bbox.min[axis])
    };

    let (mut least, mut best) = (f32::INFINITY, None);
    for axis in 0..3 {
        for i in 0..PLANES {
            let middle = partition(primitives, axis, plane(axis, i));
            let (left, right) = primitives.split_at(middle);
            if left.is_empty() || right.is_empty() {
                continue;
            }
            let cost = cost(left) + cost(right);
            if cost < least {
                (least, best) = (cost, Some((axis, plane(axis, i))));
            }
        }
    }
    // If all centers are on the same side of every plane, half of the primitives.
    best.map_or(primitives.len() / 2, |(axis, plane)| {
        partition(primitives, axis, plane)
    })
}

/// Brings those before the plane to the front, as `std::partition` does; returns their number.
fn partition(primitives: &mut [Primitive], axis: usize, plane: f32) -> usize {
    let mut first = 0;
    for i in 0..primitives.len() {
        if primitives[i].bbox().center()[axis] < plane {
            primitives.swap(first, i);
            first += 1;
        }
    }
    first
}

fn cost(side: &[Primitive]) -> f32 {
    around(side).surface_area() * side.len() as f32
}

fn around(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose(primitive.bbox());
    }
    all
}
