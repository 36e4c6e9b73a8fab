//! Calls to `BBox::hit`.

use glam::Vec3;
use protocol::{Interval, Query, Question, Ray};

use crate::domains::fields;
use crate::domains::{Aimed, Call, Placed};
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

/// Direction components below this limit count as almost 0.
pub(super) const SMALL_COMPONENT: f32 = 1e-4;

/// A call to `BBox::hit`.
#[derive(Clone, Copy, Debug)]
pub struct BoxCall {
    /// The box. Its corners are exact in single precision.
    pub bounds: Bounds,
    /// The ray.
    pub ray: Ray,
    /// The times.
    pub times: Interval,
    /// The arguments of the previous call, if it was about the same box.
    pub(super) before: Option<(Ray, Interval)>,
}

/// Returns the calls in a question about a box.
pub(super) fn calls(question: &Question) -> Vec<BoxCall> {
    let Question::BBoxHit(table) = question else {
        return Vec::new();
    };
    let bounds = Bounds::new(table.subject.min, table.subject.max);
    let rows = table.rows.to_vec();
    let mut before = None;
    let calls = rows.iter().map(|&Query { ray, times }| BoxCall {
        bounds,
        ray,
        times,
        before: before.replace((ray, times)),
    });
    calls.collect()
}

impl BoxCall {
    /// Returns whether the answers to the two calls clearly differ.
    pub(super) fn differs(&self, other: &Self) -> bool {
        let spans = [self, other].map(|call| call.bounds.span(&call.ray64()));
        let [Some(one), Some(other)] = spans else {
            return spans[0].is_some() != spans[1].is_some();
        };
        let far = self.ray.origin.as_dvec3().abs().max_element() + self.bounds.diagonal();
        let scale = far.max(
            self.bounds
                .min
                .abs()
                .max(self.bounds.max.abs())
                .max_element(),
        );
        let is_other = |a: f64, b: f64| a != b && (a - b).abs() > 2.2e-4 * scale;
        is_other(one.0, other.0) || is_other(one.1, other.1)
    }

    /// Returns half of the longest side.
    pub(super) fn size(&self) -> f64 {
        self.bounds.half_side()
    }

    /// Returns the ray with its range replaced by the times of the call.
    pub fn ray64(&self) -> Ray64 {
        Ray64::from(&self.ray).within(self.times)
    }

    /// Returns whether the times range from 0 to ∞.
    pub fn is_unlimited(&self) -> bool {
        self.times == Interval::AHEAD
    }

    /// Returns whether the thickness of the box is 0 along an axis.
    pub fn is_flat(&self) -> bool {
        self.bounds.min.cmpeq(self.bounds.max).any()
    }

    /// Returns the distance between the box's centre and the ray's line, as a multiple of half the
    /// diagonal.
    pub(super) fn distance_of_line(&self) -> f64 {
        let to_center = self.bounds.center() - self.ray.origin.as_dvec3();
        let dir = self.ray.dir.as_dvec3();
        to_center.reject_from(dir).length() / (0.5 * self.bounds.diagonal())
    }

    /// Returns the number of axes along which the box is thick and the ray starts in the plane of a
    /// face.
    pub(super) fn faces_at_start(&self) -> usize {
        let start = self.ray.origin.as_dvec3();
        let is_on = start.cmpeq(self.bounds.min) | start.cmpeq(self.bounds.max);
        is_on.bitmask().count_ones() as usize
    }

    /// Returns whether the previous call was about almost the same ray with the same times.
    pub(super) fn is_after_almost_the_same_ray(&self) -> bool {
        self.before.is_some_and(|(ray, times)| {
            times == self.times && fields::is_almost_the_same_ray(&ray, &self.ray)
        })
    }

    /// Returns whether the direction has a component that is 0.
    pub fn is_parallel(&self) -> bool {
        self.ray.dir.cmpeq(Vec3::ZERO).any()
    }

    /// Returns whether the ray starts in the box.
    pub fn starts_inside(&self) -> bool {
        let start = Bounds::around([self.ray.origin.as_dvec3()]);
        self.bounds.contains(&start)
    }

    /// Returns whether it matters that a component of the direction is almost 0 rather than exactly
    /// 0.
    pub fn is_decided_by_slant(&self) -> bool {
        let would_hit = self.with_zeros().map(|call| call.is_hit());
        would_hit.is_some_and(|would_hit| would_hit != self.is_hit())
    }

    /// Returns the call with all almost-zero components of the direction set to 0, or `None` if
    /// there are no such components.
    fn with_zeros(&self) -> Option<BoxCall> {
        let is_small = self.ray.dir.abs().cmplt(Vec3::splat(SMALL_COMPONENT));
        let dir = Vec3::select(is_small, Vec3::ZERO, self.ray.dir);
        let ray = Ray { dir, ..self.ray };
        (dir != self.ray.dir).then_some(BoxCall { ray, ..*self })
    }

    /// Returns the times at which the ray's line enters and leaves the box, ignoring the call's own
    /// times.
    pub fn crossing(&self) -> Option<(f64, f64)> {
        let whole = Interval::new(f32::NEG_INFINITY, f32::INFINITY);
        self.bounds.span(&Ray64::from(&self.ray).within(whole))
    }

    /// Returns whether this line, which misses the box, would hit a slightly larger box.
    pub(super) fn is_narrow_miss(&self, line: &Ray64) -> bool {
        /// The margin, as a multiple of the box's size.
        const NARROW: f64 = 0.002;
        let larger = self.bounds.grown(NARROW * self.size());
        larger.span(line).is_some()
    }
}

impl Call for BoxCall {
    type Subject = Bounds;
    type Input = (Ray, Interval);

    fn new(bounds: Bounds, (ray, times): (Ray, Interval)) -> Self {
        BoxCall {
            bounds,
            ray,
            times,
            before: None,
        }
    }

    fn subject(&self) -> Bounds {
        self.bounds
    }

    fn input(&self) -> (Ray, Interval) {
        (self.ray, self.times)
    }

    fn is_hit(&self) -> bool {
        self.bounds.span(&self.ray64()).is_some()
    }

    fn with_other_range(&self, rng: &mut Rng) -> Option<Self> {
        let (_, leave) = self.bounds.span(&self.ray64())?;
        let leave = if leave.is_finite() { leave } else { 0.0 };
        let times = fields::range(rng, leave + 2.0 * self.size());
        Some(BoxCall { times, ..*self })
    }
}

impl Aimed for BoxCall {
    fn ray(&self) -> &Ray {
        &self.ray
    }
}

impl Placed for BoxCall {
    fn bounds(&self) -> Option<Bounds> {
        (self.bounds.half_side() > 0.0).then_some(self.bounds)
    }
}
