//! The results of the programs' work.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::UVec2;
use grader::probe::Fault;
use protocol::{ElementOutcome, Panic, Tree};
use view_probe::messages::{Draw, Drawn, Opened, Values};

use super::{Key, Pinned, Session};
use crate::model::explanation::Explanation;
use crate::model::tiles::LayerKind;
use crate::model::tree::TreeModel;

/// The number of pixels that may end the program before drawing stops.
const MAX_FAULTS: u32 = 3;

impl Session {
    /// Reports that a program has opened the scene.
    pub fn opened(&mut self, key: Key, opened: Opened, took: Duration) {
        if !key.has_tree_of(&self.numbers) {
            return;
        }
        self.last_opening = took;
        if let ElementOutcome::Panicked(_) = opened.tree {
            self.fault =
                Some("The scene cannot be drawn, because building the tree failed.".to_owned());
        }
        if self.opened.as_ref() != Some(&opened) {
            self.opened = Some(opened);
            self.shown.version += 1;
        }
    }

    /// Reports that a program could not open the scene.
    pub fn opening_ended(&mut self, key: Key, why: &str) {
        if key.has_tree_of(&self.numbers) {
            self.stop(format!(
                "Opening the scene, which calls `Bvh::build`, and each `hit` once: {why}"
            ));
        }
    }

    fn stop(&mut self, why: String) {
        self.fault = Some(why);
        self.shown.version += 1;
    }

    /// Adds drawn pixels.
    pub fn drawn(&mut self, key: Key, tile: usize, draw: &Draw, drawn: &Drawn, now: Instant) {
        if key != self.numbers {
            return;
        }
        let panics = drawn.panics.iter();
        let panicked = panics.flat_map(|(_, indices)| indices.iter().copied());
        match &drawn.values {
            Values::Light(light) => self
                .light
                .add(tile, draw, light, panicked, |sum, x| sum + x),
            Values::Hits(hits) => self.hits.add(tile, draw, hits, panicked, |_, hit| hit),
            Values::Tests(tests) => self.tests.add(tile, draw, tests, panicked, |_, test| test),
        }
        for (panic, indices) in &drawn.panics {
            let first = indices.first().copied().unwrap_or(u32::MAX);
            let first = draw.pixels().nth(first as usize);
            let pixel = first.map_or(UVec2::ZERO, |(_, pixel)| pixel);
            self.add_panic(panic, pixel, indices.len() as u64);
        }
        self.invalid_paths += drawn.invalid_paths;
        let layer = LayerKind::of(draw.quantity);
        self.timings[layer as usize].add(drawn.rays, now);
        self.is_dirty = true;
        if self.is_complete() {
            self.timing_mut().stop(now);
            self.shown.version += 1;
        }
    }

    /// Reports that a program ended while drawing. The pixels are drawn again, one by one, to find
    /// the one at fault.
    pub fn drawing_ended(&mut self, key: Key, tile: usize, draw: &Draw, fault: &Fault) {
        if key != self.numbers {
            return;
        }
        let pixel = draw.pixels().next().map(|(_, pixel)| pixel);
        let pixel = pixel.filter(|_| draw.milliseconds == 0);
        let drawn = usize::from(pixel.is_some());
        let panicked = (0..).take(drawn);
        let tiles = self.tiles_mut(LayerKind::of(draw.quantity));
        tiles.add(tile, draw, drawn, panicked);
        self.is_careful = true;
        self.is_dirty = true;
        if let Some(pixel) = pixel {
            let panic = Panic {
                message: fault.to_string(),
                location: String::new(),
            };
            self.add_panic(&panic, pixel, 1);
            self.faults += 1;
            if self.faults == MAX_FAULTS {
                self.stop(format!(
                    "Drawing has stopped, because {MAX_FAULTS} pixels ended the program. \
                     Save a change, or move the camera, to try again."
                ));
            }
        }
        self.shown.version += 1;
    }

    /// Reports that a tile was not drawn because the program could not be started.
    pub fn not_started(&mut self, key: Key, why: &str) {
        if key == self.numbers {
            self.stop(format!("The program cannot be started: {why}"));
        }
    }

    /// Reports the tree, or why it couldn't be read. In that case, an empty tree is shown and
    /// drawing continues.
    pub fn received_tree(&mut self, key: Key, tree: Result<TreeModel, String>) {
        if key.has_tree_of(&self.numbers) {
            let tree = tree.unwrap_or_else(|why| {
                self.tree_fault = Some(why);
                TreeModel::new(Tree::default())
            });
            self.tree = Some(Arc::new(tree));
            self.is_tree_busy = false;
            self.is_dirty = true;
            self.shown.version += 1;
        }
    }

    /// Reports an explanation, or why it failed.
    pub fn explained(&mut self, key: Key, pinned: &Pinned, result: Result<Explanation, String>) {
        if key.has_tree_of(&self.numbers) && self.pinned.as_ref() == Some(pinned) {
            let (explanation, fault) = match result {
                Ok(explanation) => (Some(explanation), None),
                Err(why) => (None, Some(why)),
            };
            self.set_explanation(explanation);
            self.explanation_fault = fault;
        }
    }
}
