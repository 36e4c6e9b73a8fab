//! The page's commands.

use std::time::Instant;

use framework::math::tan;
use glam::UVec2;
use serde::Deserialize;
use view_probe::messages::Quantity;

use super::{PinnedTarget, Session, View};
use crate::model::viewpoint::{Movement, Side, Viewpoint};

/// The maximum number of pixels along one side of a film.
const MAX_SIDE: u32 = 2048;
/// The maximum number of samples per pixel.
const MAX_SAMPLES: u32 = 4096;
/// The maximum exposure, in stops.
const MAX_EXPOSURE: f32 = 16.0;

/// A command from the page. Scenes are identified by name, never by path.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Command {
    /// Opens the scene with this name.
    Scene(String),
    /// Shows another quantity.
    View(View),
    /// Sets the exposure, in stops.
    Exposure(f32),
    /// Sets the width and height of the picture, in pixels.
    Film([u32; 2]),
    /// Sets the number of samples per pixel.
    Samples(u32),
    /// Moves the camera.
    Move(Movement),
    /// Moves the camera to one side of the scene.
    Side(Side),
    /// Returns to the scene's own camera.
    OwnCamera,
    /// Explains a pixel, counted from the bottom left.
    Pick {
        /// The pixel.
        pixel: [u32; 2],
        /// The number of the path to explain, or `None` for the ray through the centre.
        sample: Option<u32>,
    },
    /// Explains the exam's ray.
    PickQuestion,
    /// Stops explaining a pixel.
    Unpick,
}

impl Session {
    /// Executes a command from the page. Returns the name of a scene to load, if any.
    ///
    /// # Errors
    /// Fails if a number is out of range or a name is unknown.
    pub fn apply(&mut self, command: &Command, now: Instant) -> Result<Option<String>, String> {
        match command {
            Command::Scene(name) => {
                if !self.shown.scenes.contains(name) {
                    return Err(format!("unknown scene {name:?}"));
                }
                self.shown.loading = Some(name.clone());
                self.shown.version += 1;
                return Ok(Some(name.clone()));
            }
            Command::View(view) => self.show_view(*view, now),
            Command::Exposure(stops) => {
                if !stops.is_finite() || stops.abs() > MAX_EXPOSURE {
                    return Err("the exposure is out of range".to_owned());
                }
                self.shown.exposure = *stops;
                self.is_dirty = true;
                self.shown.is_picture_complete = false;
            }
            Command::Film([width, height]) => {
                let side = 1..=MAX_SIDE;
                if !side.contains(width) || !side.contains(height) {
                    return Err(format!(
                        "the width and height must be from 1 to {MAX_SIDE} pixels"
                    ));
                }
                self.shown.film = UVec2::new(*width, *height);
                self.restart(now);
            }
            Command::Samples(samples) => {
                if !(1..=MAX_SAMPLES).contains(samples) {
                    return Err(format!("a pixel can have 1 to {MAX_SAMPLES} samples"));
                }
                self.shown.samples = *samples;
                // Samples that have been added cannot be removed.
                if *samples < self.picture.light.tiles.samples {
                    self.restart(now);
                } else {
                    self.picture.light.tiles.samples = *samples;
                    self.picture.clay.tiles.samples = *samples;
                }
            }
            Command::Move(movement) => {
                let height =
                    2.0 * tan(0.5 * self.subject.camera().pinhole.vertical_fov.to_radians());
                self.viewpoint = self.viewpoint.moved(*movement, height);
                self.restart(now);
            }
            Command::Side(side) => {
                let pinhole = self.camera().pinhole;
                let (fov, aspect) = (pinhole.vertical_fov, pinhole.aspect_ratio);
                self.viewpoint = Viewpoint::from_side(*side, &self.subject.bounds, fov, aspect);
                self.restart(now);
            }
            Command::OwnCamera => {
                self.viewpoint = self.subject.viewpoint;
                self.restart(now);
            }
            Command::Pick { pixel, sample } => {
                let pixel = UVec2::from(*pixel);
                if pixel.cmpge(self.shown.film).any() {
                    return Err("the pixel is outside the picture".to_owned());
                }
                self.pin(Some(pixel), *sample);
            }
            Command::PickQuestion => match &self.subject.question {
                Some(question) if question.ray.is_some() => self.pin(None, None),
                Some(_) | None => return Err("no ray from the exam is shown".to_owned()),
            },
            Command::Unpick => {
                self.pinned = None;
                self.set_explanation(None);
            }
        }
        self.shown.version += 1;
        Ok(None)
    }

    /// Shows another quantity.
    pub fn show_view(&mut self, view: View, now: Instant) {
        self.timing_mut().stop(now);
        self.shown.view = view;
        self.is_dirty = true;
        self.shown.is_picture_complete = false;
        self.is_tree_wanted |= view == View::Bvh;
        self.is_recording_wanted |= view.layer() == Quantity::Tests;
        self.picture.fault = None;
    }

    fn pin(&mut self, pixel: Option<UVec2>, sample: Option<u32>) {
        let pinned = PinnedTarget {
            aim: self.aim(),
            pixel,
            sample,
        };
        self.pinned = Some(pinned);
        self.is_recording_wanted = true;
        self.is_tree_wanted = true;
        self.set_explanation(None);
    }
}
