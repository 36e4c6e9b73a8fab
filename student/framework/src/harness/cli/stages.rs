//! The steps before the first pixel. Each step prints what it is doing, since an infinite loop
//! would otherwise look like a large scene. A step that calls the submission's code runs on a
//! thread named after the task, since the message about a stack overflow contains only the thread's
//! name.

use std::thread;
use std::time::Duration;

use glam::{Vec2, Vec3};
use indicatif::{ProgressBar, ProgressStyle};
use protocol::{Interval, Ray, Shape, Tree};

use super::error::{RenderError, call};
use super::progress::Notice;
use crate::harness::attempt::attempt;
use crate::harness::probe::STACK_BYTES;
use crate::scene::Scene;
use crate::submission::{Submission, World};

/// How long to wait before printing that a step is still running.
const LONG: Duration = Duration::from_secs(5);

/// Runs a step and shows its name: immediately if standard error is a terminal, otherwise only if
/// the step takes a long time.
pub(super) fn show<T>(step: &str, code: impl FnOnce() -> T) -> T {
    let spinner = ProgressBar::new_spinner().with_message(format!("{step} …"));
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
        spinner.set_style(style);
    }
    spinner.enable_steady_tick(Duration::from_millis(100));
    let notice = spinner
        .is_hidden()
        .then(|| Notice::after(LONG, format!("{step}: still running")));
    let value = code();
    drop(notice);
    spinner.finish_and_clear();
    value
}

/// Runs a step that calls the submission's code, on a separate thread named after the task.
fn run<T: Send>(
    task: &str,
    step: &str,
    code: impl FnOnce() -> Result<T, RenderError> + Send,
) -> Result<T, RenderError> {
    show(&format!("{task}: {step}"), || {
        thread::scope(|scope| {
            let thread = thread::Builder::new()
                .name(task.to_owned())
                .stack_size(STACK_BYTES)
                .spawn_scoped(scope, code)
                .map_err(RenderError::threads)?;
            thread
                .join()
                .unwrap_or_else(|_| Err(RenderError::threads("a thread panicked")))
        })
    })
}

/// Converts the scene to the submission's types and builds the tree.
pub(super) fn build(
    submission: &dyn Submission,
    scene: &Scene,
) -> Result<(World, Tree), RenderError> {
    let camera = run("task 1, camera", "Camera::new", || {
        call(None, || submission.camera(&scene.camera.pinhole))
    })?;
    let count = scene.shapes.len();
    let step = format!("Bvh::build over {count} primitives");
    run("task 3, build", &step, || {
        let bvh = call(None, || {
            submission.build(&scene.shapes, scene.max_leaf_size)
        })?;
        let tree = call(None, || bvh.tree())?;
        Ok((World { camera, bvh }, tree))
    })
}

/// Calls each method that rendering will call, with one ray. Errors aren't reported here, because
/// not every picture calls every method.
pub(super) fn try_methods(
    submission: &dyn Submission,
    scene: &Scene,
    world: &World,
    tree: &Tree,
) -> Result<(), RenderError> {
    let middle = scene.camera.pinhole.film / 2;
    let camera_ray = run("task 1, camera", "Camera::sample_ray", || {
        call(Some(middle), || world.camera.ray(middle, Vec2::splat(0.5)))
    })?;
    if let Some(note) = not_numbers(&camera_ray) {
        eprintln!("{note}");
    }
    let ray = &scene.camera.placement.to_world(&camera_ray);
    let is_triangle = |shape: &&Shape| !matches!(shape, Shape::Sphere { .. });
    let is_sphere = |shape: &&Shape| matches!(shape, Shape::Sphere { .. });
    let triangle = scene.shapes.iter().find(is_triangle);
    let sphere = scene.shapes.iter().find(is_sphere);
    for (task, step, shape) in [
        ("task 2, triangle", "Triangle::hit", triangle),
        ("task 2, sphere", "Sphere::hit", sphere),
    ] {
        if let Some(shape) = shape {
            try_method(task, step, || {
                submission.primitive_list(&[*shape]).closest_hit(ray);
            })?;
        }
    }
    // An empty tree needs no box tests.
    if !tree.nodes.is_empty() {
        let toward = Ray::new(Vec3::splat(2.0), Vec3::NEG_ONE);
        try_method("task 3, bbox", "BBox::hit", || {
            let times = Interval::new(0.0, f32::INFINITY);
            submission.intersect_box(Vec3::ZERO, Vec3::ONE, &toward, times);
        })?;
    }
    try_method("task 3, traverse", "Bvh::hit", || {
        world.bvh.closest_hit(ray);
    })
}

/// Returns a message if a camera ray contains NaN or infinity. Without this message, only the ray's
/// hits would look wrong.
fn not_numbers(ray: &Ray) -> Option<String> {
    let is_finite = ray.origin.is_finite() && ray.dir.is_finite();
    (!is_finite).then(|| {
        format!(
            "note: task 1, camera: the ray through the middle of the film contains NaN or infinity, so it \
             hits nothing: origin {}, dir {}",
            ray.origin, ray.dir
        )
    })
}

fn try_method(task: &str, step: &str, method: impl FnOnce() + Send) -> Result<(), RenderError> {
    run(task, step, || {
        drop(attempt(method));
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_ray_that_is_not_made_of_numbers_is_named() {
        let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
        assert_eq!(not_numbers(&ray), None);
        let broken = Ray {
            dir: Vec3::splat(f32::NAN),
            ..ray
        };
        let note = not_numbers(&broken).unwrap();
        assert!(
            note.ends_with("origin [0, 0, 0], dir [NaN, NaN, NaN]"),
            "{note}"
        );
    }
}
