//! A tree, walked from its root: what each node holds, and whether it is a tree at all.

use std::collections::BTreeMap;

use protocol::{Shape, Tree, TreeNode};

use super::bounds::Bounds;
use crate::describe;

/// A tree whose leaves name every primitive so often, on average, is looked at no further.
const MAX_LISTINGS_PER_PRIMITIVE: usize = 64;

/// What is wrong with a tree, in the words of a report.
pub struct TreeDefect {
    /// What of it.
    pub what: &'static str,
    /// As it came.
    pub got: String,
    /// As it should have come.
    pub wanted: String,
}

/// A node that is reached from the root.
pub struct ReachedNode<'a> {
    /// Where it stands among the tree's nodes.
    pub index: u32,
    /// As it came.
    pub node: &'a TreeNode,
    /// The places of the primitives below, as the submission ordered them; only of a leaf.
    pub leaf_primitives: Option<Vec<usize>>,
    /// How many primitives are below.
    pub count: usize,
    /// The tightest box around them.
    pub tight_bounds: Bounds,
}

/// All nodes that are reached from the root, parents before children.
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
    // A primitive is known by its material. One that nobody gave us is in no place.
    let places: BTreeMap<u32, usize> = shapes.iter().map(Shape::material).zip(0..).collect();
    let order: Vec<Option<usize>> = tree
        .order
        .iter()
        .map(|material| places.get(material).copied())
        .collect();

    // Each of many leaves may name them all: that would be more than there is memory for.
    let most = MAX_LISTINGS_PER_PRIMITIVE * shapes.len().max(64);
    let mut named = 0;
    let mut reached = vec![false; tree.nodes.len()];
    let mut cells = Vec::new();
    let mut children = Vec::new();
    let mut open = vec![(tree.root, "root")];
    while let Some((place, whose)) = open.pop() {
        let node = tree.nodes.get(place as usize).ok_or_else(|| TreeDefect {
            what: whose,
            got: format!("node {place} of {}", tree.nodes.len()),
            wanted: "the place of a node".to_owned(),
        })?;
        if std::mem::replace(&mut reached[place as usize], true) {
            return Err(TreeDefect {
                what: "nodes",
                got: format!("node {place} is reached twice"),
                wanted: "a tree: one way to each node".to_owned(),
            });
        }
        let leaf = node
            .is_leaf()
            .then(|| leaf_primitives(node, place, &order))
            .transpose()?;
        named += leaf.as_ref().map_or(0, Vec::len);
        if named > most {
            return Err(TreeDefect {
                what: "leaves",
                got: format!("leaves that hold more than {most} primitives in all"),
                wanted: format!("each of the {} primitives in one leaf", shapes.len()),
            });
        }
        if leaf.is_none() {
            children.push((cells.len(), [node.l, node.r]));
            open.extend([(node.l, "child l"), (node.r, "child r")]);
        }
        let mut needs = Bounds::EMPTY;
        for &primitive in leaf.iter().flatten() {
            needs.enclose(Bounds::of_shape(&shapes[primitive]));
        }
        cells.push(ReachedNode {
            index: place,
            node,
            count: leaf.as_ref().map_or(0, Vec::len),
            leaf_primitives: leaf,
            tight_bounds: needs,
        });
    }

    // Children come after their parents: from the last to the first, each is complete.
    let mut by_place = vec![usize::MAX; tree.nodes.len()];
    for (index, cell) in cells.iter().enumerate() {
        by_place[cell.index as usize] = index;
    }
    for (parent, pair) in children.into_iter().rev() {
        for child in pair.map(|place| by_place[place as usize]) {
            let (count, needs) = (cells[child].count, cells[child].tight_bounds);
            cells[parent].count += count;
            cells[parent].tight_bounds.enclose(needs);
        }
    }
    Ok(cells)
}

fn leaf_primitives(
    node: &TreeNode,
    place: u32,
    order: &[Option<usize>],
) -> Result<Vec<usize>, TreeDefect> {
    let start = node.start as usize;
    let listed = order.get(start..start.saturating_add(node.size as usize));
    let listed = listed.and_then(|listed| listed.iter().copied().collect::<Option<Vec<_>>>());
    listed.ok_or_else(|| TreeDefect {
        what: "leaves",
        got: format!(
            "leaf {place} holds primitives {start} to {} of {}",
            start as u64 + u64::from(node.size),
            order.len()
        ),
        wanted: "a range of the tree's own primitives".to_owned(),
    })
}

impl ReachedNode<'_> {
    /// What is wrong with its box, called `what`: the one that came, and the one that it needs.
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
