//! `score.json`: whole at any moment, because it appears in one step.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use crate::score::Score;
use crate::system;

/// Writes the score to `path`: to a temporary file beside it, then in its place.
pub fn write(score: &Score, path: &Path) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut file = NamedTempFile::new_in(folder)?;
    file.write_all(text(score).as_bytes())?;
    system::readable_by_all(file.as_file())?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// The score as JSON, with a line end.
pub fn text(score: &Score) -> String {
    let mut text = serde_json::to_string_pretty(score).expect("a score has no maps of odd keys");
    text.push('\n');
    text
}
