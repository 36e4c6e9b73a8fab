//! Draws failed questions to scale, each with the submitted and the expected answer.
//!
//! This module is pure and computes no answers. The steps that lead to an expected answer, such as
//! a correct traversal, come from the exam ([`judging::drawing_data`]). Submitted answers may
//! contain any numbers, including NaN and infinities.

mod along_ray;
mod bars;
mod bbox;
mod build;
mod camera;
mod canvas;
mod hit_comparison;
mod ink;
mod light;
mod numbers;
mod plane;
mod shapes;
mod sheet;
mod side;
mod sphere;
mod traversal;
mod triangle;
mod uv;
mod window;

use protocol::{Answer, Corners, ElementOutcome, Geometry, Query, Question};

use judging::drawing_data::DrawingData;
use judging::exam::{ExamQuestion, ExpectedRows, Key};
use judging::judge::tree::TreeCriteria;

use bbox::BoxQuery;
use hit_comparison::HitComparison;
use traversal::RecordedTraversal;

/// A drawing of one element of a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// One `<svg>` element without ids, ready to be embedded in a page. It is designed for a width
    /// of at least 340 pixels. Its colours come from the CSS property `color` and the custom
    /// properties `--right`, `--wrong` and `--paper` (the background).
    pub svg: String,
    /// One sentence that says what the drawing shows.
    pub caption: String,
}

/// Draws one element of a question. `element` is its index, and `answer` is the answer to the whole
/// question, if any. Returns `None` if there is nothing to draw, or if a drawing would add nothing
/// to the text.
pub fn draw(question: &ExamQuestion, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    let (asked, key) = (&question.question, &question.key);
    if let (Question::SampleRay(table), Key::Table { rows, .. }) = (asked, key)
        && let ExpectedRows::Rays(directions) = rows
    {
        let got = if let Some(Answer::Rays(rays)) = answer {
            value(rays, element).copied()
        } else {
            None
        };
        let wanted = directions.get(element)?.as_dvec3();
        return camera::draw(&table.subject, table.rows.get(element)?, wanted, got);
    }
    if let Question::Hit(table) = asked {
        let comparison = HitComparison::new(question, element, answer)?;
        return match &table.subject {
            Geometry::List { shapes } => shapes::draw(&comparison, shapes),
            Geometry::Tree {
                shapes,
                nodes,
                root,
            } => {
                let steps = if let DrawingData::Traversals(all) = &question.drawing_data {
                    all.get(element)
                } else {
                    None
                };
                let recorded = RecordedTraversal {
                    shapes,
                    nodes,
                    root: *root,
                    steps: steps.map(Vec::as_slice).unwrap_or_default(),
                };
                let drawing = traversal::draw(&comparison, &recorded);
                Some(drawing.unwrap_or_else(|| along_ray::draw(&comparison)))
            }
            Geometry::BuiltTree { .. } => Some(along_ray::draw(&comparison)),
        };
    }
    if let Question::Light(table) = asked {
        return light::draw(table, question, element, answer);
    }
    if let (Question::BBoxHit(table), Key::Table { rows, .. }) = (asked, key)
        && let ExpectedRows::Spans(spans) = rows
    {
        let Corners { min, max } = table.subject;
        let Query { ray, times } = table.rows.get(element)?;
        return bbox::draw(&BoxQuery {
            corners: [min, max],
            ray,
            times,
            wanted: *spans.get(element)?,
            got: if let Some(Answer::Spans(spans)) = answer {
                value(spans, element).copied()
            } else {
                None
            },
            slabs: if let DrawingData::Slabs(slabs) = &question.drawing_data {
                slabs.get(element).copied()
            } else {
                None
            },
        });
    }
    let criteria = TreeCriteria::of(question)?;
    let sweep = if let DrawingData::Sweep(sweep) = &question.drawing_data {
        Some(sweep)
    } else {
        None
    };
    build::draw(&criteria, sweep, answer)
}

/// Returns the value of an element, or `None` if it is missing, e.g. because the code panicked.
fn value<T>(outcomes: &[ElementOutcome<T>], element: usize) -> Option<&T> {
    outcomes.get(element)?.value()
}

#[cfg(test)]
mod tests;
