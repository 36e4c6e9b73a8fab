//! Rules that every correct traversal follows, checked without knowing the correct answer. The
//! checks use the submission's own `BBox::hit` and the exam's margin of 1% of a box's diagonal,
//! within which nothing is judged.

use std::collections::{BTreeMap, BTreeSet};

use crate::messages::{RecordedRay, Test};
use glam::Vec3;
use protocol::{Interval, TreeNode};
use serde::Serialize;

use crate::indexed_tree::IndexedTree;

/// The margin within which nothing is judged, as a fraction of a box's diagonal.
const MARGIN: f32 = 0.01;

/// The part of a ray inside a node's box, without and with the margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeSpan {
    /// The part of the ray's range inside the box, or `None` if the ray misses the box.
    pub inside: Option<Interval>,
    /// The part of the ray's range that lies inside the box after the box has been enlarged by the
    /// margin on each side.
    pub inside_larger: Option<Interval>,
}

/// The nodes that a test belongs to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// The nodes whose box was tested (several if their boxes are equal), or the leaf of the
    /// primitive that was tested.
    pub nodes: Vec<u32>,
    /// The node that was entered for the first time with this test: the parent of the node whose
    /// box was tested, or the leaf of the primitive that was tested.
    pub enters: Option<u32>,
    /// The nodes that may have been entered when this box was tested: all parents, if several nodes
    /// share the box.
    pub may_enter: Vec<u32>,
}

/// The number of rules.
pub const RULES: usize = 3;

/// A rule of traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Rule {
    /// A node isn't entered if the ray misses its box.
    MissedBox,
    /// A node isn't entered if its box begins beyond the closest hit so far.
    BeyondClosestHit,
    /// If the ray hits the boxes of both children, the one it enters first is visited first.
    FartherChildFirst,
}

/// The locations of a submission's nodes in memory, for telling nodes with equal boxes apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeAddresses {
    /// The address of the box of node 0.
    first: i128,
    /// The distance between the boxes of two nodes, in bytes.
    stride: i128,
}

impl NodeAddresses {
    /// Finds the addresses from the tests of nodes with unique boxes. Returns `None` if the
    /// addresses don't form a list of nodes because the traversal copies the nodes.
    pub fn find<'a>(tests: impl Iterator<Item = &'a Test>, tree: &IndexedTree) -> Option<Self> {
        let known = tests.filter_map(|test| match test {
            Test::Box {
                min, max, address, ..
            } => match tree.with_box(*min, *max) {
                [node] => Some((i128::from(*node), i128::from(*address))),
                _ => None,
            },
            Test::Primitive { .. } => None,
        });
        let known: Vec<(i128, i128)> = known.collect();
        let (node, address) = *known.first()?;
        let (other_node, other_address) = *known.iter().find(|(other, _)| *other != node)?;
        let stride = (other_address - address) / (other_node - node);
        let addresses = NodeAddresses {
            first: address - node * stride,
            stride,
        };
        let fits = |(node, address): &(i128, i128)| addresses.of(*node) == *address;
        (stride > 0 && known.iter().all(fits)).then_some(addresses)
    }

    fn of(self, node: i128) -> i128 {
        self.first + node * self.stride
    }

    /// Returns the node at this address.
    fn node_at(self, address: u64) -> Option<u32> {
        let offset = i128::from(address) - self.first;
        let node = u32::try_from(offset.div_euclid(self.stride)).ok()?;
        (self.of(node.into()) == i128::from(address)).then_some(node)
    }
}

/// Finds the nodes that the tests of a ray belong to.
pub fn rows(ray: &RecordedRay, tree: &IndexedTree, addresses: Option<NodeAddresses>) -> Vec<Row> {
    let mut entered = BTreeSet::new();
    let mut rows = Vec::new();
    for test in &ray.tests {
        let (nodes, inner) = match test {
            Test::Box {
                min, max, address, ..
            } => {
                let node = addresses.and_then(|addresses| addresses.node_at(*address));
                let nodes = match node.filter(|node| tree.has_box(*node, *min, *max)) {
                    Some(node) => vec![node],
                    None => tree.with_box(*min, *max).to_vec(),
                };
                let parents = nodes.iter().filter_map(|node| tree.parent(*node));
                let parents = parents.collect();
                (nodes, parents)
            }
            Test::Primitive { shape, .. } => {
                let leaf: Vec<u32> = tree.leaf_of(*shape).into_iter().collect();
                (leaf.clone(), leaf)
            }
        };
        let (enters, may_enter) = match inner[..] {
            [node] => (Some(node), Vec::new()),
            _ => (None, inner),
        };
        rows.push(Row {
            nodes,
            enters: enters.filter(|node| entered.insert(*node)),
            may_enter,
        });
    }
    rows
}

/// Counts, for each rule, the tests of a ray that break it. `span` returns the part of the ray's
/// range inside the box with these corners.
pub fn count_marks(
    ray: &RecordedRay,
    tree: &IndexedTree,
    mut span: impl FnMut((Vec3, Vec3)) -> Option<Interval>,
) -> [u32; RULES] {
    let rows = rows(ray, tree, NodeAddresses::find(ray.tests.iter(), tree));
    let nodes = judged_nodes(&rows, tree).into_iter();
    let spans = nodes.filter_map(|node| {
        let [inside, inside_larger] = corners_with_margin(node, tree)?.map(&mut span);
        let span = NodeSpan {
            inside,
            inside_larger,
        };
        Some((node, span))
    });
    let mut marks = [0; RULES];
    for (rule, _) in broken_rules(ray, &rows, tree, &spans.collect())
        .into_iter()
        .flatten()
    {
        marks[rule as usize] += 1;
    }
    marks
}

/// Returns the nodes whose spans are needed by [`broken_rules`] and the explanation: all entered
/// nodes, their siblings, and nodes whose boxes are tested.
pub fn judged_nodes(rows: &[Row], tree: &IndexedTree) -> BTreeSet<u32> {
    let entered = rows.iter().filter_map(|row| row.enters);
    let judged = entered.flat_map(|node| [Some(node), tree.sibling(node)]);
    let tested = rows.iter().map(|row| row.nodes.first().copied());
    judged.chain(tested).flatten().collect()
}

/// Returns the corners of a node's box and the corners of the same box enlarged by the margin.
pub fn corners_with_margin(node: u32, tree: &IndexedTree) -> Option<[(Vec3, Vec3); 2]> {
    let node = tree.node(node)?;
    let margin = MARGIN * diagonal(node);
    Some([(node.min, node.max), (node.min - margin, node.max + margin)])
}

/// Returns, for each test of a ray, the rule that the test breaks, if any, and the node that
/// shouldn't have been entered. `spans` contains the spans of the judged nodes.
pub fn broken_rules(
    ray: &RecordedRay,
    rows: &[Row],
    tree: &IndexedTree,
    spans: &BTreeMap<u32, NodeSpan>,
) -> Vec<Option<(Rule, u32)>> {
    let mut closest = f32::INFINITY;
    let mut visited = BTreeSet::new();
    let mut broken = Vec::new();
    for (row, test) in rows.iter().zip(&ray.tests) {
        // The root has no sibling, and its box doesn't need to be tested.
        let judged = row.enters.filter(|node| *node != tree.tree.root);
        let rule = judged.and_then(|node| broken_rule(node, closest, &visited, tree, spans));
        broken.push(rule.zip(judged));
        // A node is visited as soon as something below it is.
        for node in row.enters.iter().chain(&row.may_enter) {
            let mut above = Some(*node);
            while let Some(node) = above.filter(|node| visited.insert(*node)) {
                above = tree.parent(node);
            }
        }
        if let Test::Primitive {
            distance: Some(distance),
            ..
        } = test
            && ray.ray.range.contains(*distance)
        {
            closest = closest.min(*distance);
        }
    }
    broken
}

fn broken_rule(
    node: u32,
    closest: f32,
    visited: &BTreeSet<u32>,
    tree: &IndexedTree,
    spans: &BTreeMap<u32, NodeSpan>,
) -> Option<Rule> {
    let span = spans.get(&node)?;
    let Some(inside) = span.inside else {
        return span.inside_larger.is_none().then_some(Rule::MissedBox);
    };
    if inside.min > closest + MARGIN * diagonal(tree.node(node)?) {
        return Some(Rule::BeyondClosestHit);
    }
    let parent = tree.node(tree.parent(node)?)?;
    let other = tree.sibling(node)?;
    let of_other = spans.get(&other)?.inside?;
    // A visit to an empty leaf tests nothing, so it can't be observed.
    if tree.count(other) == 0 {
        return None;
    }
    let is_farther = inside.min > of_other.min + MARGIN * diagonal(parent);
    (is_farther && !visited.contains(&other)).then_some(Rule::FartherChildFirst)
}

fn diagonal(node: &TreeNode) -> f32 {
    node.min.distance(node.max)
}

#[cfg(test)]
mod tests;
