//! Draws a correct traversal of the exam's tree, as stored in the exam: the nodes it tests, in
//! order, and the part of the ray inside each node's box.

mod layout;
mod rows;

use glam::dvec2;
use protocol::{Shape, TreeNode};

use super::Drawing;
use super::bars::Axis;
use super::canvas::{Anchor, Mark, WIDTH};
use super::hit_comparison::{HitComparison, hit_text};
use super::ink::{Fill, Ink};
use super::numbers::short;
use super::sheet::{Sheet, Symbol};
use super::side::add_range_legend;

use judging::drawing_data::TraversalStep;
use layout::{Layout, NodeRow, NodeStatus};

/// The exam's tree and one correct traversal of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct RecordedTraversal<'a> {
    /// The primitives, in the order that the leaves' ranges refer to.
    pub(super) shapes: &'a [Shape],
    /// The nodes, in any order.
    pub(super) nodes: &'a [TreeNode],
    /// The index of the root in `nodes`.
    pub(super) root: u32,
    /// The nodes that the traversal tests, in order.
    pub(super) steps: &'a [TraversalStep],
}

/// Draws the traversal. Returns `None` if it doesn't contain any steps because the tree is empty,
/// or if the nodes don't form a tree.
pub(super) fn draw(comparison: &HitComparison, traversal: &RecordedTraversal) -> Option<Drawing> {
    if traversal.steps.is_empty() {
        return None;
    }
    let layout = Layout::new(comparison, traversal)?;
    let mut sheet = Sheet::default();
    let canvas = &mut sheet.canvas;
    let left = dvec2(0.0, sheet.y + 12.0);
    canvas.text(left, Anchor::Start, Ink::Faint, "a correct traversal");
    let right = dvec2(WIDTH - 12.0, sheet.y + 12.0);
    let text = "the part of the ray in each box";
    canvas.text(right, Anchor::End, Ink::Faint, text);
    sheet.advance(18.0);
    let axis = Axis::over(rows::LEFT, axis_distances(comparison, &layout));
    rows::draw(&mut sheet, &axis, comparison, &layout);
    draw_legend(&mut sheet, comparison, &layout);
    let title = "The nodes that a correct traversal tests, and the part of the ray in each box";
    Some(sheet.finish(title, caption(comparison, &layout)))
}

/// Returns the distances that the axis must cover, such as the distance to a hit and the distances
/// at which the ray enters and leaves a box.
fn axis_distances(comparison: &HitComparison, layout: &Layout) -> Vec<f64> {
    let range = comparison.ray.range;
    let mut seen = vec![f64::from(range.min)];
    seen.extend(comparison.wanted.map(|hit| f64::from(hit.distance)));
    let spans = layout.rows.iter().filter_map(|row| row.span);
    seen.extend(spans.flat_map(|span| [f64::from(span.min), f64::from(span.max)]));
    let reach = seen.iter().copied().filter(|t| t.is_finite());
    let reach = 3.0 * reach.fold(1e-3, f64::max);
    let got = comparison.got_hit().map(|hit| f64::from(hit.distance));
    seen.extend(got.filter(|distance| distance.abs() < reach));
    if range.max.is_finite() {
        seen.push(f64::from(range.max).min(reach));
    }
    seen
}

fn draw_legend(sheet: &mut Sheet, comparison: &HitComparison, layout: &Layout) {
    let leaf = |leaf: Option<u32>| leaf.map_or(String::new(), |leaf| format!(", in leaf {leaf}"));
    match comparison.wanted {
        Some(hit) => {
            let text = hit_text(&hit) + &leaf(layout.wanted_leaf);
            sheet.add_wanted(Symbol::Mark(Mark::Right), &text);
        }
        None => sheet.add_wanted(Symbol::None, "no hit"),
    }
    match comparison.got {
        Some(Some(hit)) => {
            let decoy = layout.decoy().map_or("", |_| ", a decoy");
            let text = hit_text(&hit) + &leaf(layout.got_leaf) + decoy;
            sheet.add_got(Symbol::Mark(Mark::Wrong), &text);
        }
        Some(None) => sheet.add_got(Symbol::None, "no hit"),
        None => {}
    }
    add_range_legend(sheet, comparison);
    let entered = Symbol::Area(Fill::Tint(Ink::Text, 0.4));
    sheet.add_legend(entered, "entered, numbered in order");
    sheet.add_legend(Symbol::Area(Fill::None), "not entered");
}

fn caption(comparison: &HitComparison, layout: &Layout) -> String {
    let why = layout.got_row().map(|row| (row, row.status));
    match (comparison.got_hit(), layout.got_leaf, why) {
        (Some(hit), None, _) => format!(
            "Your hit at {} is on a primitive that isn't in any leaf below the root, so a traversal of the \
             tree never reaches it.",
            short(hit.distance.into())
        ),
        (Some(_), Some(leaf), Some((row, NodeStatus::Missed))) => format!(
            "Your hit is in leaf {leaf}, {} box the ray misses.",
            whose(row, leaf)
        ),
        (Some(hit), Some(leaf), Some((_, NodeStatus::Beyond)))
            if is_farther(comparison, hit.distance) =>
        {
            format!(
                "{} Yours is in leaf {leaf}, which a correct traversal does not enter.",
                comparison.caption()
            )
        }
        (Some(_), Some(leaf), Some((row, NodeStatus::Beyond))) => {
            let begin = row
                .span
                .map_or(String::new(), |span| short(span.min.into()));
            let closest = comparison.wanted.map_or(f32::NAN, |hit| hit.distance);
            format!(
                "Your hit is in leaf {leaf}, {} box the ray enters at {begin}, beyond the closest \
                 hit at {}.",
                whose(row, leaf),
                short(closest.into())
            )
        }
        (Some(_), Some(leaf), Some((_, NodeStatus::OutOfRange))) => {
            format!("Your hit is in leaf {leaf}, whose box is outside the ray's range.")
        }
        (Some(_), Some(_), Some((_, NodeStatus::Entered | NodeStatus::Elided)) | None)
        | (None, _, _) => match (comparison.wanted, layout.wanted_leaf_number()) {
            (Some(_), Some(number)) => format!(
                "{} That hit is in the leaf numbered {number}.",
                comparison.caption()
            ),
            (Some(_) | None, _) => comparison.caption(),
        },
    }
}

/// Returns the phrase that relates a row's box to a leaf. The row shows the leaf itself or a node
/// above it.
fn whose(row: &NodeRow, leaf: u32) -> String {
    if row.node == leaf {
        "whose".to_owned()
    } else {
        format!("below node {}, whose", row.node)
    }
}

fn is_farther(comparison: &HitComparison, distance: f32) -> bool {
    comparison
        .wanted
        .is_some_and(|wanted| wanted.distance < distance)
}
