//! Traverses a tree from its root, collects the primitives below each node, and checks that the
//! nodes form a tree.

use std::collections::BTreeMap;

use protocol::{Shape, Tree, TreeNode};

use super::LEAVES;
use super::bounds::Bounds;
use crate::describe;

/// Maximum number of leaves that may list a primitive, on average. If there are more, the tree is
/// rejected.
const MAX_LISTINGS_PER_PRIMITIVE: usize = 64;

/// A defect of a tree, as text for the report.
///
/// `what` is also part of the signatures of known mistakes in exam files, and `got` for some defects,
/// so changing their texts makes existing exams recognise fewer mistakes.
pub struct TreeDefect {
    /// The name of the part or property of the tree that is wrong.
    pub what: &'static str,
    /// The value in the submission's tree.
    pub got: String,
    /// The expected value.
    pub wanted: String,
}

/// A node that can be reached from the root.
pub struct ReachedNode<'a> {
    /// Index of the node in the tree's nodes.
    pub index: u32,
    /// The node in the answer.
    pub node: &'a TreeNode,
    /// For a leaf, its primitives in the submission's order, as indices of the question's shapes.
    pub leaf_primitives: Option<Vec<usize>>,
    /// Number of primitives below the node.
    pub count: usize,
    /// Tightest box around these primitives.
    pub tight_bounds: Bounds,
}

/// Returns all nodes that can be reached from the root, parents before children.
pub fn reached_nodes<'a>(
    shapes: &[Shape],
    tree: &'a Tree,
) -> Result<Vec<ReachedNode<'a>>, TreeDefect> {
    if tree.nodes.is_empty() {
        if shapes.is_empty() {
            return Ok(Vec::new());
        }
        return Err(TreeDefect {
            what: "nodes",
            got: "no node at all".to_owned(),
            wanted: format!("a tree over {} primitives", shapes.len()),
        });
    }
    // Each primitive has its own material, by which it is identified. Unknown materials have no
    // index.
    let index_of: BTreeMap<u32, usize> = shapes.iter().map(Shape::material).zip(0..).collect();
    let order: Vec<Option<usize>> = tree
        .order
        .iter()
        .map(|material| index_of.get(material).copied())
        .collect();

    // If many leaves each list all primitives, storing the lists would need too much memory.
    let most = MAX_LISTINGS_PER_PRIMITIVE * shapes.len().max(64);
    let mut listed = 0;
    let mut reached = vec![false; tree.nodes.len()];
    let mut nodes = Vec::new();
    let mut children = Vec::new();
    let mut open = vec![(tree.root, "root")];
    while let Some((index, what)) = open.pop() {
        let node = tree.nodes.get(index as usize).ok_or_else(|| TreeDefect {
            what,
            got: format!("node {index} of {}", tree.nodes.len()),
            wanted: "the index of a node".to_owned(),
        })?;
        if std::mem::replace(&mut reached[index as usize], true) {
            return Err(TreeDefect {
                what: "nodes",
                got: format!("node {index} is reached twice"),
                wanted: "a tree, with one path to each node".to_owned(),
            });
        }
        let leaf = node
            .is_leaf()
            .then(|| leaf_primitives(node, index, &order))
            .transpose()?;
        listed += leaf.as_ref().map_or(0, Vec::len);
        if listed > most {
            return Err(TreeDefect {
                what: LEAVES,
                got: format!("leaves that hold more than {most} primitives in all"),
                wanted: format!("each of the {} primitives in one leaf", shapes.len()),
            });
        }
        if leaf.is_none() {
            children.push((nodes.len(), [node.l, node.r]));
            open.extend([(node.l, "child l"), (node.r, "child r")]);
        }
        let mut bounds = Bounds::EMPTY;
        for &primitive in leaf.iter().flatten() {
            bounds.enclose(Bounds::of_shape(&shapes[primitive]));
        }
        nodes.push(ReachedNode {
            index,
            node,
            count: leaf.as_ref().map_or(0, Vec::len),
            leaf_primitives: leaf,
            tight_bounds: bounds,
        });
    }

    // Children come after their parents, so in reverse order each child is complete before its
    // parent.
    let mut by_index = vec![usize::MAX; tree.nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        by_index[node.index as usize] = index;
    }
    for (parent, pair) in children.into_iter().rev() {
        for child in pair.map(|index| by_index[index as usize]) {
            let (count, bounds) = (nodes[child].count, nodes[child].tight_bounds);
            nodes[parent].count += count;
            nodes[parent].tight_bounds.enclose(bounds);
        }
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
    listed.ok_or_else(|| TreeDefect {
        what: LEAVES,
        got: format!(
            "leaf {index} holds primitives {start} to {} of {}",
            start as u64 + u64::from(node.size),
            order.len()
        ),
        wanted: "a range of the tree's own primitives".to_owned(),
    })
}

impl ReachedNode<'_> {
    /// Returns a defect of the node's box, called `what`, with the actual and the tightest box.
    pub fn box_defect(&self, what: &'static str) -> TreeDefect {
        let corners = |min, max| format!("{} to {}", describe::point(min), describe::point(max));
        TreeDefect {
            what,
            got: format!(
                "node {}: {}",
                self.index,
                corners(self.node.min, self.node.max)
            ),
            wanted: corners(
                self.tight_bounds.min.as_vec3(),
                self.tight_bounds.max.as_vec3(),
            ),
        }
    }
}
