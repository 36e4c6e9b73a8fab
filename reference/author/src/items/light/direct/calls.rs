//! Calls of `direct` whose answers don't depend on rounding.

use std::f64::consts::TAU;

use glam::{DVec3, Vec2, dvec2};
use judging::drawing_data::PathHit;
use protocol::light::transport::DirectSample;

use super::super::rooms::{is_lit, least_cosine, margin, random_ray};
use super::super::{random, random_pair};
use crate::oracle::Ray64;
use crate::oracle::light::quad::{Material64, Quad};
use crate::oracle::light::room::{Room, Surface64};
use crate::oracle::light::{Numbers64, lambertian, transport};
use crate::seed::Rng;

/// A call of `direct` and everything that its answer depends on.
pub(super) struct DirectCase<'a> {
    room: &'a Room,
    /// The surface that the ray hits.
    pub(super) surface: Surface64,
    numbers: Numbers64,
    /// The direct light, which is the answer.
    pub(super) light: DVec3,
    light_margin: f64,
    /// How far the ray is from hitting a different quad first.
    hit_margin: f64,
}

impl<'a> DirectCase<'a> {
    /// Returns `None` if the ray hits nothing, which isn't tested.
    pub(super) fn new(room: &'a Room, call: &DirectSample) -> Option<Self> {
        let hit = room.hit(&Ray64::from(&call.ray), None);
        let (surface, numbers) = (hit.value?, Numbers64::from(call));
        let light = transport::direct(room, &surface, &numbers);
        Some(DirectCase {
            light: light.value,
            light_margin: light.margin,
            hit_margin: hit.margin,
            room,
            surface,
            numbers,
        })
    }

    pub(super) fn is_matte(&self) -> bool {
        self.surface.kind() == PathHit::Matte
    }

    /// Returns whether the ray hits the surface almost along it.
    pub(super) fn is_grazed(&self) -> bool {
        self.surface.out.z < (2.0 * least_cosine(self.room)).max(0.049)
    }

    pub(super) fn is_lit(&self) -> bool {
        is_lit(self.light)
    }

    /// Returns whether the hit and the answer have large enough margins. `least` is the smallest
    /// margin of the answer, if it isn't the one that the room requires.
    pub(super) fn is_clear(&self, least: Option<f64>) -> bool {
        let of_room = margin(self.room);
        self.hit_margin > of_room
            && self.surface.out.z.abs() > least_cosine(self.room)
            && self.light_margin > least.unwrap_or(of_room)
    }

    /// Returns the sampled direction toward a light, if there is one.
    pub(super) fn sample(&self) -> Option<DVec3> {
        let sources = self.room.sources();
        sources.sample(self.surface.position, &self.numbers).value
    }

    /// Returns the sampled direction toward a light in the surface's frame.
    pub(super) fn local_sample(&self) -> Option<DVec3> {
        let to_local = |direction| self.surface.frame.to_local(direction);
        self.sample().map(to_local)
    }

    /// Returns the direction, in the world, that the surface samples for its direct light.
    pub(super) fn scattered(&self) -> DVec3 {
        let direction = lambertian::sample_cosine_hemisphere(self.numbers.direct);
        self.surface.frame.to_world(direction)
    }

    /// Returns what is seen from the surface in a direction.
    pub(super) fn seen(&self, direction: DVec3) -> Option<Surface64> {
        let ray = transport::ray(self.surface.position, direction);
        self.room.hit(&ray, Some(&self.surface)).value
    }

    /// Returns what is in the way of the sampled direction toward a light, if that direction is above
    /// the surface.
    pub(super) fn blocker(&self) -> Option<Surface64> {
        let direction = self.sample()?;
        let is_above = self.surface.frame.to_local(direction).z > 0.0;
        let is_blocked = is_above && !self.is_lit_from(direction);
        self.seen(direction).filter(|_| is_blocked)
    }

    /// Returns whether light arrives at the surface from a direction without being scattered.
    pub(super) fn is_lit_from(&self, direction: DVec3) -> bool {
        is_lit(transport::emitted(self.room, &self.surface, direction).value)
    }

    /// Returns whether the direction that the surface samples for its direct light leads to a light.
    pub(super) fn scatters_to_a_light(&self) -> bool {
        let direction = self.scattered();
        let pdf = self.room.sources().pdf(self.surface.position, direction);
        self.is_lit_from(direction) && pdf.value > 0.0
    }

    /// Returns whether the surface would get light if it were matte.
    pub(super) fn would_be_lit(&self) -> bool {
        let mut matte = self.surface;
        matte.material = Material64::Lambertian { albedo: DVec3::ONE };
        is_lit(transport::direct(self.room, &matte, &self.numbers).value)
    }
}

/// A way to draw the random numbers of calls of `direct`.
#[derive(Clone, Copy)]
pub(super) struct Aim {
    /// Returns the random numbers for the point on the light and for the scattered direction.
    pairs: fn(&mut Rng, &Room, &Surface64) -> Option<[Vec2; 2]>,
    /// The smallest margin, if it isn't the one that the room requires.
    margin: Option<f64>,
}

/// Any numbers. Some scattered directions lead to a point on a light, since they would hardly ever
/// find a small light by chance.
pub(super) const ANYWHERE: Aim = Aim {
    pairs: |rng, room, surface| {
        let direct = match rng.index(4) {
            0 => toward_a_light(rng, room, surface)?,
            _ => random_pair(rng),
        };
        Some([random_pair(rng), direct])
    },
    margin: None,
};

/// Any numbers, in rooms whose lights look so small that all directions toward them are close to
/// their edges.
pub(super) const FAR: Aim = Aim {
    pairs: |rng, _, _| Some([random_pair(rng), random_pair(rng)]),
    margin: Some(1e-4),
};

/// The scattered direction is almost along the surface.
pub(super) const GRAZING: Aim = Aim {
    pairs: |rng, _, _| Some([random_pair(rng), along_the_surface(rng)]),
    margin: Some(1e-4),
};

/// The scattered direction is almost along the surface, and the direction toward a light leads to the
/// light's lower edge. The room is one of those that [`beside_a_light`] returns.
pub(super) const LOW: Aim = Aim {
    pairs: |rng, _, _| {
        let low = rng.log_uniform(2e-3, 0.2) as f32;
        Some([random_pair(rng).with_y(low), along_the_surface(rng)])
    },
    margin: Some(1e-5),
};

/// Returns calls of `direct` for which a condition is true. Their rays are random and hit a surface.
pub(super) fn direct_calls(
    rng: &mut Rng,
    room: &Room,
    aim: Aim,
    count: usize,
    wanted: impl Fn(&DirectCase) -> bool,
) -> Vec<DirectSample> {
    rng.retry_list(count, |rng| {
        let ray = random_ray(rng, room);
        let surface = room.hit(&Ray64::from(&ray), None).value?;
        let light = random(rng);
        let [on_light, direct] = (aim.pairs)(rng, room, &surface)?;
        let call = DirectSample {
            ray,
            light,
            on_light,
            direct,
        };
        let case = DirectCase::new(room, &call)?;
        (case.is_clear(aim.margin) && wanted(&case)).then_some(call)
    })
}

/// Returns random numbers for which a surface scatters almost along itself.
fn along_the_surface(rng: &mut Rng) -> Vec2 {
    let below_one = 1.0 - rng.log_uniform(6e-8, 9e-7) as f32;
    random_pair(rng).with_x(below_one)
}

/// Returns the random numbers for which a surface scatters toward a random point on a light. Returns
/// `None` if that point is below the surface.
fn toward_a_light(rng: &mut Rng, room: &Room, surface: &Surface64) -> Option<Vec2> {
    let quads = room.quads().iter();
    let is_light = |quad: &&Quad| matches!(quad.material(), Material64::Emitter { .. });
    let lights: Vec<&Quad> = quads.filter(is_light).collect();
    let light = lights.get(rng.index(lights.len().max(1)))?;
    let to = light.shape().at(random_pair(rng).as_dvec2()) - surface.position;
    let direction = surface.frame.to_local(to.normalize());
    // The inverse of `sample_cosine_hemisphere`.
    let turn = libm::atan2(direction.y, direction.x) / TAU;
    let x = 1.0 - direction.z * direction.z;
    (direction.z > 0.0).then(|| dvec2(x, turn - turn.floor()).as_vec2())
}
