//! Calls of `radiance` whose answers don't depend on rounding.

use glam::{DVec3, UVec2};
use judging::drawing_data::PathStep;
use protocol::light::transport::PathStart;
use protocol::sampler::Sampler;

use super::super::rooms::{is_lit, margin, random_ray};
use crate::oracle::Ray64;
use crate::oracle::light::path_steps::path_steps;
use crate::oracle::light::room::{Room, Surface64};
use crate::oracle::light::{Numbers64, numbers_of_path, transport};
use crate::seed::Rng;

/// A call of `radiance` and everything that its answer depends on.
pub(super) struct PathCase<'a> {
    room: &'a Room,
    ray: Ray64,
    pub(super) numbers: Vec<Numbers64>,
    /// The surface that the ray hits, if any.
    pub(super) first: Option<Surface64>,
    /// How far the ray is from hitting a different quad first.
    hit_margin: f64,
    /// The radiance along the ray, which is the answer.
    pub(super) light: DVec3,
    light_margin: f64,
}

impl<'a> PathCase<'a> {
    pub(super) fn new(room: &'a Room, call: &PathStart) -> Self {
        let (ray, numbers) = (Ray64::from(&call.ray), numbers_of_path(call));
        let hit = room.hit(&ray, None);
        let light = transport::radiance(room, &ray, &numbers);
        PathCase {
            light: light.value,
            light_margin: light.margin,
            first: hit.value,
            hit_margin: hit.margin,
            room,
            ray,
            numbers,
        }
    }

    pub(super) fn is_lit(&self) -> bool {
        is_lit(self.light)
    }

    /// Returns whether the hit and the answer have large enough margins. `least` is the smallest
    /// margin of the answer, if it isn't the one that the room requires.
    pub(super) fn is_clear(&self, least: Option<f64>) -> bool {
        let of_room = margin(self.room);
        self.hit_margin > of_room && self.light_margin > least.unwrap_or(of_room)
    }

    /// Returns whether the ray hits a surface of this kind.
    pub(super) fn starts_at(&self, is_kind: fn(&Surface64) -> bool) -> bool {
        self.first.as_ref().is_some_and(is_kind)
    }

    /// Returns the surface that the path hits after the first one.
    pub(super) fn second(&self) -> Option<Surface64> {
        transport::next_surface(self.room, self.first.as_ref()?, &self.numbers[0])
    }

    /// Returns the radiance along the ray with other random numbers.
    pub(super) fn light_with(&self, numbers: &[Numbers64]) -> DVec3 {
        transport::radiance(self.room, &self.ray, numbers).value
    }

    /// Returns the radiance along the ray with the maximum number of bounces reduced by one.
    pub(super) fn without_the_last(&self) -> DVec3 {
        self.light_with(&self.numbers[..self.numbers.len() - 1])
    }

    /// Returns the surfaces that the path hits up to this number of bounces, as if it always
    /// survived.
    pub(super) fn surfaces(&self, bounces: usize) -> Vec<Surface64> {
        transport::surfaces(self.room, &self.ray, &self.numbers[..bounces])
    }

    /// Returns the steps of the path.
    pub(super) fn steps(&self) -> Vec<PathStep> {
        path_steps(self.room, &self.ray, &self.numbers)
    }

    /// Returns whether the radiance hardly changes if the ray starts slightly beside its origin. In
    /// long paths, rounding errors can grow at each bounce.
    pub(super) fn is_stable(&self) -> bool {
        /// The distance by which the origin is moved, relative to its coordinates. Rounding to single
        /// precision moves a point by about 1e-7.
        const SHIFT: f64 = 3e-6;
        /// The largest relative change in the radiance: half the tolerance.
        const CHANGE: f64 = 5e-4;
        let (center, half) = self.room.extent();
        let shift = SHIFT * (center.length() + half.max_element());
        DVec3::AXES.into_iter().all(|axis| {
            let shifted = Ray64 {
                origin: self.ray.origin + shift * axis,
                ..self.ray
            };
            let light = transport::radiance(self.room, &shifted, &self.numbers).value;
            let change = (light - self.light).abs();
            change.cmple(CHANGE * self.light).all()
        })
    }
}

/// A way to draw the seeds of paths.
#[derive(Clone, Copy)]
pub(super) struct Seeds {
    draw: fn(&mut Rng) -> u32,
    /// The smallest margin, if it isn't the one that the room requires.
    margin: Option<f64>,
}

/// Any seeds.
pub(super) const ANY: Seeds = Seeds {
    draw: |rng| rng.integer(0, 1 << 30),
    margin: None,
};

/// Seeds that make a matte first surface scatter almost along itself, at a cosine between 2.4e-4 and
/// 2.8e-3. Only about one in 120,000 seeds does.
pub(super) const GRAZING: Seeds = Seeds {
    draw: |rng| {
        let start = (ANY.draw)(rng);
        let is_grazing = |seed: &u32| {
            let numbers = Sampler::new((*seed).into(), UVec2::ZERO, 0).numbers(0);
            numbers.scatter.x > 1.0 - 8e-6
        };
        (start..).find(is_grazing).unwrap_or(start)
    },
    margin: Some(1e-4),
};

/// Returns calls of `radiance` for which a condition is true. Their rays are random.
pub(super) fn path_calls(
    rng: &mut Rng,
    room: &Room,
    bounces: u32,
    seeds: Seeds,
    count: usize,
    wanted: impl Fn(&PathCase) -> bool,
) -> Vec<PathStart> {
    rng.retry_list(count, |rng| {
        let ray = random_ray(rng, room);
        let seed = (seeds.draw)(rng);
        let call = PathStart { ray, seed, bounces };
        let case = PathCase::new(room, &call);
        (case.is_clear(seeds.margin) && wanted(&case)).then_some(call)
    })
}
