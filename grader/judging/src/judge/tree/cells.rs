//! A tree, walked from its root: what each node holds, and whether it is a tree at all.

use std::collections::BTreeMap;

use protocol::{Shape, Tree, TreeNode};

use super::bounds::Bounds;
use crate::describe;

/// A tree whose leaves name every primitive so often, on average, is looked at no further.
const MOST_NAMED_AGAIN: usize = 64;

/// What is wrong with a tree, in the words of a report.
pub struct Mistake {
    /// What of it.
    pub what: &'static str,
    /// As it came.
    pub got: String,
    /// As it should have come.
    pub wanted: String,
}

/// A node that is reached from the root.
pub struct Cell<'a> {
    /// Where it stands among the tree's nodes.
    pub place: u32,
    /// As it came.
    pub node: &'a TreeNode,
    /// The places of the primitives below, as the submission ordered them; only of a leaf.
    pub leaf: Option<Vec<usize>>,
    /// How many primitives are below.
    pub count: usize,
    /// The tightest box around them.
    pub needs: Bounds,
}

/// All nodes that are reached from the root, parents before children.
pub fn cells<'a>(shapes: &[Shape], tree: &'a Tree) -> Result<Vec<Cell<'a>>, Mistake> {
    if tree.nodes.is_empty() {
        if shapes.is_empty() {
            return Ok(Vec::new());
        }
        return Err(Mistake {
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
    let most = MOST_NAMED_AGAIN * shapes.len().max(64);
    let mut named = 0;
    let mut reached = vec![false; tree.nodes.len()];
    let mut cells = Vec::new();
    let mut children = Vec::new();
    let mut open = vec![(tree.root, "root")];
    while let Some((place, whose)) = open.pop() {
        let node = tree.nodes.get(place as usize).ok_or_else(|| Mistake {
            what: whose,
            got: format!("node {place} of {}", tree.nodes.len()),
            wanted: "the place of a node".to_owned(),
        })?;
        if std::mem::replace(&mut reached[place as usize], true) {
            return Err(Mistake {
                what: "nodes",
                got: format!("node {place} is reached twice"),
                wanted: "a tree: one way to each node".to_owned(),
            });
        }
        let leaf = node
            .is_leaf()
            .then(|| leaf(node, place, &order))
            .transpose()?;
        named += leaf.as_ref().map_or(0, Vec::len);
        if named > most {
            return Err(Mistake {
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
            needs.enclose(Bounds::around(&shapes[primitive]));
        }
        cells.push(Cell {
            place,
            node,
            count: leaf.as_ref().map_or(0, Vec::len),
            leaf,
            needs,
        });
    }

    // Children come after their parents: from the last to the first, each is complete.
    let mut by_place = vec![usize::MAX; tree.nodes.len()];
    for (index, cell) in cells.iter().enumerate() {
        by_place[cell.place as usize] = index;
    }
    for (parent, pair) in children.into_iter().rev() {
        for child in pair.map(|place| by_place[place as usize]) {
            let (count, needs) = (cells[child].count, cells[child].needs);
            cells[parent].count += count;
            cells[parent].needs.enclose(needs);
        }
    }
    Ok(cells)
}

fn leaf(node: &TreeNode, place: u32, order: &[Option<usize>]) -> Result<Vec<usize>, Mistake> {
    let start = node.start as usize;
    let listed = order.get(start..start.saturating_add(node.size as usize));
    let listed = listed.and_then(|listed| listed.iter().copied().collect::<Option<Vec<_>>>());
    listed.ok_or_else(|| Mistake {
        what: "leaves",
        got: format!(
            "leaf {place} holds primitives {start} to {} of {}",
            start as u64 + u64::from(node.size),
            order.len()
        ),
        wanted: "a range of the tree's own primitives".to_owned(),
    })
}

impl Cell<'_> {
    /// What is wrong with its box, called `what`: the one that came, and the one that it needs.
    pub fn box_mistake(&self, what: &'static str) -> Mistake {
        let corners = |min, max| format!("{} to {}", describe::point(min), describe::point(max));
        Mistake {
            what,
            got: format!(
                "node {}: {}",
                self.place,
                corners(self.node.min, self.node.max)
            ),
            wanted: corners(self.needs.min.as_vec3(), self.needs.max.as_vec3()),
        }
    }
}
