//! Given: the scene as your code sees it. [`World`] finds what a ray hits and which lights there
//! are, and [`Surface`] converts between directions in the world and in the surface's own frame.

use framework::render::frame::Frame;
use framework::render::path_log::log;
use framework::render::path_steps::Step;
use framework::render::sampler::RandomNumbers;
use framework::render::sphere_light::SphereLight;
use framework::render::tracer::{self, Intersect};
use framework::scene::{self, Scene, checker};
use glam::Vec3;
use protocol::{Ray, Shape};

use crate::environment::Environment;
use crate::lights::{AreaLight, Light, Lights};
use crate::material::{Glass, Lambertian, Mirror, Scattered};

/// A scene.
pub struct World<'a> {
    hits: &'a dyn Intersect,
    sources: &'a LightSources,
}

/// Everything in a scene that emits light.
pub struct LightSources {
    lights: Lights,
    sky: Sky,
}

/// The light that arrives from far away.
enum Sky {
    /// The same radiance from all directions.
    Constant(Vec3),
    /// A picture of all directions.
    Map(Environment),
}

/// How a surface scatters or emits light.
#[derive(Clone, Copy, Debug)]
pub enum Material {
    /// A matte surface.
    Lambertian(Lambertian),
    /// A mirror.
    Mirror(Mirror),
    /// Glass.
    Glass(Glass),
    /// A light, which scatters nothing.
    Emitter,
}

/// The point on a surface that a ray hits first.
pub struct Surface<'a> {
    /// The position in the world.
    pub position: Vec3,
    /// The material.
    pub material: Material,
    /// The direction to where the ray came from, in the surface's frame: see [`Surface::to_local`].
    pub out: Vec3,
    /// The radiance that the surface itself emits toward where the ray came from.
    pub emitted: Vec3,
    frame: Frame,
    hit: tracer::Surface<'a>,
}

impl<'a> World<'a> {
    /// Creates a world.
    pub fn new(hits: &'a dyn Intersect, sources: &'a LightSources) -> Self {
        World { hits, sources }
    }

    /// Returns the surface that a ray hits first, or `None` if it hits nothing.
    pub fn hit(&self, ray: &Ray) -> Option<Surface<'_>> {
        let surface = self.hits.intersect(ray).map(Surface::of);
        log(|| match &surface {
            Some(surface) => Step::Hit {
                surface: surface.material.name(),
                position: surface.position,
                emitted: surface.emitted,
            },
            None => Step::Miss,
        });
        surface
    }

    /// Returns the radiance that arrives from far away in a direction, which must be a unit vector.
    pub fn environment(&self, direction: Vec3) -> Vec3 {
        let radiance = self.sources.sky.radiance(direction);
        log(|| Step::Environment {
            radiance,
            direction,
        });
        radiance
    }

    /// Returns the radiance that arrives at a surface from this direction without being scattered
    /// on the way, i.e. straight from a light or the environment.
    ///
    /// A ray is traced only if there is something to see, and only as far as the nearest light in
    /// this direction, since nothing behind that light is visible.
    pub fn emitted(&self, at: &Surface, direction: Vec3) -> Vec3 {
        let radiance = self.unblocked(at, direction);
        log(|| Step::Light {
            radiance,
            direction,
            is_sampled: self.is_sampled(at, direction),
        });
        radiance
    }

    /// Returns whether [`World::sample_light`] can choose this direction. A constant environment is
    /// never sampled.
    fn is_sampled(&self, at: &Surface, direction: Vec3) -> bool {
        let LightSources { lights, sky } = self.sources;
        matches!(sky, Sky::Map(_)) || lights.nearest(at.position, direction).is_some()
    }

    /// Computes [`World::emitted`].
    fn unblocked(&self, at: &Surface, direction: Vec3) -> Vec3 {
        let nearest = self.sources.lights.nearest(at.position, direction);
        let radiance = match nearest {
            Some((light, _)) => light.emitted(direction),
            None => self.sources.sky.radiance(direction),
        };
        if radiance == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let mut ray = at.leave(direction);
        if let Some((light, distance)) = nearest {
            ray.range.max = distance - light.margin(at.position, distance, direction);
        }
        if ray.range.is_empty() || self.hits.intersect(&ray).is_some() {
            return Vec3::ZERO;
        }
        radiance
    }

    /// Samples a direction from a point toward the lights. Where there are both lights and an
    /// environment map, half of the samples go to each. A constant environment is never sampled.
    pub fn sample_light(&self, from: Vec3, numbers: &RandomNumbers) -> Option<Vec3> {
        let RandomNumbers {
            light: choice,
            on_light,
            ..
        } = *numbers;
        let LightSources { lights, sky } = self.sources;
        match sky {
            Sky::Constant(_) => lights.sample(from, choice, on_light),
            Sky::Map(map) if lights.is_empty() => Some(map.sample(choice, on_light)),
            Sky::Map(map) if choice >= 0.5 => Some(map.sample(2.0 * choice - 1.0, on_light)),
            Sky::Map(_) => lights.sample(from, 2.0 * choice, on_light),
        }
    }

    /// Returns the probability density, per solid angle, with which [`World::sample_light`] chooses
    /// this direction. The direction must be a unit vector.
    pub fn light_pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let LightSources { lights, sky } = self.sources;
        let pdf = match sky {
            Sky::Constant(_) => lights.pdf(from, direction),
            Sky::Map(map) if lights.is_empty() => map.pdf(direction),
            Sky::Map(map) => 0.5 * (lights.pdf(from, direction) + map.pdf(direction)),
        };
        log(|| Step::LightPdf { pdf, direction });
        pdf
    }
}

impl Sky {
    /// Returns the radiance that arrives from a direction, which must be a unit vector.
    fn radiance(&self, direction: Vec3) -> Vec3 {
        match self {
            Sky::Constant(radiance) => *radiance,
            Sky::Map(map) => map.radiance(direction),
        }
    }
}

impl LightSources {
    /// Collects everything in a scene that emits light.
    pub fn of(scene: &Scene) -> Self {
        let mut lights = Vec::new();
        for shape in &scene.shapes {
            let material = scene.material_of(shape.number());
            if let Some(radiance) = material.and_then(scene::Material::emitted) {
                lights.push(light(shape, radiance));
            }
        }
        LightSources::new(lights, &scene.environment)
    }

    /// Collects lights and an environment.
    pub fn new(lights: Vec<Light>, environment: &scene::Environment) -> Self {
        let sky = match environment {
            scene::Environment::Constant(radiance) => Sky::Constant(*radiance),
            scene::Environment::Map(map) => Sky::Map(Environment::new(map.clone())),
        };
        LightSources {
            lights: Lights::new(lights),
            sky,
        }
    }
}

/// Converts a light-emitting shape of the scene to a [`Light`]. A triangle emits on the side that
/// its corners' normals point to.
fn light(shape: &Shape, radiance: Vec3) -> Light {
    match *shape {
        Shape::Sphere { center, radius, .. } => Light::Sphere(SphereLight {
            center,
            radius,
            radiance,
        }),
        Shape::FlatTriangle { corners, .. } => Light::Area(AreaLight::triangle(corners, radiance)),
        Shape::Triangle { vertices, .. } => {
            let [p0, p1, p2] = vertices.map(|vertex| vertex.position);
            let outward: Vec3 = vertices.iter().map(|vertex| vertex.normal).sum();
            let is_turned = (p1 - p0).cross(p2 - p0).dot(outward) < 0.0;
            let corners = if is_turned {
                [p0, p2, p1]
            } else {
                [p0, p1, p2]
            };
            Light::Area(AreaLight::triangle(corners, radiance))
        }
    }
}

impl Material {
    /// Samples the continuation of a path, in the surface's frame. Returns `None` if the path ends
    /// at the surface.
    pub fn scatter(&self, out: Vec3, numbers: &RandomNumbers) -> Option<Scattered> {
        let scattered = match self {
            Material::Lambertian(lambertian) => Some(lambertian.scatter(out, numbers.scatter)),
            Material::Mirror(mirror) => Some(mirror.scatter(out)),
            Material::Glass(glass) => Some(glass.scatter(out, numbers.reflect)),
            Material::Emitter => None,
        };
        log(|| match scattered {
            Some(Scattered {
                direction,
                attenuation,
                pdf,
            }) => Step::Scatter {
                direction,
                attenuation,
                pdf,
            },
            None => Step::Absorbed,
        });
        scattered
    }

    /// Returns the material's name in a sentence.
    fn name(&self) -> &'static str {
        match self {
            Material::Lambertian(_) => "a matte surface",
            Material::Mirror(_) => "a mirror",
            Material::Glass(_) => "glass",
            Material::Emitter => "a light",
        }
    }
}

impl<'a> Surface<'a> {
    fn of(hit: tracer::Surface<'a>) -> Self {
        let matte = |albedo| Material::Lambertian(Lambertian { albedo });
        let material = match *hit.material {
            scene::Material::Lambertian { albedo } => matte(albedo),
            scene::Material::Checker { a, b, scale } => matte(checker(a, b, scale, hit.uv)),
            scene::Material::Mirror { reflectance } => Material::Mirror(Mirror { reflectance }),
            scene::Material::Glass { ior } => Material::Glass(Glass { ior }),
            scene::Material::Emitter { .. } => Material::Emitter,
        };
        // The framework's normal is on the side that the ray comes from.
        let is_inside_glass = matches!(material, Material::Glass(_)) && !hit.outside;
        let frame = Frame::from_z(if is_inside_glass {
            -hit.normal
        } else {
            hit.normal
        });
        let emitted = hit.material.emitted().filter(|_| hit.outside);
        Surface {
            position: hit.position,
            material,
            out: frame.to_local(hit.out),
            emitted: emitted.unwrap_or(Vec3::ZERO),
            frame,
            hit,
        }
    }

    /// Converts a direction in the world to the surface's frame, where +z is the normal. The normal
    /// of glass points out of the glass. The normal of any other material is on the side that the
    /// ray came from.
    pub fn to_local(&self, direction: Vec3) -> Vec3 {
        self.frame.to_local(direction)
    }

    /// Converts a direction in the surface's frame to the world.
    pub fn to_world(&self, direction: Vec3) -> Vec3 {
        self.frame.to_world(direction)
    }

    /// Returns the ray that leaves the surface in a direction in the world. It starts far enough
    /// away not to hit the surface itself.
    pub fn leave(&self, direction: Vec3) -> Ray {
        self.hit.leave(direction, f32::INFINITY)
    }
}
