//! The command that renders a scene with a submission's code.

mod error;
pub mod examples;
mod files;
mod image_file;
mod options;
mod parallel;
mod progress;

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use glam::{UVec2, Vec2, Vec3};
use protocol::{Trace, Tree};

use crate::attempt::{attempt, keep_panics_quiet};
use crate::cli::error::RenderError;
use crate::cli::options::Options;
use crate::cli::parallel::{RenderPool, value_or_error};
use crate::cli::progress::Progress;
use crate::film::{Film, Tone};
use crate::integrator::{Integrator, RenderStats};
use crate::scene::Scene;
use crate::submission::{Submission, World};
use crate::view::{self, ViewMode};

/// Runs the command. Exit codes: 0 for success, 1 if the submission's code panicked, 2 for invalid
/// input.
pub fn main(submission: &dyn Submission) -> ExitCode {
    let options = match Options::try_parse() {
        Ok(options) => options,
        Err(error) => {
            // Prints help to standard output, and errors to standard error. If the stream is
            // closed, there is no way to report that.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    keep_panics_quiet();
    match run(submission, &options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            error.exit_code()
        }
    }
}

fn run(submission: &dyn Submission, options: &Options) -> Result<(), RenderError> {
    let path = files::find_scene(&options.scene)?;
    let scene = Scene::load(&path)?;
    let scene = scene.on_film(options.size.unwrap_or(scene.camera.pinhole.film));
    let out = files::output_path(options, &path)?;
    let pool = RenderPool::new(scene.camera.pinhole.film, options.threads)?;

    pool.run(|| render_or_print(submission, options, &scene, &out, &pool))
}

/// Converts the scene to the submission's types, and renders a picture or prints one pixel.
fn render_or_print(
    submission: &dyn Submission,
    options: &Options,
    scene: &Scene,
    out: &Path,
    pool: &RenderPool,
) -> Result<(), RenderError> {
    let world = value_or_error(attempt(|| World::new(submission, scene)), None)?;
    let tree = value_or_error(attempt(|| world.tree()), None)?;
    if let Some(pixel) = options.pixel {
        return print_pixel(pixel, options, scene, &world);
    }

    // Traces one ray first, so that if the submission still has a stub, the stub's panic is the
    // only message.
    let corner = UVec2::ZERO;
    let first = || first_hit(scene, &world, corner, &mut RenderStats::default());
    value_or_error(attempt(first), Some(corner))?;
    if tree.nodes.is_empty() && !scene.shapes.is_empty() {
        let count = scene.shapes.len();
        eprintln!("note: task 3, build: no tree yet, so each ray may test all {count} primitives");
    }
    let started = Instant::now();
    let (film, stats) = render(pool, options, scene, &world, &tree)?;
    let time = started.elapsed();
    image_file::write(&film, options.tone(), out)?;
    println!("{}", progress::summary(out, film.size, stats, time));
    if stats.invalid_paths > 0 {
        eprintln!(
            "note: paths that are black, because a hit contains NaN or infinity, a normal of \
             length zero, or an unknown material: {}",
            stats.invalid_paths
        );
    }
    Ok(())
}

fn render(
    pool: &RenderPool,
    options: &Options,
    scene: &Scene,
    world: &World,
    tree: &Tree,
) -> Result<(Film, RenderStats), RenderError> {
    let size = scene.camera.pinhole.film;
    let progress = Progress::new(size.y);
    let integrator = Integrator::new(scene, world, options.settings(size));
    let (pixels, stats) = match options.view {
        ViewMode::Shaded => pool.render(&progress, |pixel, stats| {
            integrator.pixel_radiance(pixel, stats)
        })?,
        ViewMode::Normals | ViewMode::Depth | ViewMode::Uv | ViewMode::Bvh => {
            let first = |pixel, stats: &mut RenderStats| first_hit(scene, world, pixel, stats);
            let (hits, stats) = pool.render(&progress, first)?;
            let epsilon = integrator.epsilon();
            (view::picture(options.view, &hits, tree, epsilon), stats)
        }
    };
    Ok((Film { size, pixels }, stats))
}

/// Returns the hit of the ray through the centre of a pixel.
fn first_hit(scene: &Scene, world: &World, pixel: UVec2, stats: &mut RenderStats) -> Option<Trace> {
    stats.rays += 1;
    let ray = world.camera_ray(pixel, Vec2::splat(0.5));
    world.hit(&scene.camera.placement.to_world(&ray))
}

/// Prints the hit and the radiance of one pixel, and renders nothing else. This is useful in a
/// debugger.
fn print_pixel(
    pixel: UVec2,
    options: &Options,
    scene: &Scene,
    world: &World,
) -> Result<(), RenderError> {
    let size = scene.camera.pinhole.film;
    if pixel.cmpge(size).any() {
        return Err(RenderError::PixelOutsideFilm { pixel, size });
    }
    let integrator = Integrator::new(scene, world, options.settings(size));
    let mut stats = RenderStats::default();
    let first = value_or_error(
        attempt(|| first_hit(scene, world, pixel, &mut stats)),
        Some(pixel),
    )?;
    println!("pixel {pixel}, hit at its centre: {first:#?}");
    let light = attempt(|| integrator.pixel_radiance(pixel, &mut stats));
    let light: Vec3 = value_or_error(light, Some(pixel))?;
    println!("radiance: {light}, traced rays: {}", stats.rays);
    Ok(())
}

impl Options {
    fn tone(&self) -> Tone {
        match self.view {
            ViewMode::Shaded => Tone::Light {
                stops: self.exposure,
            },
            ViewMode::Normals | ViewMode::Depth | ViewMode::Uv | ViewMode::Bvh => Tone::Data,
        }
    }
}

#[cfg(test)]
mod tests;
