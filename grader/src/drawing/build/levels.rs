//! Draws a tree as rows of bars, one row per level. The width of a node's bar shows the node's
//! share of the primitives.

use glam::{DVec2, dvec2};
use judging::drawing_data::{LevelNode, UpperLevels};

use crate::drawing::canvas::{Anchor, Canvas, Mark, WIDTH};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::sheet::{Sheet, Symbol};

/// The height of a level.
const ROW_HEIGHT: f64 = 19.0;
/// The right end of the bars. The costs are to the right of it.
const RIGHT: f64 = WIDTH - 52.0;
/// The maximum number of nodes to draw in a level.
const MAX_NODES: usize = 2_000;

/// Draws the levels of a tree over `all` primitives and the cost of each level. `total` is the cost
/// of the whole tree, or NaN if it is unknown. Returns the symbol that marks the node `mark`.
pub(super) fn draw(
    sheet: &mut Sheet,
    nodes: &[LevelNode],
    all: u32,
    total: f64,
    mark: Option<LevelNode>,
) -> Symbol {
    let mut symbol = Symbol::None;
    let top = sheet.y;
    let x = |count: u32| RIGHT * f64::from(count) / f64::from(all.max(1));
    let ends = |node: &LevelNode| [node.start, node.start.saturating_add(node.count)].map(x);
    let canvas = &mut sheet.canvas;
    let at_right = |y: f64| dvec2(WIDTH - 2.0, y);
    canvas.text(at_right(top - 6.0), Anchor::End, Ink::Faint, "SAH cost");
    let deepest = nodes.iter().map(|node| node.level).max().unwrap_or(0);
    let mut sum = 0.0;
    for level in 0..=deepest.min(UpperLevels::LEVELS - 1) {
        let y = top + ROW_HEIGHT * f64::from(level);
        let on_level = nodes.iter().filter(|node| node.level == level);
        let cost: f64 = on_level.clone().map(|node| f64::from(node.cost)).sum();
        sum += cost;
        for node in on_level.take(MAX_NODES) {
            draw_node(canvas, node, ends(node), y);
        }
        let cost = format!("{cost:.2}");
        canvas.text(at_right(y + 13.5), Anchor::End, Ink::Text, &cost);
    }
    if let Some(node) = mark {
        let y = top + ROW_HEIGHT * f64::from(node.level.min(deepest));
        let [from, to] = ends(&node);
        let (from, to) = (dvec2(from, y), dvec2(to, y + ROW_HEIGHT - 3.0));
        if node.level <= deepest && to.x - from.x > 14.0 {
            canvas.rectangle(from, to, LineStyle::Wrong, Fill::None);
            symbol = Symbol::Line(LineStyle::Wrong);
        } else {
            canvas.mark(0.5 * (from + to), Mark::Wrong);
            symbol = Symbol::Mark(Mark::Wrong);
        }
    }
    sheet.advance(ROW_HEIGHT * f64::from(deepest + 1));
    let rest = total - sum;
    if rest > 0.005 {
        let y = sheet.y + 13.5;
        let canvas = &mut sheet.canvas;
        canvas.text(dvec2(0.0, y), Anchor::Start, Ink::Faint, "deeper levels");
        canvas.text(at_right(y), Anchor::End, Ink::Text, &format!("{rest:.2}"));
        sheet.advance(ROW_HEIGHT);
    }
    sheet.advance(4.0);
    symbol
}

fn draw_node(canvas: &mut Canvas, node: &LevelNode, [from, to]: [f64; 2], y: f64) {
    /// The approximate width of a digit, in page units.
    const DIGIT_WIDTH: f64 = 8.0;

    let times = if node.is_leaf { node.count.max(1) } else { 1 };
    let area = f64::from(node.cost) / f64::from(times);
    let area = if area.is_finite() { area } else { 0.0 };
    let height = if node.is_leaf { 0.5 } else { 1.0 } * (ROW_HEIGHT - 3.0);
    // Neighbours are separated by a small gap, which is narrower for narrow nodes.
    let gap = (0.1 * (to - from)).min(1.0);
    let (low, high): (DVec2, DVec2) = (dvec2(from, y), dvec2(to - gap, y + height));
    let fill = Fill::Tint(Ink::Text, 0.1 + 0.75 * area.sqrt());
    if to - from > 6.0 {
        canvas.rectangle(low, high, LineStyle::Grid, fill);
    } else {
        canvas.area(low, high, fill);
    }
    let text = node.count.to_string();
    if to - from > DIGIT_WIDTH * (text.len() as f64 + 0.5) {
        let at = dvec2(0.5 * (from + to), y + 13.0);
        canvas.text(at, Anchor::Middle, Ink::Text, &text);
    }
}
