//! From below: along the Z-order curve each cluster looks for its nearest among a few neighbours,
//! and two that chose each other join. Meister and Bittner, "Parallel Locally-Ordered Clustering
//! for Bounding Volume Hierarchy Construction", IEEE TVCG 24(3), 2018. The walk: first all leaves
//! that the ray meets are listed, then asked from near to far.

use glam::Vec3;
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
        let mut leaves = Vec::new();
        if let Some(root) = self.nodes.get(self.root) {
            self.list_leaves(root, ray, &mut leaves);
        }
        leaves.sort_by(|a, b| a.0.total_cmp(&b.0));

        let mut closest: Option<Trace> = None;
        for (entry, leaf) in leaves {
            if closest.is_some_and(|closest| closest.distance < entry) {
                break;
            }
            for primitive in &self.primitives[leaf.start..leaf.start + leaf.size] {
                closest = Trace::nearer(closest, primitive.hit(ray));
            }
        }
        closest
    }

    /// Lists the leaves below `node` whose boxes the ray meets, with the times when it does.
    fn list_leaves<'a>(&'a self, node: &'a Node, ray: &Ray, leaves: &mut Vec<(f32, &'a Node)>) {
        let Some(inside) = node.bbox.hit(ray, ray.range) else {
            return;
        };
        if node.is_leaf() {
            leaves.push((inside.min, node));
        } else {
            self.list_leaves(&self.nodes[node.l], ray, leaves);
            self.list_leaves(&self.nodes[node.r], ray, leaves);
        }
    }
}

/// How many neighbours to each side are looked at.
const RADIUS: usize = 16;

fn join_all(mut primitives: Vec<Primitive>) -> Option<Cluster> {
    let centers = around_centers(&primitives);
    primitives.sort_by_cached_key(|p| morton_code(p.bbox().center(), &centers));
    let mut clusters: Vec<Cluster> = primitives.into_iter().map(Cluster::one).collect();
    while clusters.len() > 1 {
        let nearest: Vec<usize> = (0..clusters.len()).map(|i| nearest(&clusters, i)).collect();
        let mut waiting: Vec<Option<Cluster>> = clusters.into_iter().map(Some).collect();
        clusters = Vec::new();
        for i in 0..waiting.len() {
            // The later one of a pair is gone already.
            let Some(cluster) = waiting[i].take() else {
                continue;
            };
            let is_mutual = nearest[nearest[i]] == i;
            let partner = is_mutual.then(|| waiting[nearest[i]].take()).flatten();
            clusters.push(match partner {
                Some(partner) => Cluster::two(cluster, partner),
                None => cluster,
            });
        }
    }
    clusters.pop()
}

/// The cluster within the radius that is nearest to the one at `i`. The two nearest of all always
/// choose each other: of several at the same distance the first pair in the list counts.
fn nearest(clusters: &[Cluster], i: usize) -> usize {
    let window = i.saturating_sub(RADIUS)..clusters.len().min(i + RADIUS + 1);
    let others = window.filter(|&other| other != i);
    let distance = |other: usize| clusters[i].distance(&clusters[other]);
    let nearest = others.min_by(|&a, &b| {
        let by_distance = distance(a).total_cmp(&distance(b));
        by_distance.then((a.min(i), a.max(i)).cmp(&(b.min(i), b.max(i))))
    });
    nearest.expect("there are two clusters at least, and RADIUS is not 0")
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

/// The place of a point in the box along the Z-order curve: three times 16 bits, interleaved.
fn morton_code(point: Vec3, bbox: &BBox) -> u64 {
    let size = (bbox.max - bbox.min).max(Vec3::splat(f32::MIN_POSITIVE));
    let cell = ((point - bbox.min) / size * 65535.0).as_uvec3();
    (0..16).fold(0, |code, bit| {
        let [x, y, z] = cell
            .to_array()
            .map(|component| u64::from(component >> bit & 1));
        code | (x << 2 | y << 1 | z) << (3 * bit)
    })
}

fn around_centers(primitives: &[Primitive]) -> BBox {
    let mut all = BBox::EMPTY;
    for primitive in primitives {
        all.enclose_point(primitive.bbox().center());
    }
    all
}
