//! Finds out whether part two is written, since pictures are drawn in clay until then.

use glam::UVec2;
use protocol::Panic;

use crate::harness::attempt::attempt;
use crate::render::renderer::{Lighting, PathSettings, RenderStats, Renderer};
use crate::scene::Scene;
use crate::submission::World;

/// Creates the path tracer of part two and traces one sample with it.
///
/// # Errors
/// Fails if the code for this sample isn't written yet, or if the path tracer cannot be created.
pub fn written_path_tracer<'a>(
    light: &dyn Lighting,
    scene: &'a Scene,
    world: &'a World,
    settings: PathSettings,
) -> Result<Box<dyn Renderer + 'a>, Panic> {
    let path_tracer = attempt(|| light.path_tracer(scene, world, settings))?;
    let mut stats = RenderStats::default();
    match attempt(|| path_tracer.trace_sample(UVec2::ZERO, 0, &mut stats)) {
        Err(panic) if panic.is_unimplemented() => Err(panic),
        // Any other panic is reported along with its pixel when the picture is rendered.
        _ => Ok(path_tracer),
    }
}
