//! Calls that are almost identical to the previous call on the same box.

use protocol::{Interval, Ray};

use super::call::BoxCall;
use crate::domains::Call;
use crate::domains::fields::{
    HARDLY, history_class, is_mirrored, is_same_line, mirrored, moved, turned,
};
use crate::domains::tables::Follow;

/// The ways a call can follow another.
pub(super) const FOLLOW: &[Follow<BoxCall>] = &[
    |_, before| {
        let dir = -before.ray.dir;
        Some(vec![before.with_ray(Ray { dir, ..before.ray })])
    },
    |rng, before| Some(vec![before.with_ray(mirrored(rng, &before.ray)?)]),
    |rng, before| {
        let mut times = before.times;
        let end = if rng.coin() {
            &mut times.min
        } else {
            &mut times.max
        };
        *end *= 1.0 + (rng.sign() * rng.uniform(0.005, 0.028)) as f32;
        let is_other = times != before.times && times.min <= times.max;
        is_other.then(|| vec![BoxCall::new(before.bounds, (before.ray, times))])
    },
    |rng, before| {
        let angle = rng.uniform(0.7, 0.97) * HARDLY;
        Some(vec![before.with_ray(turned(rng, &before.ray, angle))])
    },
    |rng, before| {
        let distance = rng.uniform(0.7, 0.97) * HARDLY * before.size();
        Some(vec![before.with_ray(moved(rng, &before.ray, distance))])
    },
];

/// The class of a call whose direction is virtually the previous call's.
pub(super) const HARDLY_TURNED: &str = "virtually the same direction";

/// The class of a call whose start is virtually the previous call's.
pub(super) const HARDLY_MOVED: &str = "virtually the same start";

/// The classes of the previous call.
pub(super) const CLASSES: &[&str] = &[
    "none",
    "another ray",
    "the same ray with other times",
    "a parallel ray",
    "another ray from the same start",
    "almost the same ray",
    "the opposite direction",
    "a mirrored direction",
    HARDLY_TURNED,
    HARDLY_MOVED,
    "the same ray with almost the same times",
];

/// Returns the class of the previous call.
pub(super) fn class_of(call: &BoxCall) -> usize {
    let Some((before, times)) = &call.before else {
        return 0;
    };
    if is_same_line(before, &call.ray) && are_almost_the_same(times, &call.times) {
        return 10;
    }
    same_times_class(call, before, times).unwrap_or_else(|| {
        let (same_dir, same_start) = (before.dir == call.ray.dir, before.origin == call.ray.origin);
        match (same_dir, same_start) {
            (true, false) => 3,
            (false, true) => 4,
            _ => history_class(Some(before), &call.ray),
        }
    })
}

/// Returns whether two different intervals have almost the same ends.
fn are_almost_the_same(one: &Interval, other: &Interval) -> bool {
    const MOST: f32 = 0.03;
    let are_near = |a: f32, b: f32| a == b || (a - b).abs() <= MOST * a.abs();
    one != other && are_near(one.min, other.min) && are_near(one.max, other.max)
}

/// Returns the class of a previous call with the same times and a closely related ray, or `None` if
/// the previous call wasn't of this kind.
fn same_times_class(call: &BoxCall, before: &Ray, times: &Interval) -> Option<usize> {
    let ray = &call.ray;
    if *times != call.times {
        return None;
    }
    let angle = before.dir.as_dvec3().distance(ray.dir.as_dvec3());
    let between = before.origin.as_dvec3().distance(ray.origin.as_dvec3());
    match (before.dir == ray.dir, before.origin == ray.origin) {
        (true, false) if between < HARDLY * call.size() => Some(9),
        (false, true) if angle < HARDLY => Some(8),
        _ if call.is_after_almost_the_same_ray() => Some(5),
        (false, true) if before.dir == -ray.dir => Some(6),
        _ if is_mirrored(before, ray) => Some(7),
        _ => None,
    }
}

impl BoxCall {
    /// Returns the call with a different ray.
    fn with_ray(&self, ray: Ray) -> Self {
        BoxCall::new(self.bounds, (ray, self.times))
    }
}
