//! The aspects of direct light.

use glam::DVec3;

use super::{DirectCall, SURFACES, surface_class};
use crate::domains::Aspect;
use crate::domains::fields::{class_from, class_up_to};
use crate::domains::light::fields::{CONTRASTS, contrast_class};
use crate::oracle::Ray64;
use crate::oracle::light::quad::Material64;
use crate::oracle::light::room::Surface64;
use crate::oracle::light::transport::emitted;
use crate::oracle::light::{Numbers64, lambertian};

/// The aspects of direct light.
pub(super) const DIRECT_ASPECTS: &[Aspect<DirectCall>] = &[
    // The surface that the ray hits.
    Aspect::new("surface", SURFACES, |call| {
        call.surface.as_ref().map(surface_class)
    }),
    // The cosine between the ray and the normal of a matte surface. Smaller cosines aren't tested,
    // because rounding moves such a hit along the surface.
    Aspect::new(
        "cosine of the ray",
        &[
            "above 0.2",
            "above 0.05",
            "above 0.02",
            "above 0.005",
            "smaller",
        ],
        |call| {
            let cosine = matte(call)?.out.z;
            Some(class_from(&[0.2, 0.05, 0.02, 0.005], cosine))
        },
    ),
    // The direction toward a light.
    Aspect::new(
        "light sample",
        &["none", "below the surface", "blocked", "a light", "a map"],
        |call| {
            let surface = matte(call)?;
            let numbers = Numbers64::from(&call.input);
            let sample = call.room.sources().sample(surface.position, &numbers);
            let Some(direction) = sample.value else {
                return Some(0);
            };
            if surface.frame.to_local(direction).z <= 0.0 {
                return Some(1);
            }
            Some(2 + found(call, surface, direction))
        },
    ),
    // The kind of surface that is in the way of the direction toward a light.
    Aspect::new(
        "in the way of the light",
        &["matte", "mirror", "glass", "light, from behind"],
        |call| {
            let surface = matte(call)?;
            let direction = sampled(call)?;
            let hit = call
                .room
                .hit(&ray(surface, direction), Some(surface))
                .value?;
            // The front of a light isn't in the way.
            [0, 1, 2, 4]
                .iter()
                .position(|class| *class == surface_class(&hit))
        },
    ),
    // The cosine of the direction toward a light that isn't blocked.
    Aspect::new("cosine of the light sample", HEIGHTS, |call| {
        let direction = unblocked(call)?;
        Some(height_class(matte(call)?.frame.to_local(direction)))
    }),
    // The contrast between the channels of a lit surface's albedo.
    Aspect::new("dimmest over brightest channel", CONTRASTS, |call| {
        unblocked(call)?;
        let Material64::Lambertian { albedo } = matte(call)?.material else {
            return None;
        };
        contrast_class(albedo.as_vec3())
    }),
    // The value of `evaluate` for the direction toward a light that isn't blocked.
    Aspect::new("evaluate of the light sample", VALUES, |call| {
        let (surface, direction) = (matte(call)?, unblocked(call)?);
        value_class(surface, surface.frame.to_local(direction))
    }),
    // The light pdf of the direction toward a light that isn't blocked.
    Aspect::new(
        "light pdf of the light sample",
        &[
            "up to 1",
            "up to 100",
            "up to 10,000",
            "up to 100,000",
            "beyond",
        ],
        |call| {
            let (position, direction) = (matte(call)?.position, unblocked(call)?);
            let pdf = call.room.sources().pdf(position, direction).value;
            Some(class_up_to(&[1.0, 1e2, 1e4, 1e5], pdf))
        },
    ),
    // The light that the scattered direction finds.
    Aspect::new(
        "scattered direction",
        &["no light", "a light", "the environment"],
        |call| {
            let surface = matte(call)?;
            let direction = surface.frame.to_world(scattered(call));
            Some(found(call, surface, direction))
        },
    ),
    // The cosine of the scattered direction.
    Aspect::new("scattered cosine", HEIGHTS, |call| {
        matte(call).map(|_| height_class(scattered(call)))
    }),
    // The value of `evaluate` for the scattered direction, if it finds light.
    Aspect::new("evaluate of the scattered direction", VALUES, |call| {
        let (surface, direction) = (matte(call)?, scattered(call));
        let is_lit = found(call, surface, surface.frame.to_world(direction)) > 0;
        value_class(surface, direction).filter(|_| is_lit)
    }),
    Aspect::new(
        "light pdf of the scattered direction",
        &["0", "up to 1", "up to 100", "beyond"],
        |call| {
            let surface = matte(call)?;
            let direction = surface.frame.to_world(scattered(call));
            let pdf = call.room.sources().pdf(surface.position, direction).value;
            Some(class_up_to(&[0.0, 1.0, 100.0], pdf))
        },
    ),
    // The random number that picks the light.
    Aspect::new("light", QUARTERS, |call| quarter(call.input.light)),
    // The first random number for the point on the light.
    Aspect::new("on_light.x", QUARTERS, |call| {
        quarter(call.input.on_light.x)
    }),
    // The second random number for the point on the light.
    Aspect::new("on_light.y", QUARTERS, |call| {
        quarter(call.input.on_light.y)
    }),
    // The first random number for the scattered direction.
    Aspect::new("direct.x", QUARTERS, |call| quarter(call.input.direct.x)),
    // The second random number for the scattered direction.
    Aspect::new("direct.y", QUARTERS, |call| quarter(call.input.direct.y)),
];

/// Classes of cosines. Small ones are those of grazing directions.
const HEIGHTS: &[&str] = &["above 0.1", "above 1e-3", "smaller"];

/// Returns the class of a direction in a surface's frame.
fn height_class(direction: DVec3) -> usize {
    class_from(&[0.1, 1e-3], direction.z)
}

/// The classes of the largest channel of `evaluate`.
const VALUES: &[&str] = &["above 1e-3", "above 1e-6", "smaller"];

/// Returns the class of `evaluate` for a direction in a surface's frame.
fn value_class(surface: &Surface64, incoming: DVec3) -> Option<usize> {
    let Material64::Lambertian { albedo } = surface.material else {
        return None;
    };
    let value = lambertian::evaluate(albedo, surface.out, incoming).max_element();
    (value > 0.0).then(|| class_from(&[1e-3, 1e-6], value))
}

/// Returns the scattered direction, in the surface's frame.
fn scattered(call: &DirectCall) -> DVec3 {
    lambertian::sample_cosine_hemisphere(call.input.direct.as_dvec2())
}

/// Returns the direction toward a light, if there is one above the surface.
fn sampled(call: &DirectCall) -> Option<DVec3> {
    let surface = matte(call)?;
    let numbers = Numbers64::from(&call.input);
    let sample = call.room.sources().sample(surface.position, &numbers);
    let is_above = |direction: &DVec3| surface.frame.to_local(*direction).z > 0.0;
    sample.value.filter(is_above)
}

/// Returns the direction toward a light, if light arrives from there.
fn unblocked(call: &DirectCall) -> Option<DVec3> {
    let surface = matte(call)?;
    sampled(call).filter(|direction| found(call, surface, *direction) > 0)
}

/// Returns the ray from a surface in a direction.
fn ray(surface: &Surface64, dir: DVec3) -> Ray64 {
    Ray64 {
        origin: surface.position,
        dir,
        min: 0.0,
        max: f64::INFINITY,
    }
}

/// Returns 0 if no light arrives at a surface from a direction, 1 if it is the light of a shape,
/// and 2 if it is that of the environment.
fn found(call: &DirectCall, surface: &Surface64, direction: DVec3) -> usize {
    let is_dark = emitted(&call.room, surface, direction).value == DVec3::ZERO;
    let hit = call.room.hit(&ray(surface, direction), Some(surface)).value;
    match hit {
        _ if is_dark => 0,
        Some(_) => 1,
        None => 2,
    }
}

/// Returns the surface that the ray hits if it is matte.
fn matte(call: &DirectCall) -> Option<&Surface64> {
    let surface = call.surface.as_ref();
    surface.filter(|surface| matches!(surface.material, Material64::Lambertian { .. }))
}

/// The classes of random numbers that are only passed on to other functions, whose own domains
/// contain the ends.
const QUARTERS: &[&str] = &["below 0.25", "0.25", "0.5", "0.75"];

fn quarter(number: f32) -> Option<usize> {
    Some((4.0 * number) as usize)
}
