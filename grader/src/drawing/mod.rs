//! Drawings of failed questions, to scale: what was asked, what came, what should have come.
//!
//! Pure, and without a way of its own to any answer: how a ray meets a shape, and how a tree is
//! built or walked, comes with the exam ([`crate::shown`]). Answers may hold any numbers.

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

use crate::drawing_data::{DrawingData, TraversalStep};
use crate::exam::{ExamQuestion, Key, TreeCheck};

use bbox::BoxQuery;
use camera::CameraQuery;
use hit_comparison::HitComparison;
use traversal::RecordedTraversal;

/// A drawing of one element of a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// One `<svg>` element, to be put into a page as it is. It looks well from 340 pixels of width
    /// up, takes its colours from `color` and the custom properties `--right`, `--wrong` and
    /// `--paper` (the background), and has no ids.
    pub svg: String,
    /// What it shows, in a sentence.
    pub caption: String,
}

/// Draws one element of a question, counted from 0, beside the whole answer to the question, if one
/// came. None where there is nothing to see that words do not say.
pub fn draw(asked: &ExamQuestion, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    match &asked.question {
        Question::Shapes { shapes, .. } => {
            let encounter = HitComparison::new(asked, element, answer)?;
            shapes::draw(&encounter, shapes)
        }
        Question::BBox {
            min,
            max,
            queries: shots,
        } => {
            let &(ray, times) = shots.get(element)?;
            let shot = BoxQuery {
                corners: [*min, *max],
                ray,
                times,
                wanted: wanted_span(&asked.key, element)?,
                slabs: bbox::slabs(&asked.drawing_data, element),
            };
            bbox::draw(&shot, element, answer)
        }
        Question::Camera { camera, samples } => {
            let aim = CameraQuery {
                camera: *camera,
                sample: *samples.to_vec(camera.film).get(element)?,
                wanted: wanted_direction(&asked.key, element)?,
            };
            camera::draw(&aim, element, answer)
        }
        Question::Build {
            shapes,
            max_leaf_size,
        } => {
            let (judged, sweep_cost) = tree_key(&asked.key)?;
            let task = build::BuildCase {
                shapes,
                max_leaf_size: *max_leaf_size,
                judged,
                sweep_cost,
                shown: &asked.drawing_data,
            };
            build::draw(&task, answer)
        }
        Question::Traverse {
            shapes,
            nodes,
            root,
            ..
        } => {
            let encounter = HitComparison::new(asked, element, answer)?;
            let walked = RecordedTraversal {
                shapes,
                nodes,
                root: *root,
                steps: steps(&asked.drawing_data, element),
            };
            let walk = traversal::draw(&encounter, &walked);
            Some(walk.unwrap_or_else(|| along_ray::draw(&encounter)))
        }
        Question::BuildAndTraverse { .. } => Some(along_ray::draw(&HitComparison::new(
            asked, element, answer,
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
        Key::Tree {
            checks: judged,
            sweep_cost,
        } => Some((judged, *sweep_cost)),
        Key::Rays { .. }
        | Key::Hits { .. }
        | Key::Spans { .. }
        | Key::FirstHits { .. }
        | Key::Radiance { .. } => None,
    }
}

fn steps(shown: &DrawingData, element: usize) -> &[TraversalStep] {
    match shown {
        DrawingData::Traversals(walks) => walks.get(element).map_or(&[], Vec::as_slice),
        DrawingData::None | DrawingData::Slabs(_) | DrawingData::Sweep(_) => &[],
    }
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod captions;
