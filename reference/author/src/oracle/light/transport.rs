//! The light along a path: direct light at a surface, and the radiance along a ray.

use glam::DVec3;

use super::quad::Material64;
use super::room::{Room, Surface64};
use super::{Numbers64, Scattered64, WithMargin, lambertian, specular};
use crate::oracle::Ray64;

/// From this bounce on, a path survives only by chance.
const FIRST_ROULETTE: usize = 3;

/// Nothing is decided, and no light arrives.
const DARK: WithMargin<DVec3> = WithMargin {
    value: DVec3::ZERO,
    margin: f64::INFINITY,
};

/// The part of a path up to a surface.
#[derive(Clone, Copy)]
struct PathSoFar<'a> {
    /// The surface that the path leaves, or `None` at the camera.
    from: Option<&'a Surface64>,
    /// The product of all attenuations, divided by the probabilities of survival.
    throughput: DVec3,
    /// The number of earlier bounces.
    bounce: usize,
    /// Whether the light that the path arrives at has been counted as direct light already.
    is_counted: bool,
}

/// Returns the direct light that a surface scatters back along the path: one sample of the light
/// sources and one of the material, weighted by the balance heuristic. See Veach, *Robust Monte
/// Carlo Methods for Light Transport Simulation*, 1997, section 9.2.2. A sample with density p, in a
/// direction that the other strategy has density q for, has the weight p / (p + q).
pub fn direct(room: &Room, surface: &Surface64, numbers: &Numbers64) -> WithMargin<DVec3> {
    let Material64::Lambertian { albedo } = surface.material else {
        return DARK;
    };
    let toward_light = from_light_sample(room, surface, albedo, numbers);
    let scattered = lambertian::scatter(albedo, surface.out, numbers.direct);
    let by_material = from_scattering(room, surface, &scattered);
    toward_light.and(toward_light.value + by_material.value, by_material.margin)
}

/// Returns the weighted contribution of the sampled direction toward a light.
fn from_light_sample(
    room: &Room,
    surface: &Surface64,
    albedo: DVec3,
    numbers: &Numbers64,
) -> WithMargin<DVec3> {
    let sample = room.sources().sample(surface.position, numbers);
    let Some(direction) = sample.value else {
        return sample.and(DVec3::ZERO, f64::INFINITY);
    };
    let incoming = surface.frame.to_local(direction);
    let sample = sample.and(sample.value, incoming.z.abs());
    if incoming.z <= 0.0 {
        return sample.and(DVec3::ZERO, f64::INFINITY);
    }
    let light = weighted(room, surface, direction, |pdf| {
        // Rounding can move a sampled point across the light's edge. The margin is small, then.
        if pdf == 0.0 {
            return DVec3::ZERO;
        }
        let weight = pdf / (pdf + lambertian::pdf(surface.out, incoming));
        weight * lambertian::evaluate(albedo, surface.out, incoming) / pdf
    });
    sample.and(light.value, light.margin)
}

/// Returns the weighted contribution of the direction that a matte surface scatters to.
fn from_scattering(room: &Room, surface: &Surface64, scattered: &Scattered64) -> WithMargin<DVec3> {
    let own_pdf = scattered.pdf.unwrap_or(0.0);
    if own_pdf == 0.0 {
        return DARK;
    }
    let direction = surface.frame.to_world(scattered.direction);
    let light = weighted(room, surface, direction, |light_pdf| {
        scattered.attenuation / (1.0 + light_pdf / own_pdf)
    });
    // A ray along the surface itself can hit it again.
    light.and(light.value, scattered.direction.z)
}

/// Returns the light that arrives at a surface straight from a light or the environment, times the
/// factor for the density with which the light sources are sampled in this direction.
fn weighted(
    room: &Room,
    surface: &Surface64,
    direction: DVec3,
    factor: impl Fn(f64) -> DVec3,
) -> WithMargin<DVec3> {
    let arriving = emitted(room, surface, direction);
    if arriving.value == DVec3::ZERO {
        return arriving;
    }
    let pdf = room.sources().pdf(surface.position, direction);
    arriving.and(arriving.value * factor(pdf.value), pdf.margin)
}

/// Returns the radiance that arrives at a surface from a direction without being scattered: that
/// of the first surface in this direction or, if there is none, of the environment.
pub fn emitted(room: &Room, surface: &Surface64, direction: DVec3) -> WithMargin<DVec3> {
    let hit = room.hit(&ray(surface.position, direction), Some(surface));
    match &hit.value {
        Some(source) => hit.and(source.emitted, f64::INFINITY),
        None => {
            let environment = room.sources().environment.radiance(direction);
            hit.and(environment.value, environment.margin)
        }
    }
}

/// Returns the radiance that arrives at the origin of a ray, estimated from one path. The path is
/// scattered at most once for each element of `numbers`, which are the random numbers for bounces
/// 0, 1 and so on. The ray's range is ignored.
///
/// The margin is the smallest one of all decisions that the result depends on. Where the path ends,
/// a hit that adds no light isn't one of them.
pub fn radiance(room: &Room, ray: &Ray64, numbers: &[Numbers64]) -> WithMargin<DVec3> {
    let start = PathSoFar {
        from: None,
        throughput: DVec3::ONE,
        bounce: 0,
        is_counted: false,
    };
    let ray = self::ray(ray.origin, ray.dir.normalize());
    arriving(room, ray, start, numbers)
}

/// Returns the radiance that arrives at the origin of a ray, by recursion: the light that the hit
/// surface emits, plus the direct light that it scatters, plus what arrives there from the rest of
/// the path, times the attenuation.
fn arriving(room: &Room, ray: Ray64, path: PathSoFar, numbers: &[Numbers64]) -> WithMargin<DVec3> {
    let numbers_here = numbers.get(path.bounce);
    if path.is_counted && numbers_here.is_none() {
        return DARK;
    }
    let hit = room.hit(&ray, path.from);
    let Some(surface) = &hit.value else {
        if path.is_counted {
            return hit.and(DVec3::ZERO, f64::INFINITY);
        }
        let light = room.sources().environment.radiance(ray.dir);
        return hit.and(light.value, light.margin);
    };
    let emitted = if path.is_counted {
        DVec3::ZERO
    } else {
        surface.emitted
    };
    let Some(numbers_here) = numbers_here else {
        return hit.and(emitted, f64::INFINITY);
    };
    let direct = direct(room, surface, numbers_here);
    let rest = indirect(room, surface, path, numbers);
    hit.and((), direct.margin)
        .and(emitted + direct.value + rest.value, rest.margin)
}

/// Returns the light that a surface scatters from the rest of the path.
fn indirect(
    room: &Room,
    surface: &Surface64,
    path: PathSoFar,
    numbers: &[Numbers64],
) -> WithMargin<DVec3> {
    let numbers_here = &numbers[path.bounce];
    let Some(scattered) = scatter(surface, numbers_here) else {
        return DARK;
    };
    let Scattered64 {
        direction,
        attenuation,
        pdf,
    } = scattered.value;
    let throughput = path.throughput * attenuation;
    if throughput == DVec3::ZERO {
        return DARK;
    }
    let survival = survival(throughput, path.bounce, numbers_here);
    let decided = scattered.and((), survival.margin);
    let Some(probability) = survival.value else {
        return decided.and(DVec3::ZERO, f64::INFINITY);
    };
    let next = PathSoFar {
        from: Some(surface),
        throughput: throughput / probability,
        bounce: path.bounce + 1,
        is_counted: pdf.is_some(),
    };
    let next_ray = ray(surface.position, surface.frame.to_world(direction));
    let rest = arriving(room, next_ray, next, numbers);
    decided.and(rest.value * attenuation / probability, rest.margin)
}

/// Returns the probability with which a path survives a bounce, or `None` if it ends there.
pub(super) fn survival(
    throughput: DVec3,
    bounce: usize,
    numbers: &Numbers64,
) -> WithMargin<Option<f64>> {
    if bounce < FIRST_ROULETTE {
        return WithMargin {
            value: Some(1.0),
            margin: f64::INFINITY,
        };
    }
    let probability = throughput.max_element().clamp(0.05, 0.95);
    WithMargin {
        value: (numbers.survive < probability).then_some(probability),
        margin: (numbers.survive - probability).abs(),
    }
}

/// Samples the continuation of a path at a surface. Returns `None` if the path ends there.
pub(super) fn scatter(surface: &Surface64, numbers: &Numbers64) -> Option<WithMargin<Scattered64>> {
    let out = surface.out;
    let (value, margin) = match surface.material {
        Material64::Lambertian { albedo } => {
            let scattered = lambertian::scatter(albedo, out, numbers.scatter);
            (scattered, scattered.direction.z)
        }
        Material64::Mirror { reflectance } => {
            (specular::mirror_scatter(reflectance, out), f64::INFINITY)
        }
        Material64::Glass { ior } => (
            specular::glass_scatter(ior, out, numbers.reflect),
            specular::glass_margin(ior, out, numbers.reflect),
        ),
        Material64::Emitter { .. } => return None,
    };
    Some(WithMargin { value, margin })
}

/// Returns the surfaces that a path hits, as if it always survived.
pub fn surfaces(room: &Room, ray: &Ray64, numbers: &[Numbers64]) -> Vec<Surface64> {
    let first = room.hit(ray, None).value;
    let mut surfaces: Vec<Surface64> = first.into_iter().collect();
    for numbers in numbers {
        let last = surfaces.last();
        let Some(next) = last.and_then(|last| next_surface(room, last, numbers)) else {
            break;
        };
        surfaces.push(next);
    }
    surfaces
}

/// Returns the surface that a path hits after it leaves this one, or `None` if it hits nothing or
/// leaves a light, which scatters nothing.
pub fn next_surface(room: &Room, surface: &Surface64, numbers: &Numbers64) -> Option<Surface64> {
    let direction = scatter(surface, numbers)?.value.direction;
    let ray = ray(surface.position, surface.frame.to_world(direction));
    room.hit(&ray, Some(surface)).value
}

/// Returns the ray from a point in a direction.
pub fn ray(origin: DVec3, dir: DVec3) -> Ray64 {
    Ray64 {
        origin,
        dir,
        min: 0.0,
        max: f64::INFINITY,
    }
}
