//! The functions and methods of mirrors and glass.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{Fraction, LightQuestion, LocalDirection, Scattered};
use crate::function::{Function, Input, NoView, Question, Submission, Table};
use crate::value::fields;

/// Calls `reflect` with directions. It is a free function, so it has no subject.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reflect;

/// Calls `refract` with directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refract;

/// Calls `fresnel` with directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fresnel;

/// Calls `Mirror::scatter` with directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MirrorScatter;

/// Calls `Glass::scatter` with directions and random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GlassScatter;

/// A transparent medium.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Medium {
    /// The index of refraction. Outside, it is 1.
    pub ior: f32,
}

/// A mirror.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MirrorColor {
    /// The fraction of light that is reflected, for each colour channel.
    pub reflectance: Vec3,
}

/// The arguments of `Glass::scatter`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GlassSample {
    /// The direction to where the path came from.
    pub out: Vec3,
    /// A random number in `[0, 1)`.
    pub random: f32,
}

fields! {
    Medium {
        "ior": Ratio = ior,
    }
}

fields! {
    MirrorColor {
        "reflectance": Color = reflectance,
    }
}

fields! {
    GlassSample {
        "out": Direction = out,
        "random": Random = random,
    }
}

impl Input for LocalDirection {
    type View = NoView;
}

impl Input for GlassSample {
    type View = NoView;
}

impl Function for Reflect {
    type Subject = ();
    type Input = LocalDirection;
    type Output = LocalDirection;

    fn name((): &()) -> &'static str {
        "reflect"
    }

    fn sentence((): &()) -> &'static str {
        "out {direction}, where +z is the normal"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::Reflect(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        (): &'a (),
    ) -> impl Fn(&LocalDirection) -> LocalDirection + 'a {
        let light = submission.light();
        move |out| LocalDirection {
            direction: light.reflection(out.direction),
        }
    }
}

impl Function for Refract {
    type Subject = Medium;
    type Input = LocalDirection;
    type Output = Option<LocalDirection>;

    fn name(_: &Medium) -> &'static str {
        "refract"
    }

    fn sentence(_: &Medium) -> &'static str {
        "out {direction}, index of refraction {ior}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::Refract(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        medium: &'a Medium,
    ) -> impl Fn(&LocalDirection) -> Option<LocalDirection> + 'a {
        let light = submission.light();
        move |out| {
            let direction = light.refraction(out.direction, medium.ior)?;
            Some(LocalDirection { direction })
        }
    }
}

impl Function for Fresnel {
    type Subject = Medium;
    type Input = LocalDirection;
    type Output = Fraction;

    fn name(_: &Medium) -> &'static str {
        "fresnel"
    }

    fn sentence(_: &Medium) -> &'static str {
        "out {direction}, index of refraction {ior}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::Fresnel(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        medium: &'a Medium,
    ) -> impl Fn(&LocalDirection) -> Fraction + 'a {
        let light = submission.light();
        move |out| Fraction {
            fraction: light.reflected_fraction(out.direction, medium.ior),
        }
    }
}

impl Function for MirrorScatter {
    type Subject = MirrorColor;
    type Input = LocalDirection;
    type Output = Scattered;

    fn name(_: &MirrorColor) -> &'static str {
        "Mirror::scatter"
    }

    fn sentence(_: &MirrorColor) -> &'static str {
        "reflectance {reflectance}, out {direction}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::MirrorScatter(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        mirror: &'a MirrorColor,
    ) -> impl Fn(&LocalDirection) -> Scattered + 'a {
        let light = submission.light();
        move |out| light.scatter_mirror(mirror.reflectance, out.direction)
    }
}

impl Function for GlassScatter {
    type Subject = Medium;
    type Input = GlassSample;
    type Output = Scattered;

    fn name(_: &Medium) -> &'static str {
        "Glass::scatter"
    }

    fn sentence(_: &Medium) -> &'static str {
        "index of refraction {ior}, out {out}, random {random}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::GlassScatter(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        medium: &'a Medium,
    ) -> impl Fn(&GlassSample) -> Scattered + 'a {
        let light = submission.light();
        move |sample| light.scatter_glass(medium.ior, sample.out, sample.random)
    }
}
