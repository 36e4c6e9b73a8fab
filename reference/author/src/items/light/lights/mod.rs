//! The items about sampling lights.

mod spheres;

use glam::{DVec2, DVec3};
use judging::exam::ExamQuestion;
use judging::symptom::{SOME_OR_NONE, Symptom};
use protocol::Table;
use protocol::light::LightQuestion;
use protocol::light::lights::{
    FlatLight, LightList, LightSample, ListedLight, SphericalLight, Toward,
};

use super::groups::{LIGHT_DENSITIES, LIGHT_SAMPLES};
use super::{
    MARGIN, color, densities, optional_directions, random_pair, single, table, with_changes,
};
use crate::domains::fields::{FURTHEST, direction as random_direction};
use crate::domains::light::fields::{self, BELOW_ONE};
use crate::domains::light::lights::{AREA_LIGHT_PDF, LIGHTS_PDF, LIGHTS_SAMPLE};
use crate::items::{AuthoredTask, Declaration};
use crate::oracle::light::flat_shape::FlatShape;
use crate::oracle::light::lights::{FlatLight64, Light64, Lights64};
use crate::oracle::light::{WithMargin, nearest_border};
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
    domains: &[&AREA_LIGHT_PDF, &LIGHTS_PDF, &LIGHTS_SAMPLE],
    ..AuthoredTask::NEW
};

const DENSITY: Declaration = Declaration {
    id: "lights.density",
    points: 2,
    title: "the density of directions to a light is distance² / (cos θ · area)",
    look: "Work out distance², cos θ and the area by hand for the question shown. Which of them is \
           different in your code, and is each one multiplied or divided as in the formula?",
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
        let forms = [RECTANGLES, RECTANGLES].concat();
        one_light(rng, &forms, |rng, light| {
            let mut views = vec![(FRONT, CALLS / 2), (CLOSE, CALLS / 2)];
            let is_within_the_scene = length(light) < FURTHEST / (1.1 * FAR.distance[1]);
            if is_within_the_scene && narrowness(light) < VERY_NARROW {
                views.push((FAR, CALLS / 2));
            }
            toward(rng, light, &views)
        })
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const TRIANGLE: Declaration = Declaration {
    id: "lights.triangle",
    title: "the density of directions to a triangle uses the triangle's own area",
    look: "The given field `area` is right for both shapes, parallelograms and triangles. Do you \
           use it, or do you compute the area yourself?",
    section: "light/lights.md#the-density-of-an-area-light",
    tests: &["Returns the probability density, per solid angle, of a direction …"],
    questions: |rng| {
        one_light(rng, TRIANGLES, |rng, light| {
            toward(rng, light, &[(FRONT, CALLS)])
        })
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const BEHIND: Declaration = Declaration {
    id: "lights.behind",
    title: "a light's density is 0 from behind, and positive in front",
    look: "If the correct density is 0, the point is behind the light: what is the sign of your \
           cosine? Otherwise, compare each factor of the formula with your code.",
    look_fits: &[Symptom::of("pdf")],
    section: "light/lights.md#the-back-of-a-light-is-dark",
    tests: &["The result is zero if the direction misses the light, and from behind, …"],
    questions: |rng| {
        let views = [
            (BACK, CALLS / 2),
            (EDGE_ON_BACK, CALLS / 4),
            (FRONT, CALLS / 2),
        ];
        one_light(rng, EVERY_FORM, |rng, light| {
            let calls = toward(rng, light, &views)?;
            Some(rng.shuffled(calls))
        })
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const PAST: Declaration = Declaration {
    id: "lights.past",
    title: "only a direction that hits the light has a density",
    look: "If the correct density is 0, `intersect` finds nothing: what do you return then? \
           Otherwise, compare each factor of the formula with your code.",
    look_fits: &[Symptom::of("pdf")],
    section: "light/lights.md#past-the-light-there-is-no-density",
    tests: &[
        "The result is zero if the direction misses the light, and from behind, where the light \
         doesn't emit.",
    ],
    questions: |rng| {
        one_light(rng, EVERY_FORM, |rng, light| {
            let front = toward(rng, light, &[(FRONT, CALLS / 2)])?;
            let turned = front.iter().map(turned).collect();
            let past = rng.retry_list(CALLS, |rng| past_once(rng, light));
            let calls = [front, turned, past].concat();
            Some(rng.shuffled(calls))
        })
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const GRAZING: Declaration = Declaration {
    id: "lights.grazing",
    title: "a light that is seen nearly edge-on has a high density",
    look: "The cosine can be very small, so the density can be very large. Do you raise small \
           cosines to a minimum, or limit the density?",
    section: "light/lights.md#the-cosine-divides",
    tests: &["Returns the probability density, per solid angle, of a direction …"],
    questions: |rng| {
        let mut questions = one_light(rng, EVERY_FORM, |rng, light| {
            toward(rng, light, &[(EDGE_ON, CALLS / 2)])
        });
        let views = [(ALMOST_IN_ITS_PLANE, 2), (ALMOST_IN_ITS_PLANE_BEHIND, 2)];
        questions.extend(every_size(rng).into_iter().map(|size| {
            rng.retry(|rng| {
                let light = parallel_to_axes(rng, size);
                let calls = toward(rng, &light, &views)?;
                Some(one_light_densities(light, calls))
            })
        }));
        questions
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const DIRECTION: Declaration = Declaration {
    id: "lights.direction",
    points: 2,
    title: "a sample is the unit direction to the given point on the light",
    look: "Does your direction lead from the point shown to the one that `AreaLight::point` \
           returns, and how long is it? In front of the light, its dot product with the light's \
           normal is negative.",
    look_fits: &[Symptom::of("direction"), Symptom::less(SOME_OR_NONE)],
    section: "light/lights.md#from-the-point-to-the-light",
    tests: &[
        "Samples a direction from a point to a light with random numbers in `[0, 1)`.",
        "`random` picks the point on that light: see [`AreaLight::point`].",
        "The result is the direction to that point, as a unit vector.",
    ],
    questions: |rng| {
        let sizes = every_size(rng);
        let forms_and_sizes = EVERY_FORM.iter().zip(sizes.into_iter().cycle());
        let questions = forms_and_sizes.map(|(&form, size)| {
            let lights = [light(rng, form, size)];
            let calls = samples(rng, &lights, CALLS, Option::is_some);
            sampled(&lights, calls, is_clear)
        });
        questions.collect()
    },
    ..Declaration::in_group(LIGHT_SAMPLES)
};

const PICK: Declaration = Declaration {
    id: "lights.pick",
    points: 2,
    title: "lights are picked in proportion to their power, in the order of the list",
    look: "Add up the shares of the power, one light after the other: which light's interval \
           contains `choice`?",
    look_fits: &[Symptom::of("direction")],
    section: "light/lights.md#pick-a-light-by-its-power",
    tests: &[
        "`choice` picks the light: a light's share of `[0, 1)` is its share of the power, in the \
         order of the list.",
        "Numbers at the border between two lights are not tested.",
        "Shapes and other lights that are in the way are ignored.",
    ],
    questions: |rng| {
        let counts = [2, 3, 7, 40, 100];
        let sizes = every_size(rng);
        let lists = counts.into_iter().zip(sizes);
        let mut lists: Vec<Vec<FlatLight64>> = lists
            .map(|(count, size)| several(rng, count, size))
            .collect();
        lists.insert(3, with_exchanged_powers(&lists[2]));
        lists.insert(2, with_exchanged_powers(&lists[1]));
        lists.insert(1, with_exchanged_powers(&lists[0]));
        let size = size(rng, 3);
        lists.push(alike(rng, size));
        // Most questions start with the call that the previous one ends with.
        let mut last = None;
        let questions = lists.into_iter().map(|lights| {
            let all = Lights64::new(lights.iter().copied());
            let same = last.filter(|call| is_clear(&all, call));
            let mut calls = Vec::from_iter(same);
            calls.extend(past_rounding(rng, &lights));
            calls.extend(samples(rng, &lights, 2 * CALLS, Option::is_some));
            last = calls.last().copied();
            sampled(&lights, calls, is_clear)
        });
        questions.collect()
    },
    ..Declaration::in_group(LIGHT_SAMPLES)
};

const FACES_AWAY: Declaration = Declaration {
    id: "lights.faces_away",
    title: "there is a sample only if there are lights and the picked one doesn't face away",
    look: "If the light that was picked faces away, do you pick another light, or return a \
        direction anyway?",
    look_fits: &[Symptom::more(SOME_OR_NONE)],
    section: "light/lights.md#the-picked-light-may-face-away",
    tests: &[
        "The result is `None` if there are no lights, or if the light that was picked faces away.",
        "No other light is picked instead.",
    ],
    questions: |rng| {
        let counts = [1, 2, 5, 9, 25, 60];
        let lists = counts.into_iter().zip(every_size(rng));
        let questions = lists.map(|(count, size)| {
            let lights = several(rng, count, size);
            let mut mixed = samples(rng, &lights, CALLS, Option::is_none);
            mixed.extend(samples(rng, &lights, CALLS / 2, Option::is_some));
            mixed.extend(past_rounding(rng, &lights));
            sampled(&lights, rng.shuffled(mixed), is_clear)
        });
        let mut questions: Vec<ExamQuestion> = questions.collect();
        let nowhere = samples(rng, &[], 3, Option::is_none);
        questions.push(sampled::<Light64>(&[], nowhere, is_clear));
        // A light that is seen almost exactly edge-on still faces the point.
        let size = size(rng, 3);
        let light = parallel_to_axes(rng, size);
        let views = [ALMOST_IN_ITS_PLANE, ALMOST_IN_ITS_PLANE_BEHIND];
        let calls = [views, views, views].concat().into_iter().map(|view| {
            rng.retry(|rng| {
                let random = random_pair(rng);
                let from = toward_point(rng, &light, view, light.point(random.as_dvec2()))?.from;
                let choice = super::random(rng);
                Some(LightSample {
                    from,
                    choice,
                    random,
                })
            })
        });
        let calls = calls.collect();
        questions.push(sampled(&[light], calls, is_clear));
        questions
    },
    ..Declaration::in_group(LIGHT_SAMPLES)
};

const SHARES: Declaration = Declaration {
    id: "lights.shares",
    title: "the total density weights each light's density by its share of the power",
    look: "What is the probability that the light in this direction is picked? And does your sum run \
           over all lights, even after one that the direction misses?",
    look_fits: &[Symptom::of("pdf")],
    section: "light/lights.md#several-lights-in-one-direction",
    tests: &[
        "Returns the probability density, per solid angle, with which [`Lights::sample`] chooses \
         a direction from a point.",
        "The result is zero if there are no lights.",
    ],
    questions: |rng| {
        let counts = [1, 2, 3, 8, 40, 100];
        // Most questions start with the call that the previous one ends with.
        let mut last = None;
        let mut questions = Vec::new();
        for (count, size) in counts.into_iter().zip(every_size(rng)) {
            let (lights, calls) = rng.retry(|rng| {
                let mut lights = several(rng, count, size);
                if count == 3 {
                    // A light is hardly ever picked.
                    let others: f64 = lights[1..].iter().map(FlatLight64::power).sum();
                    let power = rng.log_uniform(1e-9, 9e-8) * others;
                    lights[0].radiance = single(DVec3::splat(power / lights[0].shape.area()));
                }
                let calls = calls_of_list(rng, &lights)?;
                Some((lights, calls))
            });
            let same = clear(&lights, Vec::from_iter(last));
            // This one leads to a light.
            let again = vec![calls[0]];
            last = Some(calls[0]);
            let calls = [same, calls, again.clone()].concat();
            questions.push(list_densities(&lights, calls));
            if (2..40).contains(&count) {
                questions.push(list_densities(&with_exchanged_powers(&lights), again));
            }
        }
        questions.push(rng.retry(|rng| {
            let size = size(rng, 3);
            let lights = alike(rng, size);
            let calls = calls_of_list(rng, &lights)?;
            Some(list_densities(&lights, calls))
        }));
        let calls = rng.list(3, |rng| Toward {
            from: rng.point(3.0).as_vec3(),
            direction: rng.direction().as_vec3(),
        });
        questions.push(list_densities::<Light64>(&[], calls));
        questions
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

const OVERLAP: Declaration = Declaration {
    id: "lights.overlap",
    title: "every light in a direction adds its density, even one behind another light",
    look: "A sample of the farther light leads in the same direction. Does your sum end too early?",
    look_fits: &[Symptom::of("pdf")],
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
            let size = size(rng, 3);
            let front = light(rng, RECTANGLES[0], size);
            let away = front.shape.normal() * -rng.uniform(0.02, 0.1) * size;
            let behind = shifted(rng, &front, away);
            let mut lights = vec![front, behind];
            lights.extend((2..12).map(|n| shifted(rng, &front, f64::from(n) * away)));
            if is_reversed {
                lights.reverse();
            }
            let hits_several =
                |call: &Toward| lights.iter().filter(|light| pdf(light, call) > 0.0).count() > 1;
            let calls = rng.retry_list(2 * CALLS, |rng| {
                let calls = clear(&lights, toward(rng, &front, &[(FRONT, 1)])?);
                calls.into_iter().find(hits_several)
            });
            list_densities(&lights, calls)
        });
        questions.collect()
    },
    ..Declaration::in_group(LIGHT_DENSITIES)
};

/// How a light is seen.
#[derive(Clone, Copy)]
struct View {
    /// The range of the cosine at the light.
    cosine: [f64; 2],
    /// The sign of the cosine: 1 in front of the light and -1 behind it.
    sign: f64,
    /// The range of the distance, as a multiple of the light's first edge.
    distance: [f64; 2],
    /// The smallest margin, which is relative to the largest coordinate.
    margin: f64,
}

impl View {
    /// Returns the same view from behind the light.
    const fn seen_from_behind(self) -> View {
        View { sign: -1.0, ..self }
    }
}

const FRONT: View = View {
    cosine: [0.2, 1.0],
    sign: 1.0,
    distance: [0.05, 20.0],
    margin: MARGIN,
};
const CLOSE: View = View {
    distance: [0.005, 0.03],
    ..FRONT
};
/// A view from so far away that the light is small compared with the coordinates.
const FAR: View = View {
    distance: [300.0, 3000.0],
    margin: 2e-5,
    ..FRONT
};
const BACK: View = FRONT.seen_from_behind();
const EDGE_ON: View = View {
    cosine: [0.005, 0.1],
    ..FRONT
};
const EDGE_ON_BACK: View = EDGE_ON.seen_from_behind();
const VERY_EDGE_ON: View = View {
    cosine: [0.005, 0.0199],
    ..FRONT
};
const VERY_EDGE_ON_BACK: View = VERY_EDGE_ON.seen_from_behind();
/// A view of a light that is parallel to two axes, from almost within its plane.
const ALMOST_IN_ITS_PLANE: View = View {
    cosine: [2e-4, 9e-4],
    sign: 1.0,
    distance: [0.05, 2.0],
    margin: 1e-5,
};
const ALMOST_IN_ITS_PLANE_BEHIND: View = ALMOST_IN_ITS_PLANE.seen_from_behind();

/// The forms of lights, as indices of the classes of their domain.
const EVERY_FORM: &[usize] = &[0, 1, 2, 3, 4, 5, 6, 7];
const RECTANGLES: &[usize] = &[2, 0, 1, 3];
const TRIANGLES: &[usize] = &[6, 4, 5, 7];

/// The smallest ratio of the edges of a very narrow light.
const VERY_NARROW: f64 = 100.0;

/// Returns a light at a random position, turned in a random direction.
fn light(rng: &mut Rng, form: usize, size: f64) -> FlatLight64 {
    let first = rng.direction() * rng.uniform(0.5, 1.0) * size;
    let across = rng.perpendicular_to(first) * rng.uniform(0.3, 1.0) * size;
    let second = match form % 4 {
        0 => across,
        1 => across * rng.uniform(0.12, 0.18) * first.length() / across.length(),
        3 => across.normalize() * first.length() / (VERY_NARROW * rng.uniform(1.1, 3.0)),
        _ => across + first * rng.uniform(0.1, 0.5) * rng.sign(),
    };
    let shape = FlatShape {
        corner: single(rng.point(size)),
        edges: [single(first), single(second)],
        is_triangle: form >= 4,
    };
    FlatLight64 {
        shape,
        radiance: single(any_color(rng) * rng.log_uniform(0.05, 500.0)),
    }
}

/// Returns a random colour. Some have only one channel, and some only two.
fn any_color(rng: &mut Rng) -> DVec3 {
    let axis = DVec3::AXES[rng.index(3)];
    match rng.index(6) {
        0 => color(rng) * axis,
        1 => color(rng) * (1.0 - axis),
        _ => color(rng),
    }
}

/// Returns a call whose choice is just below 1, past the sum of shares that are rounded down.
fn past_rounding(rng: &mut Rng, lights: &[FlatLight64]) -> Option<LightSample> {
    let all = Lights64::new(lights.iter().copied());
    rng.attempt(100, |rng| {
        let [call] = samples(rng, lights, 1, Option::is_some).try_into().ok()?;
        let choice = BELOW_ONE;
        let call = LightSample { choice, ..call };
        (is_clear(&all, &call) && sample(&all, &call).value.is_some()).then_some(call)
    })
}

/// Returns a rectangle that is parallel to two axes.
fn parallel_to_axes(rng: &mut Rng, size: f64) -> FlatLight64 {
    let axes = rng.shuffled(DVec3::AXES.to_vec());
    let edges = [axes[0], axes[1]].map(|axis| single(axis * rng.uniform(0.5, 1.0) * size));
    FlatLight64 {
        shape: FlatShape {
            corner: single(rng.point(size)),
            edges,
            is_triangle: false,
        },
        radiance: color(rng),
    }
}

/// Returns a random size of a light in this class of lengths.
fn size(rng: &mut Rng, class: usize) -> f64 {
    let decade = 10_f64.powi(class as i32 - 3);
    let least = if class == 0 { 0.1 } else { 2.0 };
    decade * rng.log_uniform(least, 9.0)
}

/// Returns a size in each class of lengths, from a ten-thousandth to a few hundreds, in random
/// order.
fn every_size(rng: &mut Rng) -> Vec<f64> {
    let sizes = (0..6).map(|class| size(rng, class)).collect();
    rng.shuffled(sizes)
}

/// Returns lights of different forms. Some lists are dim, and in some, a light has no power.
fn several(rng: &mut Rng, count: usize, size: f64) -> Vec<FlatLight64> {
    let brightness = rng.log_uniform(1e-3, 1e3);
    let mut lights = rng.list(count, |rng| {
        let form = rng.index(EVERY_FORM.len());
        let size = size * rng.uniform(0.3, 1.0);
        let mut light = light(rng, form, size);
        light.radiance = single(brightness * light.radiance);
        light
    });
    if count > 1 && rng.coin() {
        let dark = if rng.coin() { 0 } else { rng.index(count) };
        lights[dark].radiance = DVec3::ZERO;
    }
    lights
}

/// Returns lights that have something in common: the halves of a rectangle, which share a corner,
/// another light with the same power, and two lights that are the same.
fn alike(rng: &mut Rng, size: f64) -> Vec<FlatLight64> {
    let whole = light(rng, EVERY_FORM[0], size);
    let [a, b] = whole.shape.edges;
    let diagonal = single(a + b);
    let [first, second] = [[a, diagonal], [diagonal, b]].map(|edges| FlatLight64 {
        shape: FlatShape {
            edges,
            is_triangle: true,
            ..whole.shape
        },
        ..whole
    });
    let mut moved = first;
    moved.shape.corner = single(rng.point(size));
    let mut other = light(rng, EVERY_FORM[2], size);
    let power = rng.uniform(0.5, 2.0) * whole.power();
    other.radiance = single(other.radiance * power / other.power());
    vec![first, second, moved, other, other]
}

/// Returns the same lights, but each has the power of the next one. Their number and the sum of
/// their powers are the same.
fn with_exchanged_powers(lights: &[FlatLight64]) -> Vec<FlatLight64> {
    let powers = lights.iter().map(FlatLight64::power);
    let powers: Vec<f64> = powers.filter(|power| *power > 0.0).collect();
    let mut next = powers.iter().cycle().skip(1);
    let mut exchanged = lights.to_vec();
    for light in exchanged.iter_mut().filter(|light| light.power() > 0.0) {
        let factor = next.next().map_or(1.0, |next| next / light.power());
        light.radiance = single(light.radiance * factor);
    }
    exchanged
}

/// Returns a copy of a light with a different position and radiance.
fn shifted(rng: &mut Rng, light: &FlatLight64, offset: DVec3) -> FlatLight64 {
    FlatLight64 {
        shape: FlatShape {
            corner: single(light.shape.corner + offset),
            ..light.shape
        },
        radiance: single(color(rng) * rng.log_uniform(0.5, 20.0)),
    }
}

/// Returns questions about the densities of lights of these forms, in different sizes.
fn one_light(
    rng: &mut Rng,
    forms: &[usize],
    calls: impl Fn(&mut Rng, &FlatLight64) -> Option<Vec<Toward>>,
) -> Vec<ExamQuestion> {
    let sizes = every_size(rng);
    // Most questions start with the call that the previous one ends with.
    let mut last = None;
    let question = |(&form, size): (&usize, f64)| {
        let (light, calls) = rng.retry(|rng| {
            let light = light(rng, form, size);
            Some((light, calls(rng, &light)?))
        });
        let same = clear(&[light], Vec::from_iter(last));
        last = calls.last().copied();
        one_light_densities(light, [same, calls].concat())
    };
    let sizes = sizes.into_iter().cycle();
    forms.iter().zip(sizes).map(question).collect()
}

fn one_light_densities(light: FlatLight64, calls: Vec<Toward>) -> ExamQuestion {
    densities_of(&[light], calls, |light, calls| {
        LightQuestion::AreaLightPdf(Table::of_list(light, calls))
    })
}

fn list_densities<L: Copy + Into<Light64>>(lights: &[L], calls: Vec<Toward>) -> ExamQuestion {
    densities_of(lights, calls, |lights, calls| {
        LightQuestion::LightsPdf(Table::of_list(lights, calls))
    })
}

/// Returns a question about densities. The density of a single light is the same as that of a list
/// of this light.
fn densities_of<L: Copy + Into<Light64>>(
    lights: &[L],
    calls: Vec<Toward>,
    question: fn(LightList, Vec<Toward>) -> LightQuestion,
) -> ExamQuestion {
    let all = Lights64::new(lights.iter().copied());
    let pdf = |call: &Toward| all.pdf(call.from.as_dvec3(), call.direction.as_dvec3());
    let ask = |calls: Vec<Toward>| {
        let rows = densities(calls.iter().map(|call| pdf(call).value));
        table(question(subject(lights), calls), &["pdf"], rows)
    };
    with_changes(calls, ask, |call| {
        pdf(call).margin > MARGIN && is_steep(lights, call)
    })
}

/// Returns whether a direction isn't almost in the plane of any flat light, where correct formulas
/// lose too many digits.
fn is_steep<L: Copy + Into<Light64>>(lights: &[L], call: &Toward) -> bool {
    let direction = call.direction.as_dvec3();
    lights.iter().all(|light| match (*light).into() {
        Light64::Flat(light) => {
            light.shape.normal().dot(direction).abs() > 0.01 * direction.length()
        }
        Light64::Sphere(_) => true,
    })
}

/// Returns the density of a single light.
fn pdf(light: &FlatLight64, call: &Toward) -> f64 {
    light.pdf(call.from.as_dvec3(), call.direction.as_dvec3())
}

/// Returns the length of a light's first edge.
fn length(light: &FlatLight64) -> f64 {
    light.shape.edges[0].length()
}

/// Returns how many times a light is as long as it is wide.
fn narrowness(light: &FlatLight64) -> f64 {
    let [a, b] = light.shape.edges.map(DVec3::length);
    (a / b).max(b / a)
}

/// Returns directions to points on a light, as many as given for each view. No direction is close to
/// the light's edge. Returns `None` if there are no such directions, e.g. because the light is too
/// narrow.
fn toward(rng: &mut Rng, light: &FlatLight64, views: &[(View, usize)]) -> Option<Vec<Toward>> {
    const ATTEMPTS: usize = 2_000;
    let is_very_narrow = narrowness(light) > VERY_NARROW;
    let factor = if is_very_narrow { 0.05 } else { 1.0 };
    let views = views.iter().flat_map(|(view, count)| vec![*view; *count]);
    let call = |view: View| {
        rng.attempt(ATTEMPTS, |rng| {
            let along = DVec2::new(rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0));
            let call = toward_point(rng, light, view, light.shape.at(along))?;
            let (from, direction) = (call.from.as_dvec3(), call.direction.as_dvec3());
            let hit = light.shape.intersect_plane(from, direction)?;
            (hit.is_hit() && hit.margin() > factor * view.margin).then_some(call)
        })
    };
    views.map(call).collect()
}

/// Returns a direction to a point in a light's plane. Some directions are along an axis or in a
/// plane between two axes.
fn toward_point(rng: &mut Rng, light: &FlatLight64, view: View, target: DVec3) -> Option<Toward> {
    let normal = light.shape.normal();
    let View {
        cosine: [least, most],
        sign,
        distance: [nearest, farthest],
        ..
    } = view;
    let special = if rng.coin() {
        DVec3::AXES[rng.index(3)]
    } else {
        random_direction(rng)
    };
    let special = special * -sign * special.dot(normal).signum();
    let cosine = (special.dot(normal)).abs();
    let direction = if rng.coin() && (least..most).contains(&cosine) {
        special
    } else {
        let height = match rng.index(6) {
            0 if most == 1.0 => rng.uniform(0.991, 1.0),
            _ => rng.log_uniform(least, most),
        };
        let along = rng.perpendicular_to(normal) * (1.0 - height * height).sqrt();
        -(sign * height * normal + along)
    };
    let distance = length(light) * rng.log_uniform(nearest, farthest);
    let from = single(target - distance * direction);
    (from.abs().max_element() < FURTHEST).then(|| Toward {
        from: from.as_vec3(),
        direction: direction.as_vec3(),
    })
}

/// Returns directions toward lights that are picked at random. Returns `None` if none are found.
fn toward_any(
    rng: &mut Rng,
    lights: &[FlatLight64],
    view: View,
    count: usize,
) -> Option<Vec<Toward>> {
    const ATTEMPTS: usize = 100;
    let call = |_| {
        rng.attempt(ATTEMPTS, |rng| {
            let light = lights[rng.index(lights.len())];
            clear(lights, toward(rng, &light, &[(view, 1)])?).pop()
        })
    };
    (0..count).map(call).collect()
}

/// Returns a direction that misses a light but hits its plane, with a probability of one half just
/// past an edge.
fn past_once(rng: &mut Rng, light: &FlatLight64) -> Option<Toward> {
    let [mut a, b] = [rng.uniform(-1.5, 2.5), rng.uniform(-1.5, 2.5)];
    if rng.coin() {
        a = -rng.uniform(0.0, 0.1);
    }
    let along = if rng.coin() { [a, b] } else { [b, a] };
    let target = light.shape.at(DVec2::from_array(along));
    let call = toward_point(rng, light, FRONT, target)?;
    let calls = clear(&[*light], vec![call]);
    calls.into_iter().find(|call| pdf(light, call) == 0.0)
}

/// Returns directions toward and past the lights in a list. Returns `None` if too few are found.
fn calls_of_list(rng: &mut Rng, lights: &[FlatLight64]) -> Option<Vec<Toward>> {
    /// The maximum number of lights of which one is seen almost exactly edge-on. No direction may
    /// be close to the edge of any other light.
    const FEW: usize = 10;
    let mut calls = toward_any(rng, lights, FRONT, CALLS)?;
    let opposite = calls[..4].iter().map(turned).collect();
    calls.extend(clear(lights, opposite));
    for (view, count) in [(EDGE_ON, 2), (BACK, 2), (EDGE_ON_BACK, 2)] {
        calls.extend(toward_any(rng, lights, view, count)?);
    }
    if lights.len() < FEW {
        for view in [VERY_EDGE_ON, VERY_EDGE_ON_BACK] {
            calls.extend(toward_any(rng, lights, view, 1)?);
        }
    }
    // These miss the light that they are next to.
    calls.extend(rng.retry_list(4, |rng| {
        let light = lights[rng.index(lights.len())];
        let call = past_once(rng, &light)?;
        clear(lights, vec![call]).pop()
    }));
    Some(calls)
}

/// Returns the opposite direction from the same point.
fn turned(call: &Toward) -> Toward {
    Toward {
        direction: -call.direction,
        ..*call
    }
}

/// Returns the calls whose directions aren't close to the edge of any light.
fn clear(lights: &[FlatLight64], calls: Vec<Toward>) -> Vec<Toward> {
    /// The smallest distance between a direction and an edge. Rounding moves a direction by about a
    /// thousandth of this.
    const CLEAR: f64 = 5e-4;
    // Lights without power have edges, too.
    let bright = lights.iter().map(|light| FlatLight64 {
        radiance: DVec3::ONE,
        ..*light
    });
    let lights = Lights64::new(bright);
    let is_clear = |call: &Toward| {
        let density = lights.pdf(call.from.as_dvec3(), call.direction.as_dvec3());
        density.margin > CLEAR
    };
    calls.into_iter().filter(is_clear).collect()
}

/// Returns calls of `Lights::sample` whose results fulfil a condition.
fn samples(
    rng: &mut Rng,
    lights: &[FlatLight64],
    count: usize,
    condition: fn(&Option<DVec3>) -> bool,
) -> Vec<LightSample> {
    let all = Lights64::new(lights.iter().copied());
    let portions = all.portions();
    let scale = lights.iter().map(length).fold(0.0, f64::max).max(1e-3);
    rng.retry_list(count, |rng| {
        let random = fields::number_pair(rng);
        let from = if lights.is_empty() || rng.coin() {
            let half = (scale * rng.log_uniform(0.3, 10.0)).min(FURTHEST);
            rng.point(half)
        } else {
            // In front of a light or behind it, close to its normal or to its plane.
            let light = lights[rng.index(lights.len())];
            let view = [FRONT, CLOSE, BACK, EDGE_ON, EDGE_ON_BACK][rng.index(5)];
            let target = light.point(random.as_dvec2());
            toward_point(rng, &light, view, target)?.from.as_dvec3()
        };
        let choice = if portions.is_empty() || rng.coin() {
            fields::number(rng)
        } else {
            // Every light is as frequent as the others.
            let [start, end] = portions[rng.index(portions.len())];
            (rng.uniform(start, end) as f32).min(BELOW_ONE)
        };
        let call = LightSample {
            from: from.as_vec3(),
            choice,
            random,
        };
        let is_clear = is_clear(&all, &call);
        (is_clear && condition(&sample(&all, &call).value)).then_some(call)
    })
}

/// Returns whether a choice isn't close to the border between two lights, relative to the picked
/// light's share, and the picked light doesn't nearly face away.
fn is_clear(lights: &Lights64, call: &LightSample) -> bool {
    /// The smallest distance of a choice from a border, as a fraction of the light's share.
    const BORDER: f64 = 0.2;
    /// The smallest distance of a choice from a border, because sums of powers are rounded.
    const ROUNDING: f64 = 2e-5;
    let choice = f64::from(call.choice);
    let portions = lights.portions();
    let starts = portions.iter().skip(1).map(|[start, _]| *start);
    let nearest = nearest_border(choice, starts);
    let is_picked = |[start, end]: &&[f64; 2]| (*start..*end).contains(&choice);
    // The last light is also picked past the end of its share, which can be due to rounding.
    let picked = portions.iter().find(is_picked).or(portions.last());
    let share = picked.map_or(0.0, |[start, end]| end - start);
    let margin = lights.picked(choice).map_or(f64::INFINITY, |light| {
        let sample = light.sample(call.from.as_dvec3(), call.random.as_dvec2());
        sample.margin
    });
    nearest > ROUNDING.max(BORDER * share) && margin > MARGIN
}

fn sample(lights: &Lights64, call: &LightSample) -> WithMargin<Option<DVec3>> {
    let from = call.from.as_dvec3();
    lights.sample(from, call.choice.into(), call.random.as_dvec2())
}

fn sampled<L: Copy + Into<Light64>>(
    lights: &[L],
    calls: Vec<LightSample>,
    is_clear: impl Fn(&Lights64, &LightSample) -> bool,
) -> ExamQuestion {
    let all = Lights64::new(lights.iter().copied());
    let ask = |calls: Vec<LightSample>| {
        let rows = optional_directions(calls.iter().map(|call| sample(&all, call).value));
        let question = LightQuestion::LightsSample(Table::of_list(subject(lights), calls));
        table(question, &["direction", "unit_direction"], rows)
    };
    with_changes(calls, ask, |call| is_clear(&all, call))
}

/// Converts lights to those in a question.
fn subject<L: Copy + Into<Light64>>(lights: &[L]) -> LightList {
    let lights = lights.iter().map(|light| match (*light).into() {
        Light64::Flat(light) => ListedLight::Flat(FlatLight {
            corner: light.shape.corner.as_vec3(),
            edges: light.shape.edges.map(|edge| edge.as_vec3()),
            is_triangle: light.shape.is_triangle,
            radiance: light.radiance.as_vec3(),
        }),
        Light64::Sphere(light) => ListedLight::Sphere(SphericalLight {
            center: light.center.as_vec3(),
            radius: light.radius as f32,
            radiance: light.radiance.as_vec3(),
        }),
    });
    LightList {
        lights: lights.collect(),
    }
}
