//! A walk through the exam's tree: the nodes that a right one comes to, in order, each with the part
//! of the ray that is in its box. Such a walk comes with the exam.

mod plan;
mod rows;

use glam::dvec2;
use protocol::{Shape, TreeNode};

use super::Drawing;
use super::bars::Axis;
use super::canvas::{Anchor, Mark, WIDTH};
use super::encounter::{Encounter, Got};
use super::ink::{Fill, Ink, Line};
use super::sheet::{Sheet, Sign};
use super::words::short;
use crate::describe;
use crate::shown::Step;

use plan::{Fate, Plan, Row};

/// The exam's tree, and one right way through it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walked<'a> {
    /// In the order that the leaves count.
    pub(super) shapes: &'a [Shape],
    /// In any order.
    pub(super) nodes: &'a [TreeNode],
    /// Where to start.
    pub(super) root: u32,
    /// The nodes that are come to.
    pub(super) steps: &'a [Step],
}

/// The drawing. None of a tree without nodes.
pub(super) fn draw(encounter: &Encounter, walked: &Walked) -> Option<Drawing> {
    if walked.steps.is_empty() {
        return None;
    }
    let plan = Plan::of(encounter, walked);
    let mut sheet = Sheet::default();
    let head = dvec2(0.0, sheet.y + 12.0);
    sheet
        .canvas
        .text(head, Anchor::Start, Ink::Faint, "a right walk");
    let right = dvec2(WIDTH - 12.0, sheet.y + 12.0);
    let words = "where the ray is in each box";
    sheet.canvas.text(right, Anchor::End, Ink::Faint, words);
    sheet.take(18.0);
    let axis = Axis::over(rows::LEFT, distances(encounter, &plan));
    sheet.y = rows::draw(&mut sheet.canvas, sheet.y, &axis, encounter, &plan);
    explain(&mut sheet, encounter, &plan);
    let title = "The nodes that a right walk comes to, and the ray's way through their boxes";
    Some(sheet.finish(title, sentence(encounter, &plan)))
}

/// The distances to be seen: the hits, and where the ray is in boxes that it enters.
fn distances(encounter: &Encounter, plan: &Plan) -> Vec<f64> {
    let range = encounter.ray.range;
    let mut seen = vec![f64::from(range.min)];
    seen.extend(encounter.wanted.map(|met| met.distance));
    let spans = plan.rows.iter().filter_map(|row| row.span);
    seen.extend(spans.flat_map(|span| [f64::from(span.min), f64::from(span.max)]));
    let reach = seen.iter().copied().filter(|t| t.is_finite());
    let reach = 3.0 * reach.fold(1e-3, f64::max);
    if let Got::Hit(met) = encounter.got
        && met.distance.abs() < reach
    {
        seen.push(met.distance);
    }
    if range.max.is_finite() {
        seen.push(f64::from(range.max).min(reach));
    }
    seen
}

fn explain(sheet: &mut Sheet, encounter: &Encounter, plan: &Plan) {
    let leaf = |leaf: Option<u32>| leaf.map_or(String::new(), |leaf| format!(", in leaf {leaf}"));
    match encounter.wanted {
        Some(met) => {
            let distance = describe::number(met.distance as f32);
            let words = format!("wanted: a hit at {distance}{}", leaf(plan.wanted));
            sheet.explain(Sign::Mark(Mark::Right), &words);
        }
        None => sheet.explain(Sign::None, "wanted: no hit"),
    }
    match encounter.got {
        Got::Hit(met) => {
            let distance = describe::number(met.distance as f32);
            let trap = plan.trap().map_or("", |_| ", a trap");
            let words = format!("got: a hit at {distance}{}{trap}", leaf(plan.got));
            sheet.explain(Sign::Mark(Mark::Wrong), &words);
        }
        Got::Miss => sheet.explain(Sign::None, "got: no hit"),
        Got::NoAnswer => {}
    }
    if encounter.range().is_some() {
        let words = format!(
            "the range that counts: {}",
            describe::interval(encounter.ray.range)
        );
        sheet.explain(Sign::Line(Line::Range), &words);
    }
    let entered = Fill::Of(Ink::Text, 0.4);
    sheet.explain(Sign::Area(entered), "entered, in the order of the numbers");
    sheet.explain(Sign::Area(Fill::None), "not entered");
}

fn sentence(encounter: &Encounter, plan: &Plan) -> String {
    let why = plan.got_row().map(|row: &Row| (row, row.fate));
    match (encounter.got, plan.got, why) {
        (Got::Hit(met), None, _) => format!(
            "Your hit at {} is with a primitive in no leaf below the root: a walk through the tree \
             never comes to it.",
            short(met.distance)
        ),
        (Got::Hit(_), Some(leaf), Some((row, Fate::Missed))) => match row.node == leaf {
            true => format!("Your hit is in leaf {leaf}, whose box the ray misses."),
            false => format!(
                "Your hit is in leaf {leaf}, below node {}, whose box the ray misses.",
                row.node
            ),
        },
        (Got::Hit(met), Some(leaf), Some((_, Fate::Beyond)))
            if is_farther(encounter, met.distance) =>
        {
            format!(
                "{} A right walk does not come to yours, in leaf {leaf}.",
                encounter.sentence()
            )
        }
        (Got::Hit(_), Some(leaf), Some((row, Fate::Beyond))) => {
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
        (Got::Hit(_), Some(leaf), Some((_, Fate::OutOfRange))) => {
            format!("Your hit is in leaf {leaf}, whose box is outside the ray's range.")
        }
        (Got::Hit(_), Some(_), Some((_, Fate::Entered | Fate::Elided)) | None)
        | (Got::Miss | Got::NoAnswer, _, _) => match (encounter.wanted, plan.wanted_number()) {
            (Some(_), Some(number)) => format!(
                "{} That is in the leaf with number {number}.",
                encounter.sentence()
            ),
            (Some(_) | None, _) => encounter.sentence(),
        },
    }
}

fn is_farther(encounter: &Encounter, distance: f64) -> bool {
    encounter
        .wanted
        .is_some_and(|wanted| wanted.distance < distance)
}
