//! Draws a tree built by the submission: its flaw and its upper levels. Below these, draws the
//! upper levels of the tree stored in the exam, which uses the best split at every node.

mod flaw;
mod geometry;
mod levels;

use protocol::Answer;

use super::Drawing;
use super::ink::{Fill, Ink};
use super::numbers::short;
use super::sheet::{Sheet, Symbol};

use flaw::Flaw;
use judging::drawing_data::{LevelNode, UpperLevels};
use judging::judge::tree::reached_nodes::{ReachedNode, reached_nodes};
use judging::judge::tree::{self, TreeCriteria};

const TITLE: &str =
    "The levels of the tree; the width of each node is proportional to its share of the primitives";

/// Draws the submitted tree, which is judged by `criteria`. `sweep` is the exact sweep's tree, if
/// the exam contains it.
pub(super) fn draw(
    criteria: &TreeCriteria,
    sweep: Option<&UpperLevels>,
    answer: Option<&Answer>,
) -> Option<Drawing> {
    let Answer::Tree(tree) = answer? else {
        return None;
    };
    let tree = tree.value()?;
    let nodes = match reached_nodes(criteria.shapes, tree) {
        Ok(nodes) => nodes,
        Err(defect) => {
            let mut sheet = Sheet::default();
            draw_sweep(&mut sheet, sweep?);
            let caption = format!("Your nodes do not form a tree: {}.", defect.got());
            return Some(sheet.finish(TITLE, caption));
        }
    };
    let root = nodes.first()?;
    let flaw = Flaw::new(criteria, criteria.defect(tree), &nodes);
    let total = tree::cost(&nodes);

    let mut sheet = Sheet::default();
    geometry::draw(&mut sheet, criteria, sweep, &nodes, &flaw);
    sheet.title("your tree");
    let upper = from_left(&nodes).filter(|node| node.level < UpperLevels::LEVELS);
    let own: Vec<LevelNode> = upper.map(|node| level_node(node, root)).collect();
    let mark = flaw.node.map(|node| level_node(node, root));
    let symbol = levels::draw(&mut sheet, &own, root.count as u32, total, mark);
    if let Some(sweep) = sweep {
        draw_sweep(&mut sheet, sweep);
    }
    draw_legend(&mut sheet, criteria, &flaw, symbol, total);
    Some(sheet.finish(TITLE, flaw.caption(criteria, total)))
}

fn draw_sweep(sheet: &mut Sheet, sweep: &UpperLevels) {
    let count = |node: &LevelNode| (node.level == 0).then_some(node.count);
    let Some(all) = sweep.nodes.iter().find_map(count) else {
        return;
    };
    sheet.title("the tree with the best split at every node");
    // The exam only stores the upper levels, so the total cost is unknown.
    let total = f64::NAN;
    levels::draw(sheet, &sweep.nodes, all, total, None);
}

fn draw_legend(sheet: &mut Sheet, criteria: &TreeCriteria, flaw: &Flaw, symbol: Symbol, cost: f64) {
    let [interior, leaf] = [Fill::Tint(Ink::Text, 0.5), Fill::None].map(Symbol::Area);
    sheet.add_legend(
        interior,
        "a split node; a stronger colour means a larger box",
    );
    sheet.add_legend(leaf, "a leaf (half height); numbers are primitive counts");
    if flaw.node.is_some() {
        sheet.add_legend(symbol, flaw.label());
    }
    match criteria.sweep_cost {
        Some(sweep) => {
            let [own, best] = [cost, sweep].map(short);
            let text = format!("SAH cost: {own}; with the best splits: {best}");
            sheet.add_legend(Symbol::None, &text);
        }
        None => sheet.add_legend(
            Symbol::None,
            "on the right: what each level adds to the SAH cost",
        ),
    }
}

/// Returns the nodes of each level from left to right.
fn from_left<'a>(nodes: &'a [ReachedNode]) -> impl Iterator<Item = &'a ReachedNode<'a>> {
    // In `nodes`, a right child and everything below it come before the left child.
    nodes.iter().rev()
}

/// Returns a node in the format used by the exam for the exact sweep's tree.
fn level_node(node: &ReachedNode, root: &ReachedNode) -> LevelNode {
    let cost = node.cost() / root.tight_bounds.area().max(f64::MIN_POSITIVE);
    LevelNode {
        level: node.level,
        start: node.start as u32,
        count: node.count as u32,
        is_leaf: node.leaf_primitives.is_some(),
        cost: cost as f32,
    }
}

/// Returns the indices of the primitives below a node.
fn primitives_below(nodes: &[ReachedNode], node: &ReachedNode) -> Vec<usize> {
    let range = node.start..node.start + node.count;
    let inside = |other: &&ReachedNode| other.level >= node.level && range.contains(&other.start);
    let leaves = from_left(nodes).filter(inside);
    let leaves = leaves.filter_map(|leaf| leaf.leaf_primitives.as_deref());
    leaves.flatten().copied().collect()
}
