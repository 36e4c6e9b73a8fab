//! The rows of a walk: an outline of nodes to the left, their parts of the ray to the right.

use glam::dvec2;

use super::layout::{Layout, NodeRow, NodeStatus};
use crate::drawing::bars::Axis;
use crate::drawing::canvas::{Anchor, Canvas, Mark, WIDTH};
use crate::drawing::hit_comparison::{HitAnswer, HitComparison};
use crate::drawing::ink::{Fill, Ink, LineStyle};

/// The height of a row.
const ROW_HEIGHT: f64 = 17.0;
/// Where the axis begins.
pub(super) const LEFT: f64 = 156.0;
/// So far a child stands to the right of its parent.
const INDENT: f64 = 5.0;
/// Deeper nodes are not indented any more.
const MAX_INDENTS: usize = 9;

/// The rows from `y` on; returns where they end.
pub(super) fn draw(
    canvas: &mut Canvas,
    y: f64,
    axis: &Axis,
    encounter: &HitComparison,
    plan: &Layout,
) -> f64 {
    let foot = y + ROW_HEIGHT * plan.rows.len() as f64 + 3.0;
    let range = encounter.ray.range;
    if encounter.limited_range().is_some() {
        let [from, to] = [range.min, range.max].map(|end| axis.to_page(end.into()));
        let line = foot + 2.0;
        canvas.line(
            dvec2(from, line),
            dvec2(to.max(from), line),
            LineStyle::Range,
        );
    }
    let hits = [
        (encounter.wanted.map(|met| met.distance), LineStyle::Right),
        (got_distance(encounter), LineStyle::Wrong),
    ];
    for (distance, line) in hits {
        if let Some(t) = distance.filter(|t| axis.contains(*t)) {
            let x = axis.to_page(t);
            canvas.line(dvec2(x, y), dvec2(x, foot), line);
        }
    }
    for (i, row) in plan.rows.iter().enumerate() {
        let y = y + ROW_HEIGHT * i as f64;
        draw_name(canvas, y, row);
        let is_trap = plan.decoy().is_some_and(|trap| trap.node == row.node);
        if is_trap && row.status.is_skipped() {
            canvas.text(dvec2(LEFT - 6.0, y + 13.0), Anchor::End, Ink::Text, "trap");
        }
        draw_span(canvas, axis, y, row);
        let marks = [
            (hits[0].0, plan.wanted_leaf, Mark::Right),
            (hits[1].0, plan.got_row().map(|row| row.node), Mark::Wrong),
        ];
        for (distance, node, mark) in marks {
            let is_here = node == Some(row.node) && row.status != NodeStatus::Elided;
            if let Some(t) = distance.filter(|_| is_here) {
                canvas.mark(dvec2(axis.to_page(t), y + 0.5 * ROW_HEIGHT), mark);
            }
        }
    }
    axis.draw(canvas, foot + 2.0);
    foot + 26.0
}

fn got_distance(encounter: &HitComparison) -> Option<f64> {
    match encounter.got {
        HitAnswer::Hit(met) => Some(met.distance),
        HitAnswer::Miss | HitAnswer::NoAnswer => None,
    }
}

fn draw_name(canvas: &mut Canvas, y: f64, row: &NodeRow) {
    let foot = y + 13.0;
    let x = 26.0 + INDENT * row.depth.min(MAX_INDENTS) as f64;
    let kind = if row.is_leaf { "leaf" } else { "node" };
    let (ink, words) = match row.status {
        NodeStatus::Entered => (Ink::Text, format!("{kind} {}", row.node)),
        NodeStatus::Missed | NodeStatus::OutOfRange | NodeStatus::Beyond => {
            (Ink::Faint, format!("{kind} {}", row.node))
        }
        NodeStatus::Elided => (Ink::Faint, format!("… {} more", row.node)),
    };
    canvas.text(dvec2(x, foot), Anchor::Start, ink, &words);
    if row.status == NodeStatus::Entered {
        let at = dvec2(20.0, foot);
        canvas.text(at, Anchor::End, ink, &row.number.to_string());
    }
}

fn draw_span(canvas: &mut Canvas, axis: &Axis, y: f64, row: &NodeRow) {
    let foot = y + 13.0;
    let words = match row.status {
        NodeStatus::Entered | NodeStatus::Elided => "",
        NodeStatus::Missed => "missed",
        NodeStatus::OutOfRange => "out of range",
        NodeStatus::Beyond => "beyond",
    };
    let Some(span) = row.span else {
        canvas.text(dvec2(LEFT + 4.0, foot), Anchor::Start, Ink::Faint, words);
        return;
    };
    let from = axis.to_page(span.min.into());
    // A flat box is seen as well.
    let to = axis.to_page(span.max.into()).max(from + 2.0);
    let fill = match row.status {
        NodeStatus::Entered => Fill::Tint(Ink::Text, if row.is_leaf { 0.4 } else { 0.15 }),
        NodeStatus::Missed | NodeStatus::OutOfRange | NodeStatus::Beyond | NodeStatus::Elided => {
            Fill::None
        }
    };
    let (low, high) = (dvec2(from, y + 3.0), dvec2(to, y + ROW_HEIGHT - 3.0));
    canvas.rectangle(low, high, LineStyle::Grid, fill);
    // Beside the bar, on the side with more room.
    let (x, anchor) = match from - LEFT > WIDTH - to {
        true => (from - 4.0, Anchor::End),
        false => (to + 4.0, Anchor::Start),
    };
    canvas.text(dvec2(x, foot), anchor, Ink::Faint, words);
}
