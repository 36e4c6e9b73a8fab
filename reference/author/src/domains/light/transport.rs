//! The domains of direct light and of paths. The classes are those of the surfaces, lights and
//! directions that decide a call's answer, so each question's room is read from its scene's text.

use std::rc::Rc;

use glam::{DVec3, Vec3};
use judging::drawing_data::{PathHit, PathStep};
use protocol::light::transport::{DirectSample, PathStart};
use protocol::{LightQuestion, Question, Ray};

use super::fields::{CONTRASTS, contrast_class};
use crate::domains::fields::{OCTANTS, class_up_to, octant};
use crate::domains::{Aspect, FunctionDomain, not_asked};
use crate::oracle::Ray64;
use crate::oracle::light::light_sources::Environment64;
use crate::oracle::light::path_steps::path_steps;
use crate::oracle::light::quad::{Material64, Quad};
use crate::oracle::light::room::{Room, Surface64};
use crate::oracle::light::transport::{self as oracle, emitted};
use crate::oracle::light::{Numbers64, lambertian, numbers_of_path};

/// The domain of `direct`.
pub static DIRECT: FunctionDomain<DirectCall> = FunctionDomain {
    function: "direct",
    subject_aspects: &[
        Aspect::ROOM_SIZE,
        Aspect::ROOM_POSITION,
        Aspect::LIGHTS,
        Aspect::BRIGHTNESS,
        Aspect::ENVIRONMENT,
    ],
    aspects: &[
        Aspect::RAY_OCTANT,
        SURFACE,
        SIDE,
        LIGHT_SAMPLE,
        BLOCKER,
        SAMPLE_HEIGHT,
        ALBEDO_CONTRAST,
        SAMPLE_VALUE,
        SAMPLE_PDF,
        SCATTERED,
        SCATTERED_HEIGHT,
        SCATTERED_VALUE,
        LIGHT_PDF,
        LIGHT,
        ON_LIGHT_X,
        ON_LIGHT_Y,
        DIRECT_X,
        DIRECT_Y,
    ],
    pairs: &[
        [LIGHT_SAMPLE.name, SCATTERED.name],
        ["lights", LIGHT_SAMPLE.name],
    ],
    fields: &[
        "origin",
        "direction",
        "light",
        "on_light",
        "direct",
        "scene",
    ],
    calls: direct_calls,
    not_asked: &[not_asked(
        &["lights"],
        &["none"],
        &["pairs"],
        "without lights, there is a light sample only under a map",
    )],
};

/// The domain of `radiance`.
pub static RADIANCE: FunctionDomain<PathCall> = FunctionDomain {
    function: "radiance",
    subject_aspects: &[
        Aspect::ROOM_SIZE,
        Aspect::ROOM_POSITION,
        Aspect::LIGHTS,
        Aspect::BRIGHTNESS,
        Aspect::ENVIRONMENT,
        INDEX,
    ],
    aspects: &[
        Aspect::RAY_OCTANT,
        BOUNCES,
        FIRST,
        FIRST_TWO,
        LENGTH,
        SPECULAR,
        FIRST_SCATTERED,
        LAST_EMISSION,
        LAST_DIRECT,
        LAST_ENVIRONMENT,
        BEFORE_A_LIGHT,
        BEFORE_THE_ENVIRONMENT,
        LEAST_THROUGHPUT,
        LARGEST_THROUGHPUT,
        THROUGHPUT_CONTRAST,
    ],
    pairs: &[["environment", FIRST.name]],
    fields: &["origin", "direction", "seed", "bounces", "scene"],
    calls: path_calls,
    not_asked: &[],
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
    /// Half of the room's longest side.
    pub const ROOM_SIZE: Self = Aspect {
        name: "size of the room",
        classes: &["up to 0.001", "up to 0.1", "up to 10", "up to 1,000"],
        class: |call| {
            let (_, half) = call.room().extent();
            Some(
                [0.001, 0.1, 10.0]
                    .iter()
                    .filter(|limit| half.max_element() > **limit)
                    .count(),
            )
        },
    };

    /// The distance between the room and the origin.
    pub const ROOM_POSITION: Self = Aspect {
        name: "position of the room",
        classes: &["around the origin", "far away"],
        class: |call| {
            let (center, half) = call.room().extent();
            Some(usize::from(center.length() > 50.0 * half.max_element()))
        },
    };

    /// The largest radiance of a light in the room, in any channel.
    pub const BRIGHTNESS: Self = Aspect {
        name: "radiance",
        classes: &["none", "up to 0.05", "up to 500", "beyond"],
        class: |call| {
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
            let limits = [0.0, 0.05, 500.0];
            Some(limits.iter().filter(|limit| brightest > **limit).count())
        },
    };

    /// The number of emitting parallelograms. Each consists of two lights.
    pub const LIGHTS: Self = Aspect {
        name: "lights",
        classes: &["none", "one", "several"],
        class: |call| {
            let is_light = |quad: &&Quad| matches!(quad.material(), Material64::Emitter { .. });
            let lights = call.room().quads().iter().filter(is_light);
            Some(lights.count().min(2))
        },
    };

    /// The environment.
    pub const ENVIRONMENT: Self = Aspect {
        name: "environment",
        classes: &["dark", "uniform", "a map"],
        class: |call| match call.room().sources().environment {
            Environment64::Constant(DVec3::ZERO) => Some(0),
            Environment64::Constant(_) => Some(1),
            Environment64::Map(_) => Some(2),
        },
    };

    /// The octant of the ray's direction.
    pub const RAY_OCTANT: Self = Aspect {
        name: "octant of the ray",
        classes: OCTANTS,
        class: |call| octant(call.ray().dir.as_dvec3()),
    };
}

/// The kinds of surfaces.
const SURFACES: &[&str] = &["matte", "mirror", "glass", "light", "light, from behind"];

fn surface_class(surface: &Surface64) -> usize {
    match surface.material {
        Material64::Lambertian { .. } => 0,
        Material64::Mirror { .. } => 1,
        Material64::Glass { .. } => 2,
        Material64::Emitter { .. } if surface.emitted != DVec3::ZERO => 3,
        Material64::Emitter { .. } => 4,
    }
}

/// The kinds of surfaces, or none.
const HITS: &[&str] = &[
    "nothing",
    "matte",
    "mirror",
    "glass",
    "light",
    "light, from behind",
];

fn hit_class(surface: Option<&Surface64>) -> usize {
    surface.map_or(0, |surface| 1 + surface_class(surface))
}

/// The surface that the ray hits.
const SURFACE: Aspect<DirectCall> = Aspect {
    name: "surface",
    classes: SURFACES,
    class: |call| call.surface.as_ref().map(surface_class),
};

/// The cosine between the ray and the normal of a matte surface. Smaller cosines aren't tested,
/// because rounding moves such a hit along the surface.
const SIDE: Aspect<DirectCall> = Aspect {
    name: "cosine of the ray",
    classes: &[
        "above 0.2",
        "above 0.05",
        "above 0.02",
        "above 0.005",
        "smaller",
    ],
    class: |call| {
        let cosine = matte(call)?.out.z;
        let limits = [0.2, 0.05, 0.02, 0.005];
        Some(limits.iter().filter(|limit| cosine < **limit).count())
    },
};

/// The direction toward a light.
const LIGHT_SAMPLE: Aspect<DirectCall> = Aspect {
    name: "light sample",
    classes: &["none", "below the surface", "blocked", "a light", "a map"],
    class: |call| {
        let surface = matte(call)?;
        let numbers = Numbers64::from(&call.input);
        let sample = call.room.sources().sample(surface.position, &numbers);
        let Some(direction) = sample.value else {
            return Some(0);
        };
        if surface.frame.to_local(direction).z <= 0.0 {
            return Some(1);
        }
        Some(2 + found(call, surface, direction))
    },
};

/// The kind of surface that is in the way of the direction toward a light.
const BLOCKER: Aspect<DirectCall> = Aspect {
    name: "in the way of the light",
    classes: &["matte", "mirror", "glass", "light, from behind"],
    class: |call| {
        let surface = matte(call)?;
        let direction = sampled(call)?;
        let hit = call
            .room
            .hit(&ray(surface, direction), Some(surface))
            .value?;
        // The front of a light isn't in the way.
        [0, 1, 2, 4]
            .iter()
            .position(|class| *class == surface_class(&hit))
    },
};

/// Classes of cosines. Small ones are those of grazing directions.
const HEIGHTS: &[&str] = &["above 0.1", "above 1e-3", "smaller"];

/// Returns the class of a direction in a surface's frame.
fn height_class(direction: DVec3) -> usize {
    let limits = [0.1, 1e-3];
    limits.iter().filter(|limit| direction.z < **limit).count()
}

/// The cosine of the direction toward a light that isn't blocked.
const SAMPLE_HEIGHT: Aspect<DirectCall> = Aspect {
    name: "cosine of the light sample",
    classes: HEIGHTS,
    class: |call| {
        let direction = unblocked(call)?;
        Some(height_class(matte(call)?.frame.to_local(direction)))
    },
};

/// The contrast between the channels of a lit surface's albedo.
const ALBEDO_CONTRAST: Aspect<DirectCall> = Aspect {
    name: "dimmest over brightest channel",
    classes: CONTRASTS,
    class: |call| {
        unblocked(call)?;
        let Material64::Lambertian { albedo } = matte(call)?.material else {
            return None;
        };
        contrast_class(albedo.as_vec3())
    },
};

/// The classes of the largest channel of `evaluate`.
const VALUES: &[&str] = &["above 1e-3", "above 1e-6", "smaller"];

/// Returns the class of `evaluate` for a direction in a surface's frame.
fn value_class(surface: &Surface64, incoming: DVec3) -> Option<usize> {
    let Material64::Lambertian { albedo } = surface.material else {
        return None;
    };
    let value = lambertian::evaluate(albedo, surface.out, incoming).max_element();
    let limits = [1e-3, 1e-6];
    (value > 0.0).then(|| limits.iter().filter(|limit| value < **limit).count())
}

/// The value of `evaluate` for the direction toward a light that isn't blocked.
const SAMPLE_VALUE: Aspect<DirectCall> = Aspect {
    name: "evaluate of the light sample",
    classes: VALUES,
    class: |call| {
        let (surface, direction) = (matte(call)?, unblocked(call)?);
        value_class(surface, surface.frame.to_local(direction))
    },
};

/// The value of `evaluate` for the scattered direction, if it finds light.
const SCATTERED_VALUE: Aspect<DirectCall> = Aspect {
    name: "evaluate of the scattered direction",
    classes: VALUES,
    class: |call| {
        let (surface, direction) = (matte(call)?, scattered(call));
        let is_lit = found(call, surface, surface.frame.to_world(direction)) > 0;
        value_class(surface, direction).filter(|_| is_lit)
    },
};

/// The light pdf of the direction toward a light that isn't blocked.
const SAMPLE_PDF: Aspect<DirectCall> = Aspect {
    name: "light pdf of the light sample",
    classes: &[
        "up to 1",
        "up to 100",
        "up to 10,000",
        "up to 100,000",
        "beyond",
    ],
    class: |call| {
        let (position, direction) = (matte(call)?.position, unblocked(call)?);
        let pdf = call.room.sources().pdf(position, direction).value;
        let limits = [1.0, 1e2, 1e4, 1e5];
        Some(limits.iter().filter(|limit| pdf > **limit).count())
    },
};

/// The light that the scattered direction finds.
const SCATTERED: Aspect<DirectCall> = Aspect {
    name: "scattered direction",
    classes: &["no light", "a light", "the environment"],
    class: |call| {
        let surface = matte(call)?;
        let direction = surface.frame.to_world(scattered(call));
        Some(found(call, surface, direction))
    },
};

/// The cosine of the scattered direction.
const SCATTERED_HEIGHT: Aspect<DirectCall> = Aspect {
    name: "scattered cosine",
    classes: HEIGHTS,
    class: |call| matte(call).map(|_| height_class(scattered(call))),
};

/// The light pdf of the scattered direction.
const LIGHT_PDF: Aspect<DirectCall> = Aspect {
    name: "light pdf of the scattered direction",
    classes: &["0", "up to 1", "up to 100", "beyond"],
    class: |call| {
        let surface = matte(call)?;
        let direction = surface.frame.to_world(scattered(call));
        let pdf = call.room.sources().pdf(surface.position, direction).value;
        let limits = [0.0, 1.0, 100.0];
        Some(limits.iter().filter(|limit| pdf > **limit).count())
    },
};

/// Returns the scattered direction, in the surface's frame.
fn scattered(call: &DirectCall) -> DVec3 {
    lambertian::sample_cosine_hemisphere(call.input.direct.as_dvec2())
}

/// Returns the direction toward a light, if there is one above the surface.
fn sampled(call: &DirectCall) -> Option<DVec3> {
    let surface = matte(call)?;
    let numbers = Numbers64::from(&call.input);
    let sample = call.room.sources().sample(surface.position, &numbers);
    let is_above = |direction: &DVec3| surface.frame.to_local(*direction).z > 0.0;
    sample.value.filter(is_above)
}

/// Returns the direction toward a light, if light arrives from there.
fn unblocked(call: &DirectCall) -> Option<DVec3> {
    let surface = matte(call)?;
    sampled(call).filter(|direction| found(call, surface, *direction) > 0)
}

/// Returns the ray from a surface in a direction.
fn ray(surface: &Surface64, dir: DVec3) -> Ray64 {
    Ray64 {
        origin: surface.position,
        dir,
        min: 0.0,
        max: f64::INFINITY,
    }
}

/// Returns 0 if no light arrives at a surface from a direction, 1 if it is the light of a shape,
/// and 2 if it is that of the environment.
fn found(call: &DirectCall, surface: &Surface64, direction: DVec3) -> usize {
    let is_dark = emitted(&call.room, surface, direction).value == DVec3::ZERO;
    let hit = call.room.hit(&ray(surface, direction), Some(surface)).value;
    match hit {
        _ if is_dark => 0,
        Some(_) => 1,
        None => 2,
    }
}

/// Returns the surface that the ray hits if it is matte.
fn matte(call: &DirectCall) -> Option<&Surface64> {
    let surface = call.surface.as_ref();
    surface.filter(|surface| matches!(surface.material, Material64::Lambertian { .. }))
}

/// The classes of random numbers that are only passed on to other functions, whose own domains
/// contain the ends.
const QUARTERS: &[&str] = &["below 0.25", "0.25", "0.5", "0.75"];

fn quarter(number: f32) -> Option<usize> {
    Some((4.0 * number) as usize)
}

/// The random number that picks the light.
const LIGHT: Aspect<DirectCall> = Aspect {
    name: "light",
    classes: QUARTERS,
    class: |call| quarter(call.input.light),
};

/// The first random number for the point on the light.
const ON_LIGHT_X: Aspect<DirectCall> = Aspect {
    name: "on_light.x",
    classes: QUARTERS,
    class: |call| quarter(call.input.on_light.x),
};

/// The second random number for the point on the light.
const ON_LIGHT_Y: Aspect<DirectCall> = Aspect {
    name: "on_light.y",
    classes: QUARTERS,
    class: |call| quarter(call.input.on_light.y),
};

/// The first random number for the scattered direction.
const DIRECT_X: Aspect<DirectCall> = Aspect {
    name: "direct.x",
    classes: QUARTERS,
    class: |call| quarter(call.input.direct.x),
};

/// The second random number for the scattered direction.
const DIRECT_Y: Aspect<DirectCall> = Aspect {
    name: "direct.y",
    classes: QUARTERS,
    class: |call| quarter(call.input.direct.y),
};

/// The maximum number of bounces.
const BOUNCES: Aspect<PathCall> = Aspect {
    name: "bounces",
    classes: &["0", "1", "2", "3", "4 to 7", "8 to 32", "33 to 64", "more"],
    class: |call| {
        Some(class_up_to(
            &[0, 1, 2, 3, 7, 32, 64],
            call.input.bounces as usize,
        ))
    },
};

/// The surface that the ray hits.
const FIRST: Aspect<PathCall> = Aspect {
    name: "first surface",
    classes: HITS,
    class: |call| Some(hit_class(call.surfaces.first())),
};

/// The first two surfaces of a path that is scattered at the first one.
const FIRST_TWO: Aspect<PathCall> = Aspect {
    name: "first two surfaces",
    classes: &[
        "matte, then nothing",
        "matte, then matte",
        "matte, then a mirror",
        "matte, then glass",
        "matte, then a light",
        "matte, then a light, from behind",
        "a mirror, then nothing",
        "a mirror, then matte",
        "a mirror, then a mirror",
        "a mirror, then glass",
        "a mirror, then a light",
        "a mirror, then a light, from behind",
        "glass, then nothing",
        "glass, then matte",
        "glass, then a mirror",
        "glass, then glass",
        "glass, then a light",
        "glass, then a light, from behind",
    ],
    class: |call| {
        let first = call.surfaces.first()?;
        let is_scattered =
            call.input.bounces > 0 && !matches!(first.material, Material64::Emitter { .. });
        is_scattered.then(|| HITS.len() * surface_class(first) + hit_class(call.surfaces.get(1)))
    },
};

/// The number of surfaces that the path hits, as if it always survived.
const LENGTH: Aspect<PathCall> = Aspect {
    name: "surfaces",
    classes: &["0", "1", "2", "3", "4 to 8", "more"],
    class: |call| Some(class_up_to(&[0, 1, 2, 3, 8], call.surfaces.len())),
};

/// The number of mirrors or surfaces of glass that a path hits in a row.
const SPECULAR: Aspect<PathCall> = Aspect {
    name: "specular surfaces in a row",
    classes: &["0", "1", "2 to 8", "more"],
    class: |call| {
        let is_specular = |surface: &Surface64| matches!(surface_class(surface), 1 | 2);
        let runs = call.surfaces.split(|surface| !is_specular(surface));
        let longest = runs.map(<[Surface64]>::len).max();
        Some(class_up_to(&[0, 1, 8], longest.unwrap_or(0)))
    },
};

/// The cosine of the direction that a matte first surface scatters to.
const FIRST_SCATTERED: Aspect<PathCall> = Aspect {
    name: "first scattered cosine",
    classes: &["above 0.1", "above 3e-3", "smaller"],
    class: |call| {
        let first = call.surfaces.first()?;
        let numbers = numbers_of_path(&call.input);
        let random = numbers.first().filter(|_| surface_class(first) == 0)?;
        let cosine = lambertian::sample_cosine_hemisphere(random.scatter).z;
        Some([0.1, 3e-3].iter().filter(|limit| cosine < **limit).count())
    },
};

/// The classes of bounces where light is counted.
const DEPTHS: &[&str] = &["0", "1 to 8", "9 to 32", "33 to 64", "more"];

/// Returns the class of the last bounce where a path adds light from a kind of surface.
fn last_depth(call: &PathCall, hit: PathHit) -> Option<usize> {
    let is_lit = |step: &PathStep| step.hit == hit && step.light != Vec3::ZERO;
    Some(class_up_to(
        &[0, 8, 32, 64],
        call.steps.iter().rposition(is_lit)?,
    ))
}

/// The last bounce where emitted light is counted.
const LAST_EMISSION: Aspect<PathCall> = Aspect {
    name: "last emission counted at bounce",
    classes: DEPTHS,
    class: |call| last_depth(call, PathHit::Light),
};

/// The last bounce where direct light is counted.
const LAST_DIRECT: Aspect<PathCall> = Aspect {
    name: "last direct light counted at bounce",
    classes: DEPTHS,
    class: |call| last_depth(call, PathHit::Matte),
};

/// The last bounce where the environment is counted.
const LAST_ENVIRONMENT: Aspect<PathCall> = Aspect {
    name: "environment counted at bounce",
    classes: DEPTHS,
    class: |call| last_depth(call, PathHit::Nothing),
};

/// The kinds of the last two surfaces before a path finds light that counts.
const LAST_TWO: &[&str] = &[
    "matte, mirror",
    "matte, glass",
    "mirror, mirror",
    "mirror, glass",
    "glass, mirror",
    "glass, glass",
];

/// Returns the index in `LAST_TWO` of the surfaces before a path finds the light of `hit`.
pub fn last_two(steps: &[PathStep], hit: PathHit) -> Option<usize> {
    let [.., first, second, last] = steps else {
        return None;
    };
    let is_lit = last.hit == hit && last.light != Vec3::ZERO;
    let first = match first.hit {
        PathHit::Matte => 0,
        PathHit::Mirror => 2,
        PathHit::Glass => 4,
        PathHit::Nothing | PathHit::Light => return None,
    };
    let second = match second.hit {
        PathHit::Mirror => 0,
        PathHit::Glass => 1,
        PathHit::Nothing | PathHit::Matte | PathHit::Light => return None,
    };
    is_lit.then_some(first + second)
}

/// The last two surfaces before a light.
const BEFORE_A_LIGHT: Aspect<PathCall> = Aspect {
    name: "before a light",
    classes: LAST_TWO,
    class: |call| last_two(&call.steps, PathHit::Light),
};

/// The last two surfaces before the environment.
const BEFORE_THE_ENVIRONMENT: Aspect<PathCall> = Aspect {
    name: "before the environment",
    classes: LAST_TWO,
    class: |call| last_two(&call.steps, PathHit::Nothing),
};

/// Returns the largest channel of each throughput that light is multiplied by.
fn throughputs(call: &PathCall) -> impl Iterator<Item = f32> {
    let lit = call.steps.iter().filter(|step| step.light != Vec3::ZERO);
    lit.map(|step| step.throughput.max_element())
}

/// The smallest throughput that light is multiplied by.
const LEAST_THROUGHPUT: Aspect<PathCall> = Aspect {
    name: "smallest throughput",
    classes: &["above 1e-3", "above 1e-6", "above 1e-9", "smaller"],
    class: |call| {
        let least = throughputs(call).reduce(f32::min)?;
        let limits = [1e-3, 1e-6, 1e-9];
        Some(limits.iter().filter(|limit| least < **limit).count())
    },
};

/// The largest throughput that light is multiplied by.
const LARGEST_THROUGHPUT: Aspect<PathCall> = Aspect {
    name: "largest throughput",
    classes: &["up to 1", "up to 5", "up to 25", "beyond"],
    class: |call| {
        let largest = throughputs(call).reduce(f32::max)?;
        let limits = [1.0, 5.0, 25.0];
        Some(limits.iter().filter(|limit| largest > **limit).count())
    },
};

/// The contrast between the channels of the throughput, where the path adds light for the first
/// time.
const THROUGHPUT_CONTRAST: Aspect<PathCall> = Aspect {
    name: "dimmest over brightest channel",
    classes: CONTRASTS,
    class: |call| {
        let mut steps = call.steps.iter();
        let first = steps.find(|step| step.light != Vec3::ZERO)?;
        contrast_class(first.throughput)
    },
};

/// The largest index of refraction in the room.
const INDEX: Aspect<PathCall> = Aspect {
    name: "index of refraction",
    classes: &["none", "up to 2", "up to 5", "beyond"],
    class: |call| {
        let indices = call.room.quads().iter().map(|quad| match quad.material() {
            Material64::Glass { ior } => *ior,
            Material64::Lambertian { .. }
            | Material64::Mirror { .. }
            | Material64::Emitter { .. } => 0.0,
        });
        let largest = indices.fold(0.0, f64::max);
        let limits = [0.0, 2.0, 5.0];
        Some(limits.iter().filter(|limit| largest > **limit).count())
    },
};
