//! Lamps, as a matte surface asks for them: next-event estimation.
//!
//! What is known of a lamp here comes from the scene, not from a submission's `hit`: only whether
//! something stands between is asked of the submission.

mod shape;

use glam::{Vec2, Vec3};
use protocol::Shape;

use self::shape::LightShape;
use crate::scene::Scene;

/// All lamps of a scene, to be picked by power: the more light, the more often.
pub struct Lights {
    lights: Vec<AreaLight>,
    /// The power of each lamp and all before it.
    cumulative_power: Vec<f32>,
}

/// A direction in which a lamp can be seen, unless something stands between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Of length one.
    pub direction: Vec3,
    /// To the lamp.
    pub distance: f32,
    /// The lamp's radiance, divided by the density (per solid angle) of having picked this
    /// direction.
    pub radiance: Vec3,
}

struct AreaLight {
    radiance: Vec3,
    shape: LightShape,
}

impl Lights {
    /// The lamps among the scene's shapes.
    pub fn of(scene: &Scene) -> Self {
        let lamp = |shape: &Shape| {
            let material = scene.materials.get(shape.material() as usize)?;
            let radiance = material.emitted()?;
            let form = LightShape::of(shape);
            // What has no power is never picked, and would divide by zero.
            let shines = radiance != Vec3::ZERO && form.area() > 0.0;
            shines.then_some(AreaLight {
                radiance,
                shape: form,
            })
        };
        let lamps: Vec<AreaLight> = scene.shapes.iter().filter_map(lamp).collect();
        let sum = |total: &mut f32, lamp: &AreaLight| {
            *total += lamp.shape.area() * lamp.radiance.element_sum();
            Some(*total)
        };
        let power = lamps.iter().scan(0.0, sum).collect();
        Lights {
            lights: lamps,
            cumulative_power: power,
        }
    }

    /// Former name of [`Lights::sample`].
    #[doc(hidden)]
    pub fn illuminate(&self, point: Vec3, choice: f32, place: Vec2) -> Option<LightSample> {
        self.sample(point, choice, place)
    }

    /// How a point is lit by one lamp, picked by `choice`, from one place on it, picked by
    /// `place`; all in `[0, 1)`. `None` if there is no lamp, or that place does not shine on it.
    pub fn sample(&self, point: Vec3, choice: f32, place: Vec2) -> Option<LightSample> {
        let total = *self.cumulative_power.last()?;
        let wanted = choice * total;
        // Rounding may take `wanted` up to `total`: then it is the last lamp.
        let picked = self
            .cumulative_power
            .partition_point(|&power| power <= wanted);
        let picked = picked.min(self.lights.len() - 1);
        let before = if picked == 0 {
            0.0
        } else {
            self.cumulative_power[picked - 1]
        };
        let probability = (self.cumulative_power[picked] - before) / total;

        let lamp = &self.lights[picked];
        let seen = lamp.shape.sample(point, place)?;
        Some(LightSample {
            direction: seen.direction,
            distance: seen.distance,
            radiance: lamp.radiance * (seen.solid_angle / probability),
        })
    }
}

/// Former name of [`LightSample`].
#[doc(hidden)]
pub use self::LightSample as Illumination;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::{Purpose, Sampler};

    fn lights(shapes: &str) -> Lights {
        let text = format!(
            r#"{{
                "camera": {{ "vertical_fov": 90, "film": [1, 1],
                    "position": [0, 0, 1], "look_at": [0, 0, 0], "up": [0, 1, 0] }},
                "materials": {{
                    "dim": {{ "emitter": {{ "radiance": [1, 1, 1] }} }},
                    "bright": {{ "emitter": {{ "radiance": [9, 9, 9] }} }},
                    "dark": {{ "emitter": {{ "radiance": [0, 0, 0] }} }}
                }},
                "shapes": [{shapes}]
            }}"#
        );
        Lights::of(&Scene::from_text(&text).expect("a scene"))
    }

    const OVERHEAD: &str =
        r#"{ "sphere": { "center": [0, 2, 0], "radius": 1, "material": "dim" } }"#;
    const ASIDE: &str =
        r#"{ "sphere": { "center": [4, 3, 0], "radius": 1, "material": "bright" } }"#;
    const DARK: &str = r#"{ "sphere": { "center": [0, 9, 0], "radius": 5, "material": "dark" } }"#;

    /// On a floor at the origin that faces up, and how often the lamp overhead was asked.
    fn irradiance(lights: &Lights) -> (f32, u32) {
        let (mut light, mut overhead) = (0.0, 0);
        let count = 40_000;
        for n in 0..count {
            let sampler = Sampler::new(0, Default::default(), n);
            let choice = sampler.one(0, Purpose::Light);
            let place = sampler.pair(0, Purpose::PointOnLight);
            if let Some(lit) = lights.sample(Vec3::ZERO, choice, place) {
                light += lit.radiance.x * lit.direction.y / count as f32;
                overhead += u32::from(lit.distance < 2.0);
            }
        }
        (light, overhead)
    }

    #[test]
    fn two_lights_add_up_and_are_picked_by_power() {
        let (together, overhead) = irradiance(&lights(&format!("{OVERHEAD}, {ASIDE}, {DARK}")));
        let apart = irradiance(&lights(OVERHEAD)).0 + irradiance(&lights(ASIDE)).0;
        assert!(
            (together / apart - 1.0).abs() < 0.02,
            "{together} for {apart}"
        );
        // One in ten of 40,000, with a standard deviation of 60.
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
