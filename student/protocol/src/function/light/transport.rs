//! The functions that estimate the light on a surface and along a ray.

use std::borrow::Cow;

use glam::Vec2;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Serialize, Serializer};

use super::environment::MapImage;
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
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Room {
    /// The text of a scene file that needs no other file.
    pub scene: String,
    /// The environment map that replaces the scene's environment, if there is one. The text can't
    /// contain a map.
    #[serde(default)]
    pub map: Option<MapImage>,
}

/// Leaves out a map that isn't there in text formats. Binary formats need every field.
impl Serialize for Room {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        let has_map_field = !out.is_human_readable() || self.map.is_some();
        let mut fields = out.serialize_struct("Room", 1 + usize::from(has_map_field))?;
        fields.serialize_field("scene", &self.scene)?;
        if has_map_field {
            fields.serialize_field("map", &self.map)?;
        }
        fields.end()
    }
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
        Value::Scene(Cow::Borrowed(self))
    }

    fn set(&mut self, _: usize, value: Value<'_>) {
        if let Value::Scene(room) = value {
            *self = room.into_owned();
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
        "{scene}; the surface hit by the {ray}; random numbers: light {light}, on_light \
         {on_light}, direct {direct}"
    }

    fn question(table: Table<Self>) -> Question {
        LightQuestion::Direct(table).into()
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        room: &'a Room,
    ) -> impl Fn(&DirectSample) -> Color + 'a {
        let room = submission.light().room(room);
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
        let room = submission.light().room(room);
        move |start| Color {
            value: room.path_light(start),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, uvec2};

    use super::*;

    #[test]
    fn rooms_with_and_without_a_map_round_trip() {
        let without = Room {
            scene: "{}".to_owned(),
            map: None,
        };
        let with = Room {
            map: Some(MapImage {
                size: uvec2(2, 1),
                pixels: vec![Vec3::X, Vec3::Y],
            }),
            ..without.clone()
        };
        let text = serde_json::to_string(&without).unwrap();
        assert_eq!(text, r#"{"scene":"{}"}"#);
        for room in [without, with] {
            let text = serde_json::to_string(&room).unwrap();
            assert_eq!(serde_json::from_str::<Room>(&text).unwrap(), room);
            let bytes = postcard::to_stdvec(&room).unwrap();
            assert_eq!(postcard::from_bytes::<Room>(&bytes).unwrap(), room);
        }
    }
}
