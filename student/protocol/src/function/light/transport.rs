//! The functions that estimate the light on a surface and along a ray.

use std::borrow::Cow;

use glam::Vec2;
use serde::{Deserialize, Serialize};

use super::{Color, LightQuestion};
use crate::function::{Function, Input, NoView, Question, Submission, Table};
use crate::ray::Ray;
use crate::value::{Fields, Record, Value, fields};

/// Calls `direct` for the surfaces that rays hit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Direct;

/// Calls `radiance` for rays.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Radiance;

/// A scene of rectangles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Room {
    /// The text of a scene file that needs no other file.
    pub scene: String,
}

/// A surface, given by the ray that hits it first, and random numbers for its direct light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DirectSample {
    /// The ray.
    pub ray: Ray,
    /// The random number that picks the light.
    pub light: f32,
    /// The random numbers that pick the point on the light.
    pub on_light: Vec2,
    /// The random numbers for the direction that the material samples.
    pub direct: Vec2,
}

/// The arguments of `radiance`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathStart {
    /// The ray from the camera.
    pub ray: Ray,
    /// The seed of the path's random numbers.
    pub seed: u32,
    /// The maximum number of times that the path is scattered.
    pub bounces: u32,
}

impl Fields for Room {
    const NAMES: &'static [&'static str] = &["scene"];
}

impl Record for Room {
    fn names(&self) -> &'static [&'static str] {
        <Room as Fields>::NAMES
    }

    fn value(&self, _: usize) -> Value<'_> {
        Value::Scene(Cow::Borrowed(&self.scene))
    }

    fn set(&mut self, _: usize, value: Value<'_>) {
        if let Value::Scene(scene) = value {
            self.scene = scene.into_owned();
        }
    }
}

fields! {
    DirectSample {
        "origin": Point = ray.origin,
        "direction": Direction = ray.dir,
        "range": Range = ray.range,
        "light": Random = light,
        "on_light": RandomPair = on_light,
        "direct": RandomPair = direct,
    }
}

fields! {
    PathStart {
        "origin": Point = ray.origin,
        "direction": Direction = ray.dir,
        "range": Range = ray.range,
        "seed": Index = seed,
        "bounces": Count = bounces,
    }
}

impl Input for DirectSample {
    type View = NoView;
}

impl Input for PathStart {
    type View = NoView;
}

impl Function for Direct {
    type Subject = Room;
    type Input = DirectSample;
    type Output = Color;

    fn name(_: &Room) -> &'static str {
        "direct"
    }

    fn sentence(_: &Room) -> &'static str {
        "{scene}; the surface that {ray} hits; random numbers: light {light}, on_light {on_light}, \
         direct {direct}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::Direct(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        room: &'a Room,
    ) -> impl Fn(&DirectSample) -> Color + 'a {
        let room = submission.light().room(&room.scene);
        move |sample| Color {
            value: room.direct_light(sample),
        }
    }
}

impl Function for Radiance {
    type Subject = Room;
    type Input = PathStart;
    type Output = Color;

    fn name(_: &Room) -> &'static str {
        "radiance"
    }

    fn sentence(_: &Room) -> &'static str {
        "{scene}; {ray}; seed {seed}; bounces {bounces}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::Radiance(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        room: &'a Room,
    ) -> impl Fn(&PathStart) -> Color + 'a {
        let room = submission.light().room(&room.scene);
        move |start| Color {
            value: room.path_light(start),
        }
    }
}
