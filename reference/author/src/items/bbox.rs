//! Task 3, step 0: boxes.

use glam::{DVec3, Vec3, dvec3};
use grader::exam::{Asked, Item, Key, Task};
use protocol::{Interval, Question, Ray};

use crate::oracle::Beam;
use crate::oracle::bbox::Bounds;
use crate::seed::{Draw, Seed};

type Shot = (Ray, Interval);

const RAYS: usize = 12;

/// The items of the task `bbox`.
pub fn items(seed: Seed) -> Vec<Item> {
    let all: [fn(Seed) -> Item; 10] = [
        through,
        slab_after_slab,
        octants,
        behind,
        from_inside,
        clipped,
        wholly_inside,
        times_not_range,
        axis_parallel,
        flat,
    ];
    all.into_iter().map(|item| item(seed)).collect()
}

fn item(name: &str, text: [&str; 2], questions: Vec<Asked>) -> Item {
    super::item(Task::BBox, name, 1, text, questions)
}

fn asked(bounds: Bounds, shots: Vec<Shot>) -> Asked {
    let truth = |(ray, times): &Shot| {
        let span = bounds.span(&Beam::from(ray).within(*times));
        span.map(|(enter, leave)| Interval::new(enter as f32, leave as f32))
    };
    Asked {
        key: Key::Spans {
            spans: shots.iter().map(truth).collect(),
        },
        question: Question::BBox {
            min: bounds.min.as_vec3(),
            max: bounds.max.as_vec3(),
            shots,
        },
    }
}

/// A box of sides from 1 to 4, its corners in single precision.
fn bounds(draw: &mut Draw) -> Bounds {
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

fn point_in(draw: &mut Draw, bounds: &Bounds) -> DVec3 {
    let part = draw.point(0.4) + 0.5;
    bounds.min + part * (bounds.max - bounds.min)
}

/// Whether a shot hits, if that is beyond doubt: still so if all is a little larger or smaller.
fn hits(bounds: &Bounds, (ray, times): &Shot) -> Option<bool> {
    const MARGIN: f64 = 0.03;
    let beam = Beam::from(ray).within(*times);
    let with = |margin: f64| {
        let grown = bounds.grown(margin);
        // A flat side stays flat.
        let flat = bounds.min.cmpeq(bounds.max);
        let bounds = Bounds {
            min: DVec3::select(flat, bounds.min, grown.min),
            max: DVec3::select(flat, bounds.max, grown.max),
        };
        let beam = Beam {
            min: beam.min - margin,
            max: beam.max + margin,
            ..beam
        };
        bounds.span(&beam).is_some()
    };
    (with(-MARGIN) == with(MARGIN)).then_some(with(0.0))
}

/// Shots that hit, then as many that miss.
fn both(draw: &mut Draw, bounds: &Bounds, mut shot: impl FnMut(&mut Draw) -> Shot) -> Vec<Shot> {
    let mut shots = Vec::new();
    for wanted in [true, false] {
        for _ in 0..RAYS {
            shots.push(draw.until(|draw| {
                let shot = shot(draw);
                (hits(bounds, &shot) == Some(wanted)).then_some(shot)
            }));
        }
    }
    shots
}

/// A ray from around the box, toward somewhere in or near it.
fn from_around(draw: &mut Draw, bounds: &Bounds) -> Ray {
    let target = bounds.center() + draw.point(1.0) * (bounds.max - bounds.min);
    let origin = bounds.center() + draw.direction() * draw.uniform(6.0, 10.0);
    super::ray(origin, target)
}

fn through(seed: Seed) -> Item {
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

fn slab_after_slab(seed: Seed) -> Item {
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

fn octants(seed: Seed) -> Item {
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
                let ray = super::ray(target - 4.0 * dir.normalize() * 2.0, target);
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

fn behind(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.behind");
    let bounds = bounds(&mut draw);
    let shots = both(&mut draw, &bounds, |draw| {
        let ahead = from_around(draw, &bounds);
        let ray = if draw.coin() {
            ahead
        } else {
            Ray::new(ahead.origin, -ahead.dir)
        };
        (ray, Interval::AHEAD)
    });
    item(
        "behind",
        [
            "a box behind the ray is missed",
            "Times below times.min do not count, and behind the origin they are negative.",
        ],
        vec![asked(bounds, shots)],
    )
}

fn from_inside(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.from_inside");
    let bounds = bounds(&mut draw);
    let shots = both(&mut draw, &bounds, |draw| {
        let origin = if draw.coin() {
            point_in(draw, &bounds)
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
        vec![asked(bounds, shots)],
    )
}

fn clipped(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.clipped");
    let bounds = bounds(&mut draw);
    let shots = both(&mut draw, &bounds, |draw| {
        let ray = from_around(draw, &bounds);
        let min = draw.uniform(0.0, 9.0);
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
        vec![asked(bounds, shots)],
    )
}

fn wholly_inside(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.wholly_inside");
    let bounds = bounds(&mut draw);
    let shots = both(&mut draw, &bounds, |draw| {
        let ray = from_around(draw, &bounds);
        draw.until(|draw| {
            let (min, size) = (draw.uniform(0.0, 12.0), draw.uniform(0.1, 0.6));
            let times = Interval::new(min as f32, (min + size) as f32);
            // Inside at both ends, or outside all along.
            let beam = Beam::from(&ray);
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
        vec![asked(bounds, shots)],
    )
}

fn times_not_range(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.times_not_range");
    let bounds = bounds(&mut draw);
    let shots = both(&mut draw, &bounds, |draw| {
        let ray = from_around(draw, &bounds);
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
        vec![asked(bounds, shots)],
    )
}

fn axis_parallel(seed: Seed) -> Item {
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

fn flat(seed: Seed) -> Item {
    let mut draw = seed.draw("bbox.flat");
    let mut question = |axis: usize| {
        let mut bounds = bounds(&mut draw);
        bounds.max[axis] = bounds.min[axis];
        let shots = both(&mut draw, &bounds, |draw| {
            draw.until(|draw| {
                let target = bounds.center() + draw.point(1.0) * (bounds.max - bounds.min);
                let origin = bounds.center() + draw.direction() * draw.uniform(4.0, 8.0);
                let ray = super::ray(origin, target);
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
