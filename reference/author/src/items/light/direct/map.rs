//! The item about direct light from an environment map.

use glam::DVec3;
use judging::symptom::Symptom;

use super::super::groups::{
    DIRECT_MAPS, LIGHT_DENSITIES, LIGHT_SAMPLES, MAPS, MATTE, MATTE_SAMPLES,
};
use super::super::rooms::{matte, under_a_map};
use super::calls::DirectCase;
use super::{CALLS, Kind, rooms};
use crate::items::Declaration;

pub(super) const MAP: Declaration = Declaration {
    id: "direct.map",
    points: 2,
    title: "both samples find an environment map, even if there are lights",
    look: "An environment map has a light pdf too. Which method of `World` returns the light pdf \
           of any direction, whether it leads to a light or to the map?",
    look_fits: &[Symptom::of("value")],
    section: "light/direct.md#the-light-pdf-of-the-world",
    tests: &[
        "Each term uses both densities of its own direction, …",
        "[`World::light_pdf`] returns the light pdf.",
        "The radiance is the light that arrives from this direction, …",
    ],
    questions: |rng| {
        let kinds: &[Kind] = &[
            (CALLS, |it| it.is_lit()),
            (CALLS, |_| true),
            // The direction toward the light leads to the map.
            (CALLS, |it| {
                it.sample().is_some_and(|to| shows_the_map(it, to))
            }),
            // Scattering finds the map.
            (CALLS, |it| shows_the_map(it, it.scattered())),
        ];
        let questions = [0, 1, 2].map(|lights| {
            rooms(rng, kinds, |rng| {
                let left = matte(rng);
                under_a_map(rng, left, lights)
            })
        });
        questions.concat()
    },
    needs: &[MATTE, MATTE_SAMPLES, LIGHT_SAMPLES, LIGHT_DENSITIES, MAPS],
    ..Declaration::in_group(DIRECT_MAPS)
};

/// Returns whether the light that arrives at a surface from a direction comes from the environment.
fn shows_the_map(case: &DirectCase, direction: DVec3) -> bool {
    let is_above = case.surface.frame.to_local(direction).z > 0.0;
    is_above && case.seen(direction).is_none() && case.is_lit_from(direction)
}
