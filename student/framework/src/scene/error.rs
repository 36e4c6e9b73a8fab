//! Errors in scenes. Their messages say where the error is and how to fix it.

use std::fmt;
#[cfg(feature = "cli")]
use std::path::Path;
use std::path::PathBuf;

/// A position in a text file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct TextPosition {
    /// The line number, starting at 1.
    line: usize,
    /// The column in bytes, starting at 1, or 0 if only the line is known.
    column: usize,
    /// The text of the line.
    text: String,
}

/// An error in a scene or one of its meshes.
#[derive(Debug)]
pub struct SceneError {
    /// The path of the file with the error, if the scene was read from a file.
    file: Option<PathBuf>,
    /// The position in the file, if known.
    pub(super) position: Option<TextPosition>,
    /// Says why the scene is invalid and how to fix it.
    pub(super) message: String,
}

impl SceneError {
    /// Creates an error whose file isn't known yet.
    pub(super) fn new(position: Option<TextPosition>, message: impl Into<String>) -> Self {
        SceneError {
            file: None,
            position,
            message: message.into(),
        }
    }

    /// Returns the same error with the path of the file added.
    #[cfg(feature = "cli")]
    pub(super) fn in_file(self, file: &Path) -> Self {
        SceneError {
            file: Some(file.to_owned()),
            ..self
        }
    }
}

impl TextPosition {
    /// Creates the position at a line and a column of `text`, both starting at 1.
    pub(super) fn new(text: &str, line: usize, column: usize) -> Self {
        let text = text.lines().nth(line.saturating_sub(1)).unwrap_or("");
        TextPosition {
            line,
            column,
            text: text.to_owned(),
        }
    }

    /// Creates the position of the character at an offset in bytes.
    pub(super) fn at_offset(text: &str, offset: usize) -> Self {
        let before = &text[..offset];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.matches('\n').count() + 1;
        TextPosition::new(text, line, offset - line_start + 1)
    }
}

/// Prints the message and the line with a mark under the column. Lines that are too long for a
/// terminal are omitted.
impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match &self.file {
            Some(file) => write!(f, "{}:", file.display())?,
            None => f.write_str("scene:")?,
        }
        let message = &self.message;
        let Some(TextPosition { line, column, text }) = &self.position else {
            return write!(f, " {message}");
        };
        match column {
            0 => write!(f, "{line}: {message}")?,
            _ => write!(f, "{line}:{column}: {message}")?,
        }
        let text = text.trim_end().replace('\t', " ");
        if text.is_empty() || text.len() > 100 {
            return Ok(());
        }
        write!(f, "\n{line:>5} | {text}")?;
        match column {
            0 => Ok(()),
            _ => write!(f, "\n      | {:>column$}", '^'),
        }
    }
}

impl std::error::Error for SceneError {}
