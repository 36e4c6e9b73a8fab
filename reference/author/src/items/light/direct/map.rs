//! The item about direct light from an environment map.

use glam::DVec3;
use judging::symptom::Symptom;

use super::super::groups::{
    DIRECT_MAPS, LIGHT_DENSITIES, LIGHT_SAMPLES, MAPS, MATTE, MATTE_SAMPLES,
};
use super::super::rooms::{direct_case, is_lit, matte, under_a_map};
use super::{CALLS, LIT_AND_DARK, rooms, scattered, seen};
use crate::items::Declaration;
use crate::oracle::light::room::{Room, Surface64};
use crate::oracle::light::transport as oracle;

pub(super) const MAP: Declaration = Declaration {
    id: "direct.map",
    points: 2,
    title: "both samples find an environment map, even if there are lights",
    look: "An environment map has a light pdf too. Which method of `World` returns the light pdf \
           of any direction, whether it leads to a light or to the map?",
    look_fits: &[Symptom::of("value")],
    section: "light/direct.md#the-light-pdf-of-the-world",
    tests: &[
        "Each term uses both densities of its own direction, no matter which way that direction \
         was sampled.",
        "[`World::light_pdf`] returns the light pdf.",
        "The radiance is the light that arrives from this direction, straight from a light or the \
         environment.",
    ],
    questions: |rng| {
        let questions = [0, 1, 2].into_iter().flat_map(|lights| {
            rooms(
                rng,
                |rng| {
                    let left = matte(rng);
                    under_a_map(rng, left, lights)
                },
                |rng, room| {
                    let mut cases = LIT_AND_DARK(rng, room);
                    // The direction toward the light leads to the map.
                    cases.extend((0..CALLS).map(|_| {
                        direct_case(rng, room, |surface, numbers, _| {
                            let sample = room.sources().sample(surface.position, numbers);
                            let is_seen = |direction| shows_the_map(room, surface, direction);
                            sample.value.is_some_and(is_seen)
                        })
                    }));
                    // Scattering finds the map.
                    cases.extend((0..CALLS).map(|_| {
                        direct_case(rng, room, |surface, numbers, _| {
                            shows_the_map(room, surface, scattered(surface, numbers))
                        })
                    }));
                    cases
                },
            )
        });
        questions.collect()
    },
    needs: &[MATTE, MATTE_SAMPLES, LIGHT_SAMPLES, LIGHT_DENSITIES, MAPS],
    ..Declaration::in_group(DIRECT_MAPS)
};

/// Returns whether the light that arrives at a surface from a direction comes from the environment.
fn shows_the_map(room: &Room, surface: &Surface64, direction: DVec3) -> bool {
    let is_above = surface.frame.to_local(direction).z > 0.0;
    let is_free = seen(room, surface, direction).is_none();
    is_above && is_free && is_lit(oracle::emitted(room, surface, direction).value)
}
