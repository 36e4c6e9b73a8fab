//! The domains of direct light and of paths. The classes are those of the surfaces, lights and
//! directions that decide a call's answer, so each question's room is read from its scene's text.

mod direct;
mod path;

use std::rc::Rc;

use glam::DVec3;
use judging::drawing_data::PathStep;
use protocol::light::transport::{DirectSample, PathStart};
use protocol::{LightQuestion, Question, Ray};

use self::direct::DIRECT_ASPECTS;
use self::path::{INDEX, PATH_ASPECTS};
use crate::domains::fields::{OCTANTS, class_up_to, octant};
use crate::domains::{Aspect, FunctionDomain, not_asked};
use crate::oracle::Ray64;
use crate::oracle::light::light_sources::Environment64;
use crate::oracle::light::numbers_of_path;
use crate::oracle::light::path_steps::path_steps;
use crate::oracle::light::quad::{Material64, Quad};
use crate::oracle::light::room::{Room, Surface64};
use crate::oracle::light::transport as oracle;

pub use path::last_two;

/// The domain of `direct`.
pub static DIRECT: FunctionDomain<DirectCall> = FunctionDomain {
    aspects: &[Aspect::ROOM, &[Aspect::RAY_OCTANT], DIRECT_ASPECTS],
    pairs: &[
        ["light sample", "scattered direction"],
        ["lights", "light sample"],
    ],
    fields: &[
        "origin",
        "direction",
        "light",
        "on_light",
        "direct",
        "scene",
    ],
    not_asked: &[not_asked(&["lights"])
        .classes(&["none"])
        .columns(&["pairs"])
        .because("without lights, there is a light sample only under a map")],
    ..FunctionDomain::new("direct", direct_calls)
};

/// The domain of `radiance`.
pub static RADIANCE: FunctionDomain<PathCall> = FunctionDomain {
    aspects: &[Aspect::ROOM, &[INDEX, Aspect::RAY_OCTANT], PATH_ASPECTS],
    pairs: &[["environment", "first surface"]],
    fields: &["origin", "direction", "seed", "bounces", "scene"],
    ..FunctionDomain::new("radiance", path_calls)
};

/// A call of `direct`.
#[derive(Clone, Debug)]
pub struct DirectCall {
    room: Rc<Room>,
    input: DirectSample,
    /// The surface that the ray hits. `None` if it hits nothing, which isn't tested.
    surface: Option<Surface64>,
}

/// A call of `radiance`.
#[derive(Clone, Debug)]
pub struct PathCall {
    room: Rc<Room>,
    input: PathStart,
    /// The surfaces that the path hits, as if it always survived.
    surfaces: Vec<Surface64>,
    /// The steps of the path, with the light that each adds.
    steps: Vec<PathStep>,
}

fn direct_calls(question: &Question) -> Vec<DirectCall> {
    let Question::Light(LightQuestion::Direct(table)) = question else {
        return Vec::new();
    };
    let room = Rc::new(Room::in_question(&table.subject));
    let rows = table.rows.to_vec();
    let calls = rows.iter().map(|input| DirectCall {
        surface: room.hit(&Ray64::from(&input.ray), None).value,
        room: room.clone(),
        input: *input,
    });
    calls.collect()
}

fn path_calls(question: &Question) -> Vec<PathCall> {
    let Question::Light(LightQuestion::Radiance(table)) = question else {
        return Vec::new();
    };
    let room = Rc::new(Room::in_question(&table.subject));
    let rows = table.rows.to_vec();
    let calls = rows.iter().map(|input| {
        let (ray, numbers) = (Ray64::from(&input.ray), numbers_of_path(input));
        PathCall {
            surfaces: oracle::surfaces(&room, &ray, &numbers),
            steps: path_steps(&room, &ray, &numbers),
            room: room.clone(),
            input: *input,
        }
    });
    calls.collect()
}

/// A call with a ray in a room.
pub trait InRoom {
    /// Returns the room.
    fn room(&self) -> &Room;

    /// Returns the ray.
    fn ray(&self) -> &Ray;
}

impl InRoom for DirectCall {
    fn room(&self) -> &Room {
        &self.room
    }

    fn ray(&self) -> &Ray {
        &self.input.ray
    }
}

impl InRoom for PathCall {
    fn room(&self) -> &Room {
        &self.room
    }

    fn ray(&self) -> &Ray {
        &self.input.ray
    }
}

impl<C: InRoom> Aspect<C> {
    /// The aspects of the room.
    const ROOM: &'static [Self] = &[
        // Half of the room's longest side.
        Aspect::new(
            "size of the room",
            &["up to 0.001", "up to 0.1", "up to 10", "up to 1,000"],
            |call| {
                let (_, half) = call.room().extent();
                Some(class_up_to(&[0.001, 0.1, 10.0], half.max_element()))
            },
        ),
        // The distance between the room and the origin.
        Aspect::new(
            "position of the room",
            &["around the origin", "far away"],
            |call| {
                let (center, half) = call.room().extent();
                Some(usize::from(center.length() > 50.0 * half.max_element()))
            },
        ),
        // The number of emitting parallelograms. Each consists of two lights.
        Aspect::new("lights", &["none", "one", "several"], |call| {
            let is_light = |quad: &&Quad| matches!(quad.material(), Material64::Emitter { .. });
            let lights = call.room().quads().iter().filter(is_light);
            Some(lights.count().min(2))
        }),
        // The largest radiance of a light in the room, in any channel.
        Aspect::new(
            "radiance",
            &["none", "up to 0.05", "up to 500", "beyond"],
            |call| {
                let lights = call
                    .room()
                    .quads()
                    .iter()
                    .map(|quad| match quad.material() {
                        Material64::Emitter { radiance } => radiance.max_element(),
                        Material64::Lambertian { .. }
                        | Material64::Mirror { .. }
                        | Material64::Glass { .. } => 0.0,
                    });
                let brightest = lights.fold(0.0, f64::max);
                Some(class_up_to(&[0.0, 0.05, 500.0], brightest))
            },
        ),
        Aspect::new(
            "environment",
            &["dark", "uniform", "a map"],
            |call| match call.room().sources().environment {
                Environment64::Constant(DVec3::ZERO) => Some(0),
                Environment64::Constant(_) => Some(1),
                Environment64::Map(_) => Some(2),
            },
        ),
    ];

    /// The octant of the ray's direction.
    const RAY_OCTANT: Self = Aspect::new("octant of the ray", OCTANTS, |call| {
        octant(call.ray().dir.as_dvec3())
    });
}

/// The kinds of surfaces.
const SURFACES: &[&str] = &["matte", "mirror", "glass", "light", "light, from behind"];

/// Returns the class of a surface in [`SURFACES`].
fn surface_class(surface: &Surface64) -> usize {
    match surface.material {
        Material64::Lambertian { .. } => 0,
        Material64::Mirror { .. } => 1,
        Material64::Glass { .. } => 2,
        Material64::Emitter { .. } if surface.emitted != DVec3::ZERO => 3,
        Material64::Emitter { .. } => 4,
    }
}
