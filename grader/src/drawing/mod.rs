//! Drawings of failed questions, to scale: what was asked, what came, what should have come.
//!
//! Pure, and without a way of its own to any answer: how a ray meets a shape, and how a tree is
//! built or walked, comes with the exam ([`crate::shown`]). Answers may hold any numbers.

mod along;
mod bars;
mod bbox;
mod build;
mod camera;
mod canvas;
mod encounter;
mod ink;
mod shapes;
mod sheet;
mod side;
mod sphere;
mod triangle;
mod uv;
mod walk;
mod window;
mod words;

use glam::DVec3;
use protocol::{Answer, Interval, Question};

use crate::exam::{Asked, Key, TreePart};
use crate::shown::{Shown, Step};

use bbox::Shot;
use camera::Aim;
use encounter::Encounter;
use walk::Walked;

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
pub fn of(asked: &Asked, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    match &asked.question {
        Question::Shapes { shapes, .. } => {
            let encounter = Encounter::of(asked, element, answer)?;
            shapes::draw(&encounter, shapes)
        }
        Question::BBox { min, max, shots } => {
            let &(ray, times) = shots.get(element)?;
            let shot = Shot {
                corners: [*min, *max],
                ray,
                times,
                wanted: wanted_span(&asked.key, element)?,
                slabs: bbox::slabs(&asked.shown, element),
            };
            bbox::draw(&shot, element, answer)
        }
        Question::Camera { camera, samples } => {
            let aim = Aim {
                camera: *camera,
                sample: *samples.on(camera.film).get(element)?,
                wanted: wanted_direction(&asked.key, element)?,
            };
            camera::draw(&aim, element, answer)
        }
        Question::Build {
            shapes,
            max_leaf_size,
        } => {
            let (judged, sweep_cost) = judged_of_tree(&asked.key)?;
            let task = build::Task {
                shapes,
                max_leaf_size: *max_leaf_size,
                judged,
                sweep_cost,
                shown: &asked.shown,
            };
            build::draw(&task, answer)
        }
        Question::Traverse {
            shapes,
            nodes,
            root,
            ..
        } => {
            let encounter = Encounter::of(asked, element, answer)?;
            let walked = Walked {
                shapes,
                nodes,
                root: *root,
                steps: steps(&asked.shown, element),
            };
            let walk = walk::draw(&encounter, &walked);
            Some(walk.unwrap_or_else(|| along::draw(&encounter)))
        }
        Question::BuildAndTraverse { .. } => {
            Some(along::draw(&Encounter::of(asked, element, answer)?))
        }
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

fn judged_of_tree(key: &Key) -> Option<(&[TreePart], Option<f64>)> {
    match key {
        Key::Tree { judged, sweep_cost } => Some((judged, *sweep_cost)),
        Key::Rays { .. }
        | Key::Hits { .. }
        | Key::Spans { .. }
        | Key::FirstHits { .. }
        | Key::Radiance { .. } => None,
    }
}

fn steps(shown: &Shown, element: usize) -> &[Step] {
    match shown {
        Shown::Walks(walks) => walks.get(element).map_or(&[], Vec::as_slice),
        Shown::Nothing | Shown::Slabs(_) | Shown::Sweep(_) => &[],
    }
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod captions;
