//! Given: connects your files to the grader's questions.

use framework::render::rectangles::RectangleScene;
use framework::render::sampler::{RandomNumbers, Sampler};
use framework::render::sphere_light::SphereLight;
use framework::scene::{self, EnvironmentMap, Scene};
use framework::submission::Submission;
use glam::{UVec2, Vec2, Vec3};
use protocol::light::environment::MapImage;
use protocol::light::lights::{FlatLight, ListedLight, SphericalLight};
use protocol::light::transport::{self, DirectSample, PathStart};
use protocol::light::{DirectionSampler, LightFunctions, LitRoom, MapSampler};

use crate::direct::direct;
use crate::environment::{Environment, uniform_sphere};
use crate::lights::{AreaLight, Light, Lights};
use crate::material::{Glass, Lambertian, Mirror, Scattered, fresnel, reflect, refract};
use crate::path::radiance;
use crate::world::{LightSources, World};

/// Your files, as an implementation of the framework's traits.
pub struct Student;

/// The lights of a question.
struct LightList(Lights);

/// The environment map of a question.
struct Map(Environment);

/// A scene of rectangles.
struct Room {
    hits: RectangleScene,
    sources: LightSources,
}

impl Submission for Student {
    fn light(&self) -> &dyn LightFunctions {
        self
    }
}

impl LightFunctions for Student {
    fn evaluate_matte(&self, albedo: Vec3, out: Vec3, incoming: Vec3) -> Vec3 {
        Lambertian { albedo }.evaluate(out, incoming)
    }

    fn matte_pdf(&self, albedo: Vec3, out: Vec3, incoming: Vec3) -> f32 {
        Lambertian { albedo }.pdf(out, incoming)
    }

    fn scatter_matte(&self, albedo: Vec3, out: Vec3, random: Vec2) -> protocol::Scattered {
        scattered(Lambertian { albedo }.scatter(out, random))
    }

    fn reflection(&self, out: Vec3) -> Vec3 {
        reflect(out)
    }

    fn refraction(&self, out: Vec3, ior: f32) -> Option<Vec3> {
        refract(out, ior)
    }

    fn reflected_fraction(&self, out: Vec3, ior: f32) -> f32 {
        fresnel(out, ior)
    }

    fn scatter_mirror(&self, reflectance: Vec3, out: Vec3) -> protocol::Scattered {
        scattered(Mirror { reflectance }.scatter(out))
    }

    fn scatter_glass(&self, ior: f32, out: Vec3, random: f32) -> protocol::Scattered {
        scattered(Glass { ior }.scatter(out, random))
    }

    fn area_light_pdf(&self, light: &FlatLight, from: Vec3, direction: Vec3) -> f32 {
        area_light(light).pdf(from, direction)
    }

    fn lights(&self, lights: &[ListedLight]) -> Box<dyn DirectionSampler> {
        let lights = lights.iter().map(light).collect();
        Box::new(LightList(Lights::new(lights)))
    }

    fn room(&self, room: &transport::Room) -> Box<dyn LitRoom> {
        let mut scene = Scene::from_text(&room.scene).expect("the exam's scene is valid");
        if let Some(map) = &room.map {
            scene.environment = scene::Environment::Map(environment_map(map));
        }
        let sources = LightSources::of(&scene);
        let hits = RectangleScene::new(scene);
        Box::new(Room { hits, sources })
    }

    fn uniform_direction(&self, random: Vec2) -> Vec3 {
        uniform_sphere(random)
    }

    fn environment(&self, map: &MapImage) -> Box<dyn MapSampler> {
        Box::new(Map(Environment::new(environment_map(map))))
    }
}

impl DirectionSampler for LightList {
    fn direction(&self, from: Vec3, choice: f32, random: Vec2) -> Option<Vec3> {
        self.0.sample(from, choice, random)
    }

    fn density(&self, from: Vec3, direction: Vec3) -> f32 {
        self.0.pdf(from, direction)
    }
}

impl MapSampler for Map {
    fn direction(&self, choice: f32, random: Vec2) -> Vec3 {
        self.0.sample(choice, random)
    }

    fn density(&self, direction: Vec3) -> f32 {
        self.0.pdf(direction)
    }
}

impl LitRoom for Room {
    fn direct_light(&self, sample: &DirectSample) -> Vec3 {
        let world = World::new(&self.hits, &self.sources);
        let numbers = RandomNumbers {
            light: sample.light,
            on_light: sample.on_light,
            direct: sample.direct,
            // The others are for the path, not for direct light.
            scatter: Vec2::new(sample.direct.y, sample.direct.x),
            reflect: 0.0,
            survive: 0.0,
        };
        let surface = world.hit(&sample.ray);
        surface.map_or(Vec3::ZERO, |surface| direct(&world, &surface, &numbers))
    }

    fn path_light(&self, start: &PathStart) -> Vec3 {
        let world = World::new(&self.hits, &self.sources);
        let sampler = Sampler::new(start.seed.into(), UVec2::ZERO, 0);
        radiance(&world, start.ray, &sampler, start.bounces)
    }
}

/// Converts an environment map.
fn environment_map(map: &MapImage) -> EnvironmentMap {
    let map = EnvironmentMap::new(map.size, map.pixels.clone());
    map.expect("the exam's map is valid")
}

/// Converts a light.
fn light(light: &ListedLight) -> Light {
    match light {
        ListedLight::Flat(light) => Light::Area(area_light(light)),
        ListedLight::Sphere(light) => Light::Sphere(sphere_light(light)),
    }
}

/// Converts a sphere.
fn sphere_light(light: &SphericalLight) -> SphereLight {
    let SphericalLight {
        center,
        radius,
        radiance,
    } = *light;
    SphereLight {
        center,
        radius,
        radiance,
    }
}

/// Converts a flat light.
fn area_light(light: &FlatLight) -> AreaLight {
    let FlatLight {
        corner,
        edges,
        is_triangle,
        radiance,
    } = *light;
    if is_triangle {
        AreaLight::triangle([corner, corner + edges[0], corner + edges[1]], radiance)
    } else {
        AreaLight::parallelogram(corner, edges, radiance)
    }
}

/// Converts a sampled continuation of a path.
fn scattered(scattered: Scattered) -> protocol::Scattered {
    let Scattered {
        direction,
        attenuation,
        pdf,
    } = scattered;
    protocol::Scattered {
        direction,
        attenuation,
        pdf,
    }
}
