//! Captions that say what is wrong with a hit.

use glam::DVec3;
use judging::describe;

use super::{DrawnHit, Focus, HitAnswer, HitComparison};
use crate::drawing::numbers::short;

impl HitComparison {
    /// Returns a sentence that says what is wrong with the submitted hit.
    pub(in crate::drawing) fn caption(&self) -> String {
        match (self.wanted, self.got) {
            (None, HitAnswer::NoAnswer) => {
                "The ray hits nothing; your code gave no answer.".to_owned()
            }
            (Some(wanted), HitAnswer::NoAnswer) => format!(
                "The ray hits at {}; your code gave no answer.",
                short(wanted.distance)
            ),
            (None, HitAnswer::Miss) => "The ray hits nothing.".to_owned(),
            (None, HitAnswer::Hit(got)) => format!(
                "The ray hits nothing; your code reports a hit at {}{}.",
                short(got.distance),
                self.range_note(got.distance)
            ),
            (Some(wanted), HitAnswer::Miss) => format!(
                "Your code reports no hit; the ray hits at {}.",
                short(wanted.distance)
            ),
            (Some(wanted), HitAnswer::Hit(got)) => self.difference(&wanted, &got),
        }
    }

    fn range_note(&self, distance: f64) -> String {
        let range = self.ray.range;
        if range.contains(distance as f32) {
            return String::new();
        }
        match self.limited_range() {
            Some(range) => format!(", outside the range {}", describe::interval(range)),
            None if distance < 0.0 => ", behind the ray's origin".to_owned(),
            None => ", which is not a distance".to_owned(),
        }
    }

    fn difference(&self, wanted: &DrawnHit, got: &DrawnHit) -> String {
        match self.focus {
            Focus::Distance => format!(
                "Your code reports a hit at {}{}; the first hit in range is at {}.",
                number(got.distance),
                self.range_note(got.distance),
                number(wanted.distance)
            ),
            Focus::Position => format!(
                "Your position is {}; the ray hits at {}.",
                describe::point(got.position.as_vec3()),
                describe::point(wanted.position.as_vec3())
            ),
            Focus::Normal => normal_difference(wanted.normal, got.normal),
            Focus::Uv => format!(
                "Your uv is {}; the correct uv is {}.",
                describe::uv(got.uv.as_vec2()),
                describe::uv(wanted.uv.as_vec2())
            ),
            Focus::Origin => format!(
                "Your hit says that the ray starts at {}; it starts at {}.",
                describe::point(got.origin.as_vec3()),
                describe::point(wanted.origin.as_vec3())
            ),
            Focus::Shape => {
                let name =
                    |hit: &DrawnHit| hit.shape.map_or("none".to_owned(), |id| id.to_string());
                format!(
                    "Your hit is of shape {}; the ray hits shape {}.",
                    name(got),
                    name(wanted)
                )
            }
        }
    }
}

/// Formats a number with as many digits as in the text of the report.
fn number(value: f64) -> String {
    describe::number(value as f32)
}

fn normal_difference(wanted: DVec3, got: DVec3) -> String {
    let length = got.length();
    if !(length.is_finite() && length > 0.0) {
        return format!(
            "Your normal {} has no direction.",
            describe::point(got.as_vec3())
        );
    }
    let degrees = got.angle_between(wanted).to_degrees();
    match degrees {
        _ if degrees > 179.5 => "Your normal points in the opposite direction.".to_owned(),
        _ if degrees > 0.05 => format!("Your normal is off by {}°.", short(degrees)),
        _ => format!("Your normal has length {}; it must be 1.", number(length)),
    }
}
