//! Captions that say what is wrong with a hit.

use judging::describe;
use protocol::Trace;

use super::{Focus, HitComparison};
use crate::drawing::numbers::{direction_difference, short};

impl HitComparison {
    /// Returns a sentence that says what is wrong with the submitted hit.
    pub(in crate::drawing) fn caption(&self) -> String {
        match (self.wanted, self.got) {
            (None, None) => "The ray hits nothing; your code gave no answer.".to_owned(),
            (Some(wanted), None) => format!(
                "The first hit is at {}; your code gave no answer.",
                short(wanted.distance.into())
            ),
            (None, Some(None)) => "The ray hits nothing.".to_owned(),
            (None, Some(Some(got))) => format!(
                "The ray hits nothing; your code reports a hit at {}{}.",
                short(got.distance.into()),
                self.range_note(got.distance)
            ),
            (Some(wanted), Some(None)) => format!(
                "Your code reports no hit; the first hit is at {}.",
                short(wanted.distance.into())
            ),
            (Some(wanted), Some(Some(got))) => self.difference(&wanted, &got),
        }
    }

    fn range_note(&self, distance: f32) -> String {
        let range = self.ray.range;
        if range.contains(distance) {
            return String::new();
        }
        match self.limited_range() {
            Some(range) => format!(", outside the range {}", describe::interval(range)),
            None if distance < 0.0 => ", behind the ray's origin".to_owned(),
            None => ", which is not a distance".to_owned(),
        }
    }

    fn difference(&self, wanted: &Trace, got: &Trace) -> String {
        match self.focus {
            Focus::Distance => format!(
                "Your code reports a hit at {}{}; the first hit in range is at {}.",
                describe::number(got.distance),
                self.range_note(got.distance),
                describe::number(wanted.distance)
            ),
            Focus::Position => format!(
                "Your position is {}; the hit is at {}.",
                describe::point(got.position),
                describe::point(wanted.position)
            ),
            Focus::Normal => direction_difference("normal", wanted.normal, got.normal),
            Focus::Uv => format!(
                "Your uv is {}; the correct uv is {}.",
                describe::uv(got.uv),
                describe::uv(wanted.uv)
            ),
            Focus::Origin => format!(
                "According to your hit, the ray starts at {}, but it actually starts at {}.",
                describe::point(got.origin),
                describe::point(wanted.origin)
            ),
            Focus::Shape => format!(
                "Your hit is on shape {}; the ray hits shape {}.",
                got.shape, wanted.shape
            ),
        }
    }
}
