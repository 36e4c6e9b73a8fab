//! The items about mirrors and glass.

use std::ops::{Range, RangeInclusive};

use glam::{DVec2, DVec3, Vec3};
use judging::exam::ExamQuestion;
use judging::symptom::Symptom;
use protocol::light::LightQuestion;
use protocol::light::specular::{GlassSample, Medium, MirrorColor};
use protocol::{LocalDirection, Table};

use super::groups::SPECULAR;
use super::{above, below, directions, fractions, local, optional_directions, scattered};
use super::{single, table, with_changes};
use crate::domains::light::fields::{self, ABOVE, HORIZON};
use crate::domains::light::materials::{
    GLASS_SCATTER, MIRROR_SCATTER, REFLECTED_FRACTION, REFLECTION, REFRACTED,
};
use crate::items::{AuthoredTask, Declaration};
use crate::oracle::light::specular;
use crate::seed::Rng;

/// The number of calls in each question.
const CALLS: usize = 12;
/// The lower limit for comparisons: smaller fractions are compared as if they had this size.
const SMALLEST_FRACTION: f64 = 0.01;

/// The task `specular`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        REFLECT,
        REFLECT_INSIDE,
        ENTERING,
        LEAVING,
        TOTAL,
        HEAD_ON,
        LOW_INDEX,
        FRESNEL_ENTERING,
        FRESNEL_LEAVING,
        FRESNEL_TOTAL,
        FRESNEL_LOW_INDEX,
        MIRROR,
        GLASS_CHOICE,
        GLASS_RADIANCE,
        GLASS_TOTAL,
    ],
    domains: &[
        &REFLECTION,
        &REFRACTED,
        &REFLECTED_FRACTION,
        &MIRROR_SCATTER,
        &GLASS_SCATTER,
    ],
    ..AuthoredTask::NEW
};

const REFLECT: Declaration = Declaration {
    id: "specular.reflect",
    title: "a mirror rotates a direction by half a turn about the normal",
    look: "Which components change sign, and which one stays the same?",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/glass.md#the-mirror-direction",
    tests: &["Mirrors a direction about the normal."],
    questions: |rng| {
        let special = every_height(rng, 0..=HORIZON);
        vec![reflections([rng.list(CALLS, above), special].concat())]
    },
    ..Declaration::in_group(SPECULAR)
};

const REFLECT_INSIDE: Declaration = Declaration {
    id: "specular.reflect_inside",
    title: "a reflected direction stays on its side of the surface",
    look: "If the path is inside the glass, what is the sign of z in `out`, and what is it in your \
           result?",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/glass.md#the-mirror-keeps-the-side",
    tests: &[
        "The result is on the same side of the surface as `out`, which can be on either side.",
    ],
    questions: |rng| {
        let special = every_height(rng, HORIZON + 1..=2 * HORIZON);
        let [inside, outside] = [below, above].map(|draw| rng.list(CALLS, draw));
        vec![reflections([inside, outside, special].concat())]
    },
    ..Declaration::in_group(SPECULAR)
};

const ENTERING: Declaration = Declaration {
    id: "specular.refract_entering",
    points: 2,
    title: "a path that enters a denser medium is bent toward the normal",
    look: "x and y of the result are those of `out` times minus the index on the side of `out`, \
           divided by the other index. z then follows from the length. Which of the three is wrong?",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/glass.md#the-refracted-direction",
    tests: &[
        "Returns the direction on the other side of the surface of a medium with index of \
         refraction `ior`, according to Snell's law, or `None` for total reflection.",
        "See PBR, section 9.3.3.",
        "If out.z > 0, the path is outside, where the index is 1, and the result has z < 0.",
    ],
    questions: |rng| {
        // Each question ends with the direction that the next one starts with.
        let same = above(rng);
        media(rng, DENSE, |rng, medium| {
            let out = directions_that(rng, medium, above, any);
            let grazing = few(rng, medium, grazing, any);
            let out = [vec![same], out, grazing, vec![same]].concat();
            refraction(medium, out)
        })
    },
    ..Declaration::in_group(SPECULAR)
};

const LEAVING: Declaration = Declaration {
    id: "specular.refract_leaving",
    points: 2,
    title: "a path that leaves a denser medium is bent away from the normal",
    look: "If `out` is inside, the ratio of the indices is inverted, and the result points up. Which of \
           the three components is wrong in your code?",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/glass.md#the-refracted-direction",
    tests: &["If out.z < 0, the path is inside, and the result has z > 0."],
    questions: |rng| {
        media(rng, DENSE, |rng, medium| {
            let mut out = directions_that(rng, medium, below, refracted);
            out.extend(near_critical(rng, medium, -1.0, refracted));
            refraction(medium, out)
        })
    },
    ..Declaration::in_group(SPECULAR)
};

const TOTAL: Declaration = Declaration {
    id: "specular.refract_total",
    points: 2,
    title: "light is refracted up to the critical angle, and not beyond it",
    look: "What is the squared sine of the refracted angle, and what do you do if it exceeds 1?",
    section: "light/glass.md#total-reflection",
    tests: &[
        "Directions along the surface (z = 0), and those at the critical angle, are not tested.",
    ],
    questions: |rng| {
        media(rng, DENSE, |rng, medium| {
            let mut out = directions_that(rng, medium, any_below, total);
            out.extend(near_critical(rng, medium, -1.0, total));
            out.extend(directions_that(rng, medium, below, refracted));
            out.extend(directions_that(rng, medium, above, any));
            refraction(medium, rng.shuffled(out))
        })
    },
    ..Declaration::in_group(SPECULAR)
};

const HEAD_ON: Declaration = Declaration {
    id: "specular.refract_head_on",
    title: "along the normal, light goes straight on",
    look: "Along the normal, the sine of the angle is zero. Do you divide by it, or by a length \
           that is zero here?",
    look_fits: &[
        Symptom::of("direction"),
        Symptom::reversed("direction"),
        Symptom::of("length of the direction"),
    ],
    section: "light/glass.md#straight-through-is-not-a-special-case",
    tests: &["The result has length one, even along the normal."],
    questions: |rng| {
        media(rng, DENSE, |rng, medium| {
            let above = above(rng);
            let below = directions_that(rng, medium, below, refracted)[0];
            let mut out = vec![DVec3::Z, DVec3::NEG_Z, above, below];
            let near = [1, 2 * HORIZON - 1].repeat(CALLS).into_iter();
            out.extend(near.map(|class| fields::direction(rng, class)));
            refraction(medium, out)
        })
    },
    ..Declaration::in_group(SPECULAR)
};

const LOW_INDEX: Declaration = Declaration {
    id: "specular.refract_low_index",
    title: "an index of 1 bends nothing, and below 1, total reflection occurs outside",
    look: "Does any step in your code assume that `ior` is greater than 1? It can also be 1 or \
           less. Even at 1, the result is on the other side of the surface.",
    section: "light/glass.md#an-index-below-one",
    tests: &[
        "`ior` can be less than 1, in which case total reflection can occur outside.",
        "It can also be 1, in which case light isn't bent.",
    ],
    questions: |rng| thin_and_straight(rng, refraction),
    ..Declaration::in_group(SPECULAR)
};

const FRESNEL_ENTERING: Declaration = Declaration {
    id: "specular.fresnel_entering",
    points: 2,
    title: "outside, the reflected fraction follows the Fresnel equations at every angle",
    look: "Work out both ratios at 60°. The result is the mean of their squares, and an approximation \
           such as Schlick's isn't close enough to it. Which step is different in your code?",
    section: "light/glass.md#how-much-is-reflected",
    tests: &[
        "Returns the fraction of unpolarised light that the surface of a medium with index of \
         refraction `ior` reflects, according to the Fresnel equations.",
        "See PBR, section 9.3.5: the mean of the squares of two ratios, one for each polarisation.",
        "Schlick's approximation isn't accurate enough.",
    ],
    questions: |rng| {
        media(rng, DENSE, |rng, medium| {
            let mut out = directions_that(rng, medium, above, any);
            out.extend(directions_that(rng, medium, slanted, any));
            out.extend(few(rng, medium, grazing, any));
            out.extend([fields::direction(rng, 1), DVec3::Z]);
            // The next question is about the same direction first.
            out.insert(0, DVec3::Z);
            fresnel(medium, out)
        })
    },
    ..Declaration::in_group(SPECULAR)
};

const FRESNEL_LEAVING: Declaration = Declaration {
    id: "specular.fresnel_leaving",
    points: 2,
    title: "inside, the reflected fraction is that of the refracted direction outside",
    look: "Both cosines are positive, even inside. Which of them belongs to which index if the path is \
           inside?",
    section: "light/glass.md#each-side-has-its-own-angle",
    tests: &[
        "`out` can be on either side of the surface, as for [`refract`].",
        "Two directions that refract into each other have the same fraction.",
    ],
    questions: |rng| {
        media(rng, DENSE, |rng, medium| {
            let mut out = directions_that(rng, medium, below, refracted);
            out.extend(near_critical(rng, medium, -1.0, refracted));
            out.extend([DVec3::NEG_Z, -fields::direction(rng, 1)]);
            out.extend(on_both_sides(rng, medium));
            fresnel(medium, out)
        })
    },
    ..Declaration::in_group(SPECULAR)
};

const FRESNEL_TOTAL: Declaration = Declaration {
    id: "specular.fresnel_total",
    title: "everything is reflected beyond the critical angle, and only a part below it",
    look: "Is the squared sine of the refracted angle above 1 for the question shown? Then nothing is \
           refracted: what do you return? Otherwise, compare both ratios with those in your code.",
    section: "light/glass.md#total-reflection-is-full-reflection",
    tests: &["The result is 1 for total reflection, and 0 if `ior` is 1."],
    questions: |rng| {
        media(rng, DENSE, |rng, medium| {
            let mut out = directions_that(rng, medium, any_below, total);
            out.extend(near_critical(rng, medium, -1.0, total));
            out.extend(directions_that(rng, medium, below, refracted));
            fresnel(medium, rng.shuffled(out))
        })
    },
    ..Declaration::in_group(SPECULAR)
};

const FRESNEL_LOW_INDEX: Declaration = Declaration {
    id: "specular.fresnel_low_index",
    title: "an index of 1 reflects nothing, and an index below 1 swaps outside and inside",
    look: "Does any step in your code assume that `ior` is greater than 1? It can also be 1 or \
           less.",
    section: "light/glass.md#an-index-below-one",
    tests: &["The result is 1 for total reflection, and 0 if `ior` is 1."],
    questions: |rng| thin_and_straight(rng, fresnel),
    ..Declaration::in_group(SPECULAR)
};

const MIRROR: Declaration = Declaration {
    id: "specular.mirror",
    points: 2,
    title: "a mirror attenuates by its reflectance, and its only direction has no density",
    look: "A mirror's only direction has no density to divide by: what is the attenuation then?",
    look_fits: &[Symptom::of("attenuation"), Symptom::of("pdf")],
    section: "light/glass.md#what-to-return",
    tests: &[
        "Returns the only direction that reflected light can come from.",
        "`attenuation` is the reflectance, and `pdf` is `None`.",
    ],
    questions: |rng| {
        let colors = fields::reflectances(rng).into_iter();
        // Each question ends with the direction that the next one starts with.
        let same = any_above(rng);
        let question = |reflectance: DVec3| {
            let out = [vec![same], rng.list(CALLS, any_above), vec![same]].concat();
            let scatter = |out: &DVec3| specular::mirror_scatter(reflectance, *out);
            let rows = scattered(out.iter().map(scatter));
            let mirror = MirrorColor {
                reflectance: reflectance.as_vec3(),
            };
            let question = LightQuestion::MirrorScatter(Table::of_list(mirror, locals(out)));
            table(question, &["direction", "attenuation", "pdf"], rows)
        };
        colors.map(question).collect()
    },
    ..Declaration::in_group(SPECULAR)
};

const GLASS_CHOICE: Declaration = Declaration {
    id: "specular.glass_choice",
    points: 2,
    title: "glass reflects if the random number is below `fresnel`, and refracts otherwise",
    look: "Which of the two directions do you choose if `random` is less than `fresnel`? And is \
           that the `fresnel` that your own function returns?",
    look_fits: &[Symptom::of("direction"), Symptom::reversed("direction")],
    section: "light/glass.md#below-the-fraction-means-reflected",
    tests: &[
        "Chooses between reflection and refraction with a random number in `[0, 1)`: the path is \
         reflected if and only if the number is less than [`fresnel`].",
        "`pdf` is `None`.",
    ],
    questions: |rng| glass(rng, &["direction", "pdf"]),
    ..Declaration::in_group(SPECULAR)
};

const GLASS_RADIANCE: Declaration = Declaration {
    id: "specular.glass_radiance",
    points: 2,
    title: "refraction scales radiance by the squared index ratio, and reflection doesn't",
    look: "Refracted paths are scaled by the squared ratio of the indices and by nothing else. Which \
           index is on the side of `out`, and which is on the side that the light comes from?",
    section: "light/glass.md#the-ratio-of-indices-is-squared",
    tests: &[
        "If the path is reflected, `attenuation` is 1: the fraction of the light that is \
         reflected, divided by the probability of reflection.",
        "If the path is refracted, that quotient is 1, too, but where light enters a denser \
         medium, its rays are squeezed into a smaller solid angle, so their radiance grows.",
        "`attenuation` is (η_out / η_in)², the square of the index on the side of `out` over the \
         index on the side that the light comes from.",
        "See PBR, section 9.5.2.",
    ],
    questions: |rng| glass(rng, &["attenuation"]),
    ..Declaration::in_group(SPECULAR)
};

const GLASS_TOTAL: Declaration = Declaration {
    id: "specular.glass_total",
    title: "glass reflects everything beyond the critical angle, with an attenuation of 1",
    look: "What do you return if nothing is refracted? Does it depend on the random number?",
    section: "light/glass.md#total-reflection-is-not-scaled",
    tests: &["If the path is reflected, `attenuation` is 1: …"],
    questions: |rng| {
        let mut questions = media(rng, DENSE, |rng, medium| {
            let mut out = directions_that(rng, medium, any_below, total);
            out.extend(near_critical(rng, medium, -1.0, total));
            out.extend(directions_that(rng, medium, below, refracted));
            glass_samples(rng, medium, out, &["direction", "attenuation", "pdf"])
        });
        questions.extend(media(rng, THIN, |rng, medium| {
            let mut out = directions_that(rng, medium, any_above, total);
            out.extend(near_critical(rng, medium, 1.0, total));
            glass_samples(rng, medium, out, &["direction", "attenuation", "pdf"])
        }));
        questions
    },
    ..Declaration::in_group(SPECULAR)
};

/// Returns two directions at each angle in this range of classes.
fn every_height(rng: &mut Rng, classes: RangeInclusive<usize>) -> Vec<DVec3> {
    let twice = classes.clone().chain(classes);
    twice.map(|class| fields::direction(rng, class)).collect()
}

/// Returns a direction above the surface, at any angle.
fn any_above(rng: &mut Rng) -> DVec3 {
    let class = rng.index(ABOVE);
    fields::direction(rng, class)
}

/// Returns a direction below the surface, at any angle.
fn any_below(rng: &mut Rng) -> DVec3 {
    -any_above(rng)
}

/// Returns a direction above the surface that grazes it.
fn grazing(rng: &mut Rng) -> DVec3 {
    let class = rng.index(3) + 3;
    fields::direction(rng, class)
}

/// Returns a direction above the surface, farther from the normal than from the horizon.
fn slanted(rng: &mut Rng) -> DVec3 {
    rng.retry(|rng| Some(above(rng)).filter(|out| out.z < 0.5))
}

/// Returns questions about media that are thinner than their surroundings, and about one with the
/// index of its surroundings.
fn thin_and_straight(
    rng: &mut Rng,
    question: fn(Medium, Vec<DVec3>) -> ExamQuestion,
) -> Vec<ExamQuestion> {
    let mut questions = media(rng, THIN, |rng, medium| {
        let mut out = directions_that(rng, medium, any_above, total);
        out.extend(directions_that(rng, medium, above, refracted));
        out.extend(directions_that(rng, medium, below, any));
        out.extend(few(rng, medium, any_below, any));
        for wanted in [refracted, total] {
            out.extend(near_critical(rng, medium, 1.0, wanted));
        }
        question(medium, rng.shuffled(out))
    });
    questions.extend(media(rng, SAME, |rng, medium| {
        let mut out = rng.list(CALLS, above);
        out.extend(rng.list(CALLS, below));
        out.extend(few(rng, medium, any_above, any));
        out.extend(few(rng, medium, any_below, any));
        question(medium, out)
    }));
    questions
}

/// The classes of indices of media that are denser than their surroundings.
const DENSE: &[usize] = &[7, 8, 5, 6];
/// The classes of indices of media that are thinner than their surroundings.
const THIN: &[usize] = &[1, 0, 3, 2];
/// The class of the index of the surroundings.
const SAME: &[usize] = &[4];

/// A call that refracts for every index, but not in the direction that it came from.
const SLANTED: GlassSample = GlassSample {
    out: Vec3::new(0.048, 0.064, 0.996_794_9),
    random: 0.9,
};

/// Returns a question about a medium for each of these classes of indices.
fn media(
    rng: &mut Rng,
    classes: &[usize],
    mut question: impl FnMut(&mut Rng, Medium) -> ExamQuestion,
) -> Vec<ExamQuestion> {
    let question = |&class: &usize| {
        let ior = fields::index(rng, class);
        question(rng, Medium { ior })
    };
    classes.iter().map(question).collect()
}

fn any(_: DVec3, _: f64) -> bool {
    true
}

fn refracted(out: DVec3, ior: f64) -> bool {
    specular::refract(out, ior).is_some()
}

fn total(out: DVec3, ior: f64) -> bool {
    !refracted(out, ior)
}

/// Returns up to two directions whose reflected fraction is in this range.
fn with_fraction(
    rng: &mut Rng,
    medium: Medium,
    draw: fn(&mut Rng) -> DVec3,
    range: Range<f64>,
) -> Vec<DVec3> {
    let ior = medium.ior.into();
    let direction = |_| {
        rng.attempt(1_000, |rng| {
            let out = draw(rng);
            let is_wanted = range.contains(&specular::fresnel(out, ior));
            (is_wanted && is_clear(out, ior)).then_some(out)
        })
    };
    (0..2).filter_map(direction).collect()
}

/// Returns directions for which a condition is true and that all correct formulas agree on.
fn directions_that(
    rng: &mut Rng,
    medium: Medium,
    draw: fn(&mut Rng) -> DVec3,
    condition: fn(DVec3, f64) -> bool,
) -> Vec<DVec3> {
    let ior = medium.ior.into();
    rng.retry_list(CALLS, |rng| {
        let out = draw(rng);
        (is_clear(out, ior) && condition(out, ior)).then_some(out)
    })
}

/// Returns a direction outside, its mirror image inside, and the first one again. Light is
/// refracted from both.
fn on_both_sides(rng: &mut Rng, medium: Medium) -> Vec<DVec3> {
    let ior = medium.ior.into();
    let outside = rng.retry(|rng| {
        let out = above(rng);
        let is_refracted = |out| is_clear(out, ior) && refracted(out, ior);
        (is_refracted(out) && is_refracted(-specular::reflect(out))).then_some(out)
    });
    vec![outside, -specular::reflect(outside), outside]
}

/// Returns half as many directions as [`directions_that`].
fn few(
    rng: &mut Rng,
    medium: Medium,
    draw: fn(&mut Rng) -> DVec3,
    condition: fn(DVec3, f64) -> bool,
) -> Vec<DVec3> {
    let mut all = directions_that(rng, medium, draw, condition);
    all.truncate(CALLS / 2);
    all
}

/// Returns the smallest difference of a cosine from that of the critical angle. It is less where the
/// critical angle itself is close to the surface or the normal.
fn critical_distance(ior: f64) -> f64 {
    let cosine = critical_cosine(ior);
    (0.2 * cosine.min(1.0 - cosine)).clamp(5e-4, 2e-3)
}

/// Returns the cosine of the critical angle.
fn critical_cosine(ior: f64) -> f64 {
    (1.0 - ior.min(1.0 / ior).powi(2)).sqrt()
}

/// Returns up to two directions close to the critical angle, on the side with this sign, for which
/// a condition is true.
fn near_critical(
    rng: &mut Rng,
    medium: Medium,
    side: f64,
    condition: fn(DVec3, f64) -> bool,
) -> Vec<DVec3> {
    let ior = f64::from(medium.ior);
    let (critical, distance) = (critical_cosine(ior), critical_distance(ior));
    let direction = |_| {
        rng.attempt(1_000, |rng| {
            let height = critical + rng.sign() * rng.log_uniform(distance, 10.0 * distance);
            let flat = above(rng).truncate().normalize();
            let height = height.clamp(0.0, 1.0);
            let out = single((flat * (1.0 - height * height).sqrt()).extend(side * height));
            let is_wanted = is_clear(out, ior) && condition(out, ior);
            (height > 1e-3 && height < 0.9999 && is_wanted).then_some(out)
        })
    };
    (0..2).filter_map(direction).collect()
}

/// Returns whether a direction is not close to the critical angle, and rounding doesn't matter much:
/// the squared cosine of the refracted direction is 1 minus a number that is rounded.
fn is_clear(out: DVec3, ior: f64) -> bool {
    /// A tenth of the tolerances for directions and fractions.
    const MOST: f64 = 1e-4;
    let [least, most] = rounded_squares(out, ior);
    let is_decided = least > 0.0 || most < 0.0;
    let is_near = specular::critical_margin(out, ior) < critical_distance(ior);
    let [a, b] = rounded_fractions(out, ior);
    let [least, most] = [least, most].map(|square| square.max(0.0).sqrt());
    is_decided
        && !is_near
        && most - least < MOST
        && (a - b).abs() < MOST * a.max(b).max(SMALLEST_FRACTION)
}

/// Returns the smallest and the largest squared cosine of the refracted direction that rounding can
/// lead to.
fn rounded_squares(out: DVec3, ior: f64) -> [f64; 2] {
    let ratio = if out.z > 0.0 { 1.0 / ior } else { ior };
    let squared = 1.0 - ratio * ratio * (1.0 - out.z * out.z);
    let rounding = 2e-7 * (1.0 + ratio * ratio);
    [squared - rounding, squared + rounding]
}

/// Returns the reflected fractions for the [`rounded_squares`].
fn rounded_fractions(out: DVec3, ior: f64) -> [f64; 2] {
    let (near, far) = if out.z > 0.0 { (1.0, ior) } else { (ior, 1.0) };
    let square = |a: f64, b: f64| ((a - b) / (a + b)).powi(2);
    rounded_squares(out, ior).map(|squared| {
        let (cosine, refracted) = (out.z.abs(), squared.max(0.0).sqrt());
        let perpendicular = square(near * cosine, far * refracted);
        0.5 * (perpendicular + square(far * cosine, near * refracted))
    })
}

/// Returns how far a random number must be from the reflected fraction, so that rounding doesn't
/// matter.
fn fraction_margin(out: DVec3, ior: f64) -> f64 {
    let [a, b] = rounded_fractions(out, ior);
    // The fraction is a square. Its root, a difference of numbers of the order of one, is rounded,
    // too.
    2.0 * (a - b).abs() + 1e-5 * a.max(b).sqrt()
}

/// Returns whether it doesn't depend on rounding how glass scatters a path.
fn is_clear_sample(call: &GlassSample, ior: f64) -> bool {
    let (out, number) = (call.out.as_dvec3(), f64::from(call.random));
    let is_far = (number - specular::fresnel(out, ior)).abs() > fraction_margin(out, ior);
    // Total reflection doesn't depend on the number.
    let is_decided = is_far || (is_never_reflected(out, ior) && number == 0.0);
    is_clear(out, ior) && (is_decided || total(out, ior))
}

/// Returns whether the reflected fraction is zero and isn't rounded: along the normal of a medium
/// with index 1.
fn is_never_reflected(out: DVec3, ior: f64) -> bool {
    ior == 1.0 && out.truncate() == DVec2::ZERO
}

fn reflections(out: Vec<DVec3>) -> ExamQuestion {
    let rows = directions(out.iter().map(|out| specular::reflect(*out)));
    let question = LightQuestion::Reflect(Table::of_list((), locals(out)));
    table(question, &["direction", "unit_direction"], rows)
}

fn refraction(medium: Medium, out: Vec<DVec3>) -> ExamQuestion {
    let refract = |out: &DVec3| specular::refract(*out, medium.ior.into());
    let rows = optional_directions(out.iter().map(refract));
    let question = LightQuestion::Refract(Table::of_list(medium, locals(out)));
    table(question, &["direction", "unit_direction"], rows)
}

fn fresnel(medium: Medium, out: Vec<DVec3>) -> ExamQuestion {
    let fraction = |out: &DVec3| specular::fresnel(*out, medium.ior.into());
    let rows = fractions(out.iter().map(fraction));
    let question = LightQuestion::Fresnel(Table::of_list(medium, locals(out)));
    table(question, &["fraction"], rows)
}

/// Returns questions about glass in which some paths are reflected and others refracted, from both
/// sides.
fn glass(rng: &mut Rng, judged: &[&str]) -> Vec<ExamQuestion> {
    let classes = [DENSE, THIN, SAME].concat();
    media(rng, &classes, |rng, medium| {
        let mut out = Vec::new();
        for (draw, side) in [(any_above as fn(&mut Rng) -> DVec3, 1.0), (any_below, -1.0)] {
            out.extend(few(rng, medium, draw, refracted));
            out.extend(near_critical(rng, medium, side, refracted));
            for range in [1e-6..1.9e-5, 1e-4..1.9e-3, 0.9952..0.9975, 0.9985..0.9999] {
                out.extend(with_fraction(rng, medium, draw, range));
            }
            out.push(side * DVec3::Z);
        }
        glass_samples(rng, medium, out, judged)
    })
}

/// Returns a question in which each direction occurs twice: with a random number on each side of
/// its reflected fraction.
fn glass_samples(rng: &mut Rng, medium: Medium, out: Vec<DVec3>, judged: &[&str]) -> ExamQuestion {
    let ior = f64::from(medium.ior);
    let mut calls = Vec::new();
    for out in out {
        let fraction = specular::fresnel(out, ior);
        let margin = fraction_margin(out, ior).max(1e-7);
        for is_below in [true, false] {
            calls.extend(rng.attempt(1_000, |rng| {
                // Numbers close to the fraction are as frequent as others.
                let distance = rng.log_uniform(2.0 * margin, 1.0);
                let near = (fraction + rng.sign() * distance) as f32;
                let random = if is_never_reflected(out, ior) {
                    0.0
                } else if rng.coin() {
                    near
                } else {
                    fields::number(rng)
                };
                let out = out.as_vec3();
                let call = GlassSample { out, random };
                let is_wanted = (f64::from(random) < fraction) == is_below;
                let is_random = (0.0..1.0).contains(&random);
                (is_random && is_wanted && is_clear_sample(&call, ior)).then_some(call)
            }));
        }
    }
    // The next question is about the same call first, which refracts for every index.
    let calls = [vec![SLANTED], rng.shuffled(calls), vec![SLANTED]].concat();
    let ask = |calls: Vec<GlassSample>| {
        let scatter = |call: &GlassSample| {
            specular::glass_scatter(ior, call.out.as_dvec3(), call.random.into())
        };
        let rows = scattered(calls.iter().map(scatter));
        let question = LightQuestion::GlassScatter(Table::of_list(medium, calls));
        table(question, judged, rows)
    };
    with_changes(calls, ask, |call| is_clear_sample(call, ior))
}

fn locals(directions: Vec<DVec3>) -> Vec<LocalDirection> {
    directions.into_iter().map(local).collect()
}
