//! The items about sampling lights.

mod spheres;

use glam::{DVec2, DVec3};
use judging::exam::ExamQuestion;
use protocol::Table;
use protocol::light::LightQuestion;
use protocol::light::lights::{FlatLight, LightList, LightSample, ListedLight, Toward};

use super::groups::{LIGHT_DENSITIES, LIGHT_SAMPLES};
use super::{MARGIN, color, densities, optional_directions, random, random_pair, single, table};
use crate::items::{AuthoredTask, Declaration};
use crate::oracle::light::flat_shape::FlatShape;
use crate::oracle::light::lights::{FlatLight64, Lights64};
use crate::seed::Rng;

/// The number of calls in each question.
const CALLS: usize = 12;

/// The task `lights`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        DENSITY,
        TRIANGLE,
        BEHIND,
        PAST,
        GRAZING,
        DIRECTION,
        PICK,
        FACES_AWAY,
        spheres::SAMPLES,
        SHARES,
        OVERLAP,
        spheres::DENSITIES,
    ],
    ..AuthoredTask::NEW
};

const DENSITY: Declaration = Declaration {
    id: "lights.density",
    points: 2,
    title: "the density of directions to a light is distance² / (cos θ · area)",
    look: "Move the point twice as far away: by what factor does the density change?",
    section: "light/lights.md#the-density-of-an-area-light",
    tests: &[
        "Returns the probability density, per solid angle, of a direction from a point to the \
         light if points on the light are sampled uniformly: distance² / (cos θ · area), where θ \
         is the angle between the light's normal and the direction back to the point.",
        "See Shirley, Wang and Zimmerman, \"Monte Carlo Techniques for Direct Lighting \
         Calculations\", ACM TOG 15(1), 1996, section 3.",
        "`direction` has length one.",
        "The given [`AreaLight::intersect`] finds the distance.",
    ],
    questions: |rng| {
        one_light(rng, false, |rng, light| {
            toward(rng, light, Side::Front, CALLS)
        })
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const TRIANGLE: Declaration = Declaration {
    id: "lights.triangle",
    points: 1,
    title: "the density of directions to a triangle uses the triangle's own area",
    look: "The given `area` is right for both shapes. Do you compute your own?",
    section: "light/lights.md#the-density-of-an-area-light",
    tests: &[
        "Returns the probability density, per solid angle, of a direction from a point to the \
         light if points on the light are sampled uniformly: …",
    ],
    questions: |rng| {
        one_light(rng, true, |rng, light| {
            toward(rng, light, Side::Front, CALLS)
        })
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const BEHIND: Declaration = Declaration {
    id: "lights.behind",
    points: 1,
    title: "from behind, a light's density is 0",
    look: "What is the sign of your cosine if the point is behind the light?",
    section: "light/lights.md#the-back-of-a-light-is-dark",
    tests: &["The result is zero if the direction misses the light, and from behind, …"],
    questions: |rng| {
        one_light(rng, false, |rng, light| {
            let mut calls = toward(rng, light, Side::Back, CALLS);
            calls.extend(toward(rng, light, Side::Front, CALLS));
            rng.shuffled(calls)
        })
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const PAST: Declaration = Declaration {
    id: "lights.past",
    points: 1,
    title: "the density of a direction that misses the light is 0",
    look: "What do you return if `intersect` finds nothing?",
    section: "light/lights.md#past-the-light-there-is-no-density",
    tests: &[
        "The result is zero if the direction misses the light, and from behind, where the light \
         doesn't emit.",
    ],
    questions: |rng| {
        one_light(rng, false, |rng, light| {
            let mut calls = toward(rng, light, Side::Front, CALLS);
            let turned = calls.clone().into_iter().map(|call| Toward {
                direction: -call.direction,
                ..call
            });
            calls.extend(turned.collect::<Vec<_>>());
            calls.extend(past(rng, light));
            rng.shuffled(calls)
        })
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const GRAZING: Declaration = Declaration {
    id: "lights.grazing",
    points: 1,
    title: "a light that is seen nearly edge-on has a high density",
    look: "Is there a smallest cosine in your code?",
    section: "light/lights.md#the-cosine-divides",
    tests: &[
        "Returns the probability density, per solid angle, of a direction from a point to the \
         light if points on the light are sampled uniformly: …",
    ],
    questions: |rng| {
        one_light(rng, false, |rng, light| {
            toward(rng, light, Side::Grazing, CALLS)
        })
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const DIRECTION: Declaration = Declaration {
    id: "lights.direction",
    points: 2,
    title: "a sample is the unit direction to the given point on the light",
    look: "Which point does your direction start from, which point does it lead to, and how long \
        is it?",
    section: "light/lights.md#the-direction-has-length-one",
    tests: &[
        "Samples a direction from a point to a light with random numbers in `[0, 1)`.",
        "`random` picks the point on that light: see [`AreaLight::point`].",
        "The result is the direction to that point, as a unit vector.",
    ],
    questions: |rng| {
        let kinds = [false, true, false];
        let questions = kinds.into_iter().map(|is_triangle| {
            let light = light(rng, is_triangle);
            let samples = samples(rng, &[light], CALLS, Option::is_some);
            sampled(&[light], samples)
        });
        questions.collect()
    },
    ..Declaration::in_group(LIGHT_SAMPLES)
};

const PICK: Declaration = Declaration {
    id: "lights.pick",
    points: 2,
    title: "each light is picked by its share of the power, in the order of the list",
    look: "Add up the powers, one light after the other: in which light's part is `choice`?",
    section: "light/lights.md#pick-a-light-by-its-power",
    tests: &[
        "`choice` picks the light: a light's share of `[0, 1)` is its share of the power, in the \
         order of the list.",
        "Numbers at the border between two lights are not tested.",
        "Shapes and other lights that are in the way are ignored.",
    ],
    questions: |rng| {
        let counts = [2, 3, 7, 40, 100];
        let questions = counts.into_iter().map(|count| {
            let lights = several(rng, count);
            let samples = samples(rng, &lights, 2 * CALLS, Option::is_some);
            sampled(&lights, samples)
        });
        questions.collect()
    },
    ..Declaration::in_group(LIGHT_SAMPLES)
};

const FACES_AWAY: Declaration = Declaration {
    id: "lights.faces_away",
    points: 1,
    title: "there is no sample if the picked light faces away, or if there are no lights",
    look: "If the light that was picked faces away, do you pick another light, or return a \
        direction anyway?",
    section: "light/lights.md#the-picked-light-may-face-away",
    tests: &[
        "The result is `None` if there are no lights, or if the light that was picked faces away.",
        "No other light is picked instead.",
    ],
    questions: |rng| {
        let counts = [1, 2, 5, 9];
        let mut questions: Vec<ExamQuestion> = counts
            .into_iter()
            .map(|count| {
                let lights = several(rng, count);
                let mut mixed = samples(rng, &lights, CALLS, Option::is_none);
                mixed.extend(samples(rng, &lights, CALLS, Option::is_some));
                sampled(&lights, rng.shuffled(mixed))
            })
            .collect();
        let nowhere = samples(rng, &[], 3, Option::is_none);
        questions.push(sampled(&[], nowhere));
        questions
    },
    ..Declaration::in_group(LIGHT_SAMPLES)
};

const SHARES: Declaration = Declaration {
    id: "lights.shares",
    points: 1,
    title: "the total density weights each light's density by its share of the power",
    look: "What is the probability that the light in this direction is picked?",
    section: "light/lights.md#the-share-belongs-in-the-density",
    tests: &[
        "Returns the probability density, per solid angle, with which [`Lights::sample`] chooses \
         a direction from a point.",
        "The result is zero if there are no lights.",
    ],
    questions: |rng| {
        let counts = [2, 3, 8, 100];
        let mut questions: Vec<ExamQuestion> = counts
            .into_iter()
            .map(|count| {
                let lights = several(rng, count);
                let calls = toward_any(rng, &lights, 2 * CALLS);
                list_densities(&lights, calls)
            })
            .collect();
        let calls = (0..3).map(|_| Toward {
            from: rng.point(3.0).as_vec3(),
            direction: rng.direction().as_vec3(),
        });
        let calls = calls.collect();
        questions.push(list_densities(&[], calls));
        questions
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const OVERLAP: Declaration = Declaration {
    id: "lights.overlap",
    points: 1,
    title: "every light in a direction adds its density, even one behind another light",
    look: "A sample of the farther light leads in the same direction. Does your sum end too early?",
    section: "light/lights.md#lights-add-their-densities",
    tests: &[
        "Every light in that direction adds its density, given by [`Light::pdf`], times the \
         probability that it is picked.",
        "A light adds its density even if another light is in front of it.",
        "It doesn't matter whether something else is in the way.",
    ],
    questions: |rng| {
        let orders = [false, true];
        let questions = orders.into_iter().map(|is_reversed| {
            let front = light(rng, false);
            let away = front.shape.normal() * -rng.uniform(0.5, 1.5);
            let behind = shifted(rng, &front, away);
            let mut lights = vec![front, behind, shifted(rng, &front, 2.0 * away)];
            if is_reversed {
                lights.reverse();
            }
            let hits_several = |call: &Toward| {
                let pdf = |light: &FlatLight64| {
                    light.pdf(call.from.as_dvec3(), call.direction.as_dvec3())
                };
                lights.iter().filter(|light| pdf(light) > 0.0).count() > 1
            };
            let calls = (0..2 * CALLS).map(|_| {
                rng.retry(|rng| {
                    let calls = clear(&lights, toward(rng, &front, Side::Front, 1));
                    calls.into_iter().find(hits_several)
                })
            });
            let calls = calls.collect();
            list_densities(&lights, calls)
        });
        questions.collect()
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

/// Where a light is seen from.
#[derive(Clone, Copy)]
enum Side {
    Front,
    Back,
    Grazing,
}

/// Returns a light at a random position, turned in a random direction.
fn light(rng: &mut Rng, is_triangle: bool) -> FlatLight64 {
    let first = rng.direction() * rng.uniform(0.3, 2.0);
    let across = rng.perpendicular_to(first) * rng.uniform(0.3, 2.0);
    // The edges need not be perpendicular.
    let second = across + first * rng.uniform(-0.5, 0.5);
    let shape = FlatShape {
        corner: single(rng.point(2.0)),
        edges: [single(first), single(second)],
        is_triangle,
    };
    FlatLight64 {
        shape,
        radiance: single(color(rng) * rng.log_uniform(0.05, 500.0)),
    }
}

fn several(rng: &mut Rng, count: usize) -> Vec<FlatLight64> {
    let lights = (0..count).map(|_| {
        let is_triangle = rng.coin();
        light(rng, is_triangle)
    });
    lights.collect()
}

/// Returns a copy of a light that is moved and has another radiance.
fn shifted(rng: &mut Rng, light: &FlatLight64, offset: DVec3) -> FlatLight64 {
    FlatLight64 {
        shape: FlatShape {
            corner: single(light.shape.corner + offset),
            ..light.shape
        },
        radiance: single(color(rng) * rng.log_uniform(0.5, 20.0)),
    }
}

/// Returns questions about the densities of different lights.
fn one_light(
    rng: &mut Rng,
    is_triangle: bool,
    calls: impl Fn(&mut Rng, &FlatLight64) -> Vec<Toward>,
) -> Vec<ExamQuestion> {
    let question = |_| {
        let light = light(rng, is_triangle);
        let calls = clear(&[light], calls(rng, &light));
        let rows = calls
            .iter()
            .map(|call| light.pdf(call.from.as_dvec3(), call.direction.as_dvec3()));
        let rows = densities(rows);
        let question = LightQuestion::AreaLightPdf(Table::of_list(subject(&[light]), calls));
        table(question, &["pdf"], rows)
    };
    (0..3).map(question).collect()
}

/// Returns directions from points on one side of a light to points on the light.
fn toward(rng: &mut Rng, light: &FlatLight64, side: Side, count: usize) -> Vec<Toward> {
    let normal = light.shape.normal();
    let call = |_| {
        let target = light.point(DVec2::new(rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9)));
        let (height, sign) = match side {
            Side::Front => (rng.uniform(0.2, 1.0), 1.0),
            Side::Back => (rng.uniform(0.2, 1.0), -1.0),
            Side::Grazing => (rng.log_uniform(0.006, 0.1), 1.0),
        };
        let along = rng.perpendicular_to(normal) * (1.0 - height * height).sqrt();
        let distance = rng.log_uniform(0.5, 20.0);
        let from = single(target + distance * (sign * height * normal + along));
        Toward {
            from: from.as_vec3(),
            direction: (target - from).normalize().as_vec3(),
        }
    };
    (0..count).map(call).collect()
}

/// Returns directions toward lights that are picked at random, from in front of them.
fn toward_any(rng: &mut Rng, lights: &[FlatLight64], count: usize) -> Vec<Toward> {
    let calls = (0..count).map(|_| {
        let light = lights[rng.index(lights.len())];
        rng.retry(|rng| {
            let calls = clear(lights, toward(rng, &light, Side::Front, 1));
            calls.into_iter().next()
        })
    });
    calls.collect()
}

/// Returns directions that miss a light but hit its plane.
fn past(rng: &mut Rng, light: &FlatLight64) -> Vec<Toward> {
    let call = |_| {
        rng.retry(|rng| {
            let [a, b] = [rng.uniform(-1.5, 2.5), rng.uniform(-1.5, 2.5)];
            let target = light.shape.at(DVec2::new(a, b));
            let from = toward(rng, light, Side::Front, 1)[0].from.as_dvec3();
            let call = Toward {
                from: from.as_vec3(),
                direction: (target - from).normalize().as_vec3(),
            };
            let density = light.pdf(from, call.direction.as_dvec3());
            (density == 0.0).then_some(call)
        })
    };
    (0..CALLS).map(call).collect()
}

/// Returns the calls whose directions aren't close to the edge of any light.
fn clear(lights: &[FlatLight64], calls: Vec<Toward>) -> Vec<Toward> {
    let lights = Lights64::new(lights.iter().copied());
    let is_clear = |call: &Toward| {
        let density = lights.pdf(call.from.as_dvec3(), call.direction.as_dvec3());
        density.margin > MARGIN
    };
    calls.into_iter().filter(is_clear).collect()
}

fn list_densities(lights: &[FlatLight64], calls: Vec<Toward>) -> ExamQuestion {
    let all = Lights64::new(lights.iter().copied());
    let rows = calls.iter().map(|call| {
        all.pdf(call.from.as_dvec3(), call.direction.as_dvec3())
            .value
    });
    let rows = densities(rows);
    let question = LightQuestion::LightsPdf(Table::of_list(subject(lights), calls));
    table(question, &["pdf"], rows)
}

/// Returns calls of `Lights::sample` whose results fulfil a condition.
fn samples(
    rng: &mut Rng,
    lights: &[FlatLight64],
    count: usize,
    condition: fn(&Option<DVec3>) -> bool,
) -> Vec<LightSample> {
    let all = Lights64::new(lights.iter().copied());
    let call = |_| {
        rng.retry(|rng| {
            let choice = match rng.index(8) {
                0 => 0.0,
                1 => 1.0 - f32::EPSILON / 2.0,
                _ => random(rng),
            };
            let call = LightSample {
                from: rng.point(6.0).as_vec3(),
                choice,
                random: random_pair(rng),
            };
            let sample = sample(&all, &call);
            (sample.margin > MARGIN && condition(&sample.value)).then_some(call)
        })
    };
    (0..count).map(call).collect()
}

fn sample(
    lights: &Lights64,
    call: &LightSample,
) -> crate::oracle::light::WithMargin<Option<DVec3>> {
    lights.sample(
        call.from.as_dvec3(),
        call.choice.into(),
        call.random.as_dvec2(),
    )
}

fn sampled(lights: &[FlatLight64], calls: Vec<LightSample>) -> ExamQuestion {
    let all = Lights64::new(lights.iter().copied());
    let rows = optional_directions(calls.iter().map(|call| sample(&all, call).value));
    let question = LightQuestion::LightsSample(Table::of_list(subject(lights), calls));
    table(question, &["direction", "unit_direction"], rows)
}

fn subject(lights: &[FlatLight64]) -> LightList {
    let lights = lights.iter().map(|light| ListedLight::Flat(listed(light)));
    LightList {
        lights: lights.collect(),
    }
}

/// Converts a light to the one in a question.
fn listed(light: &FlatLight64) -> FlatLight {
    FlatLight {
        corner: light.shape.corner.as_vec3(),
        edges: light.shape.edges.map(|edge| edge.as_vec3()),
        is_triangle: light.shape.is_triangle,
        radiance: light.radiance.as_vec3(),
    }
}
