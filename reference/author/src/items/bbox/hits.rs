//! Rays from all sides.

use glam::{DVec3, Vec3, dvec3};
use grader::exam::Item;
use protocol::{Interval, Ray};

use super::{bbox_question, clear_outcome, hits_and_misses, item, random_box, ray_from_around};
use crate::items::ray;
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::{Rng, Seed};

pub(super) fn through(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.through");
    let mut question = || {
        let bounds = random_box(&mut draw);
        let shots = hits_and_misses(&mut draw, &bounds, |draw| {
            (ray_from_around(draw, &bounds), Interval::AHEAD)
        });
        bbox_question(bounds, shots)
    };
    item(
        "through",
        [
            "a ray through the box is inside from where it enters to where it leaves",
            "Per axis, the ray is between the two planes during one interval of times; it is in the \
             box while it is between all three pairs. Return both ends.",
        ],
        vec![question(), question()],
    )
}

pub(super) fn slab_after_slab(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.slab_after_slab");
    let bounds = random_box(&mut draw);
    // Misses that cross all three slabs ahead, only not at once.
    let shots = hits_and_misses(&mut draw, &bounds, |draw| {
        let ray = draw.retry(|draw| {
            let ray = ray_from_around(draw, &bounds);
            let beam = Ray64::from(&ray);
            let crosses = |axis: usize| {
                let mut slab = Bounds {
                    min: DVec3::NEG_INFINITY,
                    max: DVec3::INFINITY,
                };
                slab.min[axis] = bounds.min[axis];
                slab.max[axis] = bounds.max[axis];
                slab.span(&beam).is_some()
            };
            (0..3).all(crosses).then_some(ray)
        });
        (ray, Interval::AHEAD)
    });
    item(
        "slab_after_slab",
        [
            "a ray that crosses one slab after the other, never all at once, misses",
            "Compare the axes with each other: the ray must have entered the last slab before it \
             leaves the first.",
        ],
        vec![bbox_question(bounds, shots)],
    )
}

pub(super) fn octants(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.octants");
    let bounds = random_box(&mut draw);
    let mut shots = Vec::new();
    for octant in 0..8 {
        let sign = |axis: i32| if octant >> axis & 1 == 0 { 1.0 } else { -1.0 };
        let signs = dvec3(sign(0), sign(1), sign(2));
        for wanted in [true, true, false] {
            shots.push(draw.retry(|draw| {
                let dir = (draw.point(0.35) + 0.6) * signs;
                let target = bounds.center() + draw.point(1.2) * (bounds.max - bounds.min);
                let ray = ray(target - 4.0 * dir.normalize() * 2.0, target);
                let shot = (ray, Interval::AHEAD);
                (clear_outcome(&bounds, &shot) == Some(wanted)).then_some(shot)
            }));
        }
    }
    item(
        "octants",
        [
            "directions of any sign enter where they should",
            "Along an axis on which the direction is negative the ray meets the larger plane first.",
        ],
        vec![bbox_question(bounds, shots)],
    )
}

pub(super) fn axis_parallel(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.axis_parallel");
    let bounds = random_box(&mut draw);
    let zero = |draw: &mut Rng| if draw.coin() { 0.0 } else { -0.0 };
    let shots = hits_and_misses(&mut draw, &bounds, |draw| {
        let target = bounds.center() + draw.point(0.9) * (bounds.max - bounds.min);
        let axis = draw.index(3);
        // Along one axis, or across one.
        let mut dir = Vec3::from([zero(draw), zero(draw), zero(draw)]);
        dir[axis] = draw.sign() as f32;
        if draw.coin() {
            dir[(axis + 1) % 3] = (draw.sign() * draw.uniform(0.4, 0.9)) as f32;
        }
        let ray = Ray::new((target - 7.0 * dir.as_dvec3().normalize()).as_vec3(), dir);
        (ray, Interval::AHEAD)
    });
    item(
        "axis_parallel",
        [
            "directions with components 0 and −0 are no exception",
            "A ray that does not move along an axis is between its planes always or never. Dividing \
             by zero gives infinities that say so: see that no comparison spoils them.",
        ],
        vec![bbox_question(bounds, shots)],
    )
}

pub(super) fn flat(seed: Seed) -> Item {
    let mut draw = seed.rng("bbox.flat");
    let mut question = |axis: usize| {
        let mut bounds = random_box(&mut draw);
        bounds.max[axis] = bounds.min[axis];
        let shots = hits_and_misses(&mut draw, &bounds, |draw| {
            draw.retry(|draw| {
                let target = bounds.center() + draw.point(1.0) * (bounds.max - bounds.min);
                let origin = bounds.center() + draw.direction() * draw.uniform(4.0, 8.0);
                let ray = ray(origin, target);
                let steep = ray.dir[axis].abs() > 0.3;
                steep.then_some((ray, Interval::AHEAD))
            })
        });
        bbox_question(bounds, shots)
    };
    item(
        "flat",
        [
            "a box without thickness can be hit",
            "The box of an axis-parallel triangle is flat: the ray enters and leaves it at the same \
             time. That is a hit.",
        ],
        vec![question(0), question(1), question(2)],
    )
}
