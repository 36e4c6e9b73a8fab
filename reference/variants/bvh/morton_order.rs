//! Puts the primitives along the Z-order curve and splits where the highest bit of their codes
//! changes: Lauterbach et al., "Fast BVH Construction on GPUs", Computer Graphics Forum 28(2),
//! 2009. No areas are looked at. The walk: up to four children at once, found when the tree is
//! made (Wald, Benthin and Boulos, "Getting Rid of Packets", 2008).

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
    /// For each interior node, the up to four nodes that stand in for its children.
    wide: Vec<Vec<usize>>,
}

impl Bvh {
    /// A tree from its parts.
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let wide = nodes.iter().map(|node| up_to_four(&nodes, node)).collect();
        Bvh {
            primitives,
            nodes,
            root,
            wide,
        }
    }

    /// Builds the tree along the Z-order curve.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let centers = around_centers(&primitives);
        let code = |primitive: &Primitive| morton_code(primitive.bbox().center(), &centers);
        primitives.sort_by_cached_key(code);
        let codes: Vec<u64> = primitives.iter().map(code).collect();

        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&primitives, &codes, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        let mut closest = None;
        self.visit(self.root, &mut ray.clone(), &mut closest);
        closest
    }

    /// Looks for a hit below the node at `place`, whose box the ray is known to meet.
    fn visit(&self, place: usize, ray: &mut Ray, closest: &mut Option<Trace>) {
        let node = &self.nodes[place];
        if node.is_leaf() {
            return self.ask(node, ray, closest);
        }
        let hit = self.wide[place]
            .iter()
            .filter_map(|&child| Some((self.nodes[child].bbox.hit(ray, ray.range)?.min, child)));
        let mut ahead: Vec<(f32, usize)> = hit.collect();
        ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (entry, child) in ahead {
            if entry <= ray.range.max {
                self.visit(child, ray, closest);
            }
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

/// Replaces the children of a node by theirs, the largest first, while there are fewer than four.
fn up_to_four(nodes: &[Node], node: &Node) -> Vec<usize> {
    if node.is_leaf() {
        return Vec::new();
    }
    let mut children = vec![node.l, node.r];
    while children.len() < 4 {
        let area = |place: &usize| nodes[*place].bbox.surface_area();
        let interior = (0..children.len()).filter(|&i| !nodes[children[i]].is_leaf());
        let largest = interior.max_by(|&a, &b| area(&children[a]).total_cmp(&area(&children[b])));
        let Some(i) = largest else { break };
        let opened = &nodes[children.swap_remove(i)];
        children.extend([opened.l, opened.r]);
    }
    children
}

/// Builds the node over some primitives, which stand from `start` on; returns its place.
fn build_node(
    primitives: &[Primitive],
    codes: &[u64],
    start: usize,
    max_leaf_size: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let bbox = around(primitives);
    let place = nodes.len();
    nodes.push(Node::leaf(bbox, start, primitives.len()));
    if primitives.len() > max_leaf_size {
        let middle = split(codes);
        let l = build_node(
            &primitives[..middle],
            &codes[..middle],
            start,
            max_leaf_size,
            nodes,
        );
        let (primitives, codes) = (&primitives[middle..], &codes[middle..]);
        let r = build_node(primitives, codes, start + middle, max_leaf_size, nodes);
        nodes[place] = Node::interior(bbox, l, r);
    }
    place
}

/// How many of the codes, which are in order, have a zero where they first differ.
fn split(codes: &[u64]) -> usize {
    let differ = codes[0] ^ codes[codes.len() - 1];
    match differ.checked_ilog2() {
        Some(bit) => codes.partition_point(|code| code >> bit & 1 == 0),
        None => codes.len() / 2, // All are in the same cell.
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
