//! The item about paths under an environment map.

use glam::{DVec3, dvec3};
use judging::symptom::Symptom;

use super::super::color;
use super::super::groups::{
    DIRECT, DIRECT_MAPS, LIGHT_DENSITIES, LIGHT_SAMPLES, MAPS, MATTE, MATTE_SAMPLES, SPECULAR,
};
use super::super::rooms::{block, is_lit, under_a_map};
use super::{Kind, is_glass, is_light_from_behind, is_lit_matte, is_mirror, rooms};
use crate::items::Declaration;
use crate::oracle::light::quad::Material64;
use crate::oracle::light::room::Room;
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
        "The light that a surface emits, …",
        "After a matte surface, `direct` has already counted it.",
    ],
    questions: |rng| {
        let kinds: &[Kind] = &[
            (1, |it| it.first.is_none() && it.is_lit()),
            (3, is_lit_matte),
            // A mirror shows the map.
            (2, |it| {
                it.starts_at(is_mirror) && it.second().is_none() && it.is_lit()
            }),
            // After a matte surface, the map isn't counted again.
            (2, |it| is_lit_matte(it) && it.second().is_none()),
            // Glass shows it, too.
            (2, |it| it.starts_at(is_glass) && it.is_lit()),
        ];
        let at_lights: &[Kind] = &[
            (1, |it| it.starts_at(|first| is_lit(first.emitted))),
            (1, |it| it.starts_at(is_light_from_behind)),
        ];
        let room = |rng: &mut Rng, lights: usize| {
            let reflectance = color(rng);
            let mirror = Material64::Mirror { reflectance };
            let room = under_a_map(rng, mirror, lights);
            let mut quads = room.quads().to_vec();
            let glass = Material64::Glass { ior: 1.5 };
            quads.extend(block(dvec3(1.3, -1.0, 0.9), DVec3::splat(0.6), glass));
            Room::new(quads, room.sources().environment.clone())
        };
        let with_lights = [kinds, at_lights].concat();
        let mut questions = rooms(rng, CALLS, &with_lights, |rng| room(rng, 2));
        questions.extend(rooms(rng, CALLS, kinds, |rng| room(rng, 0)));
        questions
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
