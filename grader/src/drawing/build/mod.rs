//! A tree that was built: what is wrong with it, and its upper levels above those of the best
//! split at every node, which the exam tells.

mod flaw;
mod levels;
mod placed;
mod solids;

use protocol::{Answer, Outcome, Shape, Tree};

use super::Drawing;
use super::ink::{Fill, Ink};
use super::sheet::{Sheet, Sign};
use super::words::short;
use crate::exam::TreePart;
use crate::judge::tree;
use crate::judge::tree::cells::cells;
use crate::shown::{LevelNode, Shown, Sweep};

use flaw::Flaw;
use placed::Placed;

/// What was asked, and what is judged of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Task<'a> {
    /// The primitives.
    pub(super) shapes: &'a [Shape],
    /// The most of them in a leaf.
    pub(super) max_leaf_size: u32,
    /// What must hold.
    pub(super) judged: &'a [TreePart],
    /// The cost of the sweep's tree, where that of the submission's is judged.
    pub(super) sweep_cost: Option<f64>,
    /// The sweep's tree, if it is told.
    pub(super) shown: &'a Shown,
}

const TITLE: &str = "The tree by levels, each node as wide as its share of the primitives";

/// The drawing.
pub(super) fn draw(task: &Task, answer: Option<&Answer>) -> Option<Drawing> {
    let tree = tree(answer)?;
    let sweep = match task.shown {
        Shown::Sweep(sweep) => Some(sweep),
        Shown::Nothing | Shown::Slabs(_) | Shown::Walks(_) => None,
    };
    let cells = match cells(task.shapes, tree) {
        Ok(cells) => cells,
        Err(mistake) => {
            let mut sheet = Sheet::default();
            draw_sweep(&mut sheet, sweep?);
            let caption = format!("Your nodes are no tree: {}.", mistake.got);
            return Some(sheet.finish(TITLE, caption));
        }
    };
    let placed = placed::all(&cells);
    let root = placed.first()?;
    let flaw = flaw::find(task, &placed);

    let mut sheet = Sheet::default();
    solids::draw(&mut sheet, task, sweep, &placed, &flaw);
    sheet.title("your tree");
    let mark = flaw
        .node()
        .map(|node| (node.level, node.start, node.cell.count as u32));
    let own = placed::upper(&placed);
    let total = tree::cost(&cells);
    let sign = levels::draw(&mut sheet, &own, root.cell.count as u32, total, mark);
    if let Some(sweep) = sweep {
        draw_sweep(&mut sheet, sweep);
    }
    explain(&mut sheet, task, &flaw, sign, total);
    Some(sheet.finish(TITLE, flaw.sentence(task)))
}

fn tree(answer: Option<&Answer>) -> Option<&Tree> {
    match answer? {
        Answer::Tree(Outcome::Value(tree)) => Some(tree),
        Answer::Tree(Outcome::Panicked(_) | Outcome::GivenUp)
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

fn explain(sheet: &mut Sheet, task: &Task, flaw: &Flaw, sign: Sign, cost: f64) {
    let interior = Fill::Of(Ink::Text, 0.5);
    sheet.explain(
        Sign::Area(interior),
        "a split node; the stronger, the larger its box",
    );
    sheet.explain(
        Sign::Area(Fill::None),
        "half as high: a leaf; numbers: primitives",
    );
    if flaw.node().is_some() {
        sheet.explain(sign, flaw.label());
    }
    match task.sweep_cost {
        Some(sweep) => {
            let words = format!(
                "SAH cost: {}; with the best splits {}",
                short(cost),
                short(sweep)
            );
            sheet.explain(Sign::None, &words);
        }
        None => sheet.explain(Sign::None, "right: what each level adds to the SAH cost"),
    }
}

/// A node that is marked: its level, and the primitives to the left of it and below it.
type Marked = Option<(u32, u32, u32)>;

/// The places of the primitives below a node.
fn below(placed: &[Placed], node: &Placed) -> Vec<usize> {
    let inside = |other: &&Placed| {
        let range = node.start..node.start.saturating_add(node.cell.count as u32);
        other.level >= node.level && range.contains(&other.start)
    };
    let leaves = placed.iter().filter(inside);
    let leaves = leaves.filter_map(|leaf| leaf.cell.leaf.as_deref());
    leaves.flatten().copied().collect()
}
