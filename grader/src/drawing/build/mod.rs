//! A tree that was built: what is wrong with it, and its upper levels above those of the best
//! split at every node, which the exam tells.

mod flaw;
mod geometry;
mod levels;
mod node_positions;

use protocol::{Answer, ElementOutcome, Shape, Tree};

use super::Drawing;
use super::ink::{Fill, Ink};
use super::numbers::short;
use super::sheet::{Sheet, Symbol};
use crate::drawing_data::{DrawingData, LevelNode, Sweep};
use crate::exam::TreeCheck;
use crate::judge::tree;
use crate::judge::tree::reached_nodes::reached_nodes;

use flaw::Flaw;
use node_positions::NodePosition;

/// What was asked, and what is judged of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct BuildCase<'a> {
    /// The primitives.
    pub(super) shapes: &'a [Shape],
    /// The most of them in a leaf.
    pub(super) max_leaf_size: u32,
    /// What must hold.
    pub(super) judged: &'a [TreeCheck],
    /// The cost of the sweep's tree, where that of the submission's is judged.
    pub(super) sweep_cost: Option<f64>,
    /// The sweep's tree, if it is told.
    pub(super) shown: &'a DrawingData,
}

const TITLE: &str = "The tree by levels, each node as wide as its share of the primitives";

/// The drawing.
pub(super) fn draw(task: &BuildCase, answer: Option<&Answer>) -> Option<Drawing> {
    let tree = tree_answer(answer)?;
    let sweep = match task.shown {
        DrawingData::Sweep(sweep) => Some(sweep),
        DrawingData::None | DrawingData::Slabs(_) | DrawingData::Traversals(_) => None,
    };
    let reached = match reached_nodes(task.shapes, tree) {
        Ok(nodes) => nodes,
        Err(mistake) => {
            let mut sheet = Sheet::default();
            draw_sweep(&mut sheet, sweep?);
            let caption = format!("Your nodes are no tree: {}.", mistake.got);
            return Some(sheet.finish(TITLE, caption));
        }
    };
    let placed = node_positions::positions(&reached);
    let root = placed.first()?;
    let flaw = flaw::find(task, &placed);

    let mut sheet = Sheet::default();
    geometry::draw(&mut sheet, task, sweep, &placed, &flaw);
    sheet.title("your tree");
    let mark = flaw
        .node()
        .map(|node| (node.level, node.start, node.cell.count as u32));
    let own = node_positions::upper_levels(&placed);
    let total = tree::cost(&reached);
    let sign = levels::draw(&mut sheet, &own, root.cell.count as u32, total, mark);
    if let Some(sweep) = sweep {
        draw_sweep(&mut sheet, sweep);
    }
    draw_legend(&mut sheet, task, &flaw, sign, total);
    Some(sheet.finish(TITLE, flaw.caption(task)))
}

fn tree_answer(answer: Option<&Answer>) -> Option<&Tree> {
    match answer? {
        Answer::Tree(ElementOutcome::Value(tree)) => Some(tree),
        Answer::Tree(ElementOutcome::Panicked(_) | ElementOutcome::Skipped)
        | Answer::Rays(_)
        | Answer::Hits(_)
        | Answer::Spans(_)
        | Answer::Picture(_)
        | Answer::Done => None,
    }
}

fn draw_sweep(sheet: &mut Sheet, sweep: &Sweep) {
    let count = |node: &LevelNode| (node.level == 0).then_some(node.count);
    let Some(all) = sweep.nodes.iter().find_map(count) else {
        return;
    };
    sheet.title("with the best split at every node");
    // What lies deeper is not told.
    let total = f64::NAN;
    levels::draw(sheet, &sweep.nodes, all, total, None);
}

fn draw_legend(sheet: &mut Sheet, task: &BuildCase, flaw: &Flaw, sign: Symbol, cost: f64) {
    let interior = Fill::Tint(Ink::Text, 0.5);
    sheet.add_legend(
        Symbol::Area(interior),
        "a split node; the stronger, the larger its box",
    );
    sheet.add_legend(
        Symbol::Area(Fill::None),
        "half as high: a leaf; numbers: primitives",
    );
    if flaw.node().is_some() {
        sheet.add_legend(sign, flaw.label());
    }
    match task.sweep_cost {
        Some(sweep) => {
            let words = format!(
                "SAH cost: {}; with the best splits {}",
                short(cost),
                short(sweep)
            );
            sheet.add_legend(Symbol::None, &words);
        }
        None => sheet.add_legend(Symbol::None, "right: what each level adds to the SAH cost"),
    }
}

/// A node that is marked: its level, and the primitives to the left of it and below it.
type MarkedNode = Option<(u32, u32, u32)>;

/// The places of the primitives below a node.
fn primitives_below(placed: &[NodePosition], node: &NodePosition) -> Vec<usize> {
    let inside = |other: &&NodePosition| {
        let range = node.start..node.start.saturating_add(node.cell.count as u32);
        other.level >= node.level && range.contains(&other.start)
    };
    let leaves = placed.iter().filter(inside);
    let leaves = leaves.filter_map(|leaf| leaf.cell.leaf_primitives.as_deref());
    leaves.flatten().copied().collect()
}
