//! The surface area heuristic along one axis only, x, y and z in turn from level to level; if all
//! centers coincide along it, along the next. The walk: a sorted list of the children that are
//! hit; the ray itself never changes.

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

    /// Builds the tree by the surface area heuristic, one axis at a time.
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            build_node(&mut primitives, 0, 0, max_leaf_size.max(1), &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        self.nearest(root, ray, None)
    }

    /// The nearer of `closest` and the closest hit below `node`.
    fn nearest(&self, node: &Node, ray: &Ray, mut closest: Option<Trace>) -> Option<Trace> {
        if node.is_leaf() {
            let primitives = &self.primitives[node.start..node.start + node.size];
            let traces = primitives.iter().map(|primitive| primitive.hit(ray));
            return traces.fold(closest, Trace::nearer);
        }

        let children = [node.l, node.r].map(|place| &self.nodes[place]);
        let hit = children
            .into_iter()
            .filter_map(|child| Some((child.bbox.hit(ray, ray.range)?.min, child)));
        let mut ahead: Vec<(f32, &Node)> = hit.collect();
        ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (entry, child) in ahead {
            if closest.is_none_or(|closest| entry < closest.distance) {
                closest = self.nearest(child, ray, closest);
            }
        }
        closest
    }
}

/// Builds the node over some primitives, which stand from `start` on; returns its place.
fn build_node(
    primitives: &mut [Primitive],
    start: usize,
    level: usize,
    max_leaf_size: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let bbox = around(primitives);
    let place = nodes.len();
    nodes.push(Node::leaf(bbox, start, primitives.len()));
    if primitives.len() > max_leaf_size {
        let axes = [level, level + 1, level + 2].map(|axis| axis % 3);
        let middle = axes.into_iter().find_map(|axis| split(primitives, axis));
        let middle = middle.unwrap_or(primitives.len() / 2);
        let (left, right) = primitives.split_at_mut(middle);
        let l = build_node(left, start, level + 1, max_leaf_size, nodes);
        let r = build_node(right, start + middle, level + 1, max_leaf_size, nodes);
        nodes[place] = Node::interior(bbox, l, r);
    }
    place
}

/// Brings the primitives of the cheapest partition's one side to the front; returns their number.
/// None if all centers coincide along the axis.
fn split(primitives: &mut [Primitive], axis: usize) -> Option<usize> {
    let center = |primitive: &Primitive| primitive.bbox().center()[axis];
    primitives.sort_by(|a, b| center(a).total_cmp(&center(b)));
    let min = center(primitives.first()?);
    let size = center(primitives.last()?) - min;
    let planes = (1..BUCKETS).map(|i| min + size * i as f32 / BUCKETS as f32);
    let middles = planes.map(|plane| primitives.partition_point(|p| center(p) < plane));
    middles
        .filter(|&middle| 0 < middle && middle < primitives.len())
        .map(|middle| {
            (
                cost(&primitives[..middle]) + cost(&primitives[middle..]),
                middle,
            )
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, middle)| middle)
}

/// Slices along the axis.
const BUCKETS: usize = 16;

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
