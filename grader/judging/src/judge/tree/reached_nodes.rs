//! Traverses a tree from its root, collects the primitives below each node, and checks that the
//! nodes form a tree.

use std::collections::BTreeMap;

use protocol::{Shape, Tree, TreeNode};

use super::bounds::Bounds;
use super::defect::TreeDefect;

/// Maximum number of leaves that may list a primitive, on average. A tree that exceeds this number
/// is rejected.
const MAX_LISTINGS_PER_PRIMITIVE: usize = 64;

/// A node that can be reached from the root.
#[derive(Debug)]
pub struct ReachedNode<'a> {
    /// Index of the node in the tree's list of nodes.
    pub index: u32,
    /// The node in the answer.
    pub node: &'a TreeNode,
    /// For a leaf, its primitives in the submission's order, as indices into the question's shapes.
    pub leaf_primitives: Option<Vec<usize>>,
    /// Distance from the root, which is at level 0.
    pub level: u32,
    /// Number of primitives in the leaves to the left of this node.
    pub start: usize,
    /// Number of primitives below the node.
    pub count: usize,
    /// Tightest box around the primitives below the node.
    pub tight_bounds: Bounds,
}

impl ReachedNode<'_> {
    /// Returns the node's contribution to the tree's SAH cost, multiplied by the area of the root.
    pub fn cost(&self) -> f64 {
        let times = self.leaf_primitives.as_ref().map_or(1, Vec::len);
        self.tight_bounds.area() * times as f64
    }
}

/// Returns all nodes that can be reached from the root. Parents come before children, and the right
/// child's subtree before the left child's.
pub fn reached_nodes<'a>(
    shapes: &[Shape],
    tree: &'a Tree,
) -> Result<Vec<ReachedNode<'a>>, TreeDefect> {
    if tree.nodes.is_empty() {
        if shapes.is_empty() {
            return Ok(Vec::new());
        }
        let primitives = shapes.len();
        return Err(TreeDefect::NoNodes { primitives });
    }
    // Primitives are identified by their numbers. Unknown numbers have no index.
    let index_of: BTreeMap<u32, usize> = shapes.iter().map(Shape::number).zip(0..).collect();
    let order: Vec<Option<usize>> = tree
        .order
        .iter()
        .map(|shape| index_of.get(shape).copied())
        .collect();

    // If many leaves listed all primitives, the lists would take too much memory.
    let most = MAX_LISTINGS_PER_PRIMITIVE * shapes.len().max(64);
    let mut listed = 0;
    let mut reached = vec![false; tree.nodes.len()];
    let mut nodes = Vec::new();
    let mut children = Vec::new();
    let mut open = vec![(tree.root, "root", 0)];
    while let Some((index, field, level)) = open.pop() {
        let node = tree.nodes.get(index as usize);
        let node = node.ok_or(TreeDefect::UnknownNode {
            field,
            index,
            nodes: tree.nodes.len(),
        })?;
        if std::mem::replace(&mut reached[index as usize], true) {
            return Err(TreeDefect::ReachedTwice { index });
        }
        let leaf = node
            .is_leaf()
            .then(|| leaf_primitives(node, index, &order))
            .transpose()?;
        listed += leaf.as_ref().map_or(0, Vec::len);
        if listed > most {
            let primitives = shapes.len();
            return Err(TreeDefect::TooManyListed { most, primitives });
        }
        if leaf.is_none() {
            children.push((nodes.len(), [node.l, node.r]));
            open.push((node.l, "child l", level + 1));
            open.push((node.r, "child r", level + 1));
        }
        let mut bounds = Bounds::EMPTY;
        for &primitive in leaf.iter().flatten() {
            bounds.enclose(Bounds::of_shape(&shapes[primitive]));
        }
        nodes.push(ReachedNode {
            index,
            node,
            level,
            start: 0,
            count: leaf.as_ref().map_or(0, Vec::len),
            leaf_primitives: leaf,
            tight_bounds: bounds,
        });
    }

    // Children come after their parents, so iterating in reverse completes each child before its
    // parent.
    let mut by_index = vec![usize::MAX; tree.nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        by_index[node.index as usize] = index;
    }
    let place = |index: u32| by_index[index as usize];
    for &(parent, pair) in children.iter().rev() {
        for child in pair.map(place) {
            let (count, bounds) = (nodes[child].count, nodes[child].tight_bounds);
            nodes[parent].count += count;
            nodes[parent].tight_bounds.enclose(bounds);
        }
    }
    for (parent, pair) in children {
        let [left, right] = pair.map(place);
        nodes[left].start = nodes[parent].start;
        nodes[right].start = nodes[parent].start + nodes[left].count;
    }
    Ok(nodes)
}

fn leaf_primitives(
    node: &TreeNode,
    index: u32,
    order: &[Option<usize>],
) -> Result<Vec<usize>, TreeDefect> {
    let start = node.start as usize;
    let listed = order.get(start..start.saturating_add(node.size as usize));
    let listed = listed.and_then(|listed| listed.iter().copied().collect::<Option<Vec<_>>>());
    listed.ok_or(TreeDefect::UnknownPrimitives {
        leaf: index,
        start: node.start,
        size: node.size,
        listed: order.len(),
    })
}
