//! Draws a tree that the submission built: its flaw, its upper levels, and below these the upper
//! levels of the tree with the best split at every node, which the exam stores.

mod flaw;
mod geometry;
mod levels;
mod node_positions;

use protocol::{Answer, Tree};

use super::ink::{Fill, Ink};
use super::numbers::short;
use super::sheet::{Sheet, Symbol};
use super::{Drawing, value};

use flaw::Flaw;
use judging::drawing_data::{DrawingData, LevelNode, Sweep};
use judging::judge::tree::reached_nodes::reached_nodes;
use judging::judge::tree::{self, TreeCriteria};
use node_positions::NodePosition;

/// A question about building a tree, and the criteria by which the tree is judged.
#[derive(Clone, Copy, Debug)]
pub(super) struct BuildCase<'a> {
    /// The criteria, with the primitives that the tree is built over.
    pub(super) criteria: TreeCriteria<'a>,
    /// The exact sweep's tree, if the exam has it.
    pub(super) drawing_data: &'a DrawingData,
}

const TITLE: &str = "The tree by levels, each node as wide as its share of the primitives";

/// Draws the submitted tree.
pub(super) fn draw(case: &BuildCase, answer: Option<&Answer>) -> Option<Drawing> {
    let tree = tree_answer(answer)?;
    let sweep = match case.drawing_data {
        DrawingData::Sweep(sweep) => Some(sweep),
        DrawingData::None | DrawingData::Slabs(_) | DrawingData::Traversals(_) => None,
    };
    let reached = match reached_nodes(case.criteria.shapes, tree) {
        Ok(nodes) => nodes,
        Err(defect) => {
            let mut sheet = Sheet::default();
            draw_sweep(&mut sheet, sweep?);
            let caption = format!("Your nodes do not form a tree: {}.", defect.got());
            return Some(sheet.finish(TITLE, caption));
        }
    };
    let positions = node_positions::positions(&reached);
    let root = positions.first()?;
    let flaw = Flaw::new(case, case.criteria.defect(tree), &positions);
    let total = tree::cost(&reached);

    let mut sheet = Sheet::default();
    geometry::draw(&mut sheet, case, sweep, &positions, &flaw);
    sheet.title("your tree");
    let mark = flaw
        .node
        .map(|node| (node.level, node.start, node.reached.count as u32));
    let own = node_positions::upper_levels(&positions);
    let symbol = levels::draw(&mut sheet, &own, root.reached.count as u32, total, mark);
    if let Some(sweep) = sweep {
        draw_sweep(&mut sheet, sweep);
    }
    draw_legend(&mut sheet, case, &flaw, symbol, total);
    Some(sheet.finish(TITLE, flaw.caption(case, total)))
}

fn tree_answer(answer: Option<&Answer>) -> Option<&Tree> {
    let Answer::Tree(tree) = answer? else {
        return None;
    };
    value(std::slice::from_ref(tree), 0)
}

fn draw_sweep(sheet: &mut Sheet, sweep: &Sweep) {
    let count = |node: &LevelNode| (node.level == 0).then_some(node.count);
    let Some(all) = sweep.nodes.iter().find_map(count) else {
        return;
    };
    sheet.title("with the best split at every node");
    // The exam stores only the upper levels, so the total is unknown.
    let total = f64::NAN;
    levels::draw(sheet, &sweep.nodes, all, total, None);
}

fn draw_legend(sheet: &mut Sheet, case: &BuildCase, flaw: &Flaw, symbol: Symbol, cost: f64) {
    let interior = Fill::Tint(Ink::Text, 0.5);
    sheet.add_legend(
        Symbol::Area(interior),
        "a split node; stronger colour: larger box",
    );
    sheet.add_legend(
        Symbol::Area(Fill::None),
        "half height: a leaf; numbers: primitives",
    );
    if flaw.node.is_some() {
        sheet.add_legend(symbol, flaw.label());
    }
    match case.criteria.sweep_cost {
        Some(sweep) => {
            let text = format!(
                "SAH cost: {}; with the best splits: {}",
                short(cost),
                short(sweep)
            );
            sheet.add_legend(Symbol::None, &text);
        }
        None => sheet.add_legend(Symbol::None, "right: what each level adds to the SAH cost"),
    }
}

/// The position of the marked node, if there is one: its level, the number of primitives to its
/// left, and the number of primitives in it.
type MarkedNode = Option<(u32, u32, u32)>;

/// Returns the indices of the primitives below a node.
fn primitives_below(positions: &[NodePosition], node: &NodePosition) -> Vec<usize> {
    let inside = |other: &&NodePosition| {
        let range = node.start..node.start.saturating_add(node.reached.count as u32);
        other.level >= node.level && range.contains(&other.start)
    };
    let leaves = positions.iter().filter(inside);
    let leaves = leaves.filter_map(|leaf| leaf.reached.leaf_primitives.as_deref());
    leaves.flatten().copied().collect()
}
