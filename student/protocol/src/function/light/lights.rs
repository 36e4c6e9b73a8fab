//! The methods of lights.

use std::borrow::Cow;

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::{Density, LightQuestion, LocalDirection};
use crate::function::{Function, Input, NoView, Question, Submission, Table};
use crate::packed;
use crate::value::{Fields, Record, Value, fields};

/// Calls `AreaLight::pdf` with points and directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AreaLightPdf;

/// Calls `Lights::sample` with points and random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LightsSample;

/// Calls `Lights::pdf` with points and directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LightsPdf;

/// A flat light as described to a submission, which converts it to its own type. It emits on the
/// side from which the turn from the first edge to the second looks counterclockwise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlatLight {
    /// A corner.
    pub corner: Vec3,
    /// The two edges at that corner.
    pub edges: [Vec3; 2],
    /// Whether the light is only the half of the parallelogram next to the corner: a triangle.
    pub is_triangle: bool,
    /// The radiance that is emitted in every direction.
    pub radiance: Vec3,
}

/// A sphere that emits light outward, as described to a submission.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SphericalLight {
    /// The centre.
    pub center: Vec3,
    /// The radius.
    pub radius: f32,
    /// The radiance that is emitted in every direction.
    pub radiance: Vec3,
}

/// A light in a list.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ListedLight {
    /// A flat light.
    Flat(FlatLight),
    /// A sphere.
    Sphere(SphericalLight),
}

/// The lights of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightList {
    /// The lights, in order.
    #[serde(with = "packed")]
    pub lights: Vec<ListedLight>,
}

/// A direction from a point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Toward {
    /// The point.
    pub from: Vec3,
    /// The direction.
    pub direction: Vec3,
}

/// The arguments of `Lights::sample`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LightSample {
    /// The point that is lit.
    pub from: Vec3,
    /// The random number that picks the light.
    pub choice: f32,
    /// The random numbers that pick the point on the light.
    pub random: Vec2,
}

fields! {
    Toward {
        "from": Point = from,
        "direction": Direction = direction,
    }
}

fields! {
    LightSample {
        "from": Point = from,
        "choice": Random = choice,
        "random": RandomPair = random,
    }
}

impl Input for Toward {
    type View = NoView;
}

impl Input for LightSample {
    type View = NoView;
}

impl Fields for LightList {
    const NAMES: &'static [&'static str] = &["lights"];
}

impl Record for LightList {
    fn names(&self) -> &'static [&'static str] {
        <LightList as Fields>::NAMES
    }

    fn value(&self, _: usize) -> Value<'_> {
        Value::Lights(Cow::Borrowed(&self.lights))
    }

    fn set(&mut self, _: usize, value: Value<'_>) {
        if let Value::Lights(lights) = value {
            self.lights = lights.into_owned();
        }
    }
}

impl Function for AreaLightPdf {
    type Subject = LightList;
    type Input = Toward;
    type Output = Density;

    fn name(_: &LightList) -> &'static str {
        "AreaLight::pdf"
    }

    fn sentence(_: &LightList) -> &'static str {
        "{lights}; from {from} toward {direction}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::AreaLightPdf(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        list: &'a LightList,
    ) -> impl Fn(&Toward) -> Density + 'a {
        let light = submission.light();
        let [ListedLight::Flat(flat)] = list.lights[..] else {
            panic!("the exam's list is a single flat light");
        };
        move |toward| Density {
            pdf: light.area_light_pdf(&flat, toward.from, toward.direction),
        }
    }
}

impl Function for LightsSample {
    type Subject = LightList;
    type Input = LightSample;
    type Output = Option<LocalDirection>;

    fn name(_: &LightList) -> &'static str {
        "Lights::sample"
    }

    fn sentence(_: &LightList) -> &'static str {
        "{lights}; from {from}, choice {choice}, random {random}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::LightsSample(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        list: &'a LightList,
    ) -> impl Fn(&LightSample) -> Option<LocalDirection> + 'a {
        let lights = submission.light().lights(&list.lights);
        move |sample| {
            let direction = lights.direction(sample.from, sample.choice, sample.random)?;
            Some(LocalDirection { direction })
        }
    }
}

impl Function for LightsPdf {
    type Subject = LightList;
    type Input = Toward;
    type Output = Density;

    fn name(_: &LightList) -> &'static str {
        "Lights::pdf"
    }

    fn sentence(_: &LightList) -> &'static str {
        "{lights}; from {from} toward {direction}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::LightsPdf(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        list: &'a LightList,
    ) -> impl Fn(&Toward) -> Density + 'a {
        let lights = submission.light().lights(&list.lights);
        move |toward| Density {
            pdf: lights.density(toward.from, toward.direction),
        }
    }
}
