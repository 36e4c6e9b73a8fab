//! A whole question again at another [`Place`]: as dust, and in a room.

use judging::exam::{ExamQuestion, ExpectedHit, Key};
use protocol::{Question, Rays};

use super::place::Place;
use crate::oracle::bbox::Bounds;
use crate::oracle::scan;
use crate::seed::Rng;
use crate::tree::{Tree, decoy};

/// Returns the same question about dust.
///
/// # Panics
///
/// If the question is not about shapes, boxes or trees with a list of rays.
pub(super) fn dust(asked: ExamQuestion) -> ExamQuestion {
    moved(Place::dust(), asked).expect("the question has a list of rays")
}

/// Returns the same question about things that are as large and as far from the origin as those of
/// the Cornell box, whatever their size was. Returns `None` if it is not about a list of rays, or
/// about nothing.
pub(super) fn in_a_room(rng: &mut Rng, asked: &ExamQuestion) -> Option<ExamQuestion> {
    let bounds = match &asked.question {
        Question::Shapes { shapes, .. } | Question::Traverse { shapes, .. } => shapes
            .iter()
            .map(scan::bounds)
            .reduce(|all, next| all.union(&next))?,
        Question::BBox { min, max, .. } => Bounds::new(*min, *max),
        Question::Camera { .. }
        | Question::Build { .. }
        | Question::BuildAndTraverse { .. }
        | Question::Radiance { .. }
        | Question::Done => return None,
    };
    if bounds.diagonal() <= 0.0 {
        return None;
    }
    // Far from the origin, rounding moves everything a little, and what was only just fair need not be.
    rng.retry(|rng| {
        let place = Place::exact_room(rng, bounds.diagonal());
        let moved = moved(place, asked.clone());
        moved.as_ref().is_none_or(is_fair).then_some(moved)
    })
}

/// Returns whether a question about a tree is fair.
fn is_fair(asked: &ExamQuestion) -> bool {
    let tree = Tree::in_question(&asked.question);
    tree.is_none_or(|(tree, rays)| decoy::is_fair(&tree, &rays.to_vec()))
}

/// Returns a question at another place, or `None` if it is not about a list of rays.
fn moved(place: Place, asked: ExamQuestion) -> Option<ExamQuestion> {
    let question = match asked.question {
        Question::Shapes { shapes: all, rays } => Question::Shapes {
            shapes: place.shapes(&all),
            rays: moved_rays(place, rays)?,
        },
        Question::BBox { min, max, queries } => {
            let queries = queries.iter();
            let queries = queries.map(|(ray, times)| (place.ray(ray), place.interval(*times)));
            Question::BBox {
                min: place.point(min),
                max: place.point(max),
                queries: queries.collect(),
            }
        }
        Question::Build {
            shapes: all,
            max_leaf_size,
        } => Question::Build {
            shapes: place.shapes(&all),
            max_leaf_size,
        },
        Question::Traverse {
            shapes: all,
            nodes,
            root,
            rays,
        } => Question::Traverse {
            shapes: place.shapes(&all),
            nodes: nodes.iter().map(|node| place.node(node)).collect(),
            root,
            rays: moved_rays(place, rays)?,
        },
        Question::Camera { .. }
        | Question::BuildAndTraverse { .. }
        | Question::Radiance { .. }
        | Question::Done => return None,
    };
    let key = match asked.key {
        Key::Hits { checks, hits } => Key::Hits {
            checks,
            hits: hits
                .into_iter()
                .map(|hit| hit.map(|hit| moved_hit(place, hit)))
                .collect(),
        },
        Key::Spans { spans } => Key::Spans {
            spans: spans
                .into_iter()
                .map(|span| span.map(|span| place.interval(span)))
                .collect(),
        },
        // A tree's cost is a ratio of areas.
        key @ Key::Tree { .. } => key,
        Key::Rays { .. } | Key::FirstHits { .. } | Key::Radiance { .. } => return None,
    };
    Some(ExamQuestion::new(question, key))
}

/// Returns `None` for the rays of a picture.
fn moved_rays(place: Place, rays: Rays) -> Option<Rays> {
    match rays {
        Rays::List(list) => Some(Rays::List(list.iter().map(|ray| place.ray(ray)).collect())),
        Rays::View(_) => None,
    }
}

fn moved_hit(place: Place, hit: ExpectedHit) -> ExpectedHit {
    ExpectedHit {
        distance: place.length(hit.distance),
        position: place.point(hit.position),
        ..hit
    }
}
