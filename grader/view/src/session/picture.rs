//! The state of the picture.

use std::time::{Duration, Instant};

use super::{BuildState, Key, Session, View};

impl Session {
    /// Reports that the page has a new picture, of all samples or of some.
    pub fn show_picture(&mut self, key: Key, is_complete: bool) {
        self.picture_number += 1;
        self.is_picture_complete = is_complete && key == self.numbers && !self.is_dirty;
        // While there is no program, the picture is composed of old pixels.
        self.is_stale &= !matches!(self.drawing, BuildState::Ready(_));
        self.version += 1;
    }

    /// Returns whether there is something to show of the new picture. Until then, the old one stays.
    pub fn has_picture(&self) -> bool {
        match self.view {
            View::Shaded => self.light.has_coarse_picture(),
            View::Clay | View::Normals | View::Depth | View::Uv => self.hits.has_coarse_picture(),
            View::Bvh => self.hits.has_coarse_picture() && self.tree.is_some(),
            View::Tests => self.tests.has_coarse_picture(),
        }
    }

    /// Returns whether the picture is complete.
    pub fn is_complete(&self) -> bool {
        match self.view {
            View::Shaded => self.light.is_complete(),
            View::Clay | View::Normals | View::Depth | View::Uv => self.hits.is_complete(),
            View::Bvh => self.hits.is_complete() && self.tree.is_some(),
            View::Tests => self.tests.is_complete(),
        }
    }

    /// Returns the time since the picture was started.
    pub fn age(&self, now: Instant) -> Duration {
        now.saturating_duration_since(self.started_at)
    }
}
