//! The items about lists that contain spheres.

use glam::DVec3;
use judging::exam::ExamQuestion;
use protocol::Table;
use protocol::light::LightQuestion;
use protocol::light::lights::{LightList, LightSample, ListedLight, SphericalLight, Toward};

use super::super::{
    MARGIN, color, densities, optional_directions, random, random_pair, single, table,
};
use super::{EVERY_FORM, light, listed};
use crate::items::Declaration;
use crate::oracle::light::WithMargin;
use crate::oracle::light::lights::{Light64, Lights64};
use crate::oracle::light::spherical_light::SphericalLight64;
use crate::seed::Rng;

/// The number of calls of each kind in a question.
const CALLS: usize = 12;
/// The number of calls from inside a sphere in a question.
const FROM_INSIDE: usize = 4;

pub(super) const SAMPLES: Declaration = Declaration {
    id: "lights.sphere_samples",
    title: "if a sphere is picked, the direction is sampled toward that sphere",
    look: "Which function samples a direction if the light that was picked is a sphere? And can \
           your code pick a sphere in the first place?",
    section: "light/lights.md#what-to-return",
    tests: &[
        "`choice` picks the light: a light's share of `[0, 1)` is its share of the power, in the \
         order of the list.",
        "`random` picks the point on that light: …",
    ],
    questions: |rng| {
        lists(rng, |rng, lights| {
            let of_spheres = (0..CALLS).map(|_| sample_of(rng, lights, outside, is_sphere));
            let mut calls: Vec<LightSample> = of_spheres.collect();
            if !lights.iter().all(is_sphere) {
                let others = |_| sample_of(rng, lights, outside, |light| !is_sphere(light));
                calls.extend((0..CALLS).map(others));
            }
            // Inside a sphere, there is no sample of that sphere.
            calls.extend((0..FROM_INSIDE).map(|_| {
                rng.retry(|rng| {
                    let call = sample_of(rng, lights, inside, is_sphere);
                    Some(call).filter(|call| sample(lights, call).value.is_none())
                })
            }));
            sampled(lights, rng.shuffled(calls))
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
            let toward_spheres = (0..CALLS).map(|_| toward_any(rng, lights, is_sphere));
            let mut calls: Vec<Toward> = toward_spheres.collect();
            calls.extend((0..CALLS).map(|_| toward_any(rng, lights, |_| true)));
            calls.extend((0..CALLS).map(|_| anywhere(rng, lights, outside)));
            calls.extend((0..FROM_INSIDE).map(|_| anywhere(rng, lights, inside)));
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
    let counts = [(1, 0), (1, 1), (2, 3), (20, 20)];
    let questions = counts.map(|(spheres, others)| {
        let mut lights: Vec<Light64> = (0..spheres).map(|_| sphere(rng)).collect();
        lights.extend((0..others).map(|_| {
            let form = rng.index(EVERY_FORM.len());
            Light64::Flat(light(rng, form, 1.0))
        }));
        let lights = lights.into_iter().map(|light| similar(rng, light));
        let lights: Vec<Light64> = lights.collect();
        let lights = rng.shuffled(lights);
        question(rng, &lights)
    });
    questions.into()
}

/// Returns a sphere at a random position.
fn sphere(rng: &mut Rng) -> Light64 {
    Light64::Sphere(SphericalLight64 {
        center: single(rng.point(2.0)),
        radius: f64::from(rng.log_uniform(0.1, 0.8) as f32),
        radiance: color(rng),
    })
}

/// Changes the brightness of a light. In a list of such lights, no light has nearly all the power.
fn similar(rng: &mut Rng, mut light: Light64) -> Light64 {
    let factor = rng.uniform(1.0, 4.0) / light.power();
    let radiance = match &mut light {
        Light64::Flat(light) => &mut light.radiance,
        Light64::Sphere(light) => &mut light.radiance,
    };
    *radiance = single(*radiance * factor);
    light
}

fn is_sphere(light: &Light64) -> bool {
    matches!(light, Light64::Sphere(_))
}

/// Returns a point outside all spheres, with some distance from them.
fn outside(rng: &mut Rng, lights: &[Light64]) -> DVec3 {
    rng.retry(|rng| {
        let point = single(rng.point(6.0));
        let is_far = |light: &Light64| match light {
            Light64::Sphere(light) => point.distance(light.center) > 1.3 * light.radius,
            Light64::Flat(_) => true,
        };
        lights.iter().all(is_far).then_some(point)
    })
}

/// Returns a point inside a sphere.
fn inside(rng: &mut Rng, lights: &[Light64]) -> DVec3 {
    rng.retry(|rng| match lights[rng.index(lights.len())] {
        Light64::Sphere(light) => Some(single(light.center + 0.9 * light.radius * in_ball(rng))),
        Light64::Flat(_) => None,
    })
}

/// Returns a call of `Lights::sample` that picks a light which fulfils a condition. An area light
/// may face away.
fn sample_of(
    rng: &mut Rng,
    lights: &[Light64],
    from: fn(&mut Rng, &[Light64]) -> DVec3,
    wanted: fn(&Light64) -> bool,
) -> LightSample {
    let all = Lights64::new(lights.iter().copied());
    rng.retry(|rng| {
        let call = LightSample {
            from: from(rng, lights).as_vec3(),
            choice: random(rng),
            random: random_pair(rng),
        };
        let is_wanted = all.picked(call.choice.into()).is_some_and(wanted);
        (is_wanted && sample(lights, &call).margin > MARGIN).then_some(call)
    })
}

fn sample(lights: &[Light64], call: &LightSample) -> WithMargin<Option<DVec3>> {
    let all = Lights64::new(lights.iter().copied());
    let from = call.from.as_dvec3();
    all.sample(from, call.choice.into(), call.random.as_dvec2())
}

fn sampled(lights: &[Light64], calls: Vec<LightSample>) -> ExamQuestion {
    let rows = calls.iter().map(|call| sample(lights, call).value);
    let rows = optional_directions(rows);
    let question = LightQuestion::LightsSample(Table::of_list(subject(lights), calls));
    table(question, &["direction", "unit_direction"], rows)
}

/// Returns a direction toward a light that fulfils a condition.
fn toward_any(rng: &mut Rng, lights: &[Light64], wanted: fn(&Light64) -> bool) -> Toward {
    let wanted: Vec<&Light64> = lights.iter().filter(|light| wanted(light)).collect();
    rng.retry(|rng| {
        let target = match wanted[rng.index(wanted.len())] {
            Light64::Flat(light) => light.point(random_pair(rng).as_dvec2()),
            Light64::Sphere(light) => light.center + light.radius * 0.95 * in_ball(rng),
        };
        let from = outside(rng, lights);
        clear(lights, from, target - from)
    })
}

/// Returns a random point in the unit ball, more often close to its middle than far from it.
fn in_ball(rng: &mut Rng) -> DVec3 {
    rng.direction() * rng.uniform(0.0, 1.0)
}

/// Returns a random direction, which misses most lights.
fn anywhere(rng: &mut Rng, lights: &[Light64], from: fn(&mut Rng, &[Light64]) -> DVec3) -> Toward {
    rng.retry(|rng| {
        let from = from(rng, lights);
        let direction = rng.direction();
        clear(lights, from, direction)
    })
}

/// Returns a direction from a point unless it is close to the edge of a light.
fn clear(lights: &[Light64], from: DVec3, direction: DVec3) -> Option<Toward> {
    let call = Toward {
        from: from.as_vec3(),
        direction: direction.normalize().as_vec3(),
    };
    let all = Lights64::new(lights.iter().copied());
    let pdf = all.pdf(call.from.as_dvec3(), call.direction.as_dvec3());
    (pdf.margin > MARGIN).then_some(call)
}

fn list_densities(lights: &[Light64], calls: Vec<Toward>) -> ExamQuestion {
    let all = Lights64::new(lights.iter().copied());
    let pdf = |call: &Toward| {
        all.pdf(call.from.as_dvec3(), call.direction.as_dvec3())
            .value
    };
    let rows = densities(calls.iter().map(pdf));
    let question = LightQuestion::LightsPdf(Table::of_list(subject(lights), calls));
    table(question, &["pdf"], rows)
}

fn subject(lights: &[Light64]) -> LightList {
    let light = |light: &Light64| match light {
        Light64::Flat(light) => ListedLight::Flat(listed(light)),
        Light64::Sphere(light) => ListedLight::Sphere(SphericalLight {
            center: light.center.as_vec3(),
            radius: light.radius as f32,
            radiance: light.radiance.as_vec3(),
        }),
    };
    LightList {
        lights: lights.iter().map(light).collect(),
    }
}
