//! Handles what the programs report: drawn pixels, trees, explanations and failures.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::UVec2;
use grader::probe::Fault;
use protocol::{ElementOutcome, Panic};
use view_probe::messages::{Draw, DrawnPixels, OpenOutcome, Quantity, SubmissionPart, Values};

use super::{Key, Note, PictureSoFar, PinnedTarget, Session};
use crate::model::explanation::Explanation;
use crate::model::tree::TreeModel;
use crate::probe::Stop;

/// Drawing stops once the program has ended early at this many pixels.
const MAX_FAULTS: u32 = 3;

impl Session {
    /// Reports that a program has opened the scene.
    pub fn opened(&mut self, key: Key, opened: OpenOutcome, took: Duration) {
        if !key.has_tree_of(&self.numbers) {
            return;
        }
        self.last_opening = took;
        if let ElementOutcome::Panicked(_) = opened.tree {
            let text = "The scene cannot be drawn because building the tree failed.";
            self.picture.fault = Some(Note::without_location(text.to_owned()));
        }
        if self.opened.as_ref() != Some(&opened) {
            self.opened = Some(opened);
            self.shown.version += 1;
        }
    }

    /// Reports that building the tree takes a long time.
    pub fn build_is_slow(&mut self, key: Key) {
        if key.has_tree_of(&self.numbers) && self.opened.is_none() {
            self.is_build_slow = true;
            self.shown.version += 1;
        }
    }

    /// Reports that a program could not open the scene because of this method.
    pub fn opening_ended(&mut self, key: Key, part: SubmissionPart, fault: &Fault) {
        if key.has_tree_of(&self.numbers) {
            self.stop(self.note_on_fault(Some(part), fault));
        }
    }

    fn stop(&mut self, why: Note) {
        self.picture.fault = Some(why);
        self.shown.version += 1;
    }

    /// Adds drawn pixels.
    pub fn drawn(&mut self, key: Key, tile: usize, draw: &Draw, drawn: &DrawnPixels, now: Instant) {
        if key != self.numbers {
            return;
        }
        let panics = drawn.panics.iter();
        let panicked = panics.flat_map(|(_, indices)| indices.iter().copied());
        let PictureSoFar {
            light,
            clay,
            hits,
            tests,
            ..
        } = &mut self.picture;
        match &drawn.values {
            Values::Light(radiance) => {
                let is_clay = draw.quantity == Quantity::Clay;
                let layer = if is_clay { clay } else { light };
                layer.add(tile, draw, radiance, panicked, |sum, x| sum + x);
            }
            Values::Hits(drawn) => hits.add(tile, draw, drawn, panicked, |_, hit| hit),
            Values::Tests(drawn) => tests.add(tile, draw, drawn, panicked, |_, test| test),
        }
        for (panic, indices) in &drawn.panics {
            let first = indices.first().copied().unwrap_or(u32::MAX);
            let first = draw.pixels().nth(first as usize);
            let pixel = first.map_or(UVec2::ZERO, |(_, pixel)| pixel);
            self.add_panic(panic, pixel, indices.len() as u64);
        }
        self.picture.problems.add(&drawn.stats);
        if drawn.no_light.is_some() {
            self.picture.no_light.clone_from(&drawn.no_light);
        }
        let timing = self.picture.timing_mut(draw.quantity);
        timing.add(drawn.stats.rays, now);
        self.is_dirty = true;
        if self.is_complete() {
            self.timing_mut().stop(now);
            self.shown.version += 1;
        }
    }

    /// Reports that a program ended while drawing. The pixels are drawn again, one by one, to find
    /// the one at fault. `part` is the method at fault, if it has been found.
    pub fn drawing_ended(
        &mut self,
        key: Key,
        tile: usize,
        draw: &Draw,
        part: Option<SubmissionPart>,
        fault: &Fault,
    ) {
        if key != self.numbers {
            return;
        }
        let pixel = draw.pixels().next().map(|(_, pixel)| pixel);
        let pixel = pixel.filter(|_| draw.milliseconds == 0);
        let drawn = usize::from(pixel.is_some());
        let panicked = (0..).take(drawn);
        let tiles = self.picture.tiles_mut(draw.quantity);
        tiles.add(tile, draw, drawn, panicked);
        self.picture.is_careful = true;
        self.is_dirty = true;
        if let Some(pixel) = pixel {
            let note = self.note_on_fault(part, fault);
            let panic = Panic {
                message: note.text,
                location: note.location.unwrap_or_default(),
            };
            self.add_panic(&panic, pixel, 1);
            self.picture.faults += 1;
            if self.picture.faults == MAX_FAULTS {
                self.stop(Note::without_location(format!(
                    "Drawing has stopped because the program ended early at {MAX_FAULTS} pixels. Save \
                     a change or move the camera to try again."
                )));
            }
        }
        self.shown.version += 1;
    }

    /// Reports that a tile was not drawn because the program could not be started.
    pub fn not_started(&mut self, key: Key, why: &str) {
        if key == self.numbers {
            let text = format!("The program cannot be started: {why}");
            self.stop(Note::without_location(text));
        }
    }

    /// Reports the tree, or the reason it couldn't be read. If reading the tree failed, an empty
    /// tree is shown and drawing continues.
    pub fn received_tree(&mut self, key: Key, tree: Result<TreeModel, String>) {
        if key.has_tree_of(&self.numbers) {
            let tree = tree.unwrap_or_else(|why| {
                self.tree_fault = Some(why);
                TreeModel::default()
            });
            self.tree = Some(Arc::new(tree));
            self.is_tree_busy = false;
            self.is_dirty = true;
            self.shown.version += 1;
        }
    }

    /// Reports an explanation, or the reason it failed.
    pub fn explained(
        &mut self,
        key: Key,
        pinned: &PinnedTarget,
        result: Result<Explanation, Stop>,
    ) {
        if key.has_tree_of(&self.numbers) && self.pinned.as_ref() == Some(pinned) {
            let (explanation, fault) = match result {
                Ok(explanation) => (Some(explanation), None),
                Err(Stop::Fault(part, fault)) => {
                    (None, Some(self.note_on_fault(part, &fault).to_string()))
                }
                Err(stop) => (None, Some(stop.to_string())),
            };
            self.set_explanation(explanation);
            self.explanation_fault = fault;
        }
    }
}
