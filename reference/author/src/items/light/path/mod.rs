//! The items about following paths.

mod calls;
mod map;

use glam::{DVec3, dvec3};
use judging::drawing_data::PathHit;
use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::Table;
use protocol::light::LightQuestion;
use protocol::light::transport::PathStart;

use self::calls::{ANY, GRAZING, PathCase, path_calls};
use super::groups::{DIRECT, LIGHT_DENSITIES, LIGHT_SAMPLES, MATTE, MATTE_SAMPLES, SPECULAR};
use super::rooms::{
    DARK, beside_a_light, block, closed_room, emitter, is_lit, light_below_the_ceiling, matte,
    moved, panel, repainted, sky, subject, walls, with_shining_ceiling,
};
use super::{color, colors, table, with_changes};
use crate::domains::light::fields::saturation;
use crate::domains::light::transport::last_two;
use crate::items::{AuthoredTask, Declaration};
use crate::oracle::light::light_sources::Environment64;
use crate::oracle::light::quad::{Material64, Quad};
use crate::oracle::light::room::{Room, Surface64};
use crate::seed::Rng;

/// The number of calls of each kind in most questions.
const CALLS: usize = 16;

/// The default fields of an item about paths between matte surfaces.
const MATTE_PATHS: Declaration = Declaration {
    needs: &[MATTE, MATTE_SAMPLES, LIGHT_SAMPLES, LIGHT_DENSITIES, DIRECT],
    ..Declaration::ALONE
};

/// The default fields of an item about paths that also meet mirrors or glass.
const PATHS: Declaration = Declaration {
    needs: &[
        MATTE,
        MATTE_SAMPLES,
        SPECULAR,
        LIGHT_SAMPLES,
        LIGHT_DENSITIES,
        DIRECT,
    ],
    ..Declaration::ALONE
};

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
        let kinds: &[Kind] = &[
            (0, |it| it.first.is_none()),
            (0, |it| it.first.is_some() && it.is_lit()),
            (0, |it| it.first.is_some() && !it.is_lit()),
            (0, |it| it.starts_at(is_light_from_behind)),
        ];
        let mut environments = [sky(rng), DARK].into_iter();
        rooms(rng, CALLS, kinds, |rng| {
            let environment = environments.next().unwrap_or(DARK);
            bright(rng, environment)
        })
    },
    ..MATTE_PATHS
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
        let room = |rng: &mut Rng| {
            let sky = sky(rng);
            bright(rng, sky)
        };
        let mut questions = rooms(rng, CALLS, &[(1, |it| it.is_lit())], room);
        // Each question begins with the call that the previous one ends with.
        let room = room(rng);
        let mut calls = path_calls(rng, &room, 1, ANY, CALLS, is_lit_matte);
        calls.truncate(CALLS / 2);
        for factor in [1.0, 0.6, 0.3] {
            questions.push(question(&repainted(&room, factor), calls.clone()));
            calls.reverse();
        }
        questions
    },
    ..MATTE_PATHS
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
        let questions =
            [2, 3].map(|bounces| rooms(rng, CALLS, &[(bounces, |it| it.is_lit())], closed));
        let mut questions = questions.concat();
        // In a white room, many paths are long. The last bounce still adds light.
        let albedo = DVec3::splat(0.95);
        let white = closed_room(rng, [Material64::Lambertian { albedo }; 6]);
        questions.extend([12, 20].map(|bounces| {
            let calls = path_calls(rng, &white, bounces, ANY, CALLS / 2, |case| {
                let last = (case.light - case.without_the_last()).max_element();
                last > 0.01 * case.light.max_element() && case.is_stable()
            });
            question(&white, calls)
        }));
        // Between two mirrors, paths are even longer.
        let corridor = corridor(rng);
        let calls = [(40, 32), (100, 64)].map(|(bounces, period)| {
            path_calls(rng, &corridor, bounces, ANY, 2, |case| {
                let (first, rest) = case.numbers.split_at(period);
                let repeated = [first, &first[..rest.len()]].concat();
                let others = [first, &repeated].map(|numbers| case.light_with(numbers));
                case.is_lit() && !others.contains(&case.light)
            })
        });
        questions.push(question(&corridor, calls.concat()));
        // All kinds of light still count after many mirrors.
        let long = lit_corridor(rng);
        let depths = [(40, 9..33), (100, 33..65), (100, 65..101)];
        let kinds = [PathHit::Matte, PathHit::Light, PathHit::Nothing];
        let each = depths
            .into_iter()
            .flat_map(|depth| kinds.map(|kind| (depth.clone(), kind)));
        let calls = each.flat_map(|((bounces, depths), kind)| {
            path_calls(rng, &long, bounces, ANY, 2, |case| {
                let is_deep = case.steps().iter().zip(0..).any(|(step, bounce)| {
                    step.hit == kind && depths.contains(&bounce) && is_lit(step.light.as_dvec3())
                });
                is_deep && case.is_stable()
            })
        });
        let calls = calls.collect();
        questions.push(question(&long, rng.shuffled(calls)));
        questions
    },
    ..PATHS
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
        let kinds: &[Kind] = &[(2, is_lit_matte), (3, is_lit_matte)];
        let mut questions = rooms(rng, CALLS, kinds, with_shining_ceiling);
        // Almost along a floor, the density is small, but there is one.
        let sky = Environment64::Constant(color(rng));
        let floor = beside_a_light(rng, sky);
        let calls = path_calls(rng, &floor, 2, GRAZING, CALLS / 2, is_lit_matte);
        questions.push(question(&floor, calls));
        questions
    },
    ..MATTE_PATHS
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
        let kinds: &[Kind] = &[(2, |_| true), (3, |it| it.is_lit())];
        let mut questions = rooms(rng, CALLS, kinds, |rng| {
            // Some walls are black for two of the three colours.
            let [x, y, z] = DVec3::AXES;
            let pure = rng.shuffled(vec![x, y, z, DVec3::ONE, DVec3::ONE, DVec3::ZERO]);
            let materials = pure
                .into_iter()
                .rev()
                .map(|pure| Material64::Lambertian { albedo: 0.9 * pure });
            let mut quads = walls(materials);
            quads.push(light_below_the_ceiling(rng, 1.2));
            Room::new(quads, DARK)
        });
        // In a dark room, the first light that a path finds can be very dim, at least in one channel.
        let dark = [(3, 0.04), (4, 0.004), (3, 2e-5)].map(|(n, albedo)| (n, DVec3::splat(albedo)));
        let dark = dark.into_iter().chain([(2, saturation(rng))]);
        questions.extend(dark.map(|(bounces, albedo)| {
            let room = dim(rng, albedo);
            let calls = path_calls(rng, &room, bounces, ANY, CALLS / 2, |case| {
                case.light != DVec3::ZERO && case.without_the_last() == DVec3::ZERO
            });
            question(&room, calls)
        }));
        questions
    },
    ..MATTE_PATHS
};

const MIRROR: Declaration = Declaration {
    id: "path.mirror",
    points: 2,
    title: "mirrors show the lights and the sky, and a light is black from behind",
    look: "At a mirror or glass, `direct` returns zero, so the light that the path hits next must be \
           counted, multiplied by the throughput. Which value of `pdf` tells you that?",
    look_fits: &[Symptom::of("value")],
    section: "light/paths.md#a-mirror-shows-the-light",
    tests: &["The light that a surface emits, …"],
    questions: |rng| {
        let kinds: &[Kind] = &[
            (1, |it| it.starts_at(is_mirror) && it.is_lit()),
            (3, |it| it.starts_at(is_mirror) && it.is_lit()),
            // Some of these paths play roulette at a mirror.
            (7, |it| it.starts_at(is_mirror) && it.is_lit()),
            // In others, a light is seen in a mirror, also after a matte surface, or a mirror shows
            // a matte surface from which the path hits a light.
            (3, |it| leads_to_light(it, &[true])),
            (3, |it| leads_to_light(it, &[false, true])),
            (3, |it| leads_to_light(it, &[true, false])),
        ];
        let mut questions = rooms(rng, CALLS, kinds, |rng| {
            let mirror = Material64::Mirror {
                reflectance: color(rng),
            };
            let [first, second, third] = [(); 3].map(|()| matte(rng));
            let mut quads = walls([third, mirror, second, mirror, first]);
            quads.push(light_below_the_ceiling(rng, 1.2));
            let sky = sky(rng);
            Room::new(quads, sky)
        });
        // From behind, a light is black, also after a mirror, glass or a matte surface.
        let room = with_backs_of_lights(rng);
        let kinds = [is_mirror, is_glass, is_matte];
        let calls = kinds.map(|is_kind| {
            path_calls(rng, &room, 3, ANY, CALLS / 4, |case| {
                let second = case.second().filter(|_| case.starts_at(is_kind));
                second.as_ref().is_some_and(is_light_from_behind)
            })
        });
        questions.push(question(&room, calls.concat()));
        questions.extend(after_two_surfaces(rng));
        questions
    },
    ..PATHS
};

const GLASS: Declaration = Declaration {
    id: "path.glass",
    title: "glass shows what is behind it and inside it",
    look: "Follow the path of the question shown. At each surface, write down which side it \
           continues on, the light that is added and the throughput. From bounce 3 on, roulette \
           divides the throughput by q.",
    look_fits: &[Symptom::of("value")],
    section: "light/paths.md#a-mirror-shows-the-light",
    tests: &["The light that a surface emits, …"],
    questions: |rng| {
        let kinds: &[Kind] = &[
            (2, |it| it.starts_at(is_glass) && it.is_lit()),
            // The camera is inside the glass.
            (2, |it| it.starts_at(is_glass_from_inside) && it.is_lit()),
            (4, |it| it.starts_at(is_glass) && it.is_lit()),
            (4, |it| it.starts_at(is_glass_from_inside) && it.is_lit()),
            (3, |it| it.starts_at(is_glass) && it.second().is_none()),
        ];
        let mut environments = [sky(rng), DARK].into_iter();
        let mut iors = [rng.uniform(5.2, 9.0), rng.uniform(1.3, 1.8)].into_iter();
        rooms(rng, CALLS, kinds, |rng| {
            let environment = environments.next().unwrap_or(DARK);
            // Without one of the walls, glass shows the environment.
            let mut quads = walls(rng.list(6, matte));
            quads.pop();
            let ior = iors.next().unwrap_or(1.5);
            let glass = Material64::Glass { ior };
            quads.extend(block(rng.point(0.5), dvec3(0.9, 0.7, 0.8), glass));
            quads.push(light_below_the_ceiling(rng, 1.5));
            Room::new(quads, environment)
        })
    },
    ..PATHS
};

const ROULETTE: Declaration = Declaration {
    id: "path.roulette",
    points: 2,
    title: "from the fourth surface on, a path survives with probability q",
    look: "At which bounce does your roulette begin, and what do you compare `survive` with?",
    section: "light/paths.md#roulette-begins-at-bounce-three",
    tests: &["This is Russian roulette: see PBR, section 2.2.4."],
    questions: |rng| {
        let kinds: &[Kind] = &[
            // At bounce 3, about half of the paths survive.
            (7, |it| it.is_lit() && it.numbers[3].survive > 0.4),
            (7, |it| it.is_lit() && it.numbers[3].survive < 0.4),
            (20, |it| it.is_lit()),
        ];
        let mut questions = rooms(rng, CALLS, kinds, closed);
        // Mirrors and glass play roulette, too, also at the last bounce, after which only the sky can
        // add light.
        let closed = [shiny(rng), shiny(rng)].map(|room| (room, 7));
        let open = Room::new(shiny(rng).quads()[1..].to_vec(), sky(rng));
        let rooms = closed.into_iter().chain([(open, 4)]);
        questions.extend(rooms.map(|(room, bounces)| {
            let kinds = [
                (PathHit::Mirror, true),
                (PathHit::Mirror, false),
                (PathHit::Glass, true),
                (PathHit::Glass, false),
            ];
            let calls = kinds.map(|(kind, survives)| {
                path_calls(rng, &room, bounces, ANY, CALLS / 2, |case| {
                    let is_kind = |surface: &Surface64| surface.kind() == kind;
                    case.surfaces(3).get(3).is_some_and(is_kind) && decides(case, survives)
                })
            });
            question(&room, rng.shuffled(calls.concat()))
        }));
        questions
    },
    ..PATHS
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
        let questions = albedos.map(|albedo| {
            let room = closed_room(rng, [Material64::Lambertian { albedo }; 6]);
            let is_dark = albedo.max_element() < 0.5;
            let calls = path_calls(rng, &room, 6, ANY, CALLS, |case| {
                // Few paths survive in a dark room, so look for them.
                case.is_lit() && (!is_dark || case.numbers[3].survive < 0.04)
            });
            question(&room, calls)
        });
        questions.into()
    },
    ..MATTE_PATHS
};

const SIZES: Declaration = Declaration {
    id: "path.sizes",
    title: "a path doesn't hit the surface that it leaves, in a room of any size",
    look: "Where does your next ray start? Use `Surface::leave`, which takes into account how far \
           rounding can move a point.",
    look_fits: &[Symptom::of("value")],
    section: "light/paths.md#leave-the-surface",
    tests: &["At each bounce, the path adds [`direct`] light …"],
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
            let room = closed_room(rng, [Material64::Lambertian { albedo }; 6]);
            let room = moved(&room, scale, distance * rng.direction());
            let calls = path_calls(rng, &room, 3, ANY, CALLS, |it| {
                it.is_lit() && it.is_stable()
            });
            question(&room, calls)
        });
        questions.into()
    },
    ..MATTE_PATHS
};

fn is_matte(surface: &Surface64) -> bool {
    surface.kind() == PathHit::Matte
}

fn is_mirror(surface: &Surface64) -> bool {
    surface.kind() == PathHit::Mirror
}

fn is_glass(surface: &Surface64) -> bool {
    surface.kind() == PathHit::Glass
}

fn is_glass_from_inside(surface: &Surface64) -> bool {
    is_glass(surface) && surface.out.z < 0.0
}

fn is_light_from_behind(surface: &Surface64) -> bool {
    surface.kind() == PathHit::Light && surface.emitted == DVec3::ZERO
}

/// Returns whether the ray hits a matte surface and light arrives along it.
fn is_lit_matte(case: &PathCase) -> bool {
    case.starts_at(is_matte) && case.is_lit()
}

/// Returns whether a path hits a light after these surfaces. For each of them, `mirrors` says
/// whether it is a mirror. The others aren't.
fn leads_to_light(case: &PathCase, mirrors: &[bool]) -> bool {
    let surfaces = case.surfaces(mirrors.len());
    let mut pairs = surfaces.iter().zip(mirrors);
    let last = surfaces.get(mirrors.len());
    pairs.all(|(surface, expected)| is_mirror(surface) == *expected)
        && last.is_some_and(|last| is_lit(last.emitted))
}

/// Returns whether the result would be different if roulette at bounce 3 had the other outcome.
/// `survives` is the outcome that the path should have.
fn decides(case: &PathCase, survives: bool) -> bool {
    let with = |survive| {
        let mut numbers = case.numbers.clone();
        numbers[3].survive = survive;
        case.light_with(&numbers)
    };
    // q is at least 0.05 and at most 0.95.
    let (alive, ended) = (with(0.0), with(0.99));
    let expected = if survives { alive } else { ended };
    let is_visible = (alive - ended).max_element() > 0.02 * alive.max_element();
    case.light == expected && is_lit(alive) && is_visible
}

/// Returns a room without a ceiling, with lights that are also seen from behind.
fn bright(rng: &mut Rng, environment: Environment64) -> Room {
    let mut quads = walls(rng.list(6, matte));
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
    let walls = rng.list(6, |rng| Material64::Lambertian {
        albedo: color(rng).lerp(DVec3::ONE, 0.4),
    });
    closed_room(rng, walls.into_iter().rev())
}

/// Returns a closed room with bright walls (two of them mirrors), a glass block and one light.
fn shiny(rng: &mut Rng) -> Room {
    let colors = rng.list(6, |rng| color(rng).lerp(DVec3::ONE, 0.5));
    let walls = colors
        .into_iter()
        .enumerate()
        .map(|(index, bright)| match index % 3 {
            0 => Material64::Mirror {
                reflectance: bright,
            },
            _ => Material64::Lambertian { albedo: bright },
        });
    let walls = rng.shuffled(walls.collect());
    let room = closed_room(rng, walls.into_iter().rev());
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
    let mirrors = facing_mirrors(rng, DVec3::splat(200.0));
    let sky = sky(rng);
    Room::new(mirrors, sky)
}

/// Returns two mirrors that face each other, above a matte floor and below a light.
fn lit_corridor(rng: &mut Rng) -> Room {
    let height = 20.0;
    let half = DVec3::new(1.0, height, height);
    let mut quads = facing_mirrors(rng, half);
    let light = emitter(rng);
    quads.push(panel(-height * DVec3::Y, 1, 1.0, half, matte(rng)));
    quads.push(panel(height * DVec3::Y, 1, -1.0, half, light));
    let sky = sky(rng);
    Room::new(quads, sky)
}

/// Returns two mirrors that face each other. `half` is half of their size.
fn facing_mirrors(rng: &mut Rng, half: DVec3) -> Vec<Quad> {
    let mirrors = [-1.0, 1.0].map(|side| {
        let reflectance = color(rng).lerp(DVec3::ONE, 0.9);
        let mirror = Material64::Mirror { reflectance };
        panel(side * DVec3::X, 0, -side, half, mirror)
    });
    mirrors.into()
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
            path_calls(rng, &room, 4, ANY, 2, |case| {
                last_two(&case.steps(), end) == Some(kinds)
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
    let others = rng.list(4, matte);
    let mut quads = walls([mirror, mirror].into_iter().chain(others));
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
    let mut quads = walls(rng.list(6, |rng| Material64::Lambertian {
        albedo: albedo * color(rng),
    }));
    let light = emitter(rng);
    let center = dvec3(0.2, -1.2, -0.3);
    quads.push(panel(center, 1, -1.0, DVec3::ONE, light));
    Room::new(quads, DARK)
}

/// A maximum number of bounces, and the condition that is true for calls of this kind.
type Kind = (u32, fn(&PathCase) -> bool);

/// Returns one question for each of two rooms, with `count` calls of each kind.
fn rooms(
    rng: &mut Rng,
    count: usize,
    kinds: &[Kind],
    mut room: impl FnMut(&mut Rng) -> Room,
) -> Vec<ExamQuestion> {
    rng.list(2, |rng| {
        let room = room(rng);
        let calls = kinds
            .iter()
            .flat_map(|&(bounces, wanted)| path_calls(rng, &room, bounces, ANY, count, wanted));
        let calls = calls.collect();
        question(&room, rng.shuffled(calls))
    })
}

fn question(room: &Room, calls: Vec<PathStart>) -> ExamQuestion {
    let case = |call: &PathStart| PathCase::new(room, call);
    let ask = |calls: Vec<PathStart>| {
        let rows = colors(calls.iter().map(|call| case(call).light));
        let question = LightQuestion::Radiance(Table::of_list(subject(room), calls));
        table(question, &["value"], rows)
    };
    with_changes(calls, ask, |call| {
        let case = case(call);
        case.is_clear(None) && case.is_stable()
    })
}
