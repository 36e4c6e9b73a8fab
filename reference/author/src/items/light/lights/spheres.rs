//! The items about lists that contain spheres.

use glam::DVec3;
use judging::exam::ExamQuestion;
use judging::symptom::{SOME_OR_NONE, Symptom};
use protocol::light::lights::{LightSample, Toward};

use super::super::{MARGIN, color, random_pair, single};
use super::{EVERY_FORM, every_size, is_steep, light, list_densities, sample, sampled};
use crate::domains::fields::FURTHEST;
use crate::domains::light::fields;
use crate::items::Declaration;
use crate::oracle::light::lights::{FlatLight64, Light64, Lights64};
use crate::oracle::light::spherical_light::SphericalLight64;
use crate::seed::Rng;

/// The number of calls of each kind in a question.
const CALLS: usize = 12;
/// The number of calls from inside a sphere in a question.
const FROM_INSIDE: usize = 4;
/// The number of calls from close to a sphere, and from far away, in a question.
const FROM_SPECIAL: usize = 6;
/// The smallest margin of calls from close to a sphere or far away. Rounding moves a point by about
/// a hundredth of this.
const SMALL_MARGIN: f64 = 2e-5;

pub(super) const SAMPLES: Declaration = Declaration {
    id: "lights.sphere_samples",
    title: "if a sphere is picked, the direction is sampled toward that sphere",
    look: "Which function samples a direction if the light that was picked is a sphere? And can \
           your code pick a sphere in the first place?",
    look_fits: &[Symptom::of("direction"), Symptom::less(SOME_OR_NONE)],
    section: "light/lights.md#what-to-return",
    tests: &[
        "`choice` picks the light: …",
        "`random` picks the point on that light: …",
    ],
    questions: |rng| {
        lists(rng, |rng, lights| {
            let all = Lights64::new(lights.iter().copied());
            let is_some = |call: &LightSample| sample(&all, call).value.is_some();
            let mut calls = rng.list(CALLS, |rng| sample_of(rng, lights, outside, is_sphere));
            if !lights.iter().all(is_sphere) {
                calls.extend(rng.list(CALLS, |rng| sample_of(rng, lights, outside, is_flat)));
            }
            // Inside a sphere, there is no sample of that sphere.
            calls.extend(rng.retry_list(FROM_INSIDE, |rng| {
                let call = sample_of(rng, lights, inside, is_sphere);
                (!is_some(&call)).then_some(call)
            }));
            // But there is one of any other light that doesn't face away.
            if lights.len() > 1 {
                calls.extend((0..2 * FROM_INSIDE).filter_map(|index| {
                    let kinds: [fn(&Light64) -> bool; 2] = [|_| true, is_flat];
                    let kind = kinds[index % 2];
                    if !lights.iter().any(kind) {
                        return None;
                    }
                    rng.attempt(1_000, |rng| {
                        let call = sample_of(rng, lights, inside, kind);
                        (is_some(&call) == (index % 2 == 0)).then_some(call)
                    })
                }));
            }
            for from in [close as Position, far] {
                let special = |rng: &mut Rng| sample_of(rng, lights, from, is_sphere);
                calls.extend(rng.list(FROM_SPECIAL, special));
            }
            sampled(lights, rng.shuffled(calls), is_clear_sample)
        })
    },
    ..Declaration::ALONE
};

pub(super) const DENSITIES: Declaration = Declaration {
    id: "lights.sphere_densities",
    title: "a sphere in the list adds its density, weighted by its share of the power",
    look: "`Light::pdf` is given and works for every kind of light. Does your sum use it for all \
        of them?",
    section: "light/lights.md#lights-add-their-densities",
    tests: &["Every light in that direction adds its density, given by [`Light::pdf`], …"],
    questions: |rng| {
        lists(rng, |rng, lights| {
            let mut calls = rng.list(CALLS, |rng| toward_any(rng, lights, outside, is_sphere));
            calls.extend(rng.list(CALLS, |rng| toward_any(rng, lights, outside, |_| true)));
            for from in [close as Position, far] {
                let special = |rng: &mut Rng| toward_any(rng, lights, from, is_sphere);
                calls.extend(rng.list(FROM_SPECIAL, special));
            }
            calls.extend(rng.list(CALLS, |rng| anywhere(rng, lights, outside)));
            calls.extend(rng.list(FROM_INSIDE, |rng| anywhere(rng, lights, inside)));
            list_densities(lights, rng.shuffled(calls))
        })
    },
    ..Declaration::ALONE
};

/// Returns a question about a single sphere, and questions about lists that also contain other
/// lights.
fn lists(
    rng: &mut Rng,
    mut question: impl FnMut(&mut Rng, &[Light64]) -> ExamQuestion,
) -> Vec<ExamQuestion> {
    let counts = [(1, 0), (1, 1), (2, 0), (2, 1), (2, 3), (20, 20)];
    let lists = counts.into_iter().zip(every_size(rng));
    let questions = lists.map(|((spheres, others), size)| {
        // Larger spheres would leave no space for the points that they light.
        let size = size.min(0.25 * FURTHEST);
        let mut lights = rng.list(spheres, |rng| sphere(rng, size));
        lights.extend(rng.list(others, |rng| {
            let form = EVERY_FORM[rng.index(EVERY_FORM.len())];
            Light64::Flat(light(rng, form, size))
        }));
        for light in &mut lights {
            make_similar(rng, light);
        }
        let lights = rng.shuffled(lights);
        question(rng, &lights)
    });
    questions.collect()
}

/// Returns a sphere at a random position, whose radius is at most `size`.
fn sphere(rng: &mut Rng, size: f64) -> Light64 {
    let radius = size * rng.log_uniform(0.2, 1.0);
    Light64::Sphere(SphericalLight64 {
        center: single(rng.point(2.5 * size)),
        radius: f64::from(radius as f32),
        radiance: color(rng),
    })
}

/// Returns the largest coordinate of the spheres.
fn extent(lights: &[Light64]) -> f64 {
    let extents = lights.iter().map(|light| match light {
        Light64::Sphere(light) => light.center.abs().max_element() + light.radius,
        Light64::Flat(_) => 0.0,
    });
    extents.fold(0.0, f64::max)
}

/// Changes the brightness of a light. In a list of such lights, no light has nearly all the power.
fn make_similar(rng: &mut Rng, light: &mut Light64) {
    let factor = rng.uniform(1.0, 4.0) / light.power();
    let (Light64::Flat(FlatLight64 { radiance, .. })
    | Light64::Sphere(SphericalLight64 { radiance, .. })) = light;
    *radiance = single(*radiance * factor);
}

fn is_sphere(light: &Light64) -> bool {
    matches!(light, Light64::Sphere(_))
}

fn is_flat(light: &Light64) -> bool {
    !is_sphere(light)
}

/// Returns a point at some position relative to the lights, and the margin that calls from there
/// must have.
type Position = fn(&mut Rng, &[Light64]) -> (DVec3, f64);

/// Returns a point outside all spheres, with some distance from them.
fn outside(rng: &mut Rng, lights: &[Light64]) -> (DVec3, f64) {
    let point = rng.retry(|rng| {
        let point = single(rng.point((2.5 * extent(lights)).min(FURTHEST)));
        is_outside(lights, point, 1.3).then_some(point)
    });
    (point, MARGIN)
}

/// Returns whether a point's distance from the centre of each sphere is more than this multiple of
/// the radius.
fn is_outside(lights: &[Light64], point: DVec3, radii: f64) -> bool {
    lights.iter().all(|light| match light {
        Light64::Sphere(light) => point.distance(light.center) > radii * light.radius,
        Light64::Flat(_) => true,
    })
}

/// Returns a point inside a sphere.
fn inside(rng: &mut Rng, lights: &[Light64]) -> (DVec3, f64) {
    let light = any_sphere(rng, lights);
    let point = light.center + 0.9 * light.radius * in_ball(rng);
    (single(point), MARGIN)
}

/// Returns a point just outside a sphere.
fn close(rng: &mut Rng, lights: &[Light64]) -> (DVec3, f64) {
    let point = rng.retry(|rng| {
        let radii = 1.0 + rng.log_uniform(1e-4, 0.05);
        let light = any_sphere(rng, lights);
        let point = single(light.center + radii * light.radius * rng.direction());
        is_outside(lights, point, 1.0 + 5e-5).then_some(point)
    });
    (point, SMALL_MARGIN)
}

/// Returns a point so far away that a sphere looks tiny, unless the sphere is large.
fn far(rng: &mut Rng, lights: &[Light64]) -> (DVec3, f64) {
    let light = any_sphere(rng, lights);
    let farthest = (FURTHEST / light.radius).min(1200.0);
    if farthest < 330.0 {
        // Such a point would be outside the scene.
        return outside(rng, lights);
    }
    let distance = light.radius * rng.log_uniform(320.0, farthest);
    let point = light.center + distance * rng.direction();
    (single(point), SMALL_MARGIN)
}

fn any_sphere(rng: &mut Rng, lights: &[Light64]) -> SphericalLight64 {
    rng.retry(|rng| match lights[rng.index(lights.len())] {
        Light64::Sphere(light) => Some(light),
        Light64::Flat(_) => None,
    })
}

/// Returns a call of `Lights::sample` that picks a light which fulfils a condition. An area light
/// may face away.
fn sample_of(
    rng: &mut Rng,
    lights: &[Light64],
    from: Position,
    wanted: fn(&Light64) -> bool,
) -> LightSample {
    let all = Lights64::new(lights.iter().copied());
    rng.retry(|rng| {
        let (from, margin) = from(rng, lights);
        let call = LightSample {
            from: from.as_vec3(),
            choice: fields::number(rng),
            random: fields::number_pair(rng),
        };
        let is_wanted = all.picked(call.choice.into()).is_some_and(wanted);
        (is_wanted && sample(&all, &call).margin > margin).then_some(call)
    })
}

/// Returns whether a call keeps the margin of calls from ordinary positions.
fn is_clear_sample(lights: &Lights64, call: &LightSample) -> bool {
    sample(lights, call).margin > MARGIN
}

/// Returns a direction toward a light that fulfils a condition.
fn toward_any(
    rng: &mut Rng,
    lights: &[Light64],
    from: Position,
    wanted: fn(&Light64) -> bool,
) -> Toward {
    let wanted: Vec<&Light64> = lights.iter().filter(|light| wanted(light)).collect();
    rng.retry(|rng| {
        let target = match wanted[rng.index(wanted.len())] {
            Light64::Flat(light) => light.point(random_pair(rng).as_dvec2()),
            Light64::Sphere(light) => light.center + light.radius * 0.95 * in_ball(rng),
        };
        let (from, margin) = from(rng, lights);
        clear(lights, from, target - from, margin)
    })
}

/// Returns a random point in the unit ball, more often close to its middle than far from it.
fn in_ball(rng: &mut Rng) -> DVec3 {
    rng.direction() * rng.uniform(0.0, 1.0)
}

/// Returns a random direction, which misses most lights.
fn anywhere(rng: &mut Rng, lights: &[Light64], from: Position) -> Toward {
    rng.retry(|rng| {
        let (from, margin) = from(rng, lights);
        let direction = rng.direction();
        clear(lights, from, direction, margin)
    })
}

/// Returns a direction from a point unless it is close to the edge of a light.
fn clear(lights: &[Light64], from: DVec3, direction: DVec3, margin: f64) -> Option<Toward> {
    let call = Toward {
        from: from.as_vec3(),
        direction: direction.normalize().as_vec3(),
    };
    let all = Lights64::new(lights.iter().copied());
    let pdf = all.pdf(call.from.as_dvec3(), call.direction.as_dvec3());
    (pdf.margin > margin && is_steep(lights, &call)).then_some(call)
}
