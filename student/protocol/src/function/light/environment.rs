//! The functions and methods of environment maps.

use std::borrow::Cow;

use glam::{UVec2, Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::{Density, LightQuestion, LocalDirection};
use crate::function::{Function, Input, NoView, Question, Submission, Table};
use crate::packed;
use crate::value::{Fields, Record, Value, fields};

/// Calls `uniform_sphere` with random numbers. It is a free function, so it has no subject.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UniformSphere;

/// Calls `Environment::sample` with random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnvironmentSample;

/// Calls `Environment::pdf` with directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnvironmentPdf;

/// An environment map: a picture of all directions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapImage {
    /// The width and height in pixels.
    pub size: UVec2,
    /// The radiance of each pixel, row by row from the top. In exam files, equal neighbours are
    /// written once.
    #[serde(with = "packed::runs")]
    pub pixels: Vec<Vec3>,
}

/// Two random numbers in `[0, 1)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct RandomPair {
    /// The numbers.
    pub random: Vec2,
}

/// The arguments of `Environment::sample`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapSample {
    /// The random number that picks the pixel.
    pub choice: f32,
    /// The random numbers that pick the position in the pixel.
    pub random: Vec2,
}

fields! {
    RandomPair {
        "random": RandomPair = random,
    }
}

fields! {
    MapSample {
        "choice": Random = choice,
        "random": RandomPair = random,
    }
}

impl Input for RandomPair {
    type View = NoView;
}

impl Input for MapSample {
    type View = NoView;
}

impl Fields for MapImage {
    const NAMES: &'static [&'static str] = &["map"];
}

impl Record for MapImage {
    fn names(&self) -> &'static [&'static str] {
        <MapImage as Fields>::NAMES
    }

    fn value(&self, _: usize) -> Value<'_> {
        Value::Map(Cow::Borrowed(self))
    }

    fn set(&mut self, _: usize, value: Value<'_>) {
        if let Value::Map(map) = value {
            *self = map.into_owned();
        }
    }
}

impl Function for UniformSphere {
    type Subject = ();
    type Input = RandomPair;
    type Output = LocalDirection;

    fn name((): &()) -> &'static str {
        "uniform_sphere"
    }

    fn sentence((): &()) -> &'static str {
        "random {random}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::UniformSphere(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        (): &'a (),
    ) -> impl Fn(&RandomPair) -> LocalDirection + 'a {
        let light = submission.light();
        move |pair| LocalDirection {
            direction: light.uniform_direction(pair.random),
        }
    }
}

impl Function for EnvironmentSample {
    type Subject = MapImage;
    type Input = MapSample;
    type Output = LocalDirection;

    fn name(_: &MapImage) -> &'static str {
        "Environment::sample"
    }

    fn sentence(_: &MapImage) -> &'static str {
        "{map}; choice {choice}, random {random}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::EnvironmentSample(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        map: &'a MapImage,
    ) -> impl Fn(&MapSample) -> LocalDirection + 'a {
        let environment = submission.light().environment(map);
        move |sample| LocalDirection {
            direction: environment.direction(sample.choice, sample.random),
        }
    }
}

impl Function for EnvironmentPdf {
    type Subject = MapImage;
    type Input = LocalDirection;
    type Output = Density;

    fn name(_: &MapImage) -> &'static str {
        "Environment::pdf"
    }

    fn sentence(_: &MapImage) -> &'static str {
        "{map}; direction {direction}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::EnvironmentPdf(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        map: &'a MapImage,
    ) -> impl Fn(&LocalDirection) -> Density + 'a {
        let environment = submission.light().environment(map);
        move |direction| Density {
            pdf: environment.density(direction.direction),
        }
    }
}
