//! Boxes in single precision: several right formulas, and wrong ones.

use glam::Vec3;
use protocol::{Interval, Ray};

pub type BoxHit = fn(&Ray, Interval, Vec3, Vec3) -> Option<Interval>;

/// When the ray is in all three slabs, whenever that is; may be empty.
fn slabs(ray: &Ray, min: Vec3, max: Vec3) -> Interval {
    let inverse = 1.0 / ray.dir;
    let (a, b) = ((min - ray.origin) * inverse, (max - ray.origin) * inverse);
    Interval::new(a.min(b).max_element(), a.max(b).min_element())
}

fn clipped(inside: Interval, times: Interval) -> Option<Interval> {
    let both = Interval::new(inside.min.max(times.min), inside.max.min(times.max));
    (both.min <= both.max).then_some(both)
}

/// Axis by axis, with a case for a direction of 0, dividing instead of multiplying.
fn by_axes(ray: &Ray, times: Interval, min: Vec3, max: Vec3) -> Option<Interval> {
    let mut left = times;
    for axis in 0..3 {
        let (o, d) = (ray.origin[axis], ray.dir[axis]);
        if d == 0.0 {
            if o < min[axis] || o > max[axis] {
                return None;
            }
            continue;
        }
        let (mut enter, mut leave) = ((min[axis] - o) / d, (max[axis] - o) / d);
        if enter > leave {
            std::mem::swap(&mut enter, &mut leave);
        }
        left = clipped(Interval::new(enter, leave), left)?;
    }
    Some(left)
}

pub const BOXES: [(&str, BoxHit); 2] = [
    ("slabs", |ray, times, min, max| {
        clipped(slabs(ray, min, max), times)
    }),
    ("axis by axis", by_axes),
];

pub const WRONG_BOXES: [(&str, BoxHit); 13] = [
    ("never", |_, _, _, _| None),
    ("always", |_, times, _, _| Some(times)),
    ("ignores times", |ray, _, min, max| {
        clipped(slabs(ray, min, max), Interval::AHEAD)
    }),
    ("whole line", |ray, _, min, max| {
        let inside = slabs(ray, min, max);
        (inside.min <= inside.max).then_some(inside)
    }),
    ("the ray's range", |ray, _, min, max| {
        clipped(slabs(ray, min, max), ray.range)
    }),
    ("both ends must be in times", |ray, times, min, max| {
        let inside = slabs(ray, min, max);
        let both = times.contains(inside.min) && times.contains(inside.max);
        (both && inside.min <= inside.max).then_some(inside)
    }),
    ("one end must be in times", |ray, times, min, max| {
        let inside = slabs(ray, min, max);
        let one = times.contains(inside.min) || times.contains(inside.max);
        clipped(inside, times).filter(|_| one)
    }),
    ("not clipped", |ray, times, min, max| {
        let inside = slabs(ray, min, max);
        clipped(inside, times).map(|_| inside)
    }),
    ("only clipped at the start", |ray, times, min, max| {
        let inside = slabs(ray, min, max);
        clipped(inside, times).map(|cut| Interval::new(cut.min, inside.max))
    }),
    ("slabs not compared", |ray, times, min, max| {
        let inverse = 1.0 / ray.dir;
        let (a, b) = ((min - ray.origin) * inverse, (max - ray.origin) * inverse);
        let (enter, leave) = (a.min(b), a.max(b));
        let each = (0..3).all(|i| clipped(Interval::new(enter[i], leave[i]), times).is_some());
        each.then(|| {
            Interval::new(
                enter.max_element().max(times.min),
                leave.min_element().min(times.max),
            )
        })
    }),
    ("no swap for negative directions", |ray, times, min, max| {
        let inverse = 1.0 / ray.dir;
        let (a, b) = ((min - ray.origin) * inverse, (max - ray.origin) * inverse);
        clipped(Interval::new(a.max_element(), b.min_element()), times)
    }),
    ("strictly", |ray, times, min, max| {
        clipped(slabs(ray, min, max), times).filter(|cut| cut.min < cut.max)
    }),
    ("parallel rays miss", |ray, times, min, max| {
        let zero = (0..3).any(|i| ray.dir[i] == 0.0);
        clipped(slabs(ray, min, max), times).filter(|_| !zero)
    }),
];
