//! The command that draws a scene with a submission's code.

mod draw;
mod failure;
mod files;
mod options;
mod picture;
mod progress;

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use glam::{UVec2, Vec2, Vec3};
use protocol::{Trace, Tree};

use crate::attempt::{attempt, keep_panics_quiet};
use crate::cli::draw::{Canvas, finished};
use crate::cli::failure::Failure;
use crate::cli::options::Options;
use crate::cli::progress::Progress;
use crate::film::{Film, Tone};
use crate::integrator::{Integrator, Tally};
use crate::scene::Scene;
use crate::submission::{Submission, World};
use crate::view::{self, View};

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

fn run(submission: &dyn Submission, options: &Options) -> Result<(), Failure> {
    let path = files::find_scene(&options.scene)?;
    let scene = Scene::load(&path)?;
    let scene = scene.on_film(options.size.unwrap_or(scene.camera.lens.film));
    let out = files::output(options, &path)?;
    let canvas = Canvas::new(scene.camera.lens.film, options.threads)?;

    canvas.with_room(|| show(submission, options, &scene, &out, &canvas))
}

/// Makes the submission's world, and of it a picture or the words for one pixel.
fn show(
    submission: &dyn Submission,
    options: &Options,
    scene: &Scene,
    out: &Path,
    canvas: &Canvas,
) -> Result<(), Failure> {
    let world = finished(attempt(|| World::new(submission, scene)), None)?;
    let tree = finished(attempt(|| world.tree()), None)?;
    if let Some(pixel) = options.pixel {
        return look_at(pixel, options, scene, &world);
    }

    // A stub is met by the first ray, and then is all that there is to tell.
    let corner = UVec2::ZERO;
    let first = || first_hit(scene, &world, corner, &mut Tally::default());
    finished(attempt(first), Some(corner))?;
    if tree.nodes.is_empty() && !scene.shapes.is_empty() {
        let count = scene.shapes.len();
        eprintln!("note: task 3, build: no tree yet, so each ray may ask all {count} primitives");
    }
    let started = Instant::now();
    let (film, tally) = draw(canvas, options, scene, &world, &tree)?;
    let time = started.elapsed();
    picture::write(&film, options.tone(), out)?;
    println!("{}", progress::summary(out, film.size, tally, time));
    if tally.spoiled > 0 {
        let spoiled = tally.spoiled;
        eprintln!(
            "note: {spoiled} paths are black, since an answer held NaN or infinity, a normal of \
             length zero, or an unknown material"
        );
    }
    Ok(())
}

fn draw(
    canvas: &Canvas,
    options: &Options,
    scene: &Scene,
    world: &World,
    tree: &Tree,
) -> Result<(Film, Tally), Failure> {
    let size = scene.camera.lens.film;
    let progress = Progress::new(size.y);
    let integrator = Integrator::new(scene, world, options.sampling(size));
    let (pixels, tally) = match options.view {
        View::Shaded => canvas.draw(&progress, |pixel, tally| integrator.pixel(pixel, tally))?,
        View::Normals | View::Depth | View::Uv | View::Bvh => {
            let first = |pixel, tally: &mut Tally| first_hit(scene, world, pixel, tally);
            let (hits, tally) = canvas.draw(&progress, first)?;
            let epsilon = integrator.epsilon();
            (view::picture(options.view, &hits, tree, epsilon), tally)
        }
    };
    Ok((Film { size, pixels }, tally))
}

/// What the ray through the middle of a pixel meets.
fn first_hit(scene: &Scene, world: &World, pixel: UVec2, tally: &mut Tally) -> Option<Trace> {
    tally.rays += 1;
    let ray = world.camera_ray(pixel, Vec2::splat(0.5));
    world.hit(&scene.camera.placement.to_world(&ray))
}

/// One pixel alone, for a debugger: what its middle meets, and its light.
fn look_at(pixel: UVec2, options: &Options, scene: &Scene, world: &World) -> Result<(), Failure> {
    let size = scene.camera.lens.film;
    if pixel.cmpge(size).any() {
        return Err(Failure::NoSuchPixel { pixel, size });
    }
    let integrator = Integrator::new(scene, world, options.sampling(size));
    let mut tally = Tally::default();
    let first = finished(
        attempt(|| first_hit(scene, world, pixel, &mut tally)),
        Some(pixel),
    )?;
    println!("pixel {pixel}, its middle: {first:#?}");
    let light = attempt(|| integrator.pixel(pixel, &mut tally));
    let light: Vec3 = finished(light, Some(pixel))?;
    println!("light: {light} by {} rays", tally.rays);
    Ok(())
}

impl Options {
    fn tone(&self) -> Tone {
        match self.view {
            View::Shaded => Tone::Light {
                stops: self.exposure,
            },
            View::Normals | View::Depth | View::Uv | View::Bvh => Tone::Data,
        }
    }
}

#[cfg(test)]
mod tests;
