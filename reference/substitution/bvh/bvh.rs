//! The submission's `Bvh` with a different builder, so that `Bvh::hit` is graded with correct
//! trees. The submission's `Bvh::build` is graded in a different task.

use std::ops::Deref;

use parts::bbox::BBox;
use parts::primitive::Primitive;

pub use submission::bvh::Node;

/// The submission's `Bvh` with a tree built by splitting at the median.
pub struct Bvh(submission::bvh::Bvh);

impl Bvh {
    pub fn build(mut primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut nodes = Vec::new();
        if !primitives.is_empty() {
            split_at_median(&mut primitives, 0, max_leaf_size, &mut nodes);
        }
        Bvh::from_nodes(primitives, nodes, 0)
    }

    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        Bvh(submission::bvh::Bvh::from_nodes(primitives, nodes, root))
    }
}

impl Deref for Bvh {
    type Target = submission::bvh::Bvh;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

/// Builds the subtree over these primitives, the first of which is at index `start`. Returns the
/// index of the subtree's root.
fn split_at_median(
    primitives: &mut [Primitive],
    start: usize,
    max_leaf_size: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let mut bbox = BBox::EMPTY;
    for primitive in &*primitives {
        bbox.enclose(primitive.bbox());
    }
    let index = nodes.len();
    nodes.push(Node::leaf(bbox, start, primitives.len()));
    if primitives.len() > max_leaf_size.max(1) {
        let axis = (bbox.max - bbox.min).max_position();
        let center = |primitive: &Primitive| primitive.bbox().center()[axis];
        primitives.sort_by(|a, b| center(a).total_cmp(&center(b)));
        let middle = primitives.len() / 2;
        let (first, second) = primitives.split_at_mut(middle);
        let l = split_at_median(first, start, max_leaf_size, nodes);
        let r = split_at_median(second, start + middle, max_leaf_size, nodes);
        nodes[index] = Node::interior(bbox, l, r);
    }
    index
}
