//! The methods of matte surfaces.

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::{Color, Density, LightQuestion, Scattered};
use crate::function::{Function, Input, NoView, Question, Submission, Table};
use crate::value::fields;

/// Calls `Lambertian::evaluate` with pairs of directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evaluate;

/// Calls `Lambertian::pdf` with pairs of directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pdf;

/// Calls `Lambertian::scatter` with random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scatter;

/// A matte surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Matte {
    /// The fraction of light that is scattered, for each colour channel.
    pub albedo: Vec3,
}

/// Two directions at a point on a surface, in its frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DirectionPair {
    /// The direction to where the path came from.
    pub out: Vec3,
    /// The direction that light comes from.
    pub incoming: Vec3,
}

/// The arguments of `Lambertian::scatter`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MatteSample {
    /// The direction to where the path came from.
    pub out: Vec3,
    /// Two random numbers in `[0, 1)`.
    pub random: Vec2,
}

fields! {
    Matte {
        "albedo": Color = albedo,
    }
}

fields! {
    DirectionPair {
        "out": Direction = out,
        "incoming": Direction = incoming,
    }
}

fields! {
    MatteSample {
        "out": Direction = out,
        "random": RandomPair = random,
    }
}

impl Input for DirectionPair {
    type View = NoView;
}

impl Input for MatteSample {
    type View = NoView;
}

impl Function for Evaluate {
    type Subject = Matte;
    type Input = DirectionPair;
    type Output = Color;

    fn name(_: &Matte) -> &'static str {
        "Lambertian::evaluate"
    }

    fn sentence(_: &Matte) -> &'static str {
        "albedo {albedo}, out {out}, incoming {incoming}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::Evaluate(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        matte: &'a Matte,
    ) -> impl Fn(&DirectionPair) -> Color + 'a {
        let light = submission.light();
        move |pair| Color {
            value: light.evaluate_matte(matte.albedo, pair.out, pair.incoming),
        }
    }
}

impl Function for Pdf {
    type Subject = Matte;
    type Input = DirectionPair;
    type Output = Density;

    fn name(_: &Matte) -> &'static str {
        "Lambertian::pdf"
    }

    fn sentence(_: &Matte) -> &'static str {
        "albedo {albedo}, out {out}, incoming {incoming}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::LambertianPdf(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        matte: &'a Matte,
    ) -> impl Fn(&DirectionPair) -> Density + 'a {
        let light = submission.light();
        move |pair| Density {
            pdf: light.matte_pdf(matte.albedo, pair.out, pair.incoming),
        }
    }
}

impl Function for Scatter {
    type Subject = Matte;
    type Input = MatteSample;
    type Output = Scattered;

    fn name(_: &Matte) -> &'static str {
        "Lambertian::scatter"
    }

    fn sentence(_: &Matte) -> &'static str {
        "albedo {albedo}, out {out}, random {random}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::LambertianScatter(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        matte: &'a Matte,
    ) -> impl Fn(&MatteSample) -> Scattered + 'a {
        let light = submission.light();
        move |sample| light.scatter_matte(matte.albedo, sample.out, sample.random)
    }
}
