//! The picture so far.

use std::time::Instant;

use framework::render::renderer::RenderStats;
use glam::{UVec2, Vec3};
use protocol::{Panic, Trace};
use view_probe::messages::{MarkedTests, Quantity};

use super::Note;
use super::timing::Timing;
use crate::model::layer::Layer;
use crate::model::tiles::Tiles;

/// The picture so far. It starts anew when the camera, the program or the scene changes.
#[derive(Debug)]
pub(crate) struct PictureSoFar {
    pub(crate) light: Layer<Vec3>,
    pub(crate) clay: Layer<Vec3>,
    pub(crate) hits: Layer<Option<Trace>>,
    pub(crate) tests: Layer<MarkedTests>,
    /// The reason drawing has stopped.
    pub(super) fault: Option<Note>,
    /// The number of pixels whose drawing ended the program early.
    pub(super) faults: u32,
    /// Whether each request draws a single pixel, in order to find the one that ends the program.
    pub(super) is_careful: bool,
    /// The problems in the picture so far.
    pub(super) problems: RenderStats,
    /// Why the shaded view is drawn in clay.
    pub(super) no_light: Option<Panic>,
    /// The time spent drawing each layer.
    timings: [Timing; 4],
    pub(super) started_at: Instant,
}

impl PictureSoFar {
    pub(super) fn new(film: UVec2, samples: u32, now: Instant) -> Self {
        PictureSoFar {
            light: Layer::new(film, samples),
            clay: Layer::new(film, samples),
            hits: Layer::new(film, 1),
            tests: Layer::new(film, 1),
            fault: None,
            faults: 0,
            is_careful: false,
            problems: RenderStats::default(),
            no_light: None,
            timings: Default::default(),
            started_at: now,
        }
    }

    /// Returns the progress of a layer.
    pub(super) fn tiles(&self, layer: Quantity) -> &Tiles {
        match layer {
            Quantity::Light => &self.light.tiles,
            Quantity::Clay => &self.clay.tiles,
            Quantity::Hit => &self.hits.tiles,
            Quantity::Tests => &self.tests.tiles,
        }
    }

    pub(super) fn tiles_mut(&mut self, layer: Quantity) -> &mut Tiles {
        match layer {
            Quantity::Light => &mut self.light.tiles,
            Quantity::Clay => &mut self.clay.tiles,
            Quantity::Hit => &mut self.hits.tiles,
            Quantity::Tests => &mut self.tests.tiles,
        }
    }

    pub(super) fn timing(&self, layer: Quantity) -> &Timing {
        &self.timings[layer as usize]
    }

    pub(super) fn timing_mut(&mut self, layer: Quantity) -> &mut Timing {
        &mut self.timings[layer as usize]
    }
}
