//! Rays from all sides.

use glam::{DVec3, Vec3, dvec3};
use grader::exam::Item;
use protocol::{Interval, Ray};

use super::{asked, both, bounds, from_around, hits, item};
use crate::items::ray;
use crate::oracle::Beam;
use crate::oracle::bbox::Bounds;
use crate::seed::{Draw, Seed};

pub(super) fn through(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.through");
    let mut question = || {
        let bounds = bounds(&mut draw);
        let shots = both(&mut draw, &bounds, |draw| {
            (from_around(draw, &bounds), Interval::AHEAD)
        });
        asked(bounds, shots)
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
    let mut draw = seed.draw("bbox.slab_after_slab");
    let bounds = bounds(&mut draw);
    // Misses that cross all three slabs ahead, only not at once.
    let shots = both(&mut draw, &bounds, |draw| {
        let ray = draw.until(|draw| {
            let ray = from_around(draw, &bounds);
            let beam = Beam::from(&ray);
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
        vec![asked(bounds, shots)],
    )
}

pub(super) fn octants(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.octants");
    let bounds = bounds(&mut draw);
    let mut shots = Vec::new();
    for octant in 0..8 {
        let sign = |axis: i32| if octant >> axis & 1 == 0 { 1.0 } else { -1.0 };
        let signs = dvec3(sign(0), sign(1), sign(2));
        for wanted in [true, true, false] {
            shots.push(draw.until(|draw| {
                let dir = (draw.point(0.35) + 0.6) * signs;
                let target = bounds.center() + draw.point(1.2) * (bounds.max - bounds.min);
                let ray = ray(target - 4.0 * dir.normalize() * 2.0, target);
                let shot = (ray, Interval::AHEAD);
                (hits(&bounds, &shot) == Some(wanted)).then_some(shot)
            }));
        }
    }
    item(
        "octants",
        [
            "directions of any sign enter where they should",
            "Along an axis on which the direction is negative the ray meets the larger plane first.",
        ],
        vec![asked(bounds, shots)],
    )
}

pub(super) fn axis_parallel(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.axis_parallel");
    let bounds = bounds(&mut draw);
    let zero = |draw: &mut Draw| if draw.coin() { 0.0 } else { -0.0 };
    let shots = both(&mut draw, &bounds, |draw| {
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
        vec![asked(bounds, shots)],
    )
}

pub(super) fn flat(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.flat");
    let mut question = |axis: usize| {
        let mut bounds = bounds(&mut draw);
        bounds.max[axis] = bounds.min[axis];
        let shots = both(&mut draw, &bounds, |draw| {
            draw.until(|draw| {
                let target = bounds.center() + draw.point(1.0) * (bounds.max - bounds.min);
                let origin = bounds.center() + draw.direction() * draw.uniform(4.0, 8.0);
                let ray = ray(origin, target);
                let steep = ray.dir[axis].abs() > 0.3;
                steep.then_some((ray, Interval::AHEAD))
            })
        });
        asked(bounds, shots)
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
