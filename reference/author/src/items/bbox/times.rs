//! Which times count.

use glam::DVec3;
use grader::exam::Item;
use protocol::{Interval, Ray};

use super::{bbox_question, hits_and_misses, item, random_box, ray_from_around};
use crate::items::ray;
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::{Rng, Seed};

fn random_point_in(draw: &mut Rng, bounds: &Bounds) -> DVec3 {
    let part = draw.point(0.4) + 0.5;
    bounds.min + part * (bounds.max - bounds.min)
}

pub(super) fn behind(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.behind");
    let bounds = random_box(&mut draw);
    let shots = hits_and_misses(&mut draw, &bounds, |draw| {
        let ray = if draw.coin() {
            ray_from_around(draw, &bounds)
        } else {
            let inside = random_point_in(draw, &bounds);
            let origin = ray_from_around(draw, &bounds).origin.as_dvec3();
            ray(origin, origin + (origin - inside))
        };
        (ray, Interval::AHEAD)
    });
    item(
        "behind",
        [
            "a box behind the ray is missed",
            "Times below times.min do not count, and behind the origin they are negative.",
        ],
        vec![bbox_question(bounds, shots)],
    )
}

pub(super) fn from_inside(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.from_inside");
    let bounds = random_box(&mut draw);
    let shots = hits_and_misses(&mut draw, &bounds, |draw| {
        let origin = if draw.coin() {
            random_point_in(draw, &bounds)
        } else {
            bounds.center() + draw.direction() * 6.0
        };
        let min = draw.uniform(0.0, 0.2) as f32;
        let ray = Ray::new(origin.as_vec3(), draw.direction().as_vec3());
        (ray, Interval::new(min, f32::INFINITY))
    });
    item(
        "from_inside",
        [
            "from inside, the times begin where they are cut off, not behind the ray",
            "A ray that starts in the box has entered it at a negative time. What is returned is \
             clipped to times.",
        ],
        vec![bbox_question(bounds, shots)],
    )
}

pub(super) fn clipped(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.clipped");
    let bounds = random_box(&mut draw);
    let shots = hits_and_misses(&mut draw, &bounds, |draw| {
        let (ray, latest) = if draw.coin() {
            let from = random_point_in(draw, &bounds).as_vec3();
            (Ray::new(from, draw.direction().as_vec3()), 0.5)
        } else {
            (ray_from_around(draw, &bounds), 9.0)
        };
        let min = draw.uniform(0.0, latest);
        let times = (min as f32, (min + draw.uniform(0.5, 6.0)) as f32);
        (ray, Interval::new(times.0, times.1))
    });
    item(
        "clipped",
        [
            "only the part of the times that lies in the box comes back, if any does",
            "Cut at both ends; a box that is entered after times.max or left before times.min is \
             missed.",
        ],
        vec![bbox_question(bounds, shots)],
    )
}

pub(super) fn wholly_inside(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.wholly_inside");
    let bounds = random_box(&mut draw);
    let shots = hits_and_misses(&mut draw, &bounds, |draw| {
        let ray = ray_from_around(draw, &bounds);
        draw.retry(|draw| {
            let (min, size) = (draw.uniform(0.0, 12.0), draw.uniform(0.1, 0.6));
            let times = Interval::new(min as f32, (min + size) as f32);
            // Inside at both ends, or outside all along.
            let beam = Ray64::from(&ray);
            let inside = |t: f32| {
                let point = Bounds::around([beam.at(t.into())]);
                bounds.grown(-0.03).contains(&point)
            };
            let misses = bounds.grown(0.03).span(&beam.within(times)).is_none();
            ((inside(times.min) && inside(times.max)) || misses).then_some((ray, times))
        })
    });
    item(
        "wholly_inside",
        [
            "if the ray is inside during all of the times, all of them come back",
            "Then neither plane is crossed within times: that is a hit, from times.min to times.max.",
        ],
        vec![bbox_question(bounds, shots)],
    )
}

pub(super) fn times_not_range(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.times_not_range");
    let bounds = random_box(&mut draw);
    let shots = hits_and_misses(&mut draw, &bounds, |draw| {
        let ray = ray_from_around(draw, &bounds);
        // One that would hit and one that would miss, whichever is asked.
        let (short, long) = (Interval::new(0.0, 1.0), Interval::new(0.0, 30.0));
        let (range, times) = if draw.coin() {
            (short, long)
        } else {
            (long, short)
        };
        (ray.within(range.min, range.max), times)
    });
    item(
        "times_not_range",
        [
            "the times that are given count, not the ray's own range",
            "BBox::hit is asked about the times it is given; ray.range is the caller's business.",
        ],
        vec![bbox_question(bounds, shots)],
    )
}
