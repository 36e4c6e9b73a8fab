//! Items about the times that count.

use glam::DVec3;
use judging::exam::ExamQuestion;
use protocol::{Interval, Ray};

use super::{Query, random_box_question, ray_from_around};
use crate::items::place::dust;
use crate::items::{Declaration, groups, ray};
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

fn random_point_in(rng: &mut Rng, bounds: &Bounds) -> DVec3 {
    let fraction = rng.point(0.4) + 0.5;
    bounds.min + fraction * (bounds.max - bounds.min)
}

pub(super) const BEHIND: Declaration = Declaration {
    id: "bbox.behind",
    title: "a box behind the ray is missed",
    look: "Behind the origin the times are negative, so nothing of the ray's way through the box \
           is within times. An interval that would end before it begins is a miss.",
    section: "boxes.md#use-times-and-not-the-range-of-the-ray",
    questions: |rng| {
        vec![random_box_question(rng, |rng, bounds| {
            let ray = if rng.coin() {
                ray_from_around(rng, bounds)
            } else {
                let inside = random_point_in(rng, bounds);
                let origin = ray_from_around(rng, bounds).origin.as_dvec3();
                ray(origin, origin + (origin - inside))
            };
            (ray, Interval::AHEAD)
        })]
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const FROM_INSIDE: Declaration = Declaration {
    id: "bbox.from_inside",
    title: "from inside, the interval starts at times.min, not behind the ray",
    look: "A ray that starts in the box has entered it at a negative time: clip the interval to \
           times.",
    section: "boxes.md#clip-the-result-to-times",
    questions: |rng| {
        vec![random_box_question(rng, |rng, bounds| {
            let origin = if rng.coin() {
                random_point_in(rng, bounds)
            } else {
                bounds.center() + rng.direction() * 6.0
            };
            let min = rng.uniform(0.0, 0.2) as f32;
            let ray = Ray::new(origin.as_vec3(), rng.direction().as_vec3());
            (ray, Interval::new(min, f32::INFINITY))
        })]
    },
    ..Declaration::in_group(groups::BOXES)
};

fn random_query(rng: &mut Rng, bounds: &Bounds) -> Query {
    let (ray, latest) = if rng.coin() {
        let from = random_point_in(rng, bounds).as_vec3();
        (Ray::new(from, rng.direction().as_vec3()), 0.5)
    } else {
        (ray_from_around(rng, bounds), 9.0)
    };
    let min = rng.uniform(0.0, latest);
    // Half of the intervals are so short that many end inside the box.
    let longest = if rng.coin() { 1.5 } else { 6.0 };
    let times = (min as f32, (min + rng.uniform(0.3, longest)) as f32);
    (ray, Interval::new(times.0, times.1))
}

/// Returns whether the times of a query begin and whether they end inside the box, or `None` if the
/// query misses it.
fn ends_inside(bounds: &Bounds, (ray, times): &Query) -> Option<(bool, bool)> {
    let (enter, leave) = bounds.span(&Ray64::from(ray).within(*times))?;
    Some((enter == f64::from(times.min), leave == f64::from(times.max)))
}

pub(super) const CLIPPED: Declaration = Declaration {
    id: "bbox.clipped",
    title: "only the part of times in which the ray is in the box is returned",
    look: "Clip the interval at both ends. If the ray's line passes through the box, it is a miss \
           only if the box is entered after times.max or left before times.min.",
    section: "boxes.md#clip-the-result-to-times",
    questions: clipped,
    ..Declaration::in_group(groups::BOXES)
};

fn clipped(rng: &mut Rng) -> Vec<ExamQuestion> {
    let mut question = || {
        // Hits begin inside the box, end inside it, do both, and do neither, in turn.
        let mut count = 0;
        random_box_question(rng, |rng, bounds| {
            rng.retry(|rng| {
                let query = random_query(rng, bounds);
                let Some(inside) = ends_inside(bounds, &query) else {
                    return Some(query);
                };
                let is_in_turn = inside == (count % 2 == 0, count / 2 % 2 == 0);
                count += usize::from(is_in_turn);
                is_in_turn.then_some(query)
            })
        })
    };
    vec![question(), dust(question())]
}

pub(super) const WHOLLY_INSIDE: Declaration = Declaration {
    id: "bbox.wholly_inside",
    title: "if the ray is in the box during all of times, all of times is returned",
    look: "The ray then crosses no plane within times, but it is a hit, from times.min to \
           times.max.",
    section: "boxes.md#a-range-wholly-inside-the-box-is-a-hit",
    questions: wholly_inside,
    ..Declaration::in_group(groups::BOXES)
};

fn wholly_inside(rng: &mut Rng) -> Vec<ExamQuestion> {
    vec![random_box_question(rng, |rng, bounds| {
        let ray = ray_from_around(rng, bounds);
        rng.retry(|rng| {
            let (min, size) = (rng.uniform(0.0, 12.0), rng.uniform(0.1, 0.6));
            let times = Interval::new(min as f32, (min + size) as f32);
            // The ray is either inside the box at both ends of `times`, or outside the box
            // throughout `times`.
            let ray64 = Ray64::from(&ray);
            let inside = |t: f32| {
                let point = Bounds::around([ray64.at(t.into())]);
                bounds.grown(-0.03).contains(&point)
            };
            let misses = bounds.grown(0.03).span(&ray64.within(times)).is_none();
            ((inside(times.min) && inside(times.max)) || misses).then_some((ray, times))
        })
    })]
}

pub(super) const TIMES_NOT_RANGE: Declaration = Declaration {
    id: "bbox.times_not_range",
    title: "the times argument counts, not the ray's own range",
    look: "BBox::hit uses only the times that it is given; ray.range is up to the caller.",
    section: "boxes.md#use-times-and-not-the-range-of-the-ray",
    questions: |rng| {
        vec![random_box_question(rng, |rng, bounds| {
            let ray = ray_from_around(rng, bounds);
            // One interval gives a hit and the other a miss; one becomes `times`, the other the range.
            let (short, long) = (Interval::new(0.0, 1.0), Interval::new(0.0, 30.0));
            let (range, times) = if rng.coin() {
                (short, long)
            } else {
                (long, short)
            };
            (ray.within(range.min, range.max), times)
        })]
    },
    ..Declaration::in_group(groups::BOXES)
};
