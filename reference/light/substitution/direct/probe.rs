//! The probe for a submission's `direct.rs` that is graded with the reference's parts. It answers
//! questions about direct light.

use parts::*;

mod direct;
mod exam;

/// No path is followed here, because paths use direct light themselves.
mod path {
    use framework::render::sampler::Sampler;
    use glam::Vec3;
    use protocol::Ray;

    use crate::world::World;

    pub fn radiance(_: &World, _: Ray, _: &Sampler, _: u32) -> Vec3 {
        unreachable!("this probe is only asked about direct light")
    }
}

fn main() -> std::process::ExitCode {
    framework::harness::probe::main(&exam::Student)
}
