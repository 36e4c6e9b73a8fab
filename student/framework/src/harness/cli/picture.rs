//! The view of a picture, and its renderer.

use super::error::{RenderError, SubmissionPanic, call};
use super::options::Options;
use crate::harness::lighting::written_path_tracer;
use crate::harness::view::ViewMode;
use crate::render::clay::Clay;
use crate::render::film::Tone;
use crate::render::renderer::{Lighting, PathSettings, Renderer};
use crate::scene::Scene;
use crate::submission::World;

/// The view of a picture, and its renderer.
pub(super) struct Picture<'a> {
    pub(super) view: ViewMode,
    /// `None` for a view of first hits.
    pub(super) renderer: Option<Box<dyn Renderer + 'a>>,
}

impl<'a> Picture<'a> {
    /// Chooses the renderer for the view. `world` must be made from `scene`. Without a view in the
    /// options, the picture shows light if part two is written, and clay otherwise.
    pub(super) fn new(
        options: &Options,
        light: Option<&dyn Lighting>,
        scene: &'a Scene,
        world: &'a World,
    ) -> Result<Self, RenderError> {
        let Options { bounces, seed, .. } = *options;
        let settings = PathSettings { bounces, seed };
        let clay =
            || -> Option<Box<dyn Renderer + 'a>> { Some(Box::new(Clay::new(scene, world, seed))) };
        let (view, renderer) = match (options.view, light) {
            (Some(ViewMode::Shaded), None) => {
                let message = "this program has no path tracer: use `cargo render`, or --view clay";
                return Err(RenderError::Other(message.to_owned()));
            }
            (Some(ViewMode::Shaded), Some(light)) => {
                let renderer = call(None, || light.path_tracer(scene, world, settings))?;
                (ViewMode::Shaded, Some(renderer))
            }
            (Some(ViewMode::Clay) | None, None) | (Some(ViewMode::Clay), Some(_)) => {
                (ViewMode::Clay, clay())
            }
            (None, Some(light)) => match written_path_tracer(light, scene, world, settings) {
                Ok(renderer) => (ViewMode::Shaded, Some(renderer)),
                Err(panic) if panic.is_unimplemented() => {
                    let panic = SubmissionPanic { panic, pixel: None };
                    eprintln!("note: {panic}, so the picture is drawn in clay");
                    (ViewMode::Clay, clay())
                }
                Err(panic) => {
                    return Err(RenderError::Panicked(SubmissionPanic {
                        panic,
                        pixel: None,
                    }));
                }
            },
            (Some(view), _) => (view, None),
        };
        Ok(Picture { view, renderer })
    }

    /// Returns the conversion of the picture's values to colours.
    pub(super) fn tone(&self, options: &Options) -> Tone {
        match self.view {
            ViewMode::Shaded | ViewMode::Clay => Tone::Light {
                stops: options.exposure,
            },
            ViewMode::Normals | ViewMode::Depth | ViewMode::Uv | ViewMode::Bvh => Tone::Data,
        }
    }
}
