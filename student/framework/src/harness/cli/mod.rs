//! The command that renders a scene with a submission's code.

mod bench;
mod canvas;
mod error;
pub mod examples;
mod files;
mod image_file;
mod options;
mod parallel;
mod picture;
mod pixel;
mod progress;
mod slow;
mod stages;

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::Instant;

use clap::Parser;
use glam::{UVec2, Vec2};
use protocol::{Shape, Trace, Tree};

use crate::harness::attempt::keep_panics_quiet;
use crate::harness::cli::canvas::{Canvas, Event};
use crate::harness::cli::error::{RenderError, call};
use crate::harness::cli::options::Options;
use crate::harness::cli::parallel::RenderPool;
use crate::harness::cli::picture::Picture;
use crate::harness::cli::progress::Progress;
use crate::harness::view;
use crate::render::film::Film;
use crate::render::rectangles::{GivenRectangles, first_other_shape};
use crate::render::renderer::{Lighting, RenderStats, Renderer};
use crate::scene::Scene;
use crate::submission::{Submission, World};

/// Runs the command. `light` is part two's code. Without it, there is no shaded view. Exit codes: 0
/// for success, 1 if the submission's code panicked, 2 for invalid input, 130 after Ctrl-C.
pub fn main(submission: &dyn Submission, light: Option<&dyn Lighting>) -> ExitCode {
    let options = match Options::try_parse() {
        Ok(options) => options,
        Err(error) => {
            // Print help to standard output and errors to standard error. If the stream is closed,
            // there is no way to report that.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    keep_panics_quiet();
    let events = Events::new();
    let ran = events
        .keep_picture_on_ctrl_c()
        .and_then(|()| run(submission, light, &options, &events));
    match ran {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            error.exit_code()
        }
    }
}

/// The events that occur while a picture is rendered.
struct Events {
    sender: Sender<Event>,
    receiver: Receiver<Event>,
    /// Whether there is an unfinished picture that Ctrl-C should keep.
    has_picture: Arc<AtomicBool>,
}

impl Events {
    fn new() -> Self {
        let (sender, receiver) = channel();
        Events {
            sender,
            receiver,
            has_picture: Arc::default(),
        }
    }

    fn keep_picture_on_ctrl_c(&self) -> Result<(), RenderError> {
        let (sender, has_picture) = (self.sender.clone(), Arc::clone(&self.has_picture));
        ctrlc::set_handler(move || {
            // Only keep the picture the first time, so that a second Ctrl-C always ends the
            // process.
            let is_kept = has_picture.swap(false, Ordering::Relaxed);
            if !is_kept || sender.send(Event::Interrupted).is_err() {
                std::process::exit(canvas::INTERRUPTED);
            }
        })
        .map_err(RenderError::threads)
    }
}

/// A scene, converted to the submission's types, and everything needed to render it.
struct Job<'a> {
    options: &'a Options,
    picture: &'a Picture<'a>,
    scene: &'a Scene,
    world: &'a World,
    tree: &'a Tree,
    pool: &'a RenderPool,
    out: &'a Path,
}

fn run(
    submission: &dyn Submission,
    light: Option<&dyn Lighting>,
    options: &Options,
    events: &Events,
) -> Result<(), RenderError> {
    let path = files::find_scene(&options.scene)?;
    let loading = format!("loading {}", path.display());
    let (scene, names) = stages::show(&loading, || Scene::load_with_names(&path))?;
    let scene = &scene.on_film(options.size.unwrap_or(scene.camera.pinhole.film));
    let out = &files::output_path(options, &path)?;
    let rectangles = GivenRectangles(submission);
    let submission = if options.rectangles {
        refuse_other_shapes(scene)?;
        &rectangles
    } else {
        submission
    };
    let pool = &RenderPool::new(scene.camera.pinhole.film, options.threads)?;

    let (world, tree) = &stages::build(submission, scene)?;
    stages::try_methods(submission, scene, world, tree)?;
    // Trace one ray first, so that if the submission still contains a stub, the stub's panic is the
    // only message.
    let corner = UVec2::ZERO;
    call(Some(corner), || first_hit(scene, world, corner))?;
    let picture = &Picture::new(options, light, scene, world)?;
    if let Some(pixel) = options.pixel {
        let renderer = picture.renderer.as_deref();
        return pixel::print(pixel, options, scene, &names, world, renderer);
    }
    // Rectangles need no tree.
    let note = (!options.rectangles).then(|| slow::note(submission, scene, tree));
    if let Some(note) = note.flatten() {
        eprintln!("{note}");
    }
    let job = Job {
        options,
        picture,
        scene,
        world,
        tree,
        pool,
        out,
    };
    let renderer = picture.renderer.as_deref();
    if let (true, Some(renderer)) = (options.bench, renderer) {
        let measured = bench::measure(&job, renderer)?;
        println!("{}", measured.compare(&files::bench_file(&path, pool))?);
        return Ok(());
    }
    let started = Instant::now();
    let (film, stats) = match renderer {
        Some(renderer) => render_light(&job, renderer, events)?,
        None => render_hits(&job)?,
    };
    let time = started.elapsed();
    image_file::write(&film, picture.tone(options), out)?;
    println!("{}", progress::summary(out, film.size, stats, time));
    for note in stats.notes() {
        eprintln!("note: {note}");
    }
    Ok(())
}

/// Fails if a scene contains anything but rectangles.
fn refuse_other_shapes(scene: &Scene) -> Result<(), RenderError> {
    let other = first_other_shape(&scene.shapes);
    let message = |index: usize| {
        let kind = match scene.shapes[index] {
            Shape::Sphere { .. } => "a sphere",
            Shape::Triangle { .. } | Shape::FlatTriangle { .. } => "a triangle or another polygon",
        };
        RenderError::Other(format!(
            "--rectangles only works for scenes made of rectangles, such as `lamp`, but this one \
             contains {kind}: leave out the option or choose another scene"
        ))
    };
    other.map_or(Ok(()), |index| Err(message(index)))
}

/// Renders a picture of first hits.
fn render_hits(job: &Job) -> Result<(Film, RenderStats), RenderError> {
    let Job {
        picture: Picture { view, .. },
        scene,
        world,
        ..
    } = *job;
    let size = scene.camera.pinhole.film;
    let progress = Progress::new(u64::from(size.y), "");
    let first = |pixel, stats: &mut RenderStats| {
        stats.rays += 1;
        first_hit(scene, world, pixel)
    };
    let hits = job.pool.render(&progress, first)?;
    let raw = image_file::holds_numbers(job.out).then(|| view::raw_values(*view, &hits));
    let pixels = raw
        .flatten()
        .unwrap_or_else(|| view::picture(*view, &hits, job.tree, scene.extent()));
    Ok((Film { size, pixels }, progress.stats()))
}

/// Renders the picture in passes and writes it every second.
fn render_light(
    job: &Job,
    renderer: &dyn Renderer,
    events: &Events,
) -> Result<(Film, RenderStats), RenderError> {
    let Job { options, out, .. } = *job;
    let size = job.scene.camera.pinhole.film;
    let canvas = &Canvas::new(size);
    let samples = options.samples;
    let rows = u64::from(size.y) * u64::from(samples);
    let progress = &Progress::new(rows, ". The picture so far is in the file");
    thread::scope(|scope| {
        let Events {
            sender,
            receiver,
            has_picture,
        } = events;
        let (tone, finished) = (job.picture.tone(options), sender.clone());
        has_picture.store(true, Ordering::Relaxed);
        let rendering = scope.spawn(move || {
            let sample = |pixel, sample, stats: &mut RenderStats| {
                renderer.sample_radiance(pixel, sample, stats)
            };
            let rendered = job.pool.accumulate(progress, canvas, samples, sample);
            // The receiver below is still alive.
            let _ = finished.send(Event::Finished);
            rendered
        });
        canvas.write_until_finished(receiver, tone, out, samples);
        has_picture.store(false, Ordering::Relaxed);
        rendering
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })?;
    Ok((canvas.film().0, progress.stats()))
}

/// Returns the hit of the ray through the centre of a pixel.
fn first_hit(scene: &Scene, world: &World, pixel: UVec2) -> Option<Trace> {
    let ray = world.camera.ray(pixel, Vec2::splat(0.5));
    world
        .bvh
        .closest_hit(&scene.camera.placement.to_world(&ray))
}

#[cfg(test)]
mod tests;
