//! Prints one pixel: which shape is hit at its centre, and what the pixel's radiance is.

use std::fmt::Write;

use glam::{UVec2, Vec3};
use protocol::{Shape, Trace};

use super::error::RenderError;
use super::options::Options;
use super::parallel::value_or_error;
use super::{first_hit, stages};
use crate::attempt::attempt;
use crate::integrator::{Integrator, RenderStats};
use crate::scene::{Material, Scene};
use crate::submission::{Submission, World};

/// Prints the hit and the radiance of one pixel, and renders nothing else. This is useful in a
/// debugger.
pub(super) fn print(
    pixel: UVec2,
    options: &Options,
    submission: &dyn Submission,
    scene: &Scene,
    names: &[String],
    world: &World,
) -> Result<(), RenderError> {
    let size = scene.camera.pinhole.film;
    if pixel.cmpge(size).any() {
        return Err(RenderError::PixelOutsideFilm { pixel, size });
    }
    let mut stats = RenderStats::default();
    let hit_by = |scene: &Scene, world: &World, stats: &mut RenderStats| {
        value_or_error(
            attempt(|| first_hit(scene, world, pixel, stats)),
            Some(pixel),
        )
    };
    let hit = hit_by(scene, world, &mut stats)?;
    // The same ray in a scene whose shapes have their own number as their material.
    let numbered = numbered(scene);
    let (numbered_world, _) = stages::build(submission, &numbered)?;
    let number = hit_by(&numbered, &numbered_world, &mut RenderStats::default())?;
    let number = number.map(|hit| hit.material as usize);
    print!("{}", description(pixel, scene, names, hit.as_ref(), number));

    let integrator = Integrator::new(scene, world, options.settings(size));
    let light = attempt(|| integrator.pixel_radiance(pixel, &mut stats));
    let light: Vec3 = value_or_error(light, Some(pixel))?;
    let samples = options.samples;
    println!(
        "  radiance  {light}, from {samples} samples and {} rays",
        stats.rays
    );
    Ok(())
}

fn numbered(scene: &Scene) -> Scene {
    let with_number = |(number, shape): (usize, &Shape)| {
        let number = number as u32;
        match *shape {
            Shape::Triangle { vertices, .. } => Shape::Triangle {
                vertices,
                material: number,
            },
            Shape::FlatTriangle { corners, .. } => Shape::FlatTriangle {
                corners,
                material: number,
            },
            Shape::Sphere { center, radius, .. } => Shape::Sphere {
                center,
                radius,
                material: number,
            },
        }
    };
    Scene {
        shapes: scene.shapes.iter().enumerate().map(with_number).collect(),
        ..scene.clone()
    }
}

/// Returns the lines about the hit at a pixel's centre. `number` is the index of the shape.
fn description(
    pixel: UVec2,
    scene: &Scene,
    names: &[String],
    hit: Option<&Trace>,
    number: Option<usize>,
) -> String {
    let mut text = format!("pixel {pixel}, at its centre:\n");
    let Some(hit) = hit else {
        return text + "  nothing is hit, so the environment is visible\n";
    };
    let rows = [
        ("shape", shape_name(scene, number)),
        ("material", material_name(scene, names, hit.material)),
        ("distance", hit.distance.to_string()),
        ("position", hit.position.to_string()),
        (
            "normal",
            format!("{}, of length {}", hit.normal, hit.normal.length()),
        ),
        ("uv", hit.uv.to_string()),
        ("origin", format!("{} (of the ray)", hit.origin)),
    ];
    for (label, value) in rows {
        writeln!(text, "  {label:<9} {value}").expect("writing to a string cannot fail");
    }
    text
}

fn shape_name(scene: &Scene, number: Option<usize>) -> String {
    let found = number.and_then(|number| Some((number, scene.shapes.get(number)?)));
    let Some((number, shape)) = found else {
        return "unknown, because the hit's material is not that of a shape".to_owned();
    };
    let name = match shape {
        Shape::Sphere { center, radius, .. } => {
            format!("a sphere with centre {center} and radius {radius}")
        }
        Shape::Triangle { vertices, .. } => {
            let [a, b, c] = vertices.map(|vertex| vertex.position);
            format!("a triangle with corners {a}, {b} and {c}")
        }
        Shape::FlatTriangle {
            corners: [a, b, c], ..
        } => {
            format!("a triangle with corners {a}, {b} and {c}")
        }
    };
    format!("{name}, number {} of {}", number + 1, scene.shapes.len())
}

fn material_name(scene: &Scene, names: &[String], material: u32) -> String {
    let index = material as usize;
    let (Some(name), Some(material)) = (names.get(index), scene.materials.get(index)) else {
        return format!("{material}, which the scene does not define");
    };
    let kind = match material {
        Material::Lambertian { .. } => "matte",
        Material::Checker { .. } => "a chequerboard",
        Material::Mirror { .. } => "a mirror",
        Material::Glass { .. } => "glass",
        Material::Emitter { .. } => "a light",
    };
    format!("{name} ({kind})")
}
