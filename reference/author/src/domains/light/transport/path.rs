//! The aspects of paths.

use glam::Vec3;
use judging::drawing_data::{PathHit, PathStep};

use super::{PathCall, surface_class};
use crate::domains::Aspect;
use crate::domains::fields::{class_from, class_up_to};
use crate::domains::light::fields::{CONTRASTS, contrast_class};
use crate::oracle::light::quad::Material64;
use crate::oracle::light::room::Surface64;
use crate::oracle::light::{lambertian, numbers_of_path};

/// The largest index of refraction in the room.
pub(super) const INDEX: Aspect<PathCall> = Aspect::new(
    "index of refraction",
    &["none", "up to 2", "up to 5", "beyond"],
    |call| {
        let indices = call.room.quads().iter().map(|quad| match quad.material() {
            Material64::Glass { ior } => *ior,
            Material64::Lambertian { .. }
            | Material64::Mirror { .. }
            | Material64::Emitter { .. } => 0.0,
        });
        let largest = indices.fold(0.0, f64::max);
        Some(class_up_to(&[0.0, 2.0, 5.0], largest))
    },
);

/// The aspects of paths.
pub(super) const PATH_ASPECTS: &[Aspect<PathCall>] = &[
    // The maximum number of bounces.
    Aspect::new(
        "bounces",
        &["0", "1", "2", "3", "4 to 7", "8 to 32", "33 to 64", "more"],
        |call| {
            Some(class_up_to(
                &[0, 1, 2, 3, 7, 32, 64],
                call.input.bounces as usize,
            ))
        },
    ),
    // The surface that the ray hits.
    Aspect::new("first surface", HITS, |call| {
        Some(hit_class(call.surfaces.first()))
    }),
    // The first two surfaces of a path that is scattered at the first one.
    Aspect::new(
        "first two surfaces",
        &[
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
        |call| {
            let first = call.surfaces.first()?;
            let is_scattered =
                call.input.bounces > 0 && !matches!(first.material, Material64::Emitter { .. });
            is_scattered
                .then(|| HITS.len() * surface_class(first) + hit_class(call.surfaces.get(1)))
        },
    ),
    // The number of surfaces that the path hits, as if it always survived.
    Aspect::new(
        "surfaces",
        &["0", "1", "2", "3", "4 to 8", "more"],
        |call| Some(class_up_to(&[0, 1, 2, 3, 8], call.surfaces.len())),
    ),
    // The number of mirrors or surfaces of glass that a path hits in a row.
    Aspect::new(
        "specular surfaces in a row",
        &["0", "1", "2 to 8", "more"],
        |call| {
            let is_specular = |surface: &Surface64| matches!(surface_class(surface), 1 | 2);
            let runs = call.surfaces.split(|surface| !is_specular(surface));
            let longest = runs.map(<[Surface64]>::len).max();
            Some(class_up_to(&[0, 1, 8], longest.unwrap_or(0)))
        },
    ),
    // The cosine of the direction that a matte first surface scatters to.
    Aspect::new(
        "first scattered cosine",
        &["above 0.1", "above 3e-3", "smaller"],
        |call| {
            let first = call.surfaces.first()?;
            let numbers = numbers_of_path(&call.input);
            let random = numbers.first().filter(|_| surface_class(first) == 0)?;
            let cosine = lambertian::sample_cosine_hemisphere(random.scatter).z;
            Some(class_from(&[0.1, 3e-3], cosine))
        },
    ),
    // The last bounce where emitted light is counted.
    Aspect::new("last emission counted at bounce", DEPTHS, |call| {
        last_depth(call, PathHit::Light)
    }),
    // The last bounce where direct light is counted.
    Aspect::new("last direct light counted at bounce", DEPTHS, |call| {
        last_depth(call, PathHit::Matte)
    }),
    // The last bounce where the environment is counted.
    Aspect::new("environment counted at bounce", DEPTHS, |call| {
        last_depth(call, PathHit::Nothing)
    }),
    // The last two surfaces before a light.
    Aspect::new("before a light", LAST_TWO, |call| {
        last_two(&call.steps, PathHit::Light)
    }),
    // The last two surfaces before the environment.
    Aspect::new("before the environment", LAST_TWO, |call| {
        last_two(&call.steps, PathHit::Nothing)
    }),
    // The smallest throughput that light is multiplied by.
    Aspect::new(
        "smallest throughput",
        &["above 1e-3", "above 1e-6", "above 1e-9", "smaller"],
        |call| {
            let least = throughputs(call).reduce(f32::min)?;
            Some(class_from(&[1e-3, 1e-6, 1e-9], least))
        },
    ),
    // The largest throughput that light is multiplied by.
    Aspect::new(
        "largest throughput",
        &["up to 1", "up to 5", "up to 25", "beyond"],
        |call| {
            let largest = throughputs(call).reduce(f32::max)?;
            Some(class_up_to(&[1.0, 5.0, 25.0], largest))
        },
    ),
    // The contrast between the channels of the throughput, where the path adds light for the first
    // time.
    Aspect::new("dimmest over brightest channel", CONTRASTS, |call| {
        let mut steps = call.steps.iter();
        let first = steps.find(|step| step.light != Vec3::ZERO)?;
        contrast_class(first.throughput)
    }),
];

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

/// Returns the largest channel of each throughput that light is multiplied by.
fn throughputs(call: &PathCall) -> impl Iterator<Item = f32> {
    let lit = call.steps.iter().filter(|step| step.light != Vec3::ZERO);
    lit.map(|step| step.throughput.max_element())
}
