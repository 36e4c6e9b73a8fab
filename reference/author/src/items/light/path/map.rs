//! The item about paths under an environment map.

use glam::DVec3;

use super::super::color;
use super::super::groups::{
    DIRECT, DIRECT_MAPS, LIGHT_DENSITIES, LIGHT_SAMPLES, MAPS, MATTE, MATTE_SAMPLES, SPECULAR,
};
use super::super::rooms::{PathCase, next_surface, path_case, under_a_map};
use super::{first_is_matte, is_lit, is_mirror, rooms};
use crate::items::Declaration;
use crate::oracle::light::Numbers64;
use crate::oracle::light::quad::Material64;
use crate::oracle::light::room::{Room, Surface64};
use crate::seed::Rng;

/// The number of calls of each kind in a question.
const CALLS: usize = 8;

pub(super) const MAP: Declaration = Declaration {
    id: "path.map",
    title: "an environment map is seen by the camera and in mirrors, in the right direction",
    look: "A map doesn't look the same in every direction. Which direction do you look it up in, \
        and in which cases?",
    section: "light/paths.md#a-ray-that-hits-nothing",
    tests: &[
        "The light that a surface emits, or the environment if the ray hits nothing, is counted \
         only if …",
        "After a matte surface, `direct` has already counted it.",
    ],
    questions: |rng| {
        let has_lights = [true, false].into_iter();
        let questions = has_lights.flat_map(|has_lights| {
            rooms(
                rng,
                |rng| {
                    let reflectance = color(rng);
                    under_a_map(rng, Material64::Mirror { reflectance }, has_lights)
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
) -> Vec<PathCase> {
    let case = |_| path_case(rng, room, bounces, &wanted);
    (0..CALLS).map(case).collect()
}
