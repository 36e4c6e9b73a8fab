//! The items about following paths.

mod map;

use glam::{DVec3, dvec3};
use judging::drawing_data::PathHit;
use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::Table;
use protocol::light::LightQuestion;
use protocol::light::transport::PathStart;

use super::groups::{DIRECT, LIGHT_DENSITIES, LIGHT_SAMPLES, MATTE, MATTE_SAMPLES, SPECULAR};
use super::rooms::{
    DARK, HALF, beside_a_light, block, emitter, grazing_path_case, is_clear_path, is_lit, matte,
    moved, panel, path_case, path_case_along, path_light, repainted, sky, subject, walls,
    with_shining_ceiling,
};
use super::{color, colors, table, with_changes};
use crate::domains::light::fields::saturation;
use crate::domains::light::transport::last_two;
use crate::items::{AuthoredTask, Declaration, Group};
use crate::oracle::Ray64;
use crate::oracle::light::light_sources::Environment64;
use crate::oracle::light::path_steps::path_steps;
use crate::oracle::light::quad::{Material64, Quad};
use crate::oracle::light::room::{Room, Surface64};
use crate::oracle::light::{Numbers64, numbers_of_path, transport as oracle};
use crate::seed::Rng;

/// The number of calls in a question.
const CALLS: usize = 16;
/// The items of other tasks that paths between matte surfaces need.
const NEEDS: &[Group] = &[MATTE, MATTE_SAMPLES, LIGHT_SAMPLES, LIGHT_DENSITIES, DIRECT];
/// The items that paths need if they also meet mirrors or glass.
const NEEDS_WITH_SPECULAR: &[Group] = &[
    MATTE,
    MATTE_SAMPLES,
    SPECULAR,
    LIGHT_SAMPLES,
    LIGHT_DENSITIES,
    DIRECT,
];

/// The task `path`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        SEEN,
        ONE_BOUNCE,
        BOUNCES,
        ONCE,
        THROUGHPUT,
        MIRROR,
        GLASS,
        ROULETTE,
        SURVIVORS,
        SIZES,
        map::MAP,
    ],
    domains: &[&crate::domains::light::transport::RADIANCE],
    ..AuthoredTask::NEW
};

const SEEN: Declaration = Declaration {
    id: "path.seen",
    title: "with 0 bounces, the ray sees only emitted light or the environment",
    look: "What do you add if the ray hits a light, and what if it hits nothing? With 0 bounces, \
           nothing else is added.",
    look_fits: &[Symptom::of("value")],
    section: "light/paths.md#what-is-counted-where",
    tests: &[
        "Estimates the radiance that arrives at the origin of a ray, by following one path.",
        "See Kajiya, \"The Rendering Equation\", SIGGRAPH 1986, and PBR, section 13.4.",
        "With 0 bounces, the result is only the light emitted by the surface that the ray hits, or \
         the environment if the ray hits nothing.",
    ],
    questions: |rng| {
        let mut environments = [sky(rng), DARK].into_iter();
        rooms(
            rng,
            |rng| {
                let environment = environments.next().unwrap_or(DARK);
                bright(rng, environment)
            },
            |rng, room| {
                let mut cases = cases(rng, room, 0, |surface, _, _| surface.is_none());
                cases.extend(self::cases(rng, room, 0, |surface, _, light| {
                    surface.is_some() && is_lit(light)
                }));
                cases.extend(self::cases(rng, room, 0, |surface, _, light| {
                    surface.is_some() && !is_lit(light)
                }));
                cases.extend(self::cases(rng, room, 0, |surface, _, _| {
                    surface.is_some_and(is_light_from_behind)
                }));
                cases
            },
        )
    },
    needs: NEEDS,
    ..Declaration::ALONE
};

const ONE_BOUNCE: Declaration = Declaration {
    id: "path.one_bounce",
    title: "with 1 bounce, the path is scattered at most once and adds direct light there",
    look: "Write down what your loop adds at the first surface, and what it adds at the second. Is \
           a term missing, counted twice, or multiplied by the wrong factor?",
    section: "light/paths.md#what-to-return",
    tests: &[
        "With 1 bounce, direct light is added.",
        "Bounce 0 is at the first surface.",
        "Both use the random numbers `sampler.numbers(bounce)`.",
    ],
    questions: |rng| {
        let mut questions = rooms(
            rng,
            |rng| {
                let sky = sky(rng);
                bright(rng, sky)
            },
            |rng, room| cases(rng, room, 1, lit),
        );
        // Each question begins with the call that the previous one ends with.
        let sky = sky(rng);
        let room = bright(rng, sky);
        let mut calls = cases(rng, &room, 1, first_is_matte);
        calls.truncate(CALLS / 2);
        for factor in [1.0, 0.6, 0.3] {
            questions.push(question(&repainted(&room, factor), calls.clone()));
            calls.reverse();
        }
        questions
    },
    needs: NEEDS,
    ..Declaration::ALONE
};

const BOUNCES: Declaration = Declaration {
    id: "path.bounces",
    points: 2,
    title: "a path is scattered as often as `bounces` and Russian roulette allow",
    look: "Follow the question from surface to surface. Each one counts as a bounce, even a mirror. Where \
           does the next ray go, what do you add, and which factors apply (roulette from bounce 3 on)? \
           Does bounce n use `sampler.numbers(n)`?",
    section: "light/paths.md#what-to-return",
    tests: &["The path is scattered at most `bounces` times."],
    questions: |rng| {
        let bounces = [2, 3];
        let questions = bounces
            .into_iter()
            .flat_map(|bounces| rooms(rng, closed, |rng, room| cases(rng, room, bounces, lit)));
        let mut questions: Vec<ExamQuestion> = questions.collect();
        // In a white room, many paths are long. The last bounce still adds light.
        let white = room_with(rng, || Material64::Lambertian {
            albedo: DVec3::splat(0.95),
        });
        questions.extend([12, 20].map(|bounces| {
            let case = |_| {
                path_case_along(rng, &white, bounces, |ray, numbers, light| {
                    let shorter = without_the_last(&white, ray, numbers);
                    let is_lit_last = (light - shorter).max_element() > 0.01 * light.max_element();
                    is_lit_last && is_stable(&white, ray, numbers, light)
                })
            };
            question(&white, (0..CALLS / 2).map(case).collect())
        }));
        // Between two mirrors, paths are even longer.
        let corridor = corridor(rng);
        let cases = [(40, 32), (40, 32), (100, 64), (100, 64)].map(|(bounces, period)| {
            path_case_along(rng, &corridor, bounces, |ray, numbers, light| {
                let radiance =
                    |numbers: &[Numbers64]| oracle::radiance(&corridor, ray, numbers).value;
                let (first, rest) = numbers.split_at(period);
                let repeated = [first, &first[..rest.len()]].concat();
                is_lit(light) && radiance(first) != light && radiance(&repeated) != light
            })
        });
        questions.push(question(&corridor, cases.into()));
        // All kinds of light still count after many mirrors.
        let long = lit_corridor(rng);
        let depths = [(40, 9..33), (100, 33..65), (100, 65..101)];
        let kinds = [PathHit::Matte, PathHit::Light, PathHit::Nothing];
        let each = depths
            .into_iter()
            .flat_map(|depth| kinds.map(|kind| (depth.clone(), kind)));
        let calls = each.flat_map(|((bounces, depths), kind)| {
            [(); 2].map(|()| {
                path_case_along(rng, &long, bounces, |ray, numbers, light| {
                    let steps = path_steps(&long, ray, numbers);
                    let mut lit = steps.iter().zip(0..);
                    let is_deep = lit.any(|(step, bounce)| {
                        step.hit == kind
                            && depths.contains(&bounce)
                            && is_lit(step.light.as_dvec3())
                    });
                    is_deep && is_stable(&long, ray, numbers, light)
                })
            })
        });
        let calls = calls.collect();
        questions.push(question(&long, rng.shuffled(calls)));
        questions
    },
    needs: NEEDS_WITH_SPECULAR,
    ..Declaration::ALONE
};

const ONCE: Declaration = Declaration {
    id: "path.once",
    points: 2,
    title: "after a matte surface, a light or the sky that the path hits isn't counted again",
    look: "Which code has already counted the light that the path hits after a matte surface?",
    look_fits: &[Symptom::more("value")],
    section: "light/paths.md#only-once",
    tests: &[
        "The light that a surface emits, or the environment if the ray hits nothing, is counted \
         only if the ray comes from the camera, a mirror or glass (whose `pdf` is `None`).",
        "After a matte surface, `direct` has already counted it.",
        "A path ends at a surface that scatters nothing, when its throughput is zero, or by \
         chance: from bounce 3 on (the fourth surface), it survives if `numbers.survive` is less \
         than q, and its throughput is divided by q.",
    ],
    questions: |rng| {
        let mut questions = rooms(rng, with_shining_ceiling, |rng, room| {
            let mut cases = cases(rng, room, 2, first_is_matte);
            cases.extend(self::cases(rng, room, 3, first_is_matte));
            cases
        });
        // Almost along a floor, the density is small, but there is one.
        let sky = Environment64::Constant(color(rng));
        let floor = beside_a_light(rng, sky);
        let case = |_| {
            grazing_path_case(rng, &floor, 2, |ray, numbers, light| {
                let first = floor.hit(ray, None).value;
                first_is_matte(first.as_ref(), numbers, light)
            })
        };
        questions.push(question(&floor, (0..CALLS / 2).map(case).collect()));
        questions
    },
    needs: NEEDS,
    ..Declaration::ALONE
};

const THROUGHPUT: Declaration = Declaration {
    id: "path.throughput",
    points: 2,
    title: "light from later surfaces is multiplied by the attenuation of every earlier one",
    look: "Follow one path over two coloured walls: which factors is the last light multiplied by?",
    section: "light/paths.md#throughput-is-a-product",
    tests: &[
        "At each bounce, the path adds [`direct`] light and continues in the direction that \
         `Material::scatter` returns.",
        "Everything after the bounce is multiplied by the attenuation.",
    ],
    questions: |rng| {
        let mut questions = rooms(
            rng,
            |rng| {
                // Some walls are black for two of the three colours.
                let pure = [
                    DVec3::X,
                    DVec3::Y,
                    DVec3::Z,
                    DVec3::ONE,
                    DVec3::ONE,
                    DVec3::ZERO,
                ];
                let mut walls_left: Vec<Material64> = pure
                    .into_iter()
                    .map(|pure| Material64::Lambertian { albedo: 0.9 * pure })
                    .collect();
                walls_left = rng.shuffled(walls_left);
                let mut quads = walls(HALF, || walls_left.pop().expect("there are six walls"));
                let light = emitter(rng);
                quads.push(panel(
                    dvec3(0.0, 1.8, 0.0),
                    1,
                    -1.0,
                    dvec3(1.2, 0.0, 1.2),
                    light,
                ));
                Room::new(quads, DARK)
            },
            |rng, room| {
                let mut cases = cases(rng, room, 2, |_, _, _| true);
                cases.extend(self::cases(rng, room, 3, lit));
                cases
            },
        );
        // In a dark room, the first light that a path finds can be very dim, at least in one channel.
        let dark = [(3, 0.04), (4, 0.004), (3, 2e-5)].map(|(n, albedo)| (n, DVec3::splat(albedo)));
        let saturation = saturation(rng);
        questions.extend(
            dark.into_iter()
                .chain([(2, saturation)])
                .map(|(bounces, albedo)| {
                    let room = dim(rng, albedo);
                    let case = |_| {
                        path_case_along(rng, &room, bounces, |ray, numbers, light| {
                            let shorter = without_the_last(&room, ray, numbers);
                            light != DVec3::ZERO && shorter == DVec3::ZERO
                        })
                    };
                    question(&room, (0..CALLS / 2).map(case).collect())
                }),
        );
        questions
    },
    needs: NEEDS,
    ..Declaration::ALONE
};

const MIRROR: Declaration = Declaration {
    id: "path.mirror",
    points: 2,
    title: "mirrors show the lights and the sky, and a light is black from behind",
    look: "At a mirror or glass, `direct` returns zero, so the light that the path hits next must be \
           counted, multiplied by the throughput. Which value of `pdf` tells you that?",
    look_fits: &[Symptom::of("value")],
    section: "light/paths.md#a-mirror-shows-the-light",
    tests: &[
        "The light that a surface emits, or the environment if the ray hits nothing, is counted \
         only if …",
    ],
    questions: |rng| {
        let mut questions = rooms(
            rng,
            |rng| {
                let mirror = Material64::Mirror {
                    reflectance: color(rng),
                };
                let mut materials =
                    vec![mirror, matte(rng), mirror, matte(rng), mirror, matte(rng)];
                let mut quads = walls(HALF, || materials.pop().expect("there are six walls"));
                quads.pop();
                let light = emitter(rng);
                quads.push(panel(
                    dvec3(0.0, 1.8, 0.0),
                    1,
                    -1.0,
                    dvec3(1.2, 0.0, 1.2),
                    light,
                ));
                let sky = sky(rng);
                Room::new(quads, sky)
            },
            |rng, room| {
                let mut cases = cases(rng, room, 1, |surface, _, light| {
                    is_mirror(surface) && is_lit(light)
                });
                cases.extend(self::cases(rng, room, 3, |surface, _, light| {
                    is_mirror(surface) && is_lit(light)
                }));
                // Some of these paths play roulette at a mirror.
                cases.extend(self::cases(rng, room, 7, |surface, _, light| {
                    is_mirror(surface) && is_lit(light)
                }));
                // In others, a light is seen in a mirror, also after a matte surface, or a mirror shows
                // a matte surface from which the path hits a light.
                for kinds in [&[true][..], &[false, true], &[true, false]] {
                    cases.extend(self::cases(rng, room, 3, |surface, numbers, _| {
                        surface.is_some_and(|it| leads_to_light(room, it, numbers, kinds))
                    }));
                }
                cases
            },
        );
        // From behind, a light is black, also after a mirror, glass or a matte surface.
        let room = with_backs_of_lights(rng);
        let kinds: [fn(&Surface64) -> bool; 3] = [|it| is_mirror(Some(it)), is_glass, is_matte];
        let cases = kinds.into_iter().flat_map(|is_kind| {
            let wanted = |first: Option<&Surface64>, numbers: &[Numbers64], _| {
                let first = first.filter(|first| is_kind(first));
                let second = first.and_then(|it| oracle::next_surface(&room, it, &numbers[0]));
                second.as_ref().is_some_and(is_light_from_behind)
            };
            let case = |_| path_case(rng, &room, 3, wanted);
            (0..CALLS / 4).map(case).collect::<Vec<PathStart>>()
        });
        let cases = cases.collect();
        questions.push(question(&room, cases));
        questions.extend(after_two_surfaces(rng));
        questions
    },
    needs: NEEDS_WITH_SPECULAR,
    ..Declaration::ALONE
};

const GLASS: Declaration = Declaration {
    id: "path.glass",
    title: "glass shows what is behind it and inside it",
    look: "Follow the path of the question shown. At each surface, write down which side it \
           continues on, the light that is added and the throughput. From bounce 3 on, roulette \
           divides the throughput by q.",
    look_fits: &[Symptom::of("value")],
    section: "light/paths.md#a-mirror-shows-the-light",
    tests: &[
        "The light that a surface emits, or the environment if the ray hits nothing, is counted \
         only if …",
    ],
    questions: |rng| {
        let mut environments = [sky(rng), DARK].into_iter();
        let mut iors = [rng.uniform(5.2, 9.0), rng.uniform(1.3, 1.8)].into_iter();
        rooms(
            rng,
            |rng| {
                let environment = environments.next().unwrap_or(DARK);
                // Without one of the walls, glass shows the environment.
                let mut quads = walls(HALF, || matte(rng));
                quads.pop();
                let ior = iors.next().unwrap_or(1.5);
                let center = rng.point(0.5);
                quads.extend(block(
                    center,
                    dvec3(0.9, 0.7, 0.8),
                    Material64::Glass { ior },
                ));
                let light = emitter(rng);
                quads.push(panel(
                    dvec3(0.0, 1.8, 0.0),
                    1,
                    -1.0,
                    dvec3(1.5, 0.0, 1.5),
                    light,
                ));
                Room::new(quads, environment)
            },
            |rng, room| {
                let mut cases = Vec::new();
                for bounces in [2, 4] {
                    cases.extend(self::cases(rng, room, bounces, |surface, _, light| {
                        surface.is_some_and(is_glass) && is_lit(light)
                    }));
                    // The camera is inside the glass.
                    cases.extend(self::cases(rng, room, bounces, |surface, _, light| {
                        let is_inside = |it: &Surface64| is_glass(it) && it.out.z < 0.0;
                        surface.is_some_and(is_inside) && is_lit(light)
                    }));
                }
                cases.extend(self::cases(rng, room, 3, |surface, numbers, _| {
                    let first = surface.filter(|surface| is_glass(surface));
                    first.is_some_and(|it| oracle::next_surface(room, it, &numbers[0]).is_none())
                }));
                cases
            },
        )
    },
    needs: NEEDS_WITH_SPECULAR,
    ..Declaration::ALONE
};

const ROULETTE: Declaration = Declaration {
    id: "path.roulette",
    points: 2,
    title: "from the fourth surface on, a path survives with probability q",
    look: "At which bounce does your roulette begin, and what do you compare `survive` with?",
    section: "light/paths.md#roulette-begins-at-bounce-three",
    tests: &["This is Russian roulette: see PBR, section 2.2.4."],
    questions: |rng| {
        let mut questions = rooms(rng, closed, |rng, room| {
            // At bounce 3, about half of the paths survive.
            let mut cases = cases(rng, room, 7, |_, numbers, light| {
                is_lit(light) && numbers[3].survive > 0.4
            });
            cases.extend(self::cases(rng, room, 7, |_, numbers, light| {
                is_lit(light) && numbers[3].survive < 0.4
            }));
            cases.extend(self::cases(rng, room, 20, lit));
            cases
        });
        // Mirrors and glass play roulette, too, also at the last bounce, after which only the sky can
        // add light.
        let closed = [shiny(rng), shiny(rng)].map(|room| (room, 7));
        let open = Room::new(shiny(rng).quads()[1..].to_vec(), sky(rng));
        let rooms = closed.into_iter().chain([(open, 4)]);
        questions.extend(rooms.map(|(room, bounces)| {
            let kinds: [fn(&Surface64) -> bool; 2] = [|it| is_mirror(Some(it)), is_glass];
            let mut cases = Vec::new();
            for (is_kind, survives) in kinds.into_iter().flat_map(|it| [(it, true), (it, false)]) {
                cases.extend((0..CALLS / 2).map(|_| {
                    path_case_along(rng, &room, bounces, |ray, numbers, light| {
                        let surfaces = oracle::surfaces(&room, ray, &numbers[..3]);
                        surfaces.get(3).is_some_and(is_kind)
                            && decides(&room, ray, numbers, light, survives)
                    })
                }));
            }
            question(&room, rng.shuffled(cases))
        }));
        questions
    },
    needs: NEEDS_WITH_SPECULAR,
    ..Declaration::ALONE
};

const SURVIVORS: Declaration = Declaration {
    id: "path.survivors",
    points: 2,
    title: "a survivor's throughput is divided by q, which is at least 0.05 and at most 0.95",
    look: "Work out q in a white room and in a dark one: is it limited to the range from 0.05 to \
           0.95? And do you divide a survivor's throughput by it?",
    section: "light/paths.md#survivors-carry-more",
    tests: &[
        "Here, q is the largest channel of the throughput after this bounce's attenuation, but at \
         least 0.05 and at most 0.95.",
    ],
    questions: |rng| {
        // In a white room, q is always 0.95, and in a dark one, it is 0.05.
        let albedos = [
            DVec3::ONE,
            DVec3::splat(0.999),
            DVec3::splat(0.3),
            dvec3(0.1, 0.35, 0.05),
        ];
        let questions = albedos.into_iter().map(|albedo| {
            let room = room_with(rng, || Material64::Lambertian { albedo });
            let is_dark = albedo.max_element() < 0.5;
            let cases = cases(rng, &room, 6, |_, numbers, light| {
                // Few paths survive in a dark room, so look for them.
                is_lit(light) && (!is_dark || numbers[3].survive < 0.04)
            });
            question(&room, cases)
        });
        questions.collect()
    },
    needs: NEEDS,
    ..Declaration::ALONE
};

const SIZES: Declaration = Declaration {
    id: "path.sizes",
    title: "a path doesn't hit the surface that it leaves, in a room of any size",
    look: "Where does your next ray start? Use `Surface::leave`, which takes into account how far \
           rounding can move a point.",
    look_fits: &[Symptom::of("value")],
    section: "light/paths.md#leave-the-surface",
    tests: &[
        "At each bounce, the path adds [`direct`] light and continues in the direction that …",
    ],
    questions: |rng| {
        let sizes = [
            (1e-4, 0.0),
            (0.01, 0.0),
            (1.0, 0.0),
            (1.0, 180.0),
            (300.0, 0.0),
        ];
        let questions = sizes.map(|(scale, distance)| {
            let albedo = color(rng);
            let room = room_with(rng, || Material64::Lambertian { albedo });
            let room = moved(&room, scale, distance * rng.direction());
            let case = |_| {
                path_case_along(rng, &room, 3, |ray, numbers, light| {
                    is_lit(light) && is_stable(&room, ray, numbers, light)
                })
            };
            question(&room, (0..CALLS).map(case).collect())
        });
        questions.into()
    },
    needs: NEEDS,
    ..Declaration::ALONE
};

fn lit(_: Option<&Surface64>, _: &[Numbers64], light: DVec3) -> bool {
    is_lit(light)
}

fn first_is_matte(surface: Option<&Surface64>, _: &[Numbers64], light: DVec3) -> bool {
    surface.is_some_and(is_matte) && is_lit(light)
}

fn is_matte(surface: &Surface64) -> bool {
    matches!(surface.material, Material64::Lambertian { .. })
}

fn is_light_from_behind(surface: &Surface64) -> bool {
    matches!(surface.material, Material64::Emitter { .. }) && surface.emitted == DVec3::ZERO
}

/// Returns whether a path that starts at a surface hits a light after these surfaces. For each of
/// them, `kinds` says whether it is a mirror. The others are matte.
fn leads_to_light(room: &Room, first: &Surface64, numbers: &[Numbers64], kinds: &[bool]) -> bool {
    let mut surface = *first;
    for (kind, numbers) in kinds.iter().zip(numbers) {
        let next = oracle::next_surface(room, &surface, numbers);
        let Some(next) = next.filter(|_| is_mirror(Some(&surface)) == *kind) else {
            return false;
        };
        surface = next;
    }
    is_lit(surface.emitted)
}

fn is_mirror(surface: Option<&Surface64>) -> bool {
    surface.is_some_and(|surface| matches!(surface.material, Material64::Mirror { .. }))
}

fn is_glass(surface: &Surface64) -> bool {
    matches!(surface.material, Material64::Glass { .. })
}

/// Returns whether the radiance hardly changes if the ray starts slightly beside its origin. In
/// long paths, rounding errors can grow at each bounce.
fn is_stable(room: &Room, ray: &Ray64, numbers: &[Numbers64], light: DVec3) -> bool {
    /// The distance by which the origin is moved, relative to its coordinates. Rounding to single
    /// precision moves a point by about 1e-7.
    const SHIFT: f64 = 3e-6;
    /// The largest relative change in the radiance: half the tolerance.
    const CHANGE: f64 = 5e-4;
    let (center, half) = room.extent();
    let shift = SHIFT * (center.length() + half.max_element());
    [DVec3::X, DVec3::Y, DVec3::Z].into_iter().all(|axis| {
        let shifted = Ray64 {
            origin: ray.origin + shift * axis,
            ..*ray
        };
        let change = oracle::radiance(room, &shifted, numbers).value - light;
        change.abs().cmple(CHANGE * light).all()
    })
}

/// Returns the radiance along a ray with the maximum number of bounces reduced by one.
fn without_the_last(room: &Room, ray: &Ray64, numbers: &[Numbers64]) -> DVec3 {
    oracle::radiance(room, ray, &numbers[..numbers.len() - 1]).value
}

/// Returns whether the result would be different if roulette at bounce 3 had the other outcome.
/// `survives` is the outcome that the path should have.
fn decides(room: &Room, ray: &Ray64, numbers: &[Numbers64], light: DVec3, survives: bool) -> bool {
    let with = |survive| {
        let mut numbers = numbers.to_vec();
        numbers[3].survive = survive;
        oracle::radiance(room, ray, &numbers).value
    };
    // q is at least 0.05 and at most 0.95.
    let (alive, ended) = (with(0.0), with(0.99));
    let expected = if survives { alive } else { ended };
    let is_visible = (alive - ended).max_element() > 0.02 * alive.max_element();
    light == expected && is_lit(alive) && is_visible
}

/// Returns a room without a ceiling, with lights that are also seen from behind.
fn bright(rng: &mut Rng, environment: Environment64) -> Room {
    let mut quads: Vec<Quad> = walls(HALF, || matte(rng));
    quads.remove(3);
    for (axis, facing) in [(1, -1.0), (0, 1.0), (2, -1.0)] {
        let center = rng.point(1.2);
        // One of the lights is very dim.
        let light = match axis {
            0 => Material64::Emitter {
                radiance: color(rng) * rng.log_uniform(1e-6, 1e-4),
            },
            _ => emitter(rng),
        };
        quads.push(panel(center, axis, facing, DVec3::splat(0.5), light));
    }
    Room::new(quads, environment)
}

/// Returns a closed room with bright walls and one light.
fn closed(rng: &mut Rng) -> Room {
    let mut colors = (0..6)
        .map(|_| color(rng).lerp(DVec3::ONE, 0.4))
        .collect::<Vec<_>>();
    room_with(rng, || Material64::Lambertian {
        albedo: colors.pop().expect("there are six walls"),
    })
}

/// Returns a closed room with bright walls (two of them mirrors), a glass block and one light.
fn shiny(rng: &mut Rng) -> Room {
    let mut walls = Vec::new();
    for index in 0..6 {
        let bright = color(rng).lerp(DVec3::ONE, 0.5);
        walls.push(if index % 3 == 0 {
            Material64::Mirror {
                reflectance: bright,
            }
        } else {
            Material64::Lambertian { albedo: bright }
        });
    }
    let mut walls = rng.shuffled(walls);
    let room = room_with(rng, || walls.pop().expect("there are six walls"));
    let glass = Material64::Glass {
        ior: rng.log_uniform(1.3, 4.0),
    };
    let mut quads = room.quads().to_vec();
    quads.extend(block(rng.point(0.4), dvec3(1.0, 0.8, 1.2), glass));
    Room::new(quads, DARK)
}

/// Returns a closed room with mirrors, a glass block and lights that are also seen from behind.
fn with_backs_of_lights(rng: &mut Rng) -> Room {
    let mut quads = shiny(rng).quads().to_vec();
    for (axis, facing) in [(0, 1.0), (2, -1.0)] {
        let mut center = DVec3::ZERO;
        center[axis] = -1.6 * facing;
        // The fronts face the nearest wall.
        let light = emitter(rng);
        quads.push(panel(center, axis, -facing, DVec3::splat(0.9), light));
    }
    Room::new(quads, DARK)
}

/// Returns two large mirrors that face each other, under a sky.
fn corridor(rng: &mut Rng) -> Room {
    let mirrors = [-1.0, 1.0].map(|side| {
        let reflectance = color(rng).lerp(DVec3::ONE, 0.9);
        let mirror = Material64::Mirror { reflectance };
        panel(side * DVec3::X, 0, -side, DVec3::splat(200.0), mirror)
    });
    let sky = sky(rng);
    Room::new(mirrors.into(), sky)
}

/// Returns two mirrors that face each other, above a matte floor and below a light.
fn lit_corridor(rng: &mut Rng) -> Room {
    let height = 20.0;
    let half = DVec3::new(1.0, height, height);
    let mut quads = Vec::new();
    for side in [-1.0, 1.0] {
        let reflectance = color(rng).lerp(DVec3::ONE, 0.9);
        let mirror = Material64::Mirror { reflectance };
        quads.push(panel(side * DVec3::X, 0, -side, half, mirror));
    }
    let light = emitter(rng);
    quads.push(panel(-height * DVec3::Y, 1, 1.0, half, matte(rng)));
    quads.push(panel(height * DVec3::Y, 1, -1.0, half, light));
    let sky = sky(rng);
    Room::new(quads, sky)
}

/// Returns two questions about paths that find a light, or the environment, after each pair of kinds
/// of surfaces of which the second is a mirror or glass.
fn after_two_surfaces(rng: &mut Rng) -> [ExamQuestion; 2] {
    let mut open = hall_of_mirrors(rng);
    open.swap_remove(5);
    let sky = sky(rng);
    let closed = Room::new(hall_of_mirrors(rng), DARK);
    let rooms = [
        (closed, PathHit::Light),
        (Room::new(open, sky), PathHit::Nothing),
    ];
    rooms.map(|(room, end)| {
        let calls = (0..6).flat_map(|kinds| {
            [(); 2].map(|()| {
                path_case_along(rng, &room, 4, |ray, numbers, _| {
                    last_two(&path_steps(&room, ray, numbers), end) == Some(kinds)
                })
            })
        });
        let calls = calls.collect();
        question(&room, rng.shuffled(calls))
    })
}

/// Returns a closed room with two mirrors that face each other, a glass block and a large light.
fn hall_of_mirrors(rng: &mut Rng) -> Vec<Quad> {
    let mirror = Material64::Mirror {
        reflectance: color(rng),
    };
    let mut index = 0;
    let mut quads = walls(HALF, || {
        index += 1;
        if index <= 2 { mirror } else { matte(rng) }
    });
    let light = emitter(rng);
    quads.push(panel(1.8 * DVec3::Y, 1, -1.0, dvec3(1.8, 0.0, 2.0), light));
    let glass = Material64::Glass {
        ior: rng.uniform(1.8, 2.5),
    };
    quads.extend(block(-0.6 * DVec3::Y, dvec3(1.0, 0.6, 1.2), glass));
    quads
}

/// Returns a closed room whose walls have random colours times a factor. Its light only shines on the
/// floor and the lowest part of the walls.
fn dim(rng: &mut Rng, albedo: DVec3) -> Room {
    let mut quads = walls(HALF, || Material64::Lambertian {
        albedo: albedo * color(rng),
    });
    let light = emitter(rng);
    let half = dvec3(1.0, 0.0, 1.0);
    quads.push(panel(dvec3(0.2, -1.2, -0.3), 1, -1.0, half, light));
    Room::new(quads, DARK)
}

fn room_with(rng: &mut Rng, material: impl FnMut() -> Material64) -> Room {
    let mut quads = walls(HALF, material);
    let light = emitter(rng);
    let half = dvec3(1.0, 0.0, 1.0);
    quads.push(panel(dvec3(0.0, 1.8, 0.0), 1, -1.0, half, light));
    Room::new(quads, DARK)
}

fn cases(
    rng: &mut Rng,
    room: &Room,
    bounces: u32,
    wanted: impl Fn(Option<&Surface64>, &[Numbers64], DVec3) -> bool,
) -> Vec<PathStart> {
    let case = |_| path_case(rng, room, bounces, &wanted);
    (0..CALLS).map(case).collect()
}

/// Returns one question for each of two rooms.
fn rooms(
    rng: &mut Rng,
    mut room: impl FnMut(&mut Rng) -> Room,
    cases: impl Fn(&mut Rng, &Room) -> Vec<PathStart>,
) -> Vec<ExamQuestion> {
    let question = |_| {
        let room = room(rng);
        let cases = cases(rng, &room);
        question(&room, rng.shuffled(cases))
    };
    (0..2).map(question).collect()
}

fn question(room: &Room, calls: Vec<PathStart>) -> ExamQuestion {
    let ask = |calls: Vec<PathStart>| {
        let rows = colors(calls.iter().map(|call| path_light(room, call).value));
        let question = LightQuestion::Radiance(Table::of_list(subject(room), calls));
        table(question, &["value"], rows)
    };
    with_changes(calls, ask, |call| {
        let (ray, numbers) = (Ray64::from(&call.ray), numbers_of_path(call));
        let light = path_light(room, call).value;
        is_clear_path(room, call) && is_stable(room, &ray, &numbers, light)
    })
}
