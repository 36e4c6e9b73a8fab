//! At the middle of the longest axis, wherever the primitives are. No areas are looked at. The
//! walk: a parent tests both boxes and passes the limit down.

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

    /// Builds the tree by halves of equal width.
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

/// Brings those before the middle of the longest axis of the centers to the front.
fn split(primitives: &mut [Primitive]) -> usize {
    let centers = around_centers(primitives);
    let axis = (centers.max - centers.min).max_position();
    let is_right =
        |primitive: &Primitive| primitive.bbox().center()[axis] >= centers.center()[axis];
    primitives.sort_by_key(is_right);
    match primitives.partition_point(|primitive| !is_right(primitive)) {
        0 => primitives.len() / 2, // All centers coincide.
        middle => middle,
    }
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
