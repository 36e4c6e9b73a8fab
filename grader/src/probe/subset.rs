//! Selects some elements of a question.

use std::ops::Range;

use protocol::{Question, Rays, Samples};

/// Returns a question with only these elements. A question with a single element, such as a tree or
/// a path-traced picture, is returned unchanged.
pub fn subset(question: &Question, elements: Range<usize>) -> Question {
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
