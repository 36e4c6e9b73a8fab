//! The domains of direct light and of paths. A question shows the scene as a text, so the classes
//! are those of the ray and of the numbers.

use protocol::Ray;
use protocol::function::Function;
use protocol::light::transport::{Direct, DirectSample, PathStart, Radiance};

use super::{Row, rows_of};
use crate::domains::fields::{OCTANTS, class_up_to, octant};
use crate::domains::{Aspect, FunctionDomain};

/// The domain of `direct`.
pub static DIRECT: FunctionDomain<Row<Direct>> = FunctionDomain {
    function: "direct",
    subject_aspects: &[],
    aspects: &[
        Aspect::RAY_OCTANT,
        LIGHT,
        ON_LIGHT_X,
        ON_LIGHT_Y,
        DIRECT_X,
        DIRECT_Y,
    ],
    pairs: &[],
    calls: rows_of!(Direct),
    not_asked: &[],
};

/// The domain of `radiance`.
pub static RADIANCE: FunctionDomain<Row<Radiance>> = FunctionDomain {
    function: "radiance",
    subject_aspects: &[],
    aspects: &[Aspect::RAY_OCTANT, BOUNCES],
    pairs: &[],
    calls: rows_of!(Radiance),
    not_asked: &[],
};

/// Arguments with a ray.
pub trait WithRay {
    /// Returns the ray.
    fn ray(&self) -> &Ray;
}

impl WithRay for DirectSample {
    fn ray(&self) -> &Ray {
        &self.ray
    }
}

impl WithRay for PathStart {
    fn ray(&self) -> &Ray {
        &self.ray
    }
}

impl<F: Function<Input: WithRay>> Aspect<Row<F>> {
    /// The octant of the ray's direction.
    pub const RAY_OCTANT: Self = Aspect {
        name: "octant of the ray",
        classes: OCTANTS,
        class: |row| octant(row.input.ray().dir.as_dvec3()),
    };
}

/// The classes of random numbers that are only passed on to other functions, whose own domains
/// contain the ends.
const QUARTERS: &[&str] = &["below 0.25", "0.25", "0.5", "0.75"];

fn quarter(number: f32) -> Option<usize> {
    Some((4.0 * number) as usize)
}

/// The random number that picks the light.
const LIGHT: Aspect<Row<Direct>> = Aspect {
    name: "light",
    classes: QUARTERS,
    class: |row| quarter(row.input.light),
};

/// The first random number for the point on the light.
const ON_LIGHT_X: Aspect<Row<Direct>> = Aspect {
    name: "on_light.x",
    classes: QUARTERS,
    class: |row| quarter(row.input.on_light.x),
};

/// The second random number for the point on the light.
const ON_LIGHT_Y: Aspect<Row<Direct>> = Aspect {
    name: "on_light.y",
    classes: QUARTERS,
    class: |row| quarter(row.input.on_light.y),
};

/// The first random number for the scattered direction.
const DIRECT_X: Aspect<Row<Direct>> = Aspect {
    name: "direct.x",
    classes: QUARTERS,
    class: |row| quarter(row.input.direct.x),
};

/// The second random number for the scattered direction.
const DIRECT_Y: Aspect<Row<Direct>> = Aspect {
    name: "direct.y",
    classes: QUARTERS,
    class: |row| quarter(row.input.direct.y),
};

/// The maximum number of bounces.
const BOUNCES: Aspect<Row<Radiance>> = Aspect {
    name: "bounces",
    classes: &["0", "1", "2", "3", "4 to 7", "more"],
    class: |row| Some(class_up_to(&[0, 1, 2, 3, 7], row.input.bounces as usize)),
};
