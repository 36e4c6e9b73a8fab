//! The clues for the assignment `light`.
//!
//! As for the assignment `rays`, a clue must be true of any code with the symptom.

use super::super::{SymptomClue, TaskClues};
use crate::signatures::PanicKind;
use crate::symptom::{SOME_OR_NONE, Symptom};

/// The length of a direction that a function returns.
const LENGTH: Symptom = Symptom::of("length of the direction");
/// The clue for a direction whose length is wrong.
const WRONG_LENGTH: &str = "Your direction points the right way, but its length isn't one. Which factor \
                            scales all three components, or where do you forget to normalise?";

/// The clues for mirrors and glass.
pub(super) const SPECULAR: TaskClues = TaskClues {
    sections_on_panics: &[(
        PanicKind::NoValue,
        "light/glass.md#total-reflection-is-full-reflection",
    )],
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::less(SOME_OR_NONE)],
            clue: "Here, light is refracted, but your code returns `None`. Work out the squared sine of the \
                refracted angle for the direction shown: it is less than 1. What makes your code decide \
                otherwise?",
            section: "light/glass.md#total-reflection",
        },
        SymptomClue {
            symptoms: &[Symptom::more(SOME_OR_NONE)],
            clue: "Here, light is totally reflected, but your code returns a direction. Work out the squared \
                sine of the refracted angle for the direction shown: it is more than 1. What does your \
                code do with it?",
            section: "light/glass.md#total-reflection",
        },
        SymptomClue {
            symptoms: &[LENGTH],
            clue: WRONG_LENGTH,
            section: "light/glass.md#what-to-return",
        },
        SymptomClue {
            symptoms: &[Symptom::of("attenuation")],
            clue: "The attenuation is 1 for reflected paths, and the squared ratio of the indices for refracted \
                paths. The Fresnel fraction isn't part of it, since it already decides how many paths go each \
                way.",
            section: "light/glass.md#chosen-by-chance-and-not-weighted-again",
        },
        SymptomClue {
            symptoms: &[Symptom::of("pdf")],
            clue: "Mirrors and glass choose between single directions, so they have no density: `pdf` is \
                `None`.",
            section: "light/glass.md#a-mirror-has-no-density",
        },
        SymptomClue {
            symptoms: &[Symptom::of("direction"), Symptom::reversed("direction")],
            clue: "Which of your functions should this direction come from: `reflect` or `refract`? Call it \
                with the `out` shown, and compare its result with yours.",
            section: "light/glass.md#what-to-return",
        },
    ],
    ..TaskClues::NONE
};

/// The clues for sampling lights.
pub(super) const LIGHTS: TaskClues = TaskClues {
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::less(SOME_OR_NONE)],
            clue: "The light that `choice` picks doesn't face away, but your code returns `None`. With several \
                lights, does it pick the right one? In front of a light, the direction toward it and its normal have \
                a negative dot product: is yours negative?",
            section: "light/lights.md#pick-a-light-by-its-power",
        },
        SymptomClue {
            symptoms: &[Symptom::more(SOME_OR_NONE)],
            clue: "Your code returns a direction, although there is no light, or the light that `choice` \
                picks faces away. Where does your code test for these two cases?",
            section: "light/lights.md#the-picked-light-may-face-away",
        },
        SymptomClue {
            symptoms: &[Symptom::reversed("direction")],
            clue: "Your direction is the opposite of the correct one, so it leads away from the light. Which \
                point do you subtract from which?",
            section: "light/lights.md#from-the-point-to-the-light",
        },
        SymptomClue {
            symptoms: &[LENGTH],
            clue: WRONG_LENGTH,
            section: "light/lights.md#the-direction-has-length-one",
        },
        SymptomClue {
            symptoms: &[Symptom::of("direction")],
            clue: "Work out by hand which light `choice` picks, and which point on it `AreaLight::point` returns \
                for `random`. Does your direction lead from the point shown to that one?",
            section: "light/lights.md#from-the-point-to-the-light",
        },
        SymptomClue {
            symptoms: &[Symptom::zero("pdf")],
            clue: "The direction hits the front of a light, but your density is 0. Which direction do you pass to \
                `intersect`, what is the sign of your cosine, and does your sum run over all lights?",
            section: "light/lights.md#the-density-of-an-area-light",
        },
        SymptomClue {
            symptoms: &[Symptom::not_zero("pdf")],
            clue: "No sample leads in this direction, but your density isn't 0. Does the direction hit a light at \
                all, and from which side? Find that out before you use the formula.",
            section: "light/lights.md#past-the-light-there-is-no-density",
        },
    ],
    ..TaskClues::NONE
};

/// The clues for direct light.
pub(super) const DIRECT: TaskClues = TaskClues {
    sections_on_panics: &[(PanicKind::NoValue, "light/direct.md#without-a-light-sample")],
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::zero("value")],
            clue: "Your result is 0, although one of the two directions finds light. What makes your code drop it: \
                an early `return`, a `break` or `continue`, a direction in the wrong frame, or a radiance that isn't \
                that of `World::emitted`?",
            section: "light/direct.md#directions-that-add-nothing",
        },
        SymptomClue {
            symptoms: &[Symptom::of("value")],
            clue: "Work out both terms for the question shown: evaluate × radiance / (light pdf + scattering pdf). \
                Which factor is different in your code, and which frame is its direction in?",
            section: "light/direct.md#what-to-return",
        },
    ],
    ..TaskClues::NONE
};

/// The clues for paths.
pub(super) const PATH: TaskClues = TaskClues {
    sections_on_panics: &[(
        PanicKind::NoValue,
        "light/paths.md#a-surface-that-scatters-nothing",
    )],
    by_symptom: &[
        SymptomClue {
            symptoms: &[Symptom::zero("value")],
            clue: "Your result is 0, so your path finds no light, or loses what it has found. Where does the path \
                of the question shown end, and what do you return there for the light found so far?",
            section: "light/paths.md#what-to-return",
        },
        SymptomClue {
            symptoms: &[Symptom::of("value")],
            clue: "Follow your path for the question shown. At each surface, write down what your code adds and \
                what the throughput is. Which of the steps in the handout does your code do differently? Does \
                bounce n use `sampler.numbers(n)`?",
            section: "light/paths.md#what-to-return",
        },
    ],
    ..TaskClues::NONE
};

/// The clues for environment maps.
pub(super) const ENVIRONMENT: TaskClues = TaskClues {
    sections_on_panics: &[(
        PanicKind::Index,
        "light/environment.md#the-search-ends-at-the-last-pixel",
    )],
    by_symptom: &[
        SymptomClue {
            symptoms: &[LENGTH],
            clue: "A direction has length one: add up the squares of your components. At the height h = cos θ, the \
                other two are on a circle: what is its radius in the formula, and what is it in your code?",
            section: "light/environment.md#three-components-and-two-angles",
        },
        SymptomClue {
            symptoms: &[Symptom::of("direction"), Symptom::reversed("direction")],
            clue: "Pass the correct direction to `Environment::index`. If your search returns the same \
                   index, check how you turn it and `random` into two angles. Otherwise, check the \
                   weights (luminance × sine in the middle of the row) and the search.",
            section: "light/environment.md#pick-a-pixel-by-cumulative-sums",
        },
        SymptomClue {
            symptoms: &[Symptom::of("pdf")],
            clue: "Work out each factor of the density for the direction shown, and compare it with the value \
                in your code: the pixel's share, the number of pixels, 2π² and sin θ.",
            section: "light/environment.md#the-density-of-a-direction",
        },
    ],
    ..TaskClues::NONE
};
