//! One primitive after the other goes down to where it adds the least area: Goldsmith and Salmon,
//! "Automatic Creation of Object Hierarchies for Ray Tracing", IEEE Computer Graphics and
//! Applications 7(5), 1987. The walk: best first, from a heap: of all open nodes the one that
//! begins nearest.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

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

    /// Builds the tree by putting in one primitive after the other.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let (mut nodes, mut ordered) = (Vec::new(), Vec::new());
        let mut root = 0;
        if let Some(cluster) = insert_all(primitives) {
            root = cluster.flatten(max_leaf_size.max(1), &mut nodes, &mut ordered);
        }
        Bvh::from_nodes(ordered, nodes, root)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        let mut ray = *ray;
        let mut closest = None;
        let mut open = BinaryHeap::from_iter(Open::new(root, &ray));
        while let Some(Open { node, entry }) = open.pop() {
            // All others begin even later.
            if entry > ray.range.max {
                break;
            }
            if node.is_leaf() {
                self.ask(node, &mut ray, &mut closest);
            } else {
                let children = [node.l, node.r].map(|place| &self.nodes[place]);
                open.extend(
                    children
                        .into_iter()
                        .filter_map(|child| Open::new(child, &ray)),
                );
            }
        }
        closest
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

/// A node that is still to be entered; the greatest is the one whose box begins nearest.
struct Open<'a> {
    node: &'a Node,
    entry: f32,
}

impl<'a> Open<'a> {
    /// None if the ray misses the box.
    fn new(node: &'a Node, ray: &Ray) -> Option<Self> {
        let entry = node.bbox.hit(ray, ray.range)?.min;
        Some(Open { node, entry })
    }
}

impl Ord for Open<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.entry.total_cmp(&self.entry)
    }
}

impl PartialOrd for Open<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Open<'_> {}

fn insert_all(primitives: Vec<Primitive>) -> Option<Cluster> {
    let clusters = primitives.into_iter().map(Cluster::one);
    clusters.reduce(|tree, next| tree.with(next))
}

/// A part of the tree that is finished, but for what is above it.
struct Cluster {
    bbox: BBox,
    size: usize,
    parts: Parts,
}

enum Parts {
    One(Primitive),
    Two(Box<Cluster>, Box<Cluster>),
}

impl Cluster {
    fn one(primitive: Primitive) -> Self {
        Cluster {
            bbox: primitive.bbox(),
            size: 1,
            parts: Parts::One(primitive),
        }
    }

    fn two(a: Cluster, b: Cluster) -> Self {
        let mut bbox = a.bbox;
        bbox.enclose(b.bbox);
        Cluster {
            bbox,
            size: a.size + b.size,
            parts: Parts::Two(Box::new(a), Box::new(b)),
        }
    }

    /// The area of the box around both: what it costs to join them.
    fn distance(&self, other: &Cluster) -> f32 {
        let mut both = self.bbox;
        both.enclose(other.bbox);
        both.surface_area()
    }

    /// The cluster with one more primitive in it.
    fn with(self, new: Cluster) -> Cluster {
        // What it costs to put it beside this node, or further down: the area of the box around
        // what is joined, and the growth of all that is above.
        let beside = self.distance(&new);
        let growth = beside - self.bbox.surface_area();
        let Parts::Two(a, b) = self.parts else {
            return Cluster::two(self, new);
        };
        let below = |child: &Cluster| match child.parts {
            Parts::One(_) => growth + child.distance(&new),
            Parts::Two(..) => growth + child.distance(&new) - child.bbox.surface_area(),
        };
        let (into_a, into_b) = (below(&a), below(&b));
        if beside < into_a.min(into_b) {
            Cluster::two(Cluster::two(*a, *b), new)
        } else if into_a <= into_b {
            Cluster::two(a.with(new), *b)
        } else {
            Cluster::two(*a, b.with(new))
        }
    }

    /// Appends the primitives in the cluster.
    fn unpack(self, primitives: &mut Vec<Primitive>) {
        match self.parts {
            Parts::One(primitive) => primitives.push(primitive),
            Parts::Two(a, b) => {
                a.unpack(primitives);
                b.unpack(primitives);
            }
        }
    }

    /// Appends the cluster's nodes and primitives; returns the place of its root. Whatever fits
    /// into a leaf becomes one.
    fn flatten(self, most: usize, nodes: &mut Vec<Node>, primitives: &mut Vec<Primitive>) -> usize {
        let (bbox, size) = (self.bbox, self.size);
        let node = match self.parts {
            Parts::Two(a, b) if size > most => {
                let l = a.flatten(most, nodes, primitives);
                let r = b.flatten(most, nodes, primitives);
                Node::interior(bbox, l, r)
            }
            Parts::One(_) | Parts::Two(..) => {
                let start = primitives.len();
                self.unpack(primitives);
                Node::leaf(bbox, start, size)
            }
        };
        nodes.push(node);
        nodes.len() - 1
    }
}
