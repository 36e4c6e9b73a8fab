//! Tests of the whole command, from its arguments to the written file.

use std::fs;
use std::path::Path;

use clap::Parser;
use glam::{UVec2, Vec3};
use protocol::Ray;

use super::options::Options;
use super::{Events, run};
use crate::harness::attempt::keep_panics_quiet;
use crate::render::renderer::{InvalidSample, Lighting, PathSettings, RenderStats, Renderer};
use crate::scene::Scene;
use crate::submission::{Submission, World};
use crate::tests::{CORRECT, Folder, SphereSubmission};

const SCENE: &str = r#"{
  "camera": { "vertical_fov": 90, "film": [12, 8], "position": [0, 0, 0], "look_at": [0, 0, -1], "up": [0, 1, 0] },
  "environment": [0.5, 0.6, 0.7],
  "materials": {
    "grey": { "lambertian": { "albedo": [0.5, 0.5, 0.5] } },
    "glass": { "glass": { "ior": 1.5 } },
    "light": { "emitter": { "radiance": [4, 4, 4] } }
  },
  "shapes": [
    { "sphere": { "center": [-1, 0, -3], "radius": 1, "material": "grey" } },
    { "sphere": { "center": [1, 0, -3], "radius": 1, "material": "glass" } },
    { "sphere": { "center": [0, 4, -3], "radius": 2, "material": "light" } }
  ]
}"#;

/// A path tracer for tests, in which every sample has the same radiance.
#[derive(Clone, Copy)]
struct TestLight(fn() -> Vec3);

impl Lighting for TestLight {
    fn path_tracer<'a>(
        &self,
        _: &'a Scene,
        _: &'a World,
        _: PathSettings,
    ) -> Box<dyn Renderer + 'a> {
        Box::new(*self)
    }
}

impl Renderer for TestLight {
    fn trace_sample(&self, _: UVec2, _: u32, _: &mut RenderStats) -> Result<Vec3, InvalidSample> {
        let TestLight(sample) = self;
        Ok(sample())
    }
}

/// Runs the command without part two, with the output file `out` and the additional arguments
/// `more`. Returns the bytes of the file, or the error message.
fn render(submission: &dyn Submission, out: &str, more: &str) -> Result<Vec<u8>, String> {
    render_in(None, submission, out, more)
}

fn render_in(
    light: Option<&dyn Lighting>,
    submission: &dyn Submission,
    out: &str,
    more: &str,
) -> Result<Vec<u8>, String> {
    let folder = Folder::new();
    let scene = folder.write("spheres.json", SCENE).display().to_string();
    let out = folder.0.join(out).display().to_string();
    let arguments = ["render", &scene, &out].into_iter();
    let options = Options::try_parse_from(arguments.chain(more.split_whitespace()));
    let options = options.map_err(|error| error.to_string())?;
    run(submission, light, &options, &Events::new()).map_err(|error| error.to_string())?;
    fs::read(out).map_err(|error| error.to_string())
}

/// Runs the command with a correct submission.
fn picture(out: &str, more: &str) -> Vec<u8> {
    render(&CORRECT, out, more).expect("rendering succeeds")
}

#[test]
fn any_number_of_threads_writes_the_same_bytes() {
    for out in ["a.png", "a.exr"] {
        let one = picture(out, "--samples 3 --threads 1");
        assert!(one == picture(out, "--samples 3 --threads 3"), "{out}");
        let other = picture(out, "--samples 3 --seed 1");
        assert!(one != other, "{out}: the seed makes no difference");
    }
}

#[test]
fn the_upper_rows_of_the_picture_come_first_in_the_file() {
    let bytes = picture("a.png", "--size 3x3 --view normals");
    let picture = image::load_from_memory(&bytes).expect("the file is a PNG");
    let picture = picture.to_rgb8();
    // The upper pixel shows the light, and below the horizon nothing is hit.
    assert_ne!(picture.get_pixel(1, 0).0, [0; 3]);
    assert_eq!(picture.get_pixel(1, 2).0, [0; 3]);
}

#[test]
fn every_view_can_be_rendered() {
    let light = TestLight(|| Vec3::splat(0.5));
    for view in ["shaded", "clay", "normals", "depth", "uv", "bvh"] {
        let more = format!("--samples 1 --view {view}");
        render_in(Some(&light), &CORRECT, "a.png", &more).expect("rendering succeeds");
    }
}

#[test]
fn pictures_are_drawn_in_clay_until_part_two_is_written() {
    keep_panics_quiet();
    let with = |light: fn() -> Vec3, more: &str| {
        render_in(Some(&TestLight(light)), &CORRECT, "a.png", more)
    };
    let unwritten = || todo!("part two, path: how much light?");
    let clay = picture("a.png", "--view clay");
    assert!(picture("a.png", "") == clay);
    assert!(with(unwritten, "").as_ref() == Ok(&clay));
    assert!(with(|| Vec3::ONE, "") == with(|| Vec3::ONE, "--view shaded"));
    let error = with(unwritten, "--view shaded").expect_err("there is no light");
    assert!(
        error.starts_with("part two, path: not written yet"),
        "{error}"
    );
    let error = render(&CORRECT, "a.png", "--view shaded").expect_err("there is no part two");
    assert!(error.contains("use `cargo render`"), "{error}");
}

#[test]
fn reports_bad_input_before_rendering() {
    let error = |out, more| render(&CORRECT, out, more).expect_err("the input is invalid");
    assert!(error("a.jpg", "").ends_with("use a file name that ends in .png or .exr"));
    assert!(error("none/a.png", "").ends_with("none: it does not exist"));
    assert!(error("a.png", "--size 0x4").contains("the width and height must be from 1 to 16384"));
    assert!(error("a.png", "--view heat").contains("possible values: shaded, clay"));
    assert!(error("a.png", "--pixel 12,0").contains("outside the film, which has 12 x 8"));
}

#[test]
fn reports_the_pixel_of_a_panic_and_the_command_to_rerun_it() {
    keep_panics_quiet();
    let bug = SphereSubmission {
        ray: |_| panic!("attempt to subtract with overflow"),
        ..CORRECT
    };
    let message = render(&bug, "a.png", "--threads 1").expect_err("the camera panics");
    assert!(
        message.starts_with("panicked: attempt to subtract with overflow ("),
        "{message}"
    );
    assert!(
        message.contains("\n  at pixel [6, 4]; rerun with: cargo render --pixel 6,4"),
        "{message}"
    );
}

/// Recurses until the stack overflows.
fn recurse(depth: u64) -> u64 {
    let frame = std::hint::black_box([depth; 64]);
    if frame[1] == u64::MAX {
        return 0;
    }
    recurse(depth + 1) + frame[0]
}

/// A stack overflow ends the process, so the test runs itself in a child process.
#[test]
fn a_stack_overflow_names_the_task() {
    const IS_CHILD: &str = "FRAMEWORK_TEST_OVERFLOWS";
    if std::env::var_os(IS_CHILD).is_some() {
        let endless = SphereSubmission {
            ray: |_| Ray::new(Vec3::ZERO, Vec3::splat(recurse(0) as f32)),
            ..CORRECT
        };
        let ended = render(&endless, "a.png", "");
        panic!("the stack does not overflow: {ended:?}");
    }
    let child = std::process::Command::new(std::env::current_exe().expect("tests have a path"))
        .args([
            "--exact",
            "harness::cli::tests::a_stack_overflow_names_the_task",
            "--nocapture",
        ])
        .env(IS_CHILD, "1")
        .output()
        .expect("the test can be started");
    let message = String::from_utf8_lossy(&child.stderr);
    assert!(!child.status.success());
    assert!(
        message.contains("thread 'task 1, camera'") && message.contains("overflowed its stack"),
        "{message}"
    );
}

#[test]
fn an_exr_file_holds_the_distances_themselves() {
    let bytes = picture("a.exr", "--view depth --size 3x3");
    let picture = image::load_from_memory(&bytes);
    let picture = picture.expect("the file is an EXR").to_rgb32f();
    // The spheres at the sides have radius 1 and are at distance 3.
    let distance = picture.get_pixel(0, 1).0[0];
    assert!((2.0..3.5).contains(&distance), "{distance}");
}

#[test]
fn reports_the_name_of_a_missing_scene() {
    let options = Options::try_parse_from(["render", "no-such-scene"]).expect("the options parse");
    let message = run(&CORRECT, None, &options, &Events::new())
        .expect_err("the scene does not exist")
        .to_string();
    let expected = "cannot find the scene no-such-scene";
    assert!(message.starts_with(expected), "{message}");
    assert!(!Path::new("no-such-scene.png").exists());
}
