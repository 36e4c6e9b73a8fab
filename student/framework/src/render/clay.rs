//! Ambient occlusion: renders a scene as if everything in it were made of clay, under an overcast
//! sky.
//!
//! The light comes from the sky, and only shapes close to a point block it. So corners and gaps are
//! dark, as in Zhukov, Iones and Kronin, "An Ambient Light Illumination Model", Rendering
//! Techniques 1998. This needs no materials, no lights and no bounces: two rays per sample show
//! whether the camera, the shapes and the tree work together.

use glam::{UVec2, Vec3};

use crate::render::frame::{Frame, sample_cosine_hemisphere};
use crate::render::renderer::{InvalidSample, RenderStats, Renderer};
use crate::render::sampler::{Purpose, Sampler};
use crate::render::tracer::Tracer;
use crate::scene::Scene;
use crate::submission::World;

/// The albedo of a surface seen from the side its normal points to.
const CLAY: Vec3 = Vec3::new(0.8, 0.72, 0.63);
/// The albedo of a surface seen from behind.
const BEHIND: Vec3 = Vec3::new(0.25, 0.35, 0.65);
/// How far away a shape can be and still block the sky, relative to the point's distance from the
/// camera. A constant distance would make small scenes dark and large ones flat.
const REACH: f32 = 0.3;

/// Renders a scene in clay.
pub struct Clay<'a> {
    tracer: Tracer<'a>,
    seed: u64,
}

impl<'a> Clay<'a> {
    /// Creates a renderer. `world` must be made from `scene`. `seed` is the seed for all random
    /// numbers.
    pub fn new(scene: &'a Scene, world: &'a World, seed: u64) -> Self {
        let tracer = Tracer { scene, world };
        Clay { tracer, seed }
    }
}

impl Renderer for Clay<'_> {
    fn trace_sample(
        &self,
        pixel: UVec2,
        sample: u32,
        stats: &mut RenderStats,
    ) -> Result<Vec3, InvalidSample> {
        let sampler = Sampler::new(self.seed, pixel, sample);
        let offset = sampler.pair(0, Purpose::Pixel);
        let ray = self.tracer.camera_ray(pixel, offset);
        let Some(surface) = self.tracer.intersect(&ray, stats)? else {
            return Ok(sky(ray.dir) * Vec3::ONE);
        };
        let around_normal = sample_cosine_hemisphere(sampler.pair(0, Purpose::Direction));
        let direction = Frame::from_z(surface.normal).to_world(around_normal);
        let reach = REACH * surface.eye.distance(surface.position);
        let to_sky = surface.leave(direction, reach);
        let is_open = to_sky.range.is_empty() || self.tracer.intersect(&to_sky, stats)?.is_none();
        // The cosine and the 1/π of the BRDF cancel with the probability density.
        let albedo = if surface.outside { CLAY } else { BEHIND };
        Ok(if is_open {
            sky(direction) * albedo
        } else {
            Vec3::ZERO
        })
    }
}

/// Returns the radiance of an overcast sky, which is three times as bright overhead as at the
/// horizon and below. See Moon and Spencer, "Illumination from a Non-Uniform Sky", Illuminating
/// Engineering 37, 1942.
fn sky(direction: Vec3) -> f32 {
    0.5 + direction.y.max(0.0)
}

#[cfg(test)]
mod tests {
    use std::f32::consts::{FRAC_1_SQRT_2, PI};

    use glam::{uvec2, vec2, vec3};
    use protocol::Trace;

    use super::*;
    use crate::tests::{CORRECT, SphereSubmission, scene};

    const GREY: &str = r#""grey": { "lambertian": { "albedo": [0.5, 0.5, 0.5] } }"#;

    fn sphere(center: Vec3, radius: f32) -> String {
        format!(
            r#"{{ "sphere": {{ "center": {center}, "radius": {radius}, "material": "grey" }} }}"#
        )
    }

    /// Returns the mean radiance of the central pixel of a film of 101 × 101 pixels.
    fn central_pixel(submission: &SphereSubmission, shapes: &str) -> Vec3 {
        let scene = scene(0.0, GREY, shapes).on_film(uvec2(101, 101));
        let world = World::new(submission, &scene);
        let clay = Clay::new(&scene, &world, 1);
        clay.pixel_radiance(uvec2(50, 50), 4000, &mut RenderStats::default())
    }

    /// The mean radiance of an open sky over a surface that faces the camera, times the albedo of
    /// clay. Projected onto the disc below the hemisphere, the directions are uniformly
    /// distributed, and the mean distance of the disc's upper half from the diameter is 4 / 3π.
    fn open() -> f32 {
        CLAY.x * (0.5 + 0.5 * 4.0 / (3.0 * PI))
    }

    #[test]
    fn what_faces_the_camera_gets_half_of_the_sky() {
        let shown = central_pixel(&CORRECT, &sphere(vec3(0.0, 0.0, -3.0), 1.0));
        assert!((shown.x / open() - 1.0).abs() < 0.02, "{shown}");
    }

    #[test]
    fn a_sphere_nearby_hides_a_closed_form_share_of_the_sky() {
        // The central pixel sees a point at distance 4, so shapes within 1.2 of that point hide the
        // sky. A sphere that subtends a half-angle of 30°, in a direction 45° from the normal,
        // covers an ellipse of the disc with semi-axes sin 30° and sin 30° · cos 45°.
        let ground = sphere(vec3(0.0, 0.0, -1004.0), 1000.0);
        let radiance = |distance: f32| {
            let direction = vec3(1.0, 0.0, 1.0).normalize();
            let center = vec3(0.0, 0.0, -4.0) + distance * direction;
            let above = sphere(center, 0.5 * distance);
            central_pixel(&CORRECT, &[ground.clone(), above].join(",")).x
        };
        let mean_sky = 0.5 + 0.5 * 0.5 * 4.0 / (3.0 * PI);
        let hidden = CLAY.x * 0.25 * FRAC_1_SQRT_2 * mean_sky;
        assert!((radiance(1.2) / (open() - hidden) - 1.0).abs() < 0.02);
        assert!((radiance(6.0) / open() - 1.0).abs() < 0.02);
    }

    #[test]
    fn a_surface_seen_from_behind_is_blue() {
        let turned = SphereSubmission {
            alter: |trace| trace.normal = -trace.normal,
            ..CORRECT
        };
        let shown = central_pixel(&turned, &sphere(vec3(0.0, 0.0, -3.0), 1.0));
        let ratio = shown / BEHIND;
        assert!((ratio - ratio.x).abs().max_element() < 1e-4, "{shown}");
    }

    #[test]
    fn an_unusable_hit_is_counted_and_black() {
        let scene = scene(0.0, GREY, &sphere(vec3(0.0, 0.0, -3.0), 2.0));
        let alterations: [fn(&mut Trace); 4] = [
            |trace| trace.position = Vec3::NAN,
            |trace| trace.normal = Vec3::ZERO,
            |trace| trace.uv = vec2(f32::INFINITY, 0.0),
            |trace| trace.shape = 77,
        ];
        for alter in alterations {
            let world = World::new(&SphereSubmission { alter, ..CORRECT }, &scene);
            let mut stats = RenderStats::default();
            let shown = Clay::new(&scene, &world, 1).pixel_radiance(uvec2(4, 4), 3, &mut stats);
            assert_eq!((shown, stats.rays, stats.invalid_paths), (Vec3::ZERO, 3, 3));
        }
    }

    #[test]
    fn the_length_of_a_normal_makes_no_difference() {
        let long = SphereSubmission {
            alter: |trace| trace.normal *= 4.0,
            ..CORRECT
        };
        let near = sphere(vec3(0.0, 0.0, -3.0), 1.0);
        assert_eq!(central_pixel(&long, &near), central_pixel(&CORRECT, &near));
    }
}
