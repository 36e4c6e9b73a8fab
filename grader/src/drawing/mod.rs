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
mod numbers;
mod shapes;
mod sheet;
mod side;
mod sphere;
mod traversal;
mod triangle;
mod uv;
mod window;

use glam::DVec3;
use protocol::{Answer, Interval, Question};

use judging::drawing_data::{DrawingData, TraversalStep};
use judging::exam::{ExamQuestion, Key, TreeCheck};

use bbox::BoxQuery;
use camera::CameraQuery;
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
/// question, if there is one. Returns `None` if there is nothing to draw, or if a drawing would add
/// nothing to the text.
pub fn draw(question: &ExamQuestion, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    match &question.question {
        Question::Shapes { shapes, .. } => {
            let comparison = HitComparison::new(question, element, answer)?;
            shapes::draw(&comparison, shapes)
        }
        Question::BBox { min, max, queries } => {
            let &(ray, times) = queries.get(element)?;
            let query = BoxQuery {
                corners: [*min, *max],
                ray,
                times,
                wanted: wanted_span(&question.key, element)?,
                slabs: bbox::slabs(&question.drawing_data, element),
            };
            bbox::draw(&query, element, answer)
        }
        Question::Camera { camera, samples } => {
            let query = CameraQuery {
                camera: *camera,
                sample: *samples.to_vec(camera.film).get(element)?,
                wanted: wanted_direction(&question.key, element)?,
            };
            camera::draw(&query, element, answer)
        }
        Question::Build {
            shapes,
            max_leaf_size,
        } => {
            let (checks, sweep_cost) = tree_key(&question.key)?;
            let case = build::BuildCase {
                shapes,
                max_leaf_size: *max_leaf_size,
                checks,
                sweep_cost,
                drawing_data: &question.drawing_data,
            };
            build::draw(&case, answer)
        }
        Question::Traverse {
            shapes,
            nodes,
            root,
            ..
        } => {
            let comparison = HitComparison::new(question, element, answer)?;
            let recorded = RecordedTraversal {
                shapes,
                nodes,
                root: *root,
                steps: steps(&question.drawing_data, element),
            };
            let drawing = traversal::draw(&comparison, &recorded);
            Some(drawing.unwrap_or_else(|| along_ray::draw(&comparison)))
        }
        Question::BuildAndTraverse { .. } => Some(along_ray::draw(&HitComparison::new(
            question, element, answer,
        )?)),
        Question::Radiance { .. } | Question::Done => None,
    }
}

fn wanted_span(key: &Key, element: usize) -> Option<Option<Interval>> {
    match key {
        Key::Spans { spans } => spans.get(element).copied(),
        Key::Rays { .. }
        | Key::Hits { .. }
        | Key::Tree { .. }
        | Key::FirstHits { .. }
        | Key::Radiance { .. } => None,
    }
}

fn wanted_direction(key: &Key, element: usize) -> Option<DVec3> {
    match key {
        Key::Rays { directions, .. } => Some(directions.get(element)?.as_dvec3()),
        Key::Hits { .. }
        | Key::Spans { .. }
        | Key::Tree { .. }
        | Key::FirstHits { .. }
        | Key::Radiance { .. } => None,
    }
}

fn tree_key(key: &Key) -> Option<(&[TreeCheck], Option<f64>)> {
    match key {
        Key::Tree { checks, sweep_cost } => Some((checks, *sweep_cost)),
        Key::Rays { .. }
        | Key::Hits { .. }
        | Key::Spans { .. }
        | Key::FirstHits { .. }
        | Key::Radiance { .. } => None,
    }
}

fn steps(data: &DrawingData, element: usize) -> &[TraversalStep] {
    match data {
        DrawingData::Traversals(traversals) => traversals.get(element).map_or(&[], Vec::as_slice),
        DrawingData::None | DrawingData::Slabs(_) | DrawingData::Sweep(_) => &[],
    }
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod captions;
