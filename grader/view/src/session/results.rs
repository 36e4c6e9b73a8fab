//! The results of the programs' work.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{UVec2, Vec3};
use grader::probe::Fault;
use protocol::{ElementOutcome, Panic, Tree};
use view_probe::messages::{Draw, Drawn, Opened, Quantity, Values};

use super::{Key, Pinned, Session, View};
use crate::model::explanation::Explanation;
use crate::model::tree::TreeModel;

/// The number of pixels that may end the program before drawing stops.
const MAX_FAULTS: u32 = 3;

impl Session {
    /// Reports that a program has opened the scene.
    pub fn opened(&mut self, key: Key, opened: Opened, took: Duration) {
        if (key.program, key.scene) != (self.numbers.program, self.numbers.scene) {
            return;
        }
        self.last_opening = took;
        if let ElementOutcome::Panicked(_) = opened.tree {
            self.fault =
                Some("The scene cannot be drawn, because building the tree failed.".to_owned());
        }
        if self.opened.as_ref() != Some(&opened) {
            self.opened = Some(opened);
            self.version += 1;
        }
    }

    /// Reports that a program could not open the scene.
    pub fn opening_ended(&mut self, key: Key, why: &str) {
        if (key.program, key.scene) == (self.numbers.program, self.numbers.scene) {
            self.stop(format!(
                "Opening the scene, which calls `Bvh::build`, and each `hit` once: {why}"
            ));
        }
    }

    fn stop(&mut self, why: String) {
        self.fault = Some(why);
        self.version += 1;
    }

    /// Adds drawn pixels.
    pub fn drawn(&mut self, key: Key, tile: usize, draw: &Draw, drawn: &Drawn, now: Instant) {
        if key != self.numbers {
            return;
        }
        let indices = drawn
            .panics
            .iter()
            .flat_map(|(_, indices)| indices.iter().copied());
        match &drawn.values {
            Values::Light(light) => self
                .light
                .add(tile, draw, light, indices, |sum, x| *sum += x),
            Values::Hits(hits) => self.hits.add(tile, draw, hits, indices, |hit, x| *hit = x),
            Values::Tests(tests) => self
                .tests
                .add(tile, draw, tests, indices, |test, x| *test = x),
        }
        for (panic, indices) in &drawn.panics {
            let first = indices
                .first()
                .and_then(|index| draw.pixels().nth(*index as usize));
            let pixel = first.map_or(UVec2::ZERO, |(_, pixel)| pixel).to_array();
            self.add_panic(panic, pixel, indices.len() as u64);
        }
        self.invalid_paths += drawn.invalid_paths;
        let layer = match &drawn.values {
            Values::Light(_) => View::Shaded.layer(),
            Values::Hits(_) => View::Normals.layer(),
            Values::Tests(_) => View::Tests.layer(),
        };
        self.timings[layer].add(drawn.rays, now);
        self.is_dirty = true;
        if self.is_complete() {
            self.timing_mut().stop(now);
            self.version += 1;
        }
    }

    /// Reports that a program has ended while it was drawing. The pixels are drawn again, one by
    /// one, to find the one at fault.
    pub fn drawing_ended(&mut self, key: Key, tile: usize, draw: &Draw, fault: &Fault) {
        if key != self.numbers {
            return;
        }
        let pixel = draw.pixels().next().map(|(_, pixel)| pixel);
        let pixel = pixel.filter(|_| draw.milliseconds == 0);
        let values = usize::from(pixel.is_some());
        let panicked = || (0..).take(values);
        match draw.quantity {
            Quantity::Light { .. } => {
                self.light
                    .add(tile, draw, &[Vec3::ZERO][..values], panicked(), |_, _| {});
            }
            Quantity::Hit => self
                .hits
                .add(tile, draw, &[None][..values], panicked(), |_, _| {}),
            Quantity::Tests => {
                let nothing = &[Default::default()][..values];
                self.tests.add(tile, draw, nothing, panicked(), |_, _| {});
            }
        }
        self.is_careful = true;
        self.is_dirty = true;
        if let Some(pixel) = pixel {
            let panic = Panic {
                message: fault.to_string(),
                location: String::new(),
            };
            self.add_panic(&panic, pixel.to_array(), 1);
            self.faults += 1;
            if self.faults == MAX_FAULTS {
                self.stop(format!(
                    "Drawing has stopped, because {MAX_FAULTS} pixels ended the program. \
                     Save a change, or move the camera, to try again."
                ));
            }
        }
        self.version += 1;
    }

    /// Reports that a tile was not drawn, because the program could not be started.
    pub fn not_started(&mut self, key: Key, why: &str) {
        if key == self.numbers {
            self.stop(format!("The program cannot be started: {why}"));
        }
    }

    /// Reports the tree.
    pub fn received_tree(&mut self, key: Key, tree: Arc<TreeModel>) {
        if (key.program, key.scene) == (self.numbers.program, self.numbers.scene) {
            self.tree = Some(tree);
            self.is_tree_busy = false;
            self.is_dirty = true;
            self.version += 1;
        }
    }

    /// Reports that the tree could not be read. An empty one is shown, and drawing goes on.
    pub fn tree_ended(&mut self, key: Key, why: String) {
        if (key.program, key.scene) == (self.numbers.program, self.numbers.scene) {
            self.tree_fault = Some(why);
            self.received_tree(key, Arc::new(TreeModel::new(Tree::default())));
        }
    }

    /// Returns whether an explanation is still wanted.
    pub fn is_pinned(&self, key: Key, pinned: &Pinned) -> bool {
        (key.program, key.scene) == (self.numbers.program, self.numbers.scene)
            && self.pinned.as_ref() == Some(pinned)
    }

    /// Reports an explanation, or the reason why there is none.
    pub fn explained(&mut self, key: Key, pinned: &Pinned, result: Result<Explanation, String>) {
        if !self.is_pinned(key, pinned) {
            return;
        }
        match result {
            Ok(explanation) => self.set_explanation(Some(explanation)),
            Err(why) => {
                self.set_explanation(None);
                self.explanation_fault = Some(why);
            }
        }
    }
}
