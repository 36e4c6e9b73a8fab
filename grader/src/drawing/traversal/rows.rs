//! Draws the rows of a traversal diagram, one per node: the node's name on the left, and the part
//! of the ray inside its box on the right.

use glam::dvec2;

use super::layout::{Layout, NodeRow, NodeStatus};
use crate::drawing::bars::Axis;
use crate::drawing::canvas::{Anchor, Canvas, Mark, WIDTH};
use crate::drawing::hit_comparison::HitComparison;
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::sheet::Sheet;

/// The height of a row.
const ROW_HEIGHT: f64 = 17.0;
/// The left end of the axis.
pub(super) const LEFT: f64 = 156.0;
/// The indentation per level, in page units.
const INDENT: f64 = 5.0;
/// The maximum number of levels to indent. Deeper nodes aren't indented further.
const MAX_INDENTS: usize = 9;

/// Draws the rows and the axis below them.
pub(super) fn draw(sheet: &mut Sheet, axis: &Axis, comparison: &HitComparison, layout: &Layout) {
    let (canvas, y) = (&mut sheet.canvas, sheet.y);
    let foot = y + ROW_HEIGHT * layout.rows.len() as f64 + 3.0;
    let range = comparison.ray.range;
    if comparison.limited_range().is_some() {
        let [from, to] = [range.min, range.max].map(|end| axis.page_position(end.into()));
        let ends = [from, to.max(from)].map(|x| dvec2(x, foot + 2.0));
        canvas.line(ends[0], ends[1], LineStyle::Range);
    }
    let hits = [comparison.wanted, comparison.got_hit()];
    let [wanted, got] = hits.map(|hit| hit.map(|hit| f64::from(hit.distance)));
    for (distance, line) in [(wanted, LineStyle::Right), (got, LineStyle::Wrong)] {
        if let Some(t) = distance.filter(|t| axis.contains(*t)) {
            let x = axis.page_position(t);
            canvas.line(dvec2(x, y), dvec2(x, foot), line);
        }
    }
    for (i, row) in layout.rows.iter().enumerate() {
        let y = y + ROW_HEIGHT * i as f64;
        draw_name(canvas, y, row);
        let is_decoy = layout.decoy().is_some_and(|decoy| decoy.node == row.node);
        if is_decoy && row.status.is_skipped() {
            canvas.text(dvec2(LEFT - 6.0, y + 13.0), Anchor::End, Ink::Text, "decoy");
        }
        draw_span(canvas, axis, y, row);
        let marks = [
            (wanted, layout.wanted_leaf, Mark::Right),
            (got, layout.got_row().map(|row| row.node), Mark::Wrong),
        ];
        for (distance, node, mark) in marks {
            let is_here = node == Some(row.node) && row.status != NodeStatus::Elided;
            if let Some(t) = distance.filter(|_| is_here) {
                canvas.mark(dvec2(axis.page_position(t), y + 0.5 * ROW_HEIGHT), mark);
            }
        }
    }
    axis.draw(canvas, foot + 2.0);
    sheet.y = foot + 26.0;
}

fn draw_name(canvas: &mut Canvas, y: f64, row: &NodeRow) {
    let foot = y + 13.0;
    let x = 26.0 + INDENT * row.depth.min(MAX_INDENTS) as f64;
    let kind = if row.is_leaf { "leaf" } else { "node" };
    let is_entered = row.status == NodeStatus::Entered;
    let ink = if is_entered { Ink::Text } else { Ink::Faint };
    let text = if row.status == NodeStatus::Elided {
        format!("… {} more", row.node)
    } else {
        format!("{kind} {}", row.node)
    };
    canvas.text(dvec2(x, foot), Anchor::Start, ink, &text);
    if is_entered {
        let at = dvec2(20.0, foot);
        canvas.text(at, Anchor::End, ink, &row.number.to_string());
    }
}

fn draw_span(canvas: &mut Canvas, axis: &Axis, y: f64, row: &NodeRow) {
    let foot = y + 13.0;
    let text = match row.status {
        NodeStatus::Entered | NodeStatus::Elided => "",
        NodeStatus::Missed => "missed",
        NodeStatus::OutOfRange => "out of range",
        NodeStatus::Beyond => "beyond",
    };
    let Some(span) = row.span else {
        canvas.text(dvec2(LEFT + 4.0, foot), Anchor::Start, Ink::Faint, text);
        return;
    };
    let from = axis.page_position(span.min.into());
    // A minimum width keeps a flat box visible.
    let to = axis.page_position(span.max.into()).max(from + 2.0);
    let fill = if row.status == NodeStatus::Entered {
        Fill::Tint(Ink::Text, if row.is_leaf { 0.4 } else { 0.15 })
    } else {
        Fill::None
    };
    let (low, high) = (dvec2(from, y + 3.0), dvec2(to, y + ROW_HEIGHT - 3.0));
    canvas.rectangle(low, high, LineStyle::Grid, fill);
    // The label goes next to the bar, on the side with more space.
    let (x, anchor) = if from - LEFT > WIDTH - to {
        (from - 4.0, Anchor::End)
    } else {
        (to + 4.0, Anchor::Start)
    };
    canvas.text(dvec2(x, foot), anchor, Ink::Faint, text);
}
