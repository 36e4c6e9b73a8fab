//! From below: the two clusters with the smallest box around both join, until one is left: Walter
//! et al., "Fast Agglomerative Clustering for Rendering", 2008. Nearest pairs are found by
//! following chains of nearest neighbours, which end at a pair. The walk: a stack of nodes, each
//! with the time at which the ray enters it.

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

    /// Builds the tree from below.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let (mut nodes, mut ordered) = (Vec::new(), Vec::new());
        let mut root = 0;
        if let Some(cluster) = join_all(primitives) {
            root = cluster.flatten(max_leaf_size.max(1), &mut nodes, &mut ordered);
        }
        Bvh::from_nodes(ordered, nodes, root)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        let mut ray = *ray;
        let mut closest = None;
        let mut open = vec![(root, root.bbox.hit(&ray, ray.range)?.min)];
        while let Some((node, entry)) = open.pop() {
            // Something nearer may have been hit since the node was put on the stack.
            if entry > ray.range.max {
                continue;
            }
            if node.is_leaf() {
                self.ask(node, &mut ray, &mut closest);
                continue;
            }
            let entered = |place: usize| {
                let child = &self.nodes[place];
                Some((child, child.bbox.hit(&ray, ray.range)?.min))
            };
            match (entered(node.l), entered(node.r)) {
                // The nearer goes on top.
                (Some(l), Some(r)) if l.1 <= r.1 => open.extend([r, l]),
                (Some(l), Some(r)) => open.extend([l, r]),
                (l, r) => open.extend(l.or(r)),
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

fn join_all(primitives: Vec<Primitive>) -> Option<Cluster> {
    let mut apart: Vec<Cluster> = primitives.into_iter().map(Cluster::one).collect();
    // Each is nearer to its predecessor than that is to its own.
    let mut chain: Vec<Cluster> = Vec::new();
    while chain.len() + apart.len() > 1 {
        let Some(last) = chain.last() else {
            chain.extend(apart.pop());
            continue;
        };
        let distances = apart.iter().map(|other| last.distance(other));
        let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let back = chain
            .iter()
            .nth_back(1)
            .map(|previous| last.distance(previous));
        match nearest {
            // If there is no nearer one than where the chain came from, the two are a pair.
            Some((place, distance)) if back.is_none_or(|back| distance < back) => {
                chain.push(apart.swap_remove(place));
            }
            Some(_) | None => {
                let pair = chain.pop().zip(chain.pop());
                apart.extend(pair.map(|(a, b)| Cluster::two(a, b)));
            }
        }
    }
    apart.pop().or(chain.pop())
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
