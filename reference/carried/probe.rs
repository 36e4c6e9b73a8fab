//! Answers the grader as the given crate does, with right parts around the submission's `bvh.rs`.

use parts::{bbox, camera, primitive};

mod bvh;
mod world;

fn main() -> std::process::ExitCode {
    framework::probe::main(&world::Student)
}
