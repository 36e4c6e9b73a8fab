//! Half of the primitives to each side, in the order of their centers along the longest axis. No
//! areas are looked at. The walk: without a stack, again from the root along a trail of bits
//! (Laine, "Restart Trail for Stackless BVH Traversal", 2010).

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

    /// Builds the tree by halves of equal number.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        let mut closest = None;
        let mut rest = *ray;

        // One bit for each level, the root's on top: 1 where the last child is being done.
        let mut trail = 0_u64;
        while trail < DONE {
            let mut node = root;
            let mut parent_bit = DONE;
            while !node.is_leaf() {
                let bit = parent_bit >> 1;
                let [near, far] = self.in_order(node, ray);
                if far.is_none() {
                    trail |= bit;
                }
                let next = if trail & bit == 0 { near } else { far.or(near) };
                parent_bit = bit;
                match next.filter(|(_, entry)| *entry <= rest.range.max) {
                    Some((child, _)) => node = &self.nodes[child],
                    None => break,
                }
            }
            if node.is_leaf() {
                self.ask(node, &mut rest, &mut closest);
            }

            // To the next child: adding a one carries up past all levels that are done with.
            trail = (trail & !(parent_bit - 1)) + parent_bit;
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

/// The bit above the root's: enough for trees of 62 levels.
const DONE: u64 = 1 << 63;

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

/// Brings the half with the smaller centers along the longest axis to the front.
fn split(primitives: &mut [Primitive]) -> usize {
    let centers = around_centers(primitives);
    let axis = (centers.max - centers.min).max_position();
    let center = |primitive: &Primitive| primitive.bbox().center()[axis];
    let middle = primitives.len() / 2;
    primitives.select_nth_unstable_by(middle, |a, b| center(a).total_cmp(&center(b)));
    middle
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
