//! Light sampling for direct illumination (next-event estimation).
//!
//! The positions and shapes of lights come from the scene rather than from a submission's `hit`.
//! The submission only decides whether something blocks the light.

mod map;
mod shape;

use glam::{Vec2, Vec3};
use protocol::Shape;

use self::map::MapSampler;
use self::shape::LightShape;
use crate::scene::{Environment, Scene};

/// The lights of a scene, and its environment map, if any. The lights are picked for sampling with
/// probabilities proportional to their power. If there are both lights and a map, half of the
/// samples go to the map.
pub struct Lights {
    /// In the order of the scene's shapes.
    lights: Vec<AreaLight>,
    /// For each light, the total power of this light and all earlier lights.
    cumulative_power: Vec<f32>,
    map: Option<MapSampler>,
}

/// A source of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightSource {
    /// The shape with this index in the scene.
    Shape(u32),
    /// The environment.
    Environment,
}

/// A sampled direction toward a light, as seen from a given point. Other shapes can block the
/// light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// The light in that direction.
    pub source: LightSource,
    /// The direction to the light, as a unit vector.
    pub direction: Vec3,
    /// The distance to the light, which is infinite for the environment.
    pub distance: f32,
    /// The light's radiance.
    pub radiance: Vec3,
}

/// The contributions of linear red, green and blue to luminance. See ITU-R Recommendation BT.709.
const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

struct AreaLight {
    radiance: Vec3,
    shape: LightShape,
    /// The index of the shape in the scene.
    index: u32,
    /// The power up to a constant factor: the area times the luminance.
    power: f32,
}

impl Lights {
    /// Collects the lights among the scene's shapes.
    pub fn of(scene: &Scene) -> Self {
        let light = |shape: &Shape| {
            let index = shape.number();
            let radiance = scene.material_of(index)?.emitted()?;
            let shape = LightShape::of(shape);
            let power = shape.area() * radiance.dot(LUMINANCE);
            // A light without power must not be picked. If all lights had no power, their
            // probabilities would be 0 / 0.
            (power > 0.0).then_some(AreaLight {
                radiance,
                shape,
                index,
                power,
            })
        };
        let lights: Vec<AreaLight> = scene.shapes.iter().filter_map(light).collect();
        let sum = |total: &mut f32, light: &AreaLight| {
            *total += light.power;
            Some(*total)
        };
        let cumulative_power = lights.iter().scan(0.0, sum).collect();
        Lights {
            lights,
            cumulative_power,
            map: match &scene.environment {
                Environment::Constant(_) => None,
                Environment::Map(map) => Some(MapSampler::new(map)),
            },
        }
    }

    /// Samples a direction from `from` toward a light. The random numbers `choice` and `position`, in
    /// `[0, 1)`, pick the light and the point on it. Returns `None` if there is no light, or if the
    /// light that is picked doesn't emit toward `from`.
    pub fn sample(&self, from: Vec3, choice: f32, position: Vec2) -> Option<LightSample> {
        let in_map = |map: &MapSampler, choice: f32| {
            let (direction, radiance) = map.sample(choice, position);
            LightSample {
                source: LightSource::Environment,
                direction,
                distance: f32::INFINITY,
                radiance,
            }
        };
        match &self.map {
            None => self.sample_light(from, choice, position),
            Some(map) if self.lights.is_empty() => Some(in_map(map, choice)),
            Some(map) if choice >= 0.5 => Some(in_map(map, 2.0 * choice - 1.0)),
            Some(_) => self.sample_light(from, 2.0 * choice, position),
        }
    }

    /// Returns the probability density, per solid angle, with which [`Lights::sample`] picks this
    /// light and this direction, which must be a unit vector toward the light. The density is 0 for
    /// shapes that don't emit light, and for a constant environment. `distance` is the distance to
    /// the light.
    pub fn pdf(&self, source: LightSource, from: Vec3, direction: Vec3, distance: f32) -> f32 {
        let share = if self.map.is_some() && !self.lights.is_empty() {
            0.5
        } else {
            1.0
        };
        let pdf = match source {
            LightSource::Environment => self.map.as_ref().map(|map| map.pdf(direction)),
            LightSource::Shape(index) => {
                let found = self
                    .lights
                    .binary_search_by_key(&index, |light| light.index);
                found.ok().map(|found| {
                    let light = &self.lights[found];
                    let total = self.cumulative_power.last().copied().unwrap_or(light.power);
                    light.power / total * light.shape.pdf(from, direction, distance)
                })
            }
        };
        share * pdf.unwrap_or(0.0)
    }

    fn sample_light(&self, from: Vec3, choice: f32, position: Vec2) -> Option<LightSample> {
        let target = choice * self.cumulative_power.last()?;
        // Rounding can make `target` equal to the total. Then the last light is picked.
        let picked = self
            .cumulative_power
            .partition_point(|&power| power <= target);
        let light = self.lights.get(picked).or(self.lights.last())?;
        let (direction, distance) = light.shape.sample(from, position)?;
        Some(LightSample {
            source: LightSource::Shape(light.index),
            direction,
            distance,
            radiance: light.radiance,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::TAU;

    use super::*;
    use crate::render::sampler::{Purpose, Sampler};
    use crate::tests::scene;

    const EMITTERS: &str = r#"
        "dim": { "emitter": { "radiance": [1, 1, 1] } },
        "bright": { "emitter": { "radiance": [9, 9, 9] } },
        "dark": { "emitter": { "radiance": [0, 0, 0] } }"#;

    fn lights(shapes: &str) -> Lights {
        Lights::of(&scene(0.0, EMITTERS, shapes))
    }

    const OVERHEAD: &str =
        r#"{ "sphere": { "center": [0, 2, 0], "radius": 1, "material": "dim" } }"#;
    const ASIDE: &str =
        r#"{ "sphere": { "center": [4, 3, 0], "radius": 1, "material": "bright" } }"#;
    const DARK: &str = r#"{ "sphere": { "center": [0, 9, 0], "radius": 5, "material": "dark" } }"#;

    /// Estimates the solid angle of all lights, as seen from the origin. Also returns the number of
    /// times that the light overhead was picked.
    fn solid_angle(lights: &Lights) -> (f32, u32) {
        let (mut sum, mut overhead) = (0.0, 0);
        let count = 40_000;
        for n in 0..count {
            let sampler = Sampler::new(0, Default::default(), n);
            let choice = sampler.one(0, Purpose::Light);
            let position = sampler.pair(0, Purpose::PointOnLight);
            if let Some(sample) = lights.sample(Vec3::ZERO, choice, position) {
                let LightSample {
                    source,
                    direction,
                    distance,
                    ..
                } = sample;
                sum += 1.0 / lights.pdf(source, Vec3::ZERO, direction, distance) / count as f32;
                overhead += u32::from(source == LightSource::Shape(0));
            }
        }
        (sum, overhead)
    }

    #[test]
    fn lights_are_picked_by_power_and_their_density_is_that_of_the_sample() {
        let lights = lights(&format!("{OVERHEAD}, {ASIDE}, {DARK}"));
        let (solid_angle, overhead) = solid_angle(&lights);
        // The cones that the two spheres subtend, whose half-angles have sines of 1/2 and 1/5.
        let cone = |sine: f32| TAU * (1.0 - (1.0 - sine * sine).sqrt());
        let expected = cone(0.5) + cone(0.2);
        assert!(
            (solid_angle / expected - 1.0).abs() < 0.02,
            "expected about {expected}, got {solid_angle}"
        );
        // Expected: one in ten of 40,000, with a standard deviation of 60.
        assert!(overhead.abs_diff(4_000) < 300, "{overhead}");
    }

    #[test]
    fn a_scene_without_lights_gives_no_sample() {
        let lights = lights(DARK);
        let sample = lights.sample(Vec3::ZERO, 0.5, Vec2::splat(0.5));
        let pdf = lights.pdf(LightSource::Shape(0), Vec3::ZERO, Vec3::Y, 4.0);
        assert_eq!((sample, pdf), (None, 0.0));
    }
}
