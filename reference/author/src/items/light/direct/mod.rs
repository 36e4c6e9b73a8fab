//! The items about direct light.

mod calls;
mod map;

use std::ops::Range;

use glam::{DVec3, dvec3};
use judging::drawing_data::PathHit;
use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::Table;
use protocol::light::LightQuestion;
use protocol::light::transport::DirectSample;

use self::calls::{ANYWHERE, DirectCase, FAR, GRAZING, LOW, direct_calls};
use super::groups::{DIRECT, LIGHT_DENSITIES, LIGHT_SAMPLES, MATTE, MATTE_SAMPLES};
use super::rooms::{
    DARK, HALF, beside_a_light, closed_room, emitter, matte, moved, panel, repainted, sky, subject,
    tilted, walls, with_shining_ceiling,
};
use super::{color, colors, table, with_changes};
use crate::domains::light::fields::saturation;
use crate::items::{AuthoredTask, Declaration};
use crate::oracle::light::light_sources::Environment64;
use crate::oracle::light::quad::{Material64, Quad};
use crate::oracle::light::room::{Room, Surface64};
use crate::oracle::light::specular::reflect;
use crate::seed::Rng;

/// The number of calls of each kind in a question.
const CALLS: usize = 10;
/// The default fields of an item about direct light.
const DIRECT_LIGHT: Declaration = Declaration {
    needs: &[MATTE, MATTE_SAMPLES, LIGHT_SAMPLES, LIGHT_DENSITIES],
    ..Declaration::in_group(DIRECT)
};

/// The task `direct`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        SMALL_LIGHT,
        SKY,
        BOTH,
        BLOCKED,
        TURNED,
        NO_SAMPLE,
        OTHER_MATERIALS,
        map::MAP,
    ],
    domains: &[&crate::domains::light::transport::DIRECT],
    ..AuthoredTask::NEW
};

const SMALL_LIGHT: Declaration = Declaration {
    id: "direct.small_light",
    points: 2,
    title: "sampling the light finds a small light where nothing is in the way",
    look: "Work out both terms, evaluate × radiance / (light pdf + scattering pdf), for the question \
           shown. Is one of them wrong, or only their sum? Is each direction in the surface's frame for \
           the material, and in world space for `World`?",
    section: "light/direct.md#two-ways-to-find-a-light",
    tests: &[
        "Estimates the direct light that a surface scatters back along the path, from one \
         direction toward a light and one that the material samples.",
        "The first direction is the one that [`World::sample_light`] returns.",
        "[`World::light_pdf`] returns the light pdf.",
    ],
    questions: |rng| {
        let mut questions = rooms(rng, LIT_AND_DARK, |rng| {
            let mut quads = walls(rng.list(6, matte));
            let center = rng.point(1.2);
            let size = rng.uniform(0.1, 0.2);
            let material = emitter(rng);
            quads.push(tilted(rng, center, size, material));
            Room::new(quads, DARK)
        });
        // Farther away, the light looks even smaller, so its density is very high.
        for distances in [150.0..300.0, 400.0..750.0] {
            let room = below_a_far_light(rng, distances);
            let calls = direct_calls(rng, &room, FAR, CALLS, |case| case.is_lit());
            questions.push(question(&room, calls));
        }
        questions
    },
    ..DIRECT_LIGHT
};

const SKY: Declaration = Declaration {
    id: "direct.sky",
    title: "without lights, only the material's direction finds the uniform sky",
    look: "Without lights, only the material's direction remains. Is it the one that `scatter` \
           returns for `numbers.direct`, do you convert it to world space, and what do you divide \
           by?",
    look_fits: &[Symptom::of("value")],
    section: "light/direct.md#an-even-sky-is-found-by-scattering",
    tests: &[
        "The second is the one that `Lambertian::scatter` returns for the random numbers \
         `numbers.direct`.",
        "The radiance is the light that arrives from this direction, straight from a light or the \
         environment.",
    ],
    questions: |rng| {
        let mut questions = rooms(rng, LIT_AND_DARK, |rng| {
            let mut quads = open(rng);
            let center = rng.point(1.0);
            let material = matte(rng);
            quads.push(tilted(rng, center, 1.5, material));
            let sky = sky(rng);
            Room::new(quads, sky)
        });
        // Almost along a floor, evaluate and the pdf are tiny, but their quotient isn't.
        let floor = open(rng).swap_remove(0);
        let material = matte(rng);
        let above = tilted(rng, 1.5 * DVec3::Y, 0.3, material);
        let sky = Environment64::Constant(color(rng) * rng.log_uniform(1e-3, 1e4));
        let room = Room::new(vec![floor, above], sky);
        let calls = direct_calls(rng, &room, GRAZING, CALLS / 2, |case| case.is_lit());
        questions.push(question(&room, calls));
        questions
    },
    ..DIRECT_LIGHT
};

const BOTH: Declaration = Declaration {
    id: "direct.both",
    points: 2,
    title: "if both directions find light, each term is divided by the sum of its densities",
    look: "For each of the two directions, work out both densities. What do you divide by?",
    section: "light/direct.md#the-balance-heuristic",
    tests: &[
        "See Veach and Guibas, \"Optimally Combining Sampling Techniques for Monte Carlo \
         Rendering\", SIGGRAPH 1995, section 3.2.",
        "The result is the sum, over both directions, of evaluate × radiance / (light pdf + \
         scattering pdf).",
        "Each term uses both densities of its own direction, no matter which way that direction \
         was sampled.",
    ],
    questions: |rng| {
        let mut questions = rooms(rng, &[(2 * CALLS, |it| it.is_lit())], with_shining_ceiling);
        // Light can be very bright or very dim, and walls can be very dark.
        let saturation = saturation(rng);
        let extremes = [
            (1e7, DVec3::ONE),
            (1e-6, DVec3::ONE),
            (1.0, DVec3::splat(1e-4)),
            (1.0, saturation),
        ];
        questions.extend(extremes.map(|(brightness, albedo)| {
            let mut quads = walls(rng.list(6, |rng| Material64::Lambertian {
                albedo: albedo * color(rng),
            }));
            let radiance = brightness * color(rng);
            let ceiling = Material64::Emitter { radiance };
            quads[3] = panel(HALF.y * DVec3::Y, 1, -1.0, HALF, ceiling);
            let room = Room::new(quads, DARK);
            question(&room, lit(rng, &room, CALLS))
        }));
        // Almost along a floor, both terms are small, but neither is zero, even if it is dark.
        let low = beside_a_light(rng, DARK);
        for room in [repainted(&low, 1e-3), low] {
            let calls = direct_calls(rng, &room, LOW, CALLS, |case| {
                let is_low = |direction: DVec3| (4e-4..9e-4).contains(&direction.z);
                case.local_sample().is_some_and(is_low)
                    && case.is_lit()
                    && case.surface.position.x < 4.0
                    && case.scatters_to_a_light()
            });
            questions.push(question(&room, calls));
        }
        // Each question begins with the call that the previous one ends with.
        let room = with_shining_ceiling(rng);
        let mut calls = lit(rng, &room, CALLS / 2);
        for factor in [1.0, 0.6, 0.3] {
            questions.push(question(&repainted(&room, factor), calls.clone()));
            calls.reverse();
        }
        questions
    },
    ..DIRECT_LIGHT
};

const BLOCKED: Declaration = Declaration {
    id: "direct.blocked",
    points: 2,
    title: "light arrives from a direction only if nothing is in the way",
    look: "Which method of `World` tells you whether anything is between the surface and the \
           light?",
    look_fits: &[Symptom::more("value")],
    section: "light/direct.md#something-in-the-way",
    tests: &[
        "It is zero if something is in the way: see [`World::emitted`].",
        "A direction adds nothing if the sum of its densities is zero, or if `evaluate` is zero.",
    ],
    questions: |rng| {
        // In a tiny room, things are close together.
        let tiny = (1e-4, DVec3::ZERO);
        let places = [vec![tiny], places(rng)].concat();
        let kinds: &[Kind] = &[
            (CALLS, |it| it.is_lit()),
            (CALLS, is_like_matte),
            // The direction toward a light is blocked, but scattering finds a light.
            (CALLS / 2, |it| it.is_lit() && it.blocker().is_some()),
            (CALLS / 2, |it| is_blocked_by(it, PathHit::Matte)),
            (CALLS / 2, |it| is_blocked_by(it, PathHit::Mirror)),
            (CALLS / 2, |it| is_blocked_by(it, PathHit::Glass)),
            // The back of another light.
            (CALLS / 2, |it| is_blocked_by(it, PathHit::Light)),
        ];
        rooms_at(rng, &places, kinds, with_screens)
    },
    ..DIRECT_LIGHT
};

const TURNED: Declaration = Declaration {
    id: "direct.turned",
    points: 2,
    title: "directions are converted to and from the frame of a tilted surface",
    look: "Which of your directions are in world space, and which are in the surface's frame? Check \
           where you convert one to the other. Or does an early `return` drop the second direction?",
    look_fits: &[Symptom::of("value")],
    section: "light/direct.md#evaluate-in-the-frame-of-the-surface",
    tests: &["The result is the sum, over both directions, of evaluate × radiance / …"],
    questions: |rng| {
        let kinds: &[Kind] = &[
            (CALLS, |it| it.is_lit()),
            (CALLS, |_| true),
            (CALLS / 2, |it| it.is_lit() && it.is_grazed()),
            // The light that was picked is below the surface, but scattering finds the other.
            (CALLS / 2, |it| {
                let is_below = |direction: DVec3| direction.z < 0.0;
                it.local_sample().is_some_and(is_below) && it.scatters_to_a_light()
            }),
        ];
        let mut questions = rooms(rng, kinds, |rng| {
            let mut quads = rng.list(5, |rng| {
                let center = rng.point(2.0);
                let material = matte(rng);
                tilted(rng, center, 1.2, material)
            });
            for x in [-2.6, 2.6] {
                let light = emitter(rng);
                quads.push(panel(dvec3(x, 3.5, 0.0), 1, -1.0, HALF, light));
            }
            let sky = sky(rng);
            Room::new(quads, sky)
        });
        // Close above a large floor, rays can hit it almost along it.
        let room = below_a_close_light(rng);
        let calls = [0.0199, 0.0049].map(|most| {
            direct_calls(rng, &room, ANYWHERE, 3, |case| {
                case.is_lit() && case.surface.out.z < most
            })
        });
        questions.push(question(&room, calls.concat()));
        questions
    },
    ..DIRECT_LIGHT
};

const NO_SAMPLE: Declaration = Declaration {
    id: "direct.no_sample",
    title: "the material's direction is used with and without a direction toward a light",
    look: "If `World::sample_light` returns `None`, only the first term is zero: do you still \
           compute the second one?",
    look_fits: &[Symptom::of("value")],
    section: "light/direct.md#without-a-light-sample",
    tests: &["If it returns `None`, the first term is zero."],
    questions: |rng| {
        let kinds: &[Kind] = &[
            (CALLS, |it| it.is_lit()),
            (CALLS, |_| true),
            (CALLS, |it| it.is_lit() && it.sample().is_none()),
            // The picked light faces away, but scattering finds the other one.
            (CALLS, |it| {
                it.is_lit() && it.scatters_to_a_light() && it.sample().is_none()
            }),
        ];
        rooms(rng, kinds, |rng| {
            // One light faces away from nearly everything, and one faces the floor.
            let mut quads = open(rng);
            let half = dvec3(0.7, 0.0, 0.7);
            let brightness = rng.log_uniform(0.5, 50.0);
            let mut light = || Material64::Emitter {
                radiance: color(rng) * brightness,
            };
            quads.push(panel(dvec3(0.2, -1.0, 0.3), 1, 1.0, half, light()));
            quads.push(panel(dvec3(-0.4, 1.0, 0.0), 1, -1.0, 2.0 * half, light()));
            let sky = sky(rng);
            Room::new(quads, sky)
        })
    },
    ..DIRECT_LIGHT
};

const OTHER_MATERIALS: Declaration = Declaration {
    id: "direct.other_materials",
    title: "only matte surfaces look for direct light",
    look: "If the correct result is 0, the surface may be a mirror, glass or a light: what do you \
           return for these? Otherwise, it is matte: check each factor of the formula.",
    look_fits: &[Symptom::of("value")],
    section: "light/direct.md#no-light-sample-at-mirrors-and-glass",
    tests: &[
        "Only matte surfaces look for direct light.",
        "The result is zero for all others, because a direction toward a light is never exactly \
         one that they reflect or refract to.",
    ],
    questions: |rng| {
        let kinds: &[Kind] = &[
            (CALLS, |it| it.is_matte() && it.is_lit()),
            // A matte surface would be lit at the same place.
            (CALLS, |it| !it.is_matte() && it.would_be_lit()),
            // These show a light in their reflection.
            (CALLS, |it| {
                let reflected = it.surface.frame.to_world(reflect(it.surface.out));
                !it.is_matte() && it.is_lit_from(reflected)
            }),
        ];
        rooms(rng, kinds, |rng| {
            let mirror = Material64::Mirror {
                reflectance: color(rng),
            };
            let ior = rng.uniform(1.3, 1.8);
            let glass = Material64::Glass { ior };
            let [first, second] = [matte(rng), matte(rng)];
            closed_room(rng, [glass, mirror, second, first, glass, mirror])
        })
    },
    ..DIRECT_LIGHT
};

/// Returns whether a surface is matte, or would get no light if it were. The other surfaces are
/// those that [`OTHER_MATERIALS`] is about.
fn is_like_matte(case: &DirectCase) -> bool {
    case.is_matte() || !case.would_be_lit()
}

/// Returns whether a surface of this kind is in the way of the direction toward a light.
fn is_blocked_by(case: &DirectCase, kind: PathHit) -> bool {
    let is_kind = |blocker: Surface64| blocker.kind() == kind;
    case.blocker().is_some_and(is_kind) && is_like_matte(case)
}

/// The number of calls of some kind, and the condition that is true for them.
type Kind = (usize, fn(&DirectCase) -> bool);

/// Calls that get light, and as many that get none if the room has any.
const LIT_AND_DARK: &[Kind] = &[(CALLS, |it| it.is_lit()), (CALLS, |_| true)];

/// Returns calls that get light.
fn lit(rng: &mut Rng, room: &Room, count: usize) -> Vec<DirectSample> {
    direct_calls(rng, room, ANYWHERE, count, |case| case.is_lit())
}

/// Returns a floor and two walls.
fn open(rng: &mut Rng) -> Vec<Quad> {
    let all = walls(rng.list(6, matte));
    vec![all[2], all[0], all[4]]
}

/// Returns a room with two lights, and things of different materials below them.
fn with_screens(rng: &mut Rng) -> Room {
    let mut quads = walls(rng.list(6, matte));
    let half = dvec3(0.6, 0.0, 0.6);
    let light = emitter(rng);
    quads.push(panel(dvec3(0.0, 1.9, 0.0), 1, -1.0, half, light));
    // The front of this light is up, so it is dark from below.
    quads.push(panel(dvec3(-1.0, 0.2, -1.2), 1, 1.0, half, light));
    let light = emitter(rng);
    quads.push(panel(dvec3(-1.5, 1.5, -1.0), 1, -1.0, half, light));
    let reflectance = color(rng);
    let screens = [
        (dvec3(0.3, 0.9, 0.2), matte(rng)),
        (dvec3(1.0, 0.4, -0.9), Material64::Mirror { reflectance }),
        (dvec3(-0.7, 0.7, 0.9), Material64::Glass { ior: 1.5 }),
    ];
    quads.extend(screens.map(|(center, material)| panel(center, 1, 1.0, half, material)));
    Room::new(quads, DARK)
}

/// Returns a floor with a light high above it, as a multiple of the light's size.
fn below_a_far_light(rng: &mut Rng, sizes: Range<f64>) -> Room {
    let height = rng.uniform(20.0, 40.0);
    let half = 0.5 * height / rng.log_uniform(sizes.start, sizes.end);
    let center = rng.point(3.0).with_y(height);
    let radiance = color(rng) * rng.log_uniform(1e3, 1e6);
    let light = Material64::Emitter { radiance };
    let light = panel(center, 1, -1.0, DVec3::splat(half), light);
    Room::new(vec![open(rng).swap_remove(0), light], DARK)
}

/// Returns a floor with a light close above it. The floor is at y = 0, so that heights above it are
/// hardly rounded.
fn below_a_close_light(rng: &mut Rng) -> Room {
    let half = dvec3(8.0, 0.0, 8.0);
    let height = 0.2 * DVec3::Y;
    let light = emitter(rng);
    let mut floor = |center| panel(center, 1, 1.0, half, matte(rng));
    // Rays start around the middle of the room, which is at the height of the upper floor.
    let mut quads = vec![floor(DVec3::ZERO), floor(-height)];
    quads.push(panel(height, 1, -1.0, 0.8 * half, light));
    Room::new(quads, DARK)
}

/// Returns one question about calls of these kinds for each of two rooms.
fn rooms(rng: &mut Rng, kinds: &[Kind], room: impl Fn(&mut Rng) -> Room) -> Vec<ExamQuestion> {
    let places = places(rng);
    rooms_at(rng, &places, kinds, room)
}

/// Returns the scales and positions of two rooms. The first is small or far from the origin, and the
/// second is large or of an ordinary size.
fn places(rng: &mut Rng) -> Vec<(f64, DVec3)> {
    let direction = rng.direction();
    let first = if rng.coin() {
        (0.01, DVec3::ZERO)
    } else {
        (0.3, 54.0 * direction)
    };
    let second = if rng.coin() { 1.0 } else { 100.0 };
    vec![first, (second, DVec3::ZERO)]
}

/// Returns one question for each room with one of these scales and positions.
fn rooms_at(
    rng: &mut Rng,
    places: &[(f64, DVec3)],
    kinds: &[Kind],
    room: impl Fn(&mut Rng) -> Room,
) -> Vec<ExamQuestion> {
    let of_room = |&(scale, shift): &(f64, DVec3)| {
        let room = moved(&room(rng), scale, shift);
        let calls = kinds
            .iter()
            .flat_map(|&(count, wanted)| direct_calls(rng, &room, ANYWHERE, count, wanted));
        let calls = calls.collect();
        question(&room, rng.shuffled(calls))
    };
    places.iter().map(of_room).collect()
}

fn question(room: &Room, calls: Vec<DirectSample>) -> ExamQuestion {
    let case = |call: &DirectSample| DirectCase::new(room, call);
    let ask = |calls: Vec<DirectSample>| {
        let light = |call| {
            case(call)
                .expect("the ray of every call hits a surface")
                .light
        };
        let rows = colors(calls.iter().map(light));
        let question = LightQuestion::Direct(Table::of_list(subject(room), calls));
        table(question, &["value"], rows)
    };
    with_changes(calls, ask, |call| {
        case(call).is_some_and(|case| case.is_clear(None))
    })
}
