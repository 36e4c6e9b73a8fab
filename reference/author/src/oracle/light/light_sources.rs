//! Everything in a scene that emits light, and sampling directions toward it.

use glam::DVec3;

use super::environment::Map64;
use super::lights::Lights64;
use super::{Numbers64, WithMargin};

/// The light that arrives from far away.
#[derive(Clone, Debug)]
pub enum Environment64 {
    /// The same radiance from all directions. It is never sampled.
    Constant(DVec3),
    /// A picture of all directions.
    Map(Map64),
}

/// The lights and the environment of a scene.
#[derive(Clone, Debug)]
pub struct LightSources64 {
    /// The lights.
    pub lights: Lights64,
    /// The environment.
    pub environment: Environment64,
}

impl Environment64 {
    /// Returns the radiance from a direction.
    pub fn radiance(&self, direction: DVec3) -> WithMargin<DVec3> {
        match self {
            Environment64::Constant(radiance) => WithMargin {
                value: *radiance,
                margin: f64::INFINITY,
            },
            Environment64::Map(map) => map.radiance(direction),
        }
    }
}

impl LightSources64 {
    /// Samples a direction from a point. If there are lights and a map, the lower half of the
    /// choices goes to the lights and the upper half to the map.
    pub fn sample(&self, from: DVec3, numbers: &Numbers64) -> WithMargin<Option<DVec3>> {
        let Numbers64 {
            light: choice,
            on_light,
            ..
        } = *numbers;
        let map = match &self.environment {
            Environment64::Constant(_) => return self.lights.sample(from, choice, on_light),
            Environment64::Map(map) => map,
        };
        if self.lights.is_empty() {
            return map.sample(choice, on_light);
        }
        let sample = if choice < 0.5 {
            self.lights.sample(from, choice / 0.5, on_light)
        } else {
            map.sample((choice - 0.5) / 0.5, on_light)
        };
        sample.and(sample.value, (choice - 0.5).abs())
    }

    /// Returns the probability density, per solid angle, with which [`LightSources64::sample`]
    /// chooses a direction.
    pub fn pdf(&self, from: DVec3, direction: DVec3) -> WithMargin<f64> {
        let of_lights = self.lights.pdf(from, direction);
        let map = match &self.environment {
            Environment64::Constant(_) => return of_lights,
            Environment64::Map(map) => map,
        };
        let of_map = map.pdf(direction);
        let share_of_map = if self.lights.is_empty() { 1.0 } else { 0.5 };
        let pdf = of_lights.value * (1.0 - share_of_map) + of_map.value * share_of_map;
        of_lights.and(pdf, of_map.margin)
    }
}
