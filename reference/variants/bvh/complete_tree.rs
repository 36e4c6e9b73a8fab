//! A complete tree: all leaves full but one, and the children of node i at 2i + 1 and 2i + 2, as
//! in a binary heap. What goes left follows from the number of leaves; no areas are looked at. The
//! walk: a box is tested when its node is entered, against what is left of the ray.

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

    /// Builds the tree as a complete one.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let most = max_leaf_size.max(1);
        let leaves = primitives.len().div_ceil(most);
        let empty = Node::leaf(BBox::EMPTY, 0, 0);
        let mut nodes = vec![empty; (2 * leaves).saturating_sub(1)];
        if leaves > 0 {
            fill(&mut nodes, 0, &mut primitives, 0, most);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        if self.root < self.nodes.len() {
            self.visit(self.root, &mut ray.clone(), &mut closest);
        }
        closest
    }

    fn visit(&self, place: usize, ray: &mut Ray, closest: &mut Option<Trace>) {
        let node = &self.nodes[place];
        if node.bbox.hit(ray, ray.range).is_none() {
            return;
        }
        if node.is_leaf() {
            return self.ask(node, ray, closest);
        }

        // A box that is missed may come first: it is not entered anyway.
        let entry = |child: usize| {
            let inside = self.nodes[child].bbox.hit(ray, ray.range);
            inside.map_or(f32::INFINITY, |inside| inside.min)
        };
        let (first, second) = if entry(node.l) <= entry(node.r) {
            (node.l, node.r)
        } else {
            (node.r, node.l)
        };
        self.visit(first, ray, closest);
        self.visit(second, ray, closest);
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

/// Fills the node at `place` and all below it with some primitives, which stand from `start` on.
fn fill(nodes: &mut [Node], place: usize, primitives: &mut [Primitive], start: usize, most: usize) {
    let bbox = around(primitives);
    let leaves = primitives.len().div_ceil(most);
    if leaves == 1 {
        nodes[place] = Node::leaf(bbox, start, primitives.len());
        return;
    }

    let centers = around_centers(primitives);
    let axis = (centers.max - centers.min).max_position();
    let center = |primitive: &Primitive| primitive.bbox().center()[axis];
    primitives.sort_by(|a, b| center(a).total_cmp(&center(b)));

    let (left, right) = primitives.split_at_mut(most * left_leaves(leaves));
    let (l, r) = (2 * place + 1, 2 * place + 2);
    nodes[place] = Node::interior(bbox, l, r);
    fill(nodes, l, left, start, most);
    fill(nodes, r, right, start + left.len(), most);
}

/// How many of a complete tree's leaves are to the left of its root: the last level is filled from
/// the left.
fn left_leaves(leaves: usize) -> usize {
    let full = 1 << leaves.ilog2();
    full / 2 + (leaves - full).min(full / 2)
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
