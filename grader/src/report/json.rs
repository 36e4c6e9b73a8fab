//! Formats a score as `score.json`.

use crate::score::Score;

/// Returns the score as JSON, with a newline at the end.
pub fn to_string(score: &Score) -> String {
    let mut text =
        serde_json::to_string_pretty(score).expect("all map keys of a score are strings");
    text.push('\n');
    text
}
