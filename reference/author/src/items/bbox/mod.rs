//! Items of task 3, step 0: boxes.

mod almost_parallel;
mod hits;
mod times;

use glam::DVec3;
use judging::exam::{ExamQuestion, Key};
use protocol::{Corners, Interval, Question, Ray};

use crate::items::{DeclaredItem, draw_items};
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::{Rng, Seed};

type Query = (Ray, Interval);

const QUERIES_OF_EACH_KIND: usize = 12;

/// Returns the items of the task `bbox`.
pub fn items(seed: Seed) -> Vec<DeclaredItem> {
    let all = [
        hits::THROUGH,
        hits::SLAB_AFTER_SLAB,
        hits::OCTANTS,
        times::BEHIND,
        times::FROM_INSIDE,
        times::CLIPPED,
        times::WHOLLY_INSIDE,
        times::TIMES_NOT_RANGE,
        hits::AXIS_PARALLEL,
        hits::FLAT,
    ];
    draw_items(seed, &all)
}

fn bbox_question(bounds: Bounds, queries: Vec<Query>) -> ExamQuestion {
    let expected = |(ray, times): &Query| {
        let span = bounds.span(&Ray64::from(ray).within(*times));
        span.map(|(enter, leave)| Interval::new(enter as f32, leave as f32))
    };
    let spans = queries.iter().map(expected).collect();
    let key = Key::spans(spans);
    let corners = Corners {
        min: bounds.min.as_vec3(),
        max: bounds.max.as_vec3(),
    };
    let queries = queries.into_iter();
    let rows = queries.map(|(ray, times)| protocol::Query { ray, times });
    let question = Question::boxes(corners, rows.collect());
    ExamQuestion::new(question, key)
}

/// Returns a box with sides from 1 to 4 and corners that are exact in single precision.
fn random_box(rng: &mut Rng) -> Bounds {
    let min = rng.point(3.0);
    let size = rng.vector(1.0, 4.0);
    let rounded = |corner: DVec3| corner.as_vec3().as_dvec3();
    Bounds {
        min: rounded(min),
        max: rounded(min + size),
    }
}

/// Returns whether a query hits, or `None` if slightly growing or shrinking both the box and the
/// time interval would change the outcome.
fn clear_outcome(bounds: &Bounds, (ray, times): &Query) -> Option<bool> {
    const MARGIN: f64 = 0.03;
    let ray64 = Ray64::from(ray).within(*times);
    let hits_with = |margin: f64| {
        let grown = bounds.grown(margin);
        // Flat sides stay flat.
        let flat = bounds.min.cmpeq(bounds.max);
        let bounds = Bounds {
            min: DVec3::select(flat, bounds.min, grown.min),
            max: DVec3::select(flat, bounds.max, grown.max),
        };
        let ray64 = Ray64 {
            min: ray64.min - margin,
            max: ray64.max + margin,
            ..ray64
        };
        bounds.span(&ray64).is_some()
    };
    (hits_with(-MARGIN) == hits_with(MARGIN)).then_some(hits_with(0.0))
}

/// Returns queries that hit, followed by as many that miss.
fn hits_and_misses(
    rng: &mut Rng,
    bounds: &Bounds,
    mut query: impl FnMut(&mut Rng) -> Query,
) -> Vec<Query> {
    let mut queries = Vec::new();
    for is_hit in [true, false] {
        for _ in 0..QUERIES_OF_EACH_KIND {
            queries.push(rng.retry(|rng| {
                let query = query(rng);
                (clear_outcome(bounds, &query) == Some(is_hit)).then_some(query)
            }));
        }
    }
    queries
}

/// Creates a question about a random box, with queries that hit it and as many that miss it.
fn random_box_question(
    rng: &mut Rng,
    mut query: impl FnMut(&mut Rng, &Bounds) -> Query,
) -> ExamQuestion {
    let bounds = random_box(rng);
    let queries = hits_and_misses(rng, &bounds, |rng| query(rng, &bounds));
    bbox_question(bounds, queries)
}

/// Returns a ray from a point outside the box toward a point in or near the box.
fn ray_from_around(rng: &mut Rng, bounds: &Bounds) -> Ray {
    let target = bounds.center() + rng.point(1.0) * (bounds.max - bounds.min);
    let origin = bounds.center() + rng.direction() * rng.uniform(6.0, 10.0);
    super::ray(origin, target)
}
