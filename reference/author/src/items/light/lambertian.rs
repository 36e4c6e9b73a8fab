//! The items about matte surfaces.

use glam::{DVec3, Vec2};
use judging::exam::ExamQuestion;
use protocol::Table;
use protocol::light::LightQuestion;
use protocol::light::lambertian::{DirectionPair, Matte, MatteSample};

use super::groups::{MATTE, MATTE_SAMPLES};
use super::{colors, densities, scattered, table, with_changes};
use crate::domains::light::fields::{self, ABOVE, BELOW_ONE, HORIZON};
use crate::domains::light::materials::{MATTE_EVALUATE, MATTE_PDF, MATTE_SCATTER};
use crate::items::{AuthoredTask, Declaration};
use crate::oracle::light::lambertian;
use crate::seed::Rng;

/// The number of calls in each question.
const CALLS: usize = 8;

/// The signs of the components of a related direction.
const SAME: [f64; 3] = [1.0, 1.0, 1.0];
const OPPOSITE: [f64; 3] = [-1.0, -1.0, -1.0];
const ABOUT_THE_NORMAL: [f64; 3] = [-1.0, -1.0, 1.0];
const THROUGH_THE_SURFACE: [f64; 3] = [1.0, 1.0, -1.0];

/// The task `lambertian`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        EVALUATE,
        PDF,
        BELOW,
        GRAZING,
        DIRECTION,
        ATTENUATION,
        SAMPLED_PDF,
    ],
    domains: &[&MATTE_EVALUATE, &MATTE_PDF, &MATTE_SCATTER],
    ..AuthoredTask::NEW
};

const EVALUATE: Declaration = Declaration {
    id: "lambertian.evaluate",
    points: 2,
    title: "a matte surface scatters albedo / π times the cosine of the incoming light",
    look: "Which of the two directions does the cosine belong to, and which factor comes before it?",
    section: "light/materials.md#a-matte-surface",
    tests: &[
        "Returns the fraction of the light from `incoming` that is scattered to `out`, per solid \
         angle: albedo / π · cos θ, where θ is the angle between `incoming` and the normal.",
        "See PBR, section 9.2, whose f doesn't include the cosine.",
    ],
    questions: |rng| {
        // Each question ends with the call that the next one starts with.
        let same = related(rng, above, [ABOUT_THE_NORMAL]);
        surfaces(rng, |rng, matte| {
            let pairs = [
                same.clone(),
                pairs(rng, above, above),
                related(rng, above, [SAME, ABOUT_THE_NORMAL]),
                same.clone(),
            ];
            vec![evaluations(matte, pairs.concat())]
        })
    },
    ..Declaration::in_group(MATTE)
};

const PDF: Declaration = Declaration {
    id: "lambertian.pdf",
    points: 2,
    title: "the density of a direction is its cosine over π",
    look: "The density must integrate to 1 over the hemisphere. What does yours integrate to?",
    section: "light/materials.md#choose-directions-by-their-cosine",
    tests: &[
        "Returns the probability density, per solid angle, with which [`Lambertian::scatter`] \
         chooses `incoming`: cos θ / π.",
    ],
    questions: |rng| {
        surfaces(rng, |rng, matte| {
            let pairs = [
                pairs(rng, above, above),
                related(rng, above, [SAME, ABOUT_THE_NORMAL]),
            ];
            vec![pdfs(matte, pairs.concat())]
        })
    },
    ..Declaration::in_group(MATTE)
};

const BELOW: Declaration = Declaration {
    id: "lambertian.below",
    points: 2,
    title: "nothing is scattered unless both directions are above the surface",
    look: "What do you return if z is negative or 0 in `out`, in `incoming`, or in both?",
    section: "light/materials.md#both-directions-must-be-above-the-surface",
    tests: &["The result is zero unless both directions are above the surface (z > 0)."],
    questions: |rng| {
        surfaces(rng, |rng, matte| {
            let both = [
                pairs(rng, below, above),
                pairs(rng, above, below),
                pairs(rng, below, below),
                pairs(rng, above, above),
                pairs(rng, horizon, above),
                pairs(rng, above, horizon),
                related(rng, above, [OPPOSITE, THROUGH_THE_SURFACE]),
                related(rng, below, [SAME, OPPOSITE, ABOUT_THE_NORMAL]),
            ];
            let mut mixed = rng.shuffled(both.concat());
            mixed.extend(with_another_out(rng));
            vec![evaluations(matte, mixed.clone()), pdfs(matte, mixed)]
        })
    },
    ..Declaration::in_group(MATTE)
};

const GRAZING: Declaration = Declaration {
    id: "lambertian.grazing",
    title: "light that grazes the surface is scattered in proportion to its small cosine",
    look: "Do you treat small cosines as zero, or raise them to a minimum? A cosine of 0.001 is \
           valid.",
    section: "light/materials.md#both-directions-must-be-above-the-surface",
    tests: &["The result is zero unless both directions are above the surface (z > 0)."],
    questions: |rng| {
        surfaces(rng, |rng, matte| {
            let pairs = [
                pairs(rng, above, grazing),
                pairs(rng, grazing, above),
                pairs(rng, grazing, grazing),
            ]
            .concat();
            vec![evaluations(matte, pairs.clone()), pdfs(matte, pairs)]
        })
    },
    ..Declaration::in_group(MATTE)
};

const DIRECTION: Declaration = Declaration {
    id: "lambertian.direction",
    points: 2,
    title: "the sampled direction is the one that the given function returns",
    look: "Call the given `sample_cosine_hemisphere` with `random`, and return its direction \
           unchanged.",
    section: "light/materials.md#use-the-given-way-to-sample",
    tests: &[
        "Samples a direction above the surface with two random numbers in `[0, 1)`.",
        "`direction` is the one that the given [`sample_cosine_hemisphere`] returns for `random`.",
        "`out` is above the surface.",
    ],
    questions: |rng| samples(rng, &["direction", "unit_direction"], &[]),
    ..Declaration::in_group(MATTE_SAMPLES)
};

const ATTENUATION: Declaration = Declaration {
    id: "lambertian.attenuation",
    points: 2,
    title: "every sample is attenuated by the albedo, even close to the horizon",
    look: "Divide `evaluate` by `pdf` on paper and simplify the result. Return that, so that \
           nothing is divided by zero at the horizon.",
    section: "light/materials.md#the-attenuation-needs-no-division",
    tests: &[
        "`attenuation` is [`Lambertian::evaluate`] divided by [`Lambertian::pdf`], simplified so \
         that it is also right at the horizon, where both are zero.",
    ],
    questions: |rng| {
        // These lead to directions close to the normal and to the horizon.
        let ends = [0.0, 1e-6, 1.0 - f32::EPSILON, BELOW_ONE];
        samples(rng, &["attenuation"], &ends)
    },
    ..Declaration::in_group(MATTE_SAMPLES)
};

const SAMPLED_PDF: Declaration = Declaration {
    id: "lambertian.sampled_pdf",
    title: "a sample comes with the density of its own direction",
    look: "Which direction do you compute the density for: `out`, or the one you return?",
    section: "light/materials.md#the-density-of-the-sampled-direction",
    tests: &["`pdf` is the density of this direction."],
    questions: |rng| samples(rng, &["pdf"], &[]),
    ..Declaration::in_group(MATTE_SAMPLES)
};

/// Returns questions about surfaces with different albedos, including black and white.
fn surfaces(
    rng: &mut Rng,
    questions: impl Fn(&mut Rng, Matte) -> Vec<ExamQuestion>,
) -> Vec<ExamQuestion> {
    let mattes = fields::reflectances(rng).into_iter().map(|albedo| Matte {
        albedo: albedo.as_vec3(),
    });
    mattes.flat_map(|matte| questions(rng, matte)).collect()
}

/// Returns a direction above the surface that doesn't graze it.
fn above(rng: &mut Rng) -> DVec3 {
    let class = [0, 1, 2, 2, 2, 2][rng.index(6)];
    fields::direction(rng, class)
}

/// Returns a direction below the surface, at any angle.
fn below(rng: &mut Rng) -> DVec3 {
    let class = HORIZON + 1 + rng.index(ABOVE);
    fields::direction(rng, class)
}

/// Returns a direction along the surface.
fn horizon(rng: &mut Rng) -> DVec3 {
    fields::direction(rng, HORIZON)
}

fn grazing(rng: &mut Rng) -> DVec3 {
    let class = 3 + rng.index(3);
    fields::direction(rng, class)
}

/// Returns pairs of directions in which `incoming` is `out` with the signs of its components
/// changed.
fn related<const N: usize>(
    rng: &mut Rng,
    out: fn(&mut Rng) -> DVec3,
    signs: [[f64; 3]; N],
) -> Vec<DirectionPair> {
    let pairs = signs.map(|signs| {
        let out = out(rng);
        DirectionPair {
            out: out.as_vec3(),
            incoming: (DVec3::from_array(signs) * out).as_vec3(),
        }
    });
    pairs.into()
}

/// Returns pairs of directions that have the same `incoming` as the pair before, but `out` is on the
/// other side.
fn with_another_out(rng: &mut Rng) -> Vec<DirectionPair> {
    let incoming = above(rng).as_vec3();
    let sides: [fn(&mut Rng) -> DVec3; 4] = [above, below, above, below];
    let pairs = sides.map(|side| DirectionPair {
        out: side(rng).as_vec3(),
        incoming,
    });
    pairs.into()
}

/// Returns pairs of directions, each drawn by one of the two functions.
fn pairs(
    rng: &mut Rng,
    out: fn(&mut Rng) -> DVec3,
    incoming: fn(&mut Rng) -> DVec3,
) -> Vec<DirectionPair> {
    rng.list(CALLS, |rng| DirectionPair {
        out: out(rng).as_vec3(),
        incoming: incoming(rng).as_vec3(),
    })
}

fn evaluations(matte: Matte, pairs: Vec<DirectionPair>) -> ExamQuestion {
    let evaluate = |pair: &DirectionPair| {
        let albedo = matte.albedo.as_dvec3();
        lambertian::evaluate(albedo, pair.out.as_dvec3(), pair.incoming.as_dvec3())
    };
    let ask = |pairs: Vec<DirectionPair>| {
        let rows = colors(pairs.iter().map(evaluate));
        let question = LightQuestion::Evaluate(Table::of_list(matte, pairs));
        table(question, &["value"], rows)
    };
    with_changes(pairs, ask, |_| true)
}

fn pdfs(matte: Matte, pairs: Vec<DirectionPair>) -> ExamQuestion {
    let pdf = |pair: &DirectionPair| lambertian::pdf(pair.out.as_dvec3(), pair.incoming.as_dvec3());
    let ask = |pairs: Vec<DirectionPair>| {
        let rows = densities(pairs.iter().map(pdf));
        let question = LightQuestion::LambertianPdf(Table::of_list(matte, pairs));
        table(question, &["pdf"], rows)
    };
    with_changes(pairs, ask, |_| true)
}

/// Returns questions about samples of different surfaces. The first random number of some samples is
/// in `ends`.
fn samples(rng: &mut Rng, judged: &[&str], ends: &[f32]) -> Vec<ExamQuestion> {
    // Each question ends with the call that the next one starts with.
    let same = sample(rng, None);
    surfaces(rng, |rng, matte| {
        let mut calls = vec![same];
        calls.extend(rng.list(CALLS, |rng| sample(rng, None)));
        calls.extend(ends.iter().map(|end| sample(rng, Some(*end))));
        calls.push(same);
        let scatter = |call: &MatteSample| {
            let albedo = matte.albedo.as_dvec3();
            lambertian::scatter(albedo, call.out.as_dvec3(), call.random.as_dvec2())
        };
        let ask = |calls: Vec<MatteSample>| {
            let rows = scattered(calls.iter().map(scatter));
            let question = LightQuestion::LambertianScatter(Table::of_list(matte, calls));
            table(question, judged, rows)
        };
        vec![with_changes(calls, ask, |_| true)]
    })
}

/// Returns a call of `Lambertian::scatter`, with this first random number if there is one.
fn sample(rng: &mut Rng, first: Option<f32>) -> MatteSample {
    let class = rng.index(ABOVE);
    let random = fields::number_pair(rng);
    MatteSample {
        out: fields::direction(rng, class).as_vec3(),
        random: Vec2::new(first.unwrap_or(random.x), random.y),
    }
}
