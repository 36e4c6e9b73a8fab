//! The item about paths under an environment map.

use glam::{DVec3, dvec3};
use judging::symptom::Symptom;
use protocol::light::transport::PathStart;

use super::super::color;
use super::super::groups::{
    DIRECT, DIRECT_MAPS, LIGHT_DENSITIES, LIGHT_SAMPLES, MAPS, MATTE, MATTE_SAMPLES, SPECULAR,
};
use super::super::rooms::{block, is_lit, path_case, under_a_map};
use super::{first_is_matte, is_glass, is_light_from_behind, is_mirror, rooms};
use crate::items::Declaration;
use crate::oracle::light::Numbers64;
use crate::oracle::light::quad::Material64;
use crate::oracle::light::room::{Room, Surface64};
use crate::oracle::light::transport::next_surface;
use crate::seed::Rng;

/// The number of calls of each kind in a question.
const CALLS: usize = 8;

pub(super) const MAP: Declaration = Declaration {
    id: "path.map",
    title: "an environment map is counted like a light, in the direction of the ray",
    look: "A map doesn't look the same in every direction. Which direction do you look it up in, \
        and in which cases?",
    look_fits: &[Symptom::of("value")],
    section: "light/paths.md#a-ray-that-hits-nothing",
    tests: &[
        "The light that a surface emits, or the environment if the ray hits nothing, is counted \
         only if …",
        "After a matte surface, `direct` has already counted it.",
    ],
    questions: |rng| {
        let questions = [2, 0].into_iter().flat_map(|lights| {
            rooms(
                rng,
                |rng| {
                    let reflectance = color(rng);
                    let mirror = Material64::Mirror { reflectance };
                    let room = under_a_map(rng, mirror, lights);
                    let mut quads = room.quads().to_vec();
                    let glass = Material64::Glass { ior: 1.5 };
                    quads.extend(block(dvec3(1.3, -1.0, 0.9), dvec3(0.6, 0.6, 0.6), glass));
                    Room::new(quads, room.sources().environment.clone())
                },
                |rng, room| {
                    let escapes = |first: Option<&Surface64>, numbers: &[Numbers64]| {
                        let next = |first| next_surface(room, first, &numbers[0]);
                        first.is_some_and(|first| next(first).is_none())
                    };
                    let mut cases = cases(rng, room, 1, |surface, _, light| {
                        surface.is_none() && is_lit(light)
                    });
                    cases.extend(self::cases(rng, room, 3, first_is_matte));
                    // A mirror shows the map.
                    cases.extend(self::cases(rng, room, 2, |surface, numbers, light| {
                        is_mirror(surface) && escapes(surface, numbers) && is_lit(light)
                    }));
                    // After a matte surface, the map isn't counted again.
                    cases.extend(self::cases(rng, room, 2, |surface, numbers, light| {
                        first_is_matte(surface, numbers, light) && escapes(surface, numbers)
                    }));
                    // Glass shows it, too.
                    cases.extend(self::cases(rng, room, 2, |surface, _, light| {
                        surface.is_some_and(is_glass) && is_lit(light)
                    }));
                    if lights > 0 {
                        let sides: [fn(&Surface64) -> bool; 2] =
                            [|it| is_lit(it.emitted), is_light_from_behind];
                        for is_seen in sides {
                            cases.extend(self::cases(rng, room, 1, |surface, _, _| {
                                surface.is_some_and(is_seen)
                            }));
                        }
                    }
                    cases
                },
            )
        });
        questions.collect()
    },
    needs: &[
        MATTE,
        MATTE_SAMPLES,
        SPECULAR,
        LIGHT_SAMPLES,
        LIGHT_DENSITIES,
        MAPS,
        DIRECT,
        DIRECT_MAPS,
    ],
    ..Declaration::ALONE
};

fn cases(
    rng: &mut Rng,
    room: &Room,
    bounces: u32,
    wanted: impl Fn(Option<&Surface64>, &[Numbers64], DVec3) -> bool,
) -> Vec<PathStart> {
    let case = |_| path_case(rng, room, bounces, &wanted);
    (0..CALLS).map(case).collect()
}
