//! The command that draws a scene with a submission's code.

mod error;
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

/// Draws what the command line asks for. Exit codes: 0 drawn, 1 the submission's code did not get
/// through, 2 bad input.
pub fn main(submission: &dyn Submission) -> ExitCode {
    let options = match Options::try_parse() {
        Ok(options) => options,
        Err(error) => {
            // Help goes to standard output, mistakes to standard error; neither can be told if
            // the stream is closed.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    keep_panics_quiet();
    match run(submission, &options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            failure.exit_code()
        }
    }
}

fn run(submission: &dyn Submission, options: &Options) -> Result<(), RenderError> {
    let path = files::find_scene(&options.scene)?;
    let scene = Scene::load(&path)?;
    let scene = scene.on_film(options.size.unwrap_or(scene.camera.pinhole.film));
    let out = files::output_path(options, &path)?;
    let canvas = RenderPool::new(scene.camera.pinhole.film, options.threads)?;

    canvas.run(|| render_or_print(submission, options, &scene, &out, &canvas))
}

/// Makes the submission's world, and of it a picture or the words for one pixel.
fn render_or_print(
    submission: &dyn Submission,
    options: &Options,
    scene: &Scene,
    out: &Path,
    canvas: &RenderPool,
) -> Result<(), RenderError> {
    let world = value_or_error(attempt(|| World::new(submission, scene)), None)?;
    let tree = value_or_error(attempt(|| world.tree()), None)?;
    if let Some(pixel) = options.pixel {
        return print_pixel(pixel, options, scene, &world);
    }

    // A stub is met by the first ray, and then is all that there is to tell.
    let corner = UVec2::ZERO;
    let first = || first_hit(scene, &world, corner, &mut RenderStats::default());
    value_or_error(attempt(first), Some(corner))?;
    if tree.nodes.is_empty() && !scene.shapes.is_empty() {
        let count = scene.shapes.len();
        eprintln!("note: task 3, build: no tree yet, so each ray may ask all {count} primitives");
    }
    let started = Instant::now();
    let (film, tally) = render(canvas, options, scene, &world, &tree)?;
    let time = started.elapsed();
    image_file::write(&film, options.tone(), out)?;
    println!("{}", progress::summary(out, film.size, tally, time));
    if tally.invalid_paths > 0 {
        let spoiled = tally.invalid_paths;
        eprintln!(
            "note: {spoiled} paths are black, since an answer held NaN or infinity, a normal of \
             length zero, or an unknown material"
        );
    }
    Ok(())
}

fn render(
    canvas: &RenderPool,
    options: &Options,
    scene: &Scene,
    world: &World,
    tree: &Tree,
) -> Result<(Film, RenderStats), RenderError> {
    let size = scene.camera.pinhole.film;
    let progress = Progress::new(size.y);
    let integrator = Integrator::new(scene, world, options.sampling(size));
    let (pixels, tally) = match options.view {
        ViewMode::Shaded => canvas.render(&progress, |pixel, tally| {
            integrator.pixel_radiance(pixel, tally)
        })?,
        ViewMode::Normals | ViewMode::Depth | ViewMode::Uv | ViewMode::Bvh => {
            let first = |pixel, tally: &mut RenderStats| first_hit(scene, world, pixel, tally);
            let (hits, tally) = canvas.render(&progress, first)?;
            let epsilon = integrator.epsilon();
            (view::picture(options.view, &hits, tree, epsilon), tally)
        }
    };
    Ok((Film { size, pixels }, tally))
}

/// What the ray through the middle of a pixel meets.
fn first_hit(scene: &Scene, world: &World, pixel: UVec2, tally: &mut RenderStats) -> Option<Trace> {
    tally.rays += 1;
    let ray = world.camera_ray(pixel, Vec2::splat(0.5));
    world.hit(&scene.camera.placement.to_world(&ray))
}

/// One pixel alone, for a debugger: what its middle meets, and its light.
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
    let integrator = Integrator::new(scene, world, options.sampling(size));
    let mut tally = RenderStats::default();
    let first = value_or_error(
        attempt(|| first_hit(scene, world, pixel, &mut tally)),
        Some(pixel),
    )?;
    println!("pixel {pixel}, its middle: {first:#?}");
    let light = attempt(|| integrator.pixel_radiance(pixel, &mut tally));
    let light: Vec3 = value_or_error(light, Some(pixel))?;
    println!("light: {light} by {} rays", tally.rays);
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
