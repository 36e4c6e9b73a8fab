//! A walk through the exam's tree: the nodes that a right one comes to, in order, each with the part
//! of the ray that is in its box. Such a walk comes with the exam.

mod layout;
mod rows;

use glam::dvec2;
use protocol::{Shape, TreeNode};

use super::Drawing;
use super::bars::Axis;
use super::canvas::{Anchor, Mark, WIDTH};
use super::hit_comparison::{HitAnswer, HitComparison};
use super::ink::{Fill, Ink, LineStyle};
use super::numbers::short;
use super::sheet::{Sheet, Symbol};
use crate::describe;
use crate::drawing_data::TraversalStep;

use layout::{Layout, NodeRow, NodeStatus};

/// The exam's tree, and one right way through it.
#[derive(Clone, Copy, Debug)]
pub(super) struct RecordedTraversal<'a> {
    /// In the order that the leaves count.
    pub(super) shapes: &'a [Shape],
    /// In any order.
    pub(super) nodes: &'a [TreeNode],
    /// Where to start.
    pub(super) root: u32,
    /// The nodes that are come to.
    pub(super) steps: &'a [TraversalStep],
}

/// The drawing. None of a tree without nodes.
pub(super) fn draw(encounter: &HitComparison, walked: &RecordedTraversal) -> Option<Drawing> {
    if walked.steps.is_empty() {
        return None;
    }
    let plan = Layout::new(encounter, walked);
    let mut sheet = Sheet::default();
    let head = dvec2(0.0, sheet.y + 12.0);
    sheet
        .canvas
        .text(head, Anchor::Start, Ink::Faint, "a right walk");
    let right = dvec2(WIDTH - 12.0, sheet.y + 12.0);
    let words = "where the ray is in each box";
    sheet.canvas.text(right, Anchor::End, Ink::Faint, words);
    sheet.advance(18.0);
    let axis = Axis::over(rows::LEFT, axis_distances(encounter, &plan));
    sheet.y = rows::draw(&mut sheet.canvas, sheet.y, &axis, encounter, &plan);
    draw_legend(&mut sheet, encounter, &plan);
    let title = "The nodes that a right walk comes to, and the ray's way through their boxes";
    Some(sheet.finish(title, caption(encounter, &plan)))
}

/// The distances to be seen: the hits, and where the ray is in boxes that it enters.
fn axis_distances(encounter: &HitComparison, plan: &Layout) -> Vec<f64> {
    let range = encounter.ray.range;
    let mut seen = vec![f64::from(range.min)];
    seen.extend(encounter.wanted.map(|met| met.distance));
    let spans = plan.rows.iter().filter_map(|row| row.span);
    seen.extend(spans.flat_map(|span| [f64::from(span.min), f64::from(span.max)]));
    let reach = seen.iter().copied().filter(|t| t.is_finite());
    let reach = 3.0 * reach.fold(1e-3, f64::max);
    if let HitAnswer::Hit(met) = encounter.got
        && met.distance.abs() < reach
    {
        seen.push(met.distance);
    }
    if range.max.is_finite() {
        seen.push(f64::from(range.max).min(reach));
    }
    seen
}

fn draw_legend(sheet: &mut Sheet, encounter: &HitComparison, plan: &Layout) {
    let leaf = |leaf: Option<u32>| leaf.map_or(String::new(), |leaf| format!(", in leaf {leaf}"));
    match encounter.wanted {
        Some(met) => {
            let distance = describe::number(met.distance as f32);
            let words = format!("wanted: a hit at {distance}{}", leaf(plan.wanted_leaf));
            sheet.add_legend(Symbol::Mark(Mark::Right), &words);
        }
        None => sheet.add_legend(Symbol::None, "wanted: no hit"),
    }
    match encounter.got {
        HitAnswer::Hit(met) => {
            let distance = describe::number(met.distance as f32);
            let trap = plan.decoy().map_or("", |_| ", a trap");
            let words = format!("got: a hit at {distance}{}{trap}", leaf(plan.got_leaf));
            sheet.add_legend(Symbol::Mark(Mark::Wrong), &words);
        }
        HitAnswer::Miss => sheet.add_legend(Symbol::None, "got: no hit"),
        HitAnswer::NoAnswer => {}
    }
    if encounter.limited_range().is_some() {
        let words = format!(
            "the range that counts: {}",
            describe::interval(encounter.ray.range)
        );
        sheet.add_legend(Symbol::Line(LineStyle::Range), &words);
    }
    let entered = Fill::Tint(Ink::Text, 0.4);
    sheet.add_legend(
        Symbol::Area(entered),
        "entered, in the order of the numbers",
    );
    sheet.add_legend(Symbol::Area(Fill::None), "not entered");
}

fn caption(encounter: &HitComparison, plan: &Layout) -> String {
    let why = plan.got_row().map(|row: &NodeRow| (row, row.status));
    match (encounter.got, plan.got_leaf, why) {
        (HitAnswer::Hit(met), None, _) => format!(
            "Your hit at {} is with a primitive in no leaf below the root: a walk through the tree \
             never comes to it.",
            short(met.distance)
        ),
        (HitAnswer::Hit(_), Some(leaf), Some((row, NodeStatus::Missed))) => {
            match row.node == leaf {
                true => format!("Your hit is in leaf {leaf}, whose box the ray misses."),
                false => format!(
                    "Your hit is in leaf {leaf}, below node {}, whose box the ray misses.",
                    row.node
                ),
            }
        }
        (HitAnswer::Hit(met), Some(leaf), Some((_, NodeStatus::Beyond)))
            if is_farther(encounter, met.distance) =>
        {
            format!(
                "{} A right walk does not come to yours, in leaf {leaf}.",
                encounter.caption()
            )
        }
        (HitAnswer::Hit(_), Some(leaf), Some((row, NodeStatus::Beyond))) => {
            let begin = row
                .span
                .map_or(String::new(), |span| short(span.min.into()));
            let closest = encounter.wanted.map_or(f64::NAN, |met| met.distance);
            let node = match row.node == leaf {
                true => "which".to_owned(),
                false => format!("below node {}, which", row.node),
            };
            format!(
                "Your hit is in leaf {leaf}, {node} begins at {begin}, beyond the closest hit at {}.",
                short(closest)
            )
        }
        (HitAnswer::Hit(_), Some(leaf), Some((_, NodeStatus::OutOfRange))) => {
            format!("Your hit is in leaf {leaf}, whose box is outside the ray's range.")
        }
        (
            HitAnswer::Hit(_),
            Some(_),
            Some((_, NodeStatus::Entered | NodeStatus::Elided)) | None,
        )
        | (HitAnswer::Miss | HitAnswer::NoAnswer, _, _) => {
            match (encounter.wanted, plan.wanted_leaf_number()) {
                (Some(_), Some(number)) => format!(
                    "{} That is in the leaf with number {number}.",
                    encounter.caption()
                ),
                (Some(_) | None, _) => encounter.caption(),
            }
        }
    }
}

fn is_farther(encounter: &HitComparison, distance: f64) -> bool {
    encounter
        .wanted
        .is_some_and(|wanted| wanted.distance < distance)
}
