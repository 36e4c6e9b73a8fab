//! Items about hits and misses of rays from all sides.

use glam::{Vec3, dvec3};
use judging::exam::ExamQuestion;
use protocol::{Interval, Ray};

use super::{
    almost_parallel, bbox_question, clear_outcome, hits_and_misses, random_box,
    random_box_question, ray_from_around,
};
use crate::items::place::{Place, dust};
use crate::items::{Declaration, groups, ray};
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

pub(super) const THROUGH: Declaration = Declaration {
    id: "bbox.through",
    title: "for a ray through the box, the times of entry and exit are returned",
    look: "Work out by hand for the ray shown when it is between the two planes of each axis. The \
           answer is the interval that these three intervals and the argument times have in \
           common, or None if there is none.",
    section: "boxes.md#from-the-last-entry-to-the-first-exit",
    questions: |rng| {
        let mut question = || {
            let bounds = random_box(rng);
            let queries = hits_and_misses(rng, &bounds, |rng| {
                (ray_from_around(rng, &bounds), Interval::AHEAD)
            });
            (bounds, queries)
        };
        let [near, far] = [question(), question()];
        let room = Place::room(rng);
        let queries = far.1.iter().map(|query| room.query(query)).collect();
        let far = bbox_question(room.bounds(&far.0), queries);
        vec![bbox_question(near.0, near.1), far]
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const SLAB_AFTER_SLAB: Declaration = Declaration {
    id: "bbox.slab_after_slab",
    title: "a ray that is never in all three slabs at the same time misses",
    look: "Compare the axes with each other, and with times: it is a miss if and only if the \
           latest entry comes after the earliest exit, however small both are.",
    section: "boxes.md#the-slab-intervals-must-overlap",
    questions: |rng| {
        // Hits, and misses that cross all three slabs, but never at the same time.
        let query = |rng: &mut Rng, bounds: &Bounds| {
            let ray = rng.retry(|rng| {
                let ray = ray_from_around(rng, bounds);
                let ray64 = Ray64::from(&ray);
                let crosses = |axis: usize| bounds.slab(axis).span(&ray64).is_some();
                (0..3).all(crosses).then_some(ray)
            });
            (ray, Interval::AHEAD)
        };
        let mut question = || random_box_question(rng, query);
        vec![question(), dust(question())]
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const OCTANTS: Declaration = Declaration {
    id: "bbox.octants",
    title: "rays in all directions enter and leave at the right times",
    look: "On an axis where the direction is negative, the ray reaches the larger plane first.",
    section: "boxes.md#a-negative-direction-swaps-the-planes",
    questions: octants,
    ..Declaration::in_group(groups::BOXES)
};

fn octants(rng: &mut Rng) -> Vec<ExamQuestion> {
    let bounds = random_box(rng);
    let mut queries = Vec::new();
    for octant in 0..8 {
        let sign = |axis: i32| if octant >> axis & 1 == 0 { 1.0 } else { -1.0 };
        let signs = dvec3(sign(0), sign(1), sign(2));
        for is_hit in [true, true, false] {
            queries.push(rng.retry(|rng| {
                let dir = (rng.point(0.35) + 0.6) * signs;
                let target = bounds.center() + rng.point(1.2) * (bounds.max - bounds.min);
                let ray = ray(target - 4.0 * dir.normalize() * 2.0, target);
                let query = (ray, Interval::AHEAD);
                (clear_outcome(&bounds, &query) == Some(is_hit)).then_some(query)
            }));
        }
    }
    vec![bbox_question(bounds, queries)]
}

pub(super) const AXIS_PARALLEL: Declaration = Declaration {
    id: "bbox.axis_parallel",
    title: "directions with components 0, −0 and almost 0 work as well",
    look: "A ray that does not move along an axis is always or never between its planes: dividing \
           by zero gives infinities that say so, if your comparisons handle them. A component that \
           is almost 0 still moves the ray.",
    section: "boxes.md#zero-and-minus-zero",
    questions: |rng| {
        let zero = |rng: &mut Rng| if rng.coin() { 0.0 } else { -0.0 };
        let question = random_box_question(rng, |rng, bounds| {
            let target = bounds.center() + rng.point(0.9) * (bounds.max - bounds.min);
            let axis = rng.index(3);
            // The direction is parallel to an axis, or perpendicular to one.
            let mut dir = Vec3::from([zero(rng), zero(rng), zero(rng)]);
            dir[axis] = rng.sign() as f32;
            if rng.coin() {
                dir[(axis + 1) % 3] = (rng.sign() * rng.uniform(0.4, 0.9)) as f32;
            }
            let ray = Ray::new((target - 7.0 * dir.as_dvec3().normalize()).as_vec3(), dir);
            (ray, Interval::AHEAD)
        });
        vec![question, almost_parallel::question(rng)]
    },
    ..Declaration::in_group(groups::BOXES)
};

pub(super) const FLAT: Declaration = Declaration {
    id: "bbox.flat",
    title: "a box without thickness can be hit",
    look: "The box of an axis-parallel triangle is flat: the ray enters and leaves it at the same \
           time, and that is a hit.",
    section: "boxes.md#flat-boxes-can-be-hit",
    questions: flat,
    ..Declaration::in_group(groups::BOXES)
};

fn flat(rng: &mut Rng) -> Vec<ExamQuestion> {
    let mut question = |axis: usize| {
        let mut bounds = random_box(rng);
        bounds.max[axis] = bounds.min[axis];
        let queries = hits_and_misses(rng, &bounds, |rng| {
            rng.retry(|rng| {
                let target = bounds.center() + rng.point(1.0) * (bounds.max - bounds.min);
                let origin = bounds.center() + rng.direction() * rng.uniform(4.0, 8.0);
                let ray = ray(origin, target);
                let is_steep = ray.dir[axis].abs() > 0.3;
                is_steep.then_some((ray, Interval::AHEAD))
            })
        });
        bbox_question(bounds, queries)
    };
    vec![question(0), question(1), question(2)]
}
