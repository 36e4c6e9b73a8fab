//! Task 3, step 0: boxes.

mod hits;
mod times;

use glam::{DVec3, dvec3};
use grader::exam::{ExamQuestion, Item, Key, Task};
use protocol::{Interval, Question, Ray};

use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::{Rng, Seed};

type Query = (Ray, Interval);

const QUERIES_OF_EACH_KIND: usize = 12;

/// The items of the task `bbox`.
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 10] = [
        hits::through,
        hits::slab_after_slab,
        hits::octants,
        times::behind,
        times::from_inside,
        times::clipped,
        times::wholly_inside,
        times::times_not_range,
        hits::axis_parallel,
        hits::flat,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

fn item(name: &str, text: [&str; 2], questions: Vec<ExamQuestion>) -> Item {
    super::item(Task::BBox, name, 1, text, questions)
}

fn bbox_question(bounds: Bounds, shots: Vec<Query>) -> ExamQuestion {
    let truth = |(ray, times): &Query| {
        let span = bounds.span(&Ray64::from(ray).within(*times));
        span.map(|(enter, leave)| Interval::new(enter as f32, leave as f32))
    };
    let key = Key::Spans {
        spans: shots.iter().map(truth).collect(),
    };
    let question = Question::BBox {
        min: bounds.min.as_vec3(),
        max: bounds.max.as_vec3(),
        queries: shots,
    };
    ExamQuestion::new(question, key)
}

/// A box of sides from 1 to 4, its corners in single precision.
fn random_box(draw: &mut Rng) -> Bounds {
    let min = draw.point(3.0);
    let size = dvec3(
        draw.uniform(1.0, 4.0),
        draw.uniform(1.0, 4.0),
        draw.uniform(1.0, 4.0),
    );
    let single = |corner: DVec3| corner.as_vec3().as_dvec3();
    Bounds {
        min: single(min),
        max: single(min + size),
    }
}

/// Whether a shot hits, if that is beyond doubt: still so if all is a little larger or smaller.
fn clear_outcome(bounds: &Bounds, (ray, times): &Query) -> Option<bool> {
    const MARGIN: f64 = 0.03;
    let beam = Ray64::from(ray).within(*times);
    let with = |margin: f64| {
        let grown = bounds.grown(margin);
        // A flat side stays flat.
        let flat = bounds.min.cmpeq(bounds.max);
        let bounds = Bounds {
            min: DVec3::select(flat, bounds.min, grown.min),
            max: DVec3::select(flat, bounds.max, grown.max),
        };
        let beam = Ray64 {
            min: beam.min - margin,
            max: beam.max + margin,
            ..beam
        };
        bounds.span(&beam).is_some()
    };
    (with(-MARGIN) == with(MARGIN)).then_some(with(0.0))
}

/// Shots that hit, then as many that miss.
fn hits_and_misses(
    draw: &mut Rng,
    bounds: &Bounds,
    mut shot: impl FnMut(&mut Rng) -> Query,
) -> Vec<Query> {
    let mut shots = Vec::new();
    for wanted in [true, false] {
        for _ in 0..QUERIES_OF_EACH_KIND {
            shots.push(draw.retry(|draw| {
                let shot = shot(draw);
                (clear_outcome(bounds, &shot) == Some(wanted)).then_some(shot)
            }));
        }
    }
    shots
}

/// A ray from around the box, toward somewhere in or near it.
fn ray_from_around(draw: &mut Rng, bounds: &Bounds) -> Ray {
    let target = bounds.center() + draw.point(1.0) * (bounds.max - bounds.min);
    let origin = bounds.center() + draw.direction() * draw.uniform(6.0, 10.0);
    super::ray(origin, target)
}
