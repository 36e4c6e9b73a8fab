//! The command, from its arguments to the file, with a submission of our own.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Parser;
use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, PinholeCamera, Ray, Shape, TreeNode};

use super::options::Options;
use super::run;
use crate::attempt::keep_panics_quiet;
use crate::sphere_submission::CORRECT;
use crate::submission::{Aggregate, CameraRays, Hierarchy, Submission};

const SCENE: &str = r#"{
  "camera": { "vertical_fov": 90, "film": [12, 8], "position": [0, 0, 0], "look_at": [0, 0, -1], "up": [0, 1, 0] },
  "environment": [0.5, 0.6, 0.7],
  "materials": {
    "grey": { "lambertian": { "albedo": [0.5, 0.5, 0.5] } },
    "glass": { "glass": { "ior": 1.5 } },
    "lamp": { "emitter": { "radiance": [4, 4, 4] } }
  },
  "shapes": [
    { "sphere": { "center": [-1, 0, -3], "radius": 1, "material": "grey" } },
    { "sphere": { "center": [1, 0, -3], "radius": 1, "material": "glass" } },
    { "sphere": { "center": [0, 4, -3], "radius": 2, "material": "lamp" } }
  ]
}"#;

/// A folder of our own with a scene in it.
fn folder(test: &str) -> PathBuf {
    let name = format!("framework-cli-{test}-{}", std::process::id());
    let folder = std::env::temp_dir().join(name);
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join("balls.json"), SCENE).expect("a scene");
    folder
}

/// Draws to a file of this name; its bytes, or what went wrong.
fn draw(submission: &dyn Submission, test: &str, out: &str, more: &str) -> Result<Vec<u8>, String> {
    let folder = folder(test);
    let path = |name: &str| folder.join(name).display().to_string();
    let mut arguments = vec!["render".to_owned(), path("balls.json"), path(out)];
    arguments.extend(more.split_whitespace().map(str::to_owned));
    let options = Options::try_parse_from(arguments).map_err(|error| error.to_string())?;
    let drawn = run(submission, &options).map_err(|failure| failure.to_string());
    let bytes = drawn.and_then(|()| fs::read(path(out)).map_err(|error| error.to_string()));
    // If it can not be removed, the system does so later.
    let _ = fs::remove_dir_all(&folder);
    bytes
}

#[test]
fn any_number_of_threads_writes_the_same_bytes() {
    for out in ["a.png", "a.exr"] {
        let one = draw(&CORRECT, "one", out, "--samples 3 --threads 1").expect("a picture");
        let three = draw(&CORRECT, "three", out, "--samples 3 --threads 3").expect("a picture");
        assert!(one == three, "{out}");
        let seed = draw(&CORRECT, "seed", out, "--samples 3 --seed 1").expect("a picture");
        assert!(one != seed, "{out}: the seed makes no difference");
    }
}

#[test]
fn the_upper_rows_of_the_picture_come_first_in_the_file() {
    let bytes = draw(&CORRECT, "top", "a.png", "--size 3x3 --bounces 0").expect("a picture");
    let picture = image::load_from_memory(&bytes).expect("a PNG").to_rgb8();
    // The lamp fills most of the upper pixel, and the lower one sees the environment alone.
    assert_eq!(picture.get_pixel(1, 0).0[0], 255);
    assert_eq!(picture.get_pixel(1, 2).0, [188, 203, 218]);
}

#[test]
fn every_view_is_drawn() {
    for view in ["shaded", "normals", "depth", "uv", "bvh"] {
        let test = format!("view-{view}");
        let drawn = draw(
            &CORRECT,
            &test,
            "a.png",
            &format!("--samples 1 --view {view}"),
        );
        assert!(drawn.is_ok(), "{view}: {drawn:?}");
    }
}

#[test]
fn reports_bad_input_before_rendering() {
    let refused =
        |out: &str, more: &str| draw(&CORRECT, "refused", out, more).expect_err("refused");
    assert!(refused("a.jpg", "").ends_with("end the picture's name with .png or .exr"));
    assert!(refused("none/a.png", "").ends_with("there is no such folder to write to"));
    assert!(refused("a.png", "--size 0x4").contains("each side must be from 1 to 16384"));
    assert!(refused("a.png", "--view heat").contains("possible values: shaded, normals"));
    assert!(refused("a.png", "--pixel 12,0").contains("outside of the film of 12 x 8"));
}

/// A submission that has come as far as `camera` lets it.
struct Unfinished {
    camera: fn() -> Ray,
}

impl Submission for Unfinished {
    fn camera(&self, _: &PinholeCamera) -> Box<dyn CameraRays> {
        Box::new(Unfinished { ..*self })
    }

    fn primitive_list(&self, shapes: &[Shape]) -> Box<dyn Aggregate> {
        CORRECT.primitive_list(shapes)
    }

    fn intersect_box(&self, min: Vec3, max: Vec3, ray: &Ray, times: Interval) -> Option<Interval> {
        CORRECT.intersect_box(min, max, ray, times)
    }

    fn build(&self, shapes: &[Shape], max_leaf_size: usize) -> Box<dyn Hierarchy> {
        CORRECT.build(shapes, max_leaf_size)
    }

    fn prebuilt_tree(
        &self,
        shapes: &[Shape],
        tree: &[TreeNode],
        root: usize,
    ) -> Box<dyn Hierarchy> {
        CORRECT.prebuilt_tree(shapes, tree, root)
    }
}

impl CameraRays for Unfinished {
    fn ray(&self, _: UVec2, _: Vec2) -> Ray {
        (self.camera)()
    }
}

#[test]
fn reports_an_unwritten_task_in_one_line() {
    keep_panics_quiet();
    let stub = Unfinished {
        camera: || todo!("task 1, camera: which ray of {:?} is it?", "Camera { .. }"),
    };
    let told = draw(&stub, "stub", "a.png", "").expect_err("it is not written");
    assert!(
        told.starts_with("task 1, camera: not written yet ("),
        "{told}"
    );
    assert!(told.contains("tests.rs:") && !told.contains('\n'), "{told}");
}

#[test]
fn reports_the_pixel_of_a_panic_and_the_command_to_rerun_it() {
    keep_panics_quiet();
    let bug = Unfinished {
        camera: || panic!("attempt to subtract with overflow"),
    };
    let told = draw(&bug, "bug", "a.png", "--threads 1").expect_err("it panics");
    assert!(
        told.starts_with("panicked: attempt to subtract with overflow ("),
        "{told}"
    );
    assert!(
        told.contains("\n  at pixel [0, 0]; again: cargo render "),
        "{told}"
    );
    assert!(told.ends_with("--pixel 0,0"), "{told}");
}

#[test]
fn reports_the_name_of_a_missing_scene() {
    let options = Options::try_parse_from(["render", "no-such-scene"]).expect("options");
    let told = run(&CORRECT, &options)
        .expect_err("there is none")
        .to_string();
    assert!(told.starts_with("no-such-scene: no such scene"), "{told}");
    assert!(!Path::new("no-such-scene.png").exists());
}
