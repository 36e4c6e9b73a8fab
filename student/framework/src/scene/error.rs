//! What can be wrong with a scene, where, and what to do.

use std::fmt;
#[cfg(feature = "cli")]
use std::path::Path;
use std::path::PathBuf;

/// A place in a text file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextPosition {
    /// From 1.
    pub line: usize,
    /// From 1, in bytes; 0 if only the line is known.
    pub column: usize,
    /// The line's own text.
    pub text: String,
}

/// A scene that can not be used: which file, where in it, and why.
#[derive(Debug)]
pub struct SceneError {
    /// The file, if the scene came from one.
    pub file: Option<PathBuf>,
    /// The place in it, if the problem has one.
    pub position: Option<TextPosition>,
    /// What is wrong.
    pub kind: SceneErrorKind,
}

/// What is wrong with a scene or one of its meshes.
#[derive(Debug, thiserror::Error)]
pub enum SceneErrorKind {
    /// The file can not be opened or read.
    #[error("can not be read: {0}")]
    Unreadable(std::io::Error),
    /// The file is something else than text.
    #[error("is not UTF-8 text: byte {0} fits no character; is it the right file?")]
    NotUtf8(usize),
    /// There is nothing in the file.
    #[error("is empty: a scene has at least a camera, materials and shapes")]
    Empty,
    /// The parser's words, which name the key or value and what would be right.
    #[error("{0}")]
    Syntax(String),
    /// A shape names a material that is not there.
    #[error("no material is called `{name}`; there are: {known}")]
    UnknownMaterial {
        /// What the shape names.
        name: String,
        /// The names that would do.
        known: String,
    },
    /// A mesh in a scene that came without a folder.
    #[error("a mesh stands in a file of its own, which only a scene read from a file can name")]
    MeshWithoutFolder,
    /// A mesh's file has a problem of its own.
    #[error("mesh: {0}")]
    Mesh(Box<SceneError>),
    /// An OBJ file with a line that can not be used.
    #[error("{0}")]
    Obj(String),
    /// Subdivision would not fit in memory.
    #[error(
        "{levels} subdivisions make {triangles} triangles, and at most {limit} are drawn: take fewer"
    )]
    TooManyTriangles {
        /// What was asked for.
        levels: u32,
        /// What it would come to.
        triangles: u64,
        /// The limit.
        limit: u64,
    },
}

impl SceneError {
    /// A problem at a place of a file not yet known.
    pub(super) fn new(place: Option<TextPosition>, problem: SceneErrorKind) -> Self {
        SceneError {
            file: None,
            position: place,
            kind: problem,
        }
    }

    /// The same error, now that the file is known.
    #[cfg(feature = "cli")]
    pub(super) fn in_file(self, file: &Path) -> Self {
        SceneError {
            file: Some(file.to_owned()),
            ..self
        }
    }
}

impl TextPosition {
    /// A line and a column, from 1, of a text.
    pub(super) fn new(text: &str, line: usize, column: usize) -> Self {
        let text = text.lines().nth(line.saturating_sub(1)).unwrap_or("");
        TextPosition {
            line,
            column,
            text: text.to_owned(),
        }
    }

    /// Where `key` has the value `value`, first of all.
    pub(super) fn of_value(text: &str, key: &str, value: &str) -> Option<Self> {
        let (key, value) = (format!("{key:?}"), format!("{value:?}"));
        let follows_key = |start: usize| {
            let before = text[..start].trim_end().strip_suffix(':');
            before.is_some_and(|before| before.trim_end().ends_with(&key))
        };
        let (start, _) = text
            .match_indices(&value)
            .find(|(start, _)| follows_key(*start))?;
        let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let line = text[..start].matches('\n').count() + 1;
        Some(TextPosition::new(text, line, start - line_start + 1))
    }
}

/// A whole text file.
#[cfg(feature = "cli")]
pub(super) fn read_text(path: &Path) -> Result<String, SceneError> {
    let failed = |problem| SceneError::new(None, problem).in_file(path);
    let bytes = std::fs::read(path).map_err(|error| failed(SceneErrorKind::Unreadable(error)))?;
    String::from_utf8(bytes)
        .map_err(|error| failed(SceneErrorKind::NotUtf8(error.utf8_error().valid_up_to())))
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match &self.file {
            Some(file) => write!(f, "{}:", file.display())?,
            None => f.write_str("scene:")?,
        }
        if let Some(place) = &self.position {
            write!(f, "{}:", place.line)?;
            if place.column > 0 {
                write!(f, "{}:", place.column)?;
            }
        }
        write!(f, " {}", self.kind)?;
        match &self.position {
            Some(place) => write!(f, "{place}"),
            None => Ok(()),
        }
    }
}

/// The line itself with a mark under the column, if it fits on a terminal.
impl fmt::Display for TextPosition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let shown = self.text.trim_end();
        if shown.is_empty() || shown.len() > 100 {
            return Ok(());
        }
        let (line, column) = (self.line, self.column);
        write!(f, "\n{line:>5} | {}", shown.replace('\t', " "))?;
        if column > 0 {
            write!(f, "\n      | {:>column$}", '^')?;
        }
        Ok(())
    }
}

impl std::error::Error for SceneError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_value_of_the_given_key() {
        let text = "{\n  \"about\": \"red\",\n  \"material\" : \"red\"\n}";
        let place = TextPosition::of_value(text, "material", "red").expect("it is there");
        assert_eq!((place.line, place.column), (3, 16));
        assert_eq!(TextPosition::of_value(text, "file", "red"), None);
    }

    #[test]
    fn an_error_shows_the_line_and_a_mark_under_the_column() {
        let text = "{\n  \"radius\": -2\n}";
        let problem = SceneErrorKind::Syntax("-2 is not above 0".to_owned());
        let error = SceneError {
            file: Some(PathBuf::from("ball.json")),
            ..SceneError::new(Some(TextPosition::new(text, 2, 14)), problem)
        };
        let shown = error.to_string();
        let wanted =
            "ball.json:2:14: -2 is not above 0\n    2 |   \"radius\": -2\n      |              ^";
        assert_eq!(shown, wanted);
    }
}
