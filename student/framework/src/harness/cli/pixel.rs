//! Prints information about one pixel: the shape that is hit at the pixel's centre and, if the view
//! shows light, the pixel's radiance.

use std::fmt::Write;

use glam::{UVec2, Vec3};
use protocol::{Shape, Trace};

use super::error::{RenderError, call};
use super::first_hit;
use super::options::Options;
use crate::render::path_log::follow;
use crate::render::path_steps::{Step, bounces};
use crate::render::renderer::{RenderStats, Renderer};
use crate::scene::{Material, Scene};
use crate::submission::World;

/// Prints the hit and the radiance, if any, of one pixel without rendering anything else. This is
/// useful in a debugger.
pub(super) fn print(
    pixel: UVec2,
    options: &Options,
    scene: &Scene,
    names: &[String],
    world: &World,
    renderer: Option<&dyn Renderer>,
) -> Result<(), RenderError> {
    let size = scene.camera.pinhole.film;
    if pixel.cmpge(size).any() {
        let UVec2 { x, y } = size;
        let message = format!("pixel {pixel} is outside the film, which has {x} x {y} pixels");
        return Err(RenderError::Other(message));
    }
    let hit = call(Some(pixel), || first_hit(scene, world, pixel))?;
    print!("{}", description(pixel, scene, names, hit.as_ref()));

    let Some(renderer) = renderer else {
        return Ok(());
    };
    let mut stats = RenderStats {
        rays: 1,
        ..RenderStats::default()
    };
    let samples = options.samples;
    let radiance = || renderer.pixel_radiance(pixel, samples, &mut stats);
    let light = call(Some(pixel), radiance)?;
    println!(
        "  radiance  {light}, from {samples} samples and {} rays",
        stats.rays
    );
    let first = || follow(|| renderer.sample_radiance(pixel, 0, &mut stats));
    let (light, steps) = call(Some(pixel), first)?;
    print!("{}", description_of_path(light, &steps));
    Ok(())
}

/// Returns the lines that describe the path of a pixel's first sample. Clay has no paths.
fn description_of_path(radiance: Vec3, steps: &[Step]) -> String {
    if steps.is_empty() {
        return String::new();
    }
    let mut text = format!("path of the first sample, whose radiance is {radiance}:\n");
    let bounces = bounces(steps);
    let ends = bounces.iter().skip(1).map(|next| next.first_step as usize);
    for (bounce, end) in bounces.iter().zip(ends.chain([steps.len()])) {
        let throughput = bounce.throughput;
        text += &format!("  bounce {}, throughput {throughput:.4}:\n", bounce.number);
        for step in &steps[bounce.first_step as usize..end] {
            text += &format!("    {step}\n");
        }
        for bad in &bounce.bad_values {
            text += &format!("    wrong: {bad}\n");
        }
    }
    text
}

/// Returns the lines that describe the hit at a pixel's centre.
fn description(pixel: UVec2, scene: &Scene, names: &[String], hit: Option<&Trace>) -> String {
    let mut text = format!("pixel {pixel}, at its centre:\n");
    let Some(hit) = hit else {
        return text + "  the ray hits nothing, so the environment is visible\n";
    };
    let rows = [
        ("shape", shape_name(scene, hit.shape)),
        ("material", material_name(scene, names, hit.shape)),
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

fn shape_name(scene: &Scene, number: u32) -> String {
    let Some(shape) = scene.shapes.get(number as usize) else {
        return format!("unknown, because the scene has no shape with index {number}");
    };
    let triangle = |[a, b, c]: [Vec3; 3]| format!("a triangle with corners {a}, {b} and {c}");
    let name = match *shape {
        Shape::Sphere { center, radius, .. } => {
            format!("a sphere with centre {center} and radius {radius}")
        }
        Shape::Triangle { vertices, .. } => triangle(vertices.map(|vertex| vertex.position)),
        Shape::FlatTriangle { corners, .. } => triangle(corners),
    };
    format!("{name}, number {} of {}", number + 1, scene.shapes.len())
}

/// Returns the name and the kind of this shape's material.
fn material_name(scene: &Scene, names: &[String], shape: u32) -> String {
    let index = scene.shape_materials.get(shape as usize);
    let name = index.and_then(|&index| names.get(index as usize));
    let (Some(name), Some(material)) = (name, scene.material_of(shape)) else {
        return "unknown, because the shape is unknown".to_owned();
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
