//! `score.json`.

use crate::score::Score;

/// The score as JSON, with a line end.
pub fn to_string(score: &Score) -> String {
    let mut text = serde_json::to_string_pretty(score).expect("a score has no maps of odd keys");
    text.push('\n');
    text
}
