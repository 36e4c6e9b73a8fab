//! Light sampling for direct illumination (next-event estimation).
//!
//! The positions and shapes of lights come from the scene rather than from a submission's `hit`.
//! The submission only decides whether something blocks the light.

mod shape;

use glam::{Vec2, Vec3};
use protocol::Shape;

use self::shape::LightShape;
use crate::scene::Scene;

/// The lights of a scene. They are picked for sampling with probabilities proportional to their
/// power.
pub struct Lights {
    lights: Vec<AreaLight>,
    /// For each light, the total power of this light and all before it.
    cumulative_power: Vec<f32>,
}

/// A sampled direction toward a light, as seen from a given point. Other shapes can block the
/// light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// The direction to the light, of length one.
    pub direction: Vec3,
    /// The distance to the sampled point on the light.
    pub distance: f32,
    /// The light's radiance divided by the probability density of this direction, per solid angle.
    pub radiance: Vec3,
    /// The index of the light's shape in the scene.
    pub shape: u32,
}

struct AreaLight {
    radiance: Vec3,
    shape: LightShape,
    /// The index of the shape in the scene.
    index: u32,
}

impl Lights {
    /// Collects the lights among the scene's shapes.
    pub fn of(scene: &Scene) -> Self {
        let light = |shape: &Shape| {
            let index = shape.number();
            let radiance = scene.material_of(index)?.emitted()?;
            let shape = LightShape::of(shape);
            // A light without power must not be picked. If all lights had no power, their
            // probabilities would be 0 / 0.
            let has_power = radiance != Vec3::ZERO && shape.area() > 0.0;
            has_power.then_some(AreaLight {
                radiance,
                shape,
                index,
            })
        };
        let lights: Vec<AreaLight> = scene.shapes.iter().filter_map(light).collect();
        let sum = |total: &mut f32, light: &AreaLight| {
            *total += light.shape.area() * light.radiance.element_sum();
            Some(*total)
        };
        let cumulative_power = lights.iter().scan(0.0, sum).collect();
        Lights {
            lights,
            cumulative_power,
        }
    }

    /// Samples the light that reaches `point` from one light. The random numbers `choice` and
    /// `position`, in `[0, 1)`, pick the light and the position on it. Returns `None` if there is
    /// no light, or if that position doesn't emit light toward `point`.
    pub fn sample(&self, point: Vec3, choice: f32, position: Vec2) -> Option<LightSample> {
        let total = *self.cumulative_power.last()?;
        let target = choice * total;
        // Rounding can make `target` equal to `total`. Then the last light is picked.
        let picked = self
            .cumulative_power
            .partition_point(|&power| power <= target);
        let picked = picked.min(self.lights.len() - 1);
        let before = if picked == 0 {
            0.0
        } else {
            self.cumulative_power[picked - 1]
        };
        let probability = (self.cumulative_power[picked] - before) / total;

        let light = &self.lights[picked];
        let sample = light.shape.sample(point, position)?;
        Some(LightSample {
            direction: sample.direction,
            distance: sample.distance,
            radiance: light.radiance * (sample.solid_angle / probability),
            shape: light.index,
        })
    }
}

#[cfg(test)]
mod tests {
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

    /// Returns the irradiance at the origin on a floor that faces up, and the number of times the
    /// light overhead was picked.
    fn irradiance(lights: &Lights) -> (f32, u32) {
        let (mut light, mut overhead) = (0.0, 0);
        let count = 40_000;
        for n in 0..count {
            let sampler = Sampler::new(0, Default::default(), n);
            let choice = sampler.one(0, Purpose::Light);
            let position = sampler.pair(0, Purpose::PointOnLight);
            if let Some(sample) = lights.sample(Vec3::ZERO, choice, position) {
                light += sample.radiance.x * sample.direction.y / count as f32;
                overhead += u32::from(sample.distance < 2.0);
            }
        }
        (light, overhead)
    }

    #[test]
    fn two_lights_add_up_and_are_picked_by_power() {
        let (together, overhead) = irradiance(&lights(&format!("{OVERHEAD}, {ASIDE}, {DARK}")));
        let sum = irradiance(&lights(OVERHEAD)).0 + irradiance(&lights(ASIDE)).0;
        assert!(
            (together / sum - 1.0).abs() < 0.02,
            "expected about {sum}, got {together}"
        );
        // Expected: one in ten of 40,000, with a standard deviation of 60.
        assert!(overhead.abs_diff(4_000) < 300, "{overhead}");
    }

    #[test]
    fn a_scene_without_lights_gives_no_sample() {
        assert!(
            lights(DARK)
                .sample(Vec3::ZERO, 0.5, Vec2::splat(0.5))
                .is_none()
        );
    }
}
