//! Selects some elements of a question, of its key and of its answer.

use std::ops::Range;

use protocol::{Answer, Question, Rays, Samples};

use super::Key;

/// Returns a question with only these elements. A question with a single element, such as a tree or
/// a path-traced picture, is returned unchanged.
pub fn question_subset(question: &Question, elements: Range<usize>) -> Question {
    let some = |rays: &Rays| Rays::List(rays.to_vec()[elements.clone()].to_vec());
    match question {
        Question::Camera { camera, samples } => Question::Camera {
            camera: *camera,
            samples: Samples::List(samples.to_vec(camera.film)[elements].to_vec()),
        },
        Question::Shapes { shapes, rays } => Question::Shapes {
            shapes: shapes.clone(),
            rays: some(rays),
        },
        Question::Traverse {
            shapes,
            nodes,
            root,
            rays,
        } => Question::Traverse {
            shapes: shapes.clone(),
            nodes: nodes.clone(),
            root: *root,
            rays: some(rays),
        },
        Question::BuildAndTraverse {
            shapes,
            max_leaf_size,
            rays,
        } => Question::BuildAndTraverse {
            shapes: shapes.clone(),
            max_leaf_size: *max_leaf_size,
            rays: some(rays),
        },
        Question::BBox { min, max, queries } => Question::BBox {
            min: *min,
            max: *max,
            queries: queries[elements].to_vec(),
        },
        Question::Build { .. } | Question::Radiance { .. } | Question::Done => question.clone(),
    }
}

/// Returns the key of one element. A key with a single element is returned unchanged.
pub(super) fn single_key(key: &Key, element: usize) -> Key {
    match key {
        Key::Rays { checks, directions } => Key::Rays {
            checks: checks.clone(),
            directions: vec![directions[element]],
        },
        Key::Hits { checks, hits } => Key::Hits {
            checks: checks.clone(),
            hits: vec![hits[element]],
        },
        Key::Spans { spans } => Key::Spans {
            spans: vec![spans[element]],
        },
        Key::FirstHits { hits, alternatives } => Key::FirstHits {
            hits: vec![hits[element]],
            alternatives: alternatives
                .iter()
                .filter(|(position, _)| *position as usize == element)
                .map(|(_, surface)| (0, *surface))
                .collect(),
        },
        Key::Tree { .. } | Key::Radiance { .. } => key.clone(),
    }
}

/// Returns the answer to one element, or `None` if it is missing. An answer with a single element is
/// returned unchanged.
pub fn single_answer(answer: &Answer, element: usize) -> Option<Answer> {
    Some(match answer {
        Answer::Rays(rays) => Answer::Rays(vec![rays.get(element)?.clone()]),
        Answer::Hits(hits) => Answer::Hits(vec![hits.get(element)?.clone()]),
        Answer::Spans(spans) => Answer::Spans(vec![spans.get(element)?.clone()]),
        Answer::Tree(_) | Answer::Picture(_) | Answer::Done => answer.clone(),
    })
}
