//! The tree's cost, and the defects found by the judge's checks.

use glam::Vec3;
use judging::exam::TreeCheck;
use judging::judge::tree::TreeCriteria;
use judging::judge::tree::bounds::Bounds;
use judging::judge::tree::defect::{NodeBox, TreeDefect};
use judging::judge::tree::reached_nodes::ReachedNode;
use serde::Serialize;

/// The checks for a tree built by a submission, most important first.
pub const CHECKS: [TreeCheck; 5] = [
    TreeCheck::Partition,
    TreeCheck::Contains,
    TreeCheck::Tight,
    TreeCheck::LeafSize,
    TreeCheck::Stops,
];
/// The maximum number of defects of one kind to list. More defects would be indistinguishable in
/// the picture.
const MAX_LISTED: usize = 20;
/// The maximum number of leaves to list for a primitive.
const MAX_LEAVES: usize = 10;

/// The defects of a tree and its cost.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TreeCheckup {
    /// The SAH cost, unless primitives are missing or repeated.
    pub cost: Option<f64>,
    /// The cost divided by the cost of the tree with the best split at every node, if that cost is
    /// known.
    pub ratio: Option<f64>,
    /// The kinds of defects, most important first.
    pub kinds: Vec<DefectKind>,
}

/// All defects of the same kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DefectKind {
    /// The title of the kind.
    pub title: &'static str,
    /// The number of defects.
    pub count: usize,
    /// The first defects.
    pub defects: Vec<ListedDefect>,
}

/// A defect.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ListedDefect {
    /// The node.
    pub node: Option<u32>,
    /// A description of the defect.
    pub text: String,
    /// The corners of the node's or the primitive's box, unless the box is empty or infinite.
    pub corners: Option<[Vec3; 2]>,
    /// The corners that the node's box should have, if it is wrong.
    pub tight: Option<[Vec3; 2]>,
}

impl TreeCheckup {
    /// Checks a tree, given its nodes or the reason they don't form a tree.
    pub(super) fn new(
        reached: Result<Vec<ReachedNode>, TreeDefect>,
        criteria: &TreeCriteria,
    ) -> Self {
        let mut checkup = TreeCheckup::default();
        let nodes = match reached {
            Ok(nodes) => nodes,
            Err(defect) => {
                let text = format!("{}: {}", defect.what(), text(&defect));
                checkup.add(title(&defect), || ListedDefect {
                    node: defect.node(),
                    text,
                    ..ListedDefect::default()
                });
                return checkup;
            }
        };
        for check in criteria.checks {
            for defect in criteria.check_defects(*check, &nodes) {
                checkup.add(title(&defect), || listed(&defect, &nodes, criteria));
            }
        }
        let is_empty = |node: &&ReachedNode| {
            nodes.len() > 1 && node.leaf_primitives.as_ref().is_some_and(Vec::is_empty)
        };
        for leaf in nodes.iter().filter(is_empty) {
            checkup.add("Leaves without primitives", || ListedDefect {
                node: Some(leaf.index),
                text: format!("leaf {}", leaf.index),
                corners: corners(Bounds::of_node(leaf.node)),
                tight: None,
            });
        }
        if !nodes.is_empty() {
            checkup.cost = criteria.cost(&nodes).ok();
            let costs = checkup.cost.zip(criteria.sweep_cost);
            checkup.ratio = costs.map(|(own, best)| own / best);
        }
        checkup
    }

    /// Counts a defect and lists it unless enough defects of its kind have already been listed.
    fn add(&mut self, title: &'static str, defect: impl FnOnce() -> ListedDefect) {
        let known = self.kinds.iter().position(|kind| kind.title == title);
        let known = known.unwrap_or_else(|| {
            self.kinds.push(DefectKind {
                title,
                count: 0,
                defects: Vec::new(),
            });
            self.kinds.len() - 1
        });
        let kind = &mut self.kinds[known];
        kind.count += 1;
        if kind.count <= MAX_LISTED {
            kind.defects.push(defect());
        }
    }
}

/// Returns the title for all defects of this kind. On the page, the title is followed by the number
/// of defects.
fn title(defect: &TreeDefect) -> &'static str {
    match defect {
        TreeDefect::Partition { leaves: 0, .. } => {
            "Primitives that no ray can hit because they are not in any leaf"
        }
        TreeDefect::Partition { .. } => "Primitives that are in several leaves",
        TreeDefect::BoxTooSmall(_) => {
            "Boxes that cause missed hits because they do not contain everything below their nodes"
        }
        TreeDefect::BoxTooLarge(_) => "Boxes that are larger than necessary",
        TreeDefect::LeafTooLarge { .. } | TreeDefect::NotSplit { .. } => {
            "Leaves with too many primitives"
        }
        TreeDefect::NeedlessSplit { .. } => {
            "Nodes that are split even though their primitives fit in one leaf"
        }
        TreeDefect::Cost { .. } => "Costs that are too high",
        TreeDefect::NoNodes { .. }
        | TreeDefect::UnknownNode { .. }
        | TreeDefect::ReachedTwice { .. }
        | TreeDefect::TooManyListed { .. }
        | TreeDefect::UnknownPrimitives { .. } => {
            "The links do not form a tree, so nothing else was checked"
        }
    }
}

fn text(defect: &TreeDefect) -> String {
    format!("{}; expected {}", defect.got(), defect.wanted())
}

fn listed(defect: &TreeDefect, nodes: &[ReachedNode], criteria: &TreeCriteria) -> ListedDefect {
    if let TreeDefect::Partition { primitive, .. } = defect {
        let has_it = |node: &&ReachedNode| {
            let primitives = node.leaf_primitives.as_ref();
            primitives.is_some_and(|primitives| primitives.contains(primitive))
        };
        let leaves = nodes.iter().filter(has_it).take(MAX_LEAVES);
        let leaves: Vec<String> = leaves.map(|leaf| leaf.index.to_string()).collect();
        let shape = &criteria.shapes[*primitive];
        let list = match &leaves[..] {
            [] => String::new(),
            // One leaf can list a primitive twice.
            [leaf] => format!(", twice in leaf {leaf}"),
            leaves => format!(", in leaves {}", leaves.join(", ")),
        };
        return ListedDefect {
            text: format!("primitive {}{list}", shape.number()),
            corners: corners(Bounds::of_shape(shape)),
            ..ListedDefect::default()
        };
    }
    let node = nodes.iter().find(|node| Some(node.index) == defect.node());
    let tight = if let TreeDefect::BoxTooSmall(NodeBox { tight, .. })
    | TreeDefect::BoxTooLarge(NodeBox { tight, .. }) = defect
    {
        corners(*tight)
    } else {
        None
    };
    ListedDefect {
        node: defect.node(),
        text: text(defect),
        corners: node.and_then(|node| corners(Bounds::of_node(node.node))),
        tight,
    }
}

/// Returns the corners of a box, unless it is empty or infinite.
fn corners(bounds: Bounds) -> Option<[Vec3; 2]> {
    let corners = [bounds.min, bounds.max].map(|corner| corner.as_vec3());
    let is_finite = corners.iter().all(|corner| corner.is_finite());
    (is_finite && bounds.min.cmple(bounds.max).all()).then_some(corners)
}
