//! The functions of part two: materials, lights, direct light, paths and environment maps.

pub mod environment;
pub mod lambertian;
pub mod lights;
mod outputs;
pub mod specular;
pub mod transport;

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::{AnyTable, Question, Table};
use environment::{EnvironmentPdf, EnvironmentSample, MapImage, UniformSphere};
use lambertian::{Evaluate, Pdf, Scatter};
use lights::{AreaLightPdf, FlatLight, LightsPdf, LightsSample, ListedLight};
use specular::{Fresnel, GlassScatter, MirrorScatter, Reflect, Refract};
use transport::{Direct, DirectSample, PathStart, Radiance, Room};

pub use outputs::{Color, Density, Fraction, LocalDirection, Scattered};

/// A question about part two. Each is a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LightQuestion {
    /// Calls `Lambertian::evaluate` once per row.
    Evaluate(Table<Evaluate>),
    /// Calls `Lambertian::pdf` once per row.
    LambertianPdf(Table<Pdf>),
    /// Calls `Lambertian::scatter` once per row.
    LambertianScatter(Table<Scatter>),
    /// Calls `reflect` once per row.
    Reflect(Table<Reflect>),
    /// Calls `refract` once per row.
    Refract(Table<Refract>),
    /// Calls `fresnel` once per row.
    Fresnel(Table<Fresnel>),
    /// Calls `Mirror::scatter` once per row.
    MirrorScatter(Table<MirrorScatter>),
    /// Calls `Glass::scatter` once per row.
    GlassScatter(Table<GlassScatter>),
    /// Calls `AreaLight::pdf` once per row.
    AreaLightPdf(Table<AreaLightPdf>),
    /// Calls `Lights::sample` once per row.
    LightsSample(Table<LightsSample>),
    /// Calls `Lights::pdf` once per row.
    LightsPdf(Table<LightsPdf>),
    /// Calls `direct` once per row.
    Direct(Table<Direct>),
    /// Calls `radiance` once per row.
    Radiance(Table<Radiance>),
    /// Calls `uniform_sphere` once per row.
    UniformSphere(Table<UniformSphere>),
    /// Calls `Environment::sample` once per row.
    EnvironmentSample(Table<EnvironmentSample>),
    /// Calls `Environment::pdf` once per row.
    EnvironmentPdf(Table<EnvironmentPdf>),
}

impl LightQuestion {
    /// Returns the table.
    pub fn table(&self) -> &dyn AnyTable {
        match self {
            LightQuestion::Evaluate(table) => table,
            LightQuestion::LambertianPdf(table) => table,
            LightQuestion::LambertianScatter(table) => table,
            LightQuestion::Reflect(table) => table,
            LightQuestion::Refract(table) => table,
            LightQuestion::Fresnel(table) => table,
            LightQuestion::MirrorScatter(table) => table,
            LightQuestion::GlassScatter(table) => table,
            LightQuestion::AreaLightPdf(table) => table,
            LightQuestion::LightsSample(table) => table,
            LightQuestion::LightsPdf(table) => table,
            LightQuestion::Direct(table) => table,
            LightQuestion::Radiance(table) => table,
            LightQuestion::UniformSphere(table) => table,
            LightQuestion::EnvironmentSample(table) => table,
            LightQuestion::EnvironmentPdf(table) => table,
        }
    }
}

impl From<LightQuestion> for Question {
    fn from(question: LightQuestion) -> Self {
        Question::Light(question)
    }
}

/// A submission's functions for part two, called through a given file that implements this trait.
/// Directions at a surface are in its frame, where +z is the normal. An assignment implements the
/// methods for its own functions.
pub trait LightFunctions: Sync {
    /// Calls `Lambertian::evaluate`.
    fn evaluate_matte(&self, _albedo: Vec3, _out: Vec3, _incoming: Vec3) -> Vec3 {
        unimplemented!()
    }

    /// Calls `Lambertian::pdf`.
    fn matte_pdf(&self, _albedo: Vec3, _out: Vec3, _incoming: Vec3) -> f32 {
        unimplemented!()
    }

    /// Calls `Lambertian::scatter`.
    fn scatter_matte(&self, _albedo: Vec3, _out: Vec3, _random: Vec2) -> Scattered {
        unimplemented!()
    }

    /// Calls `reflect`.
    fn reflection(&self, _out: Vec3) -> Vec3 {
        unimplemented!()
    }

    /// Calls `refract`.
    fn refraction(&self, _out: Vec3, _ior: f32) -> Option<Vec3> {
        unimplemented!()
    }

    /// Calls `fresnel`.
    fn reflected_fraction(&self, _out: Vec3, _ior: f32) -> f32 {
        unimplemented!()
    }

    /// Calls `Mirror::scatter`.
    fn scatter_mirror(&self, _reflectance: Vec3, _out: Vec3) -> Scattered {
        unimplemented!()
    }

    /// Calls `Glass::scatter`.
    fn scatter_glass(&self, _ior: f32, _out: Vec3, _random: f32) -> Scattered {
        unimplemented!()
    }

    /// Calls `AreaLight::pdf`.
    fn area_light_pdf(&self, _light: &FlatLight, _from: Vec3, _direction: Vec3) -> f32 {
        unimplemented!()
    }

    /// Calls `Lights::new`.
    fn lights(&self, _lights: &[ListedLight]) -> Box<dyn DirectionSampler> {
        unimplemented!()
    }

    /// Creates a scene of rectangles.
    fn room(&self, _room: &Room) -> Box<dyn LitRoom> {
        unimplemented!()
    }

    /// Calls `uniform_sphere`.
    fn uniform_direction(&self, _random: Vec2) -> Vec3 {
        unimplemented!()
    }

    /// Calls `Environment::new`.
    fn environment(&self, _map: &MapImage) -> Box<dyn MapSampler> {
        unimplemented!()
    }
}

/// A submission's lights.
pub trait DirectionSampler: Send + Sync {
    /// Calls `Lights::sample`.
    fn direction(&self, from: Vec3, choice: f32, random: Vec2) -> Option<Vec3>;

    /// Calls `Lights::pdf`.
    fn density(&self, from: Vec3, direction: Vec3) -> f32;
}

/// A submission's environment map.
pub trait MapSampler: Send + Sync {
    /// Calls `Environment::sample`.
    fn direction(&self, choice: f32, random: Vec2) -> Vec3;

    /// Calls `Environment::pdf`.
    fn density(&self, direction: Vec3) -> f32;
}

/// A scene that is lit by a submission's code.
pub trait LitRoom {
    /// Calls `direct` for the surface that the ray hits. Returns zero if it hits nothing.
    fn direct_light(&self, sample: &DirectSample) -> Vec3;

    /// Calls `radiance`.
    fn path_light(&self, start: &PathStart) -> Vec3;
}
