//! Errors in scenes. Their messages say where the error is and how to fix it.

use std::fmt;
#[cfg(feature = "cli")]
use std::path::Path;
use std::path::PathBuf;

use crate::suggestion::suggestion;

/// A position in a text file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextPosition {
    /// The line number, starting at 1.
    pub line: usize,
    /// The column in bytes, starting at 1, or 0 if only the line is known.
    pub column: usize,
    /// The text of the line.
    pub text: String,
}

/// An error in a scene: the file, the position in it, and the reason.
#[derive(Debug)]
pub struct SceneError {
    /// The path of the file with the error, if the scene was read from a file.
    pub file: Option<PathBuf>,
    /// The position in the file, if known.
    pub position: Option<TextPosition>,
    /// The reason why the scene is invalid.
    pub kind: SceneErrorKind,
}

/// The reason why a scene or one of its meshes is invalid.
#[derive(Debug, thiserror::Error)]
pub enum SceneErrorKind {
    /// The file cannot be opened or read.
    #[error("cannot read the file: {0}")]
    Unreadable(std::io::Error),
    /// The file is not UTF-8 text. Holds the offset of the first invalid byte.
    #[error("the file is not UTF-8 text (invalid byte at offset {0}); is it the right file?")]
    NotUtf8(usize),
    /// The text is empty.
    #[error("the scene is empty: it needs at least a camera, materials and shapes")]
    Empty,
    /// The text is not a JSON object, as in a file of another kind.
    #[error("this is not a scene: a scene begins with `{{`. scenes/README.md describes the format")]
    NotAScene,
    /// The file is a mesh.
    #[error(
        "this is a mesh, not a scene. A scene can show it, with this entry in its `shapes`: \
         {{ \"mesh\": {{ \"file\": {0:?}, \"material\": \"…\" }} }}; see scenes/README.md"
    )]
    MeshAsScene(String),
    /// The text is not a valid scene file. Holds the message.
    #[error("{0}")]
    Syntax(String),
    /// A shape uses a material that the scene does not define.
    #[error(
        "there is no material `{name}`{}; the scene defines: {}",
        suggestion(name, known),
        known.join(", ")
    )]
    UnknownMaterial {
        /// The name that the shape uses.
        name: String,
        /// The names that the scene defines.
        known: Vec<String>,
    },
    /// The scene uses a mesh, but was not read from a file.
    #[error("meshes are separate files, so only a scene that is read from a file can use one")]
    MeshWithoutFolder,
    /// The file of a mesh has an error.
    #[error("mesh: {0}")]
    Mesh(Box<SceneError>),
    /// An OBJ file is invalid. Holds the message.
    #[error("{0}")]
    Obj(String),
    /// A coordinate of the mesh is too large after its transformation.
    #[error(
        "the mesh has a coordinate beyond 1e9 after `scale`, `rotate` and `translate`: use \
         smaller numbers"
    )]
    MeshTooLarge,
    /// No triangle of the mesh has an area.
    #[error(
        "no triangle of the mesh has an area, so no ray can hit it: use another mesh or `scale`"
    )]
    MeshWithoutArea,
    /// The subdivided mesh would be too large.
    #[error(
        "with `subdivide` {levels} the mesh has {triangles} triangles, and the limit is {limit}: \
         use a smaller number"
    )]
    TooManyTriangles {
        /// The number of subdivisions.
        levels: u32,
        /// The number of triangles that the mesh would have.
        triangles: u64,
        /// The maximum number of triangles.
        limit: u64,
    },
}

impl SceneError {
    /// Creates an error whose file is not known yet.
    pub(super) fn new(position: Option<TextPosition>, kind: SceneErrorKind) -> Self {
        SceneError {
            file: None,
            position,
            kind,
        }
    }

    /// Returns the same error with the name of the file.
    #[cfg(feature = "cli")]
    pub(super) fn in_file(self, file: &Path) -> Self {
        SceneError {
            file: Some(file.to_owned()),
            ..self
        }
    }
}

impl TextPosition {
    /// Creates the position at a line and a column of a text, both starting at 1.
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

    /// Finds the first position at which `key` has the value `value`.
    pub(super) fn of_value(text: &str, key: &str, value: &str) -> Option<Self> {
        let (key, value) = (format!("{key:?}"), format!("{value:?}"));
        let follows_key = |start: usize| {
            let before = text[..start].trim_end().strip_suffix(':');
            before.is_some_and(|before| before.trim_end().ends_with(&key))
        };
        let (start, _) = text
            .match_indices(&value)
            .find(|(start, _)| follows_key(*start))?;
        Some(TextPosition::at_offset(text, start))
    }
}

/// Reads a text file.
#[cfg(feature = "cli")]
pub(super) fn read_text(path: &Path) -> Result<String, SceneError> {
    String::from_utf8(read_bytes(path)?).map_err(|error| {
        let kind = SceneErrorKind::NotUtf8(error.utf8_error().valid_up_to());
        SceneError::new(None, kind).in_file(path)
    })
}

/// Reads a text file that may have bytes that are not UTF-8, without the byte order mark that some
/// editors put at its start.
#[cfg(feature = "cli")]
pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>, SceneError> {
    let unreadable = |error| SceneError::new(None, SceneErrorKind::Unreadable(error)).in_file(path);
    let bytes = std::fs::read(path).map_err(unreadable)?;
    Ok(
        match (utf_16(&bytes), bytes.strip_prefix("\u{feff}".as_bytes())) {
            (Some(text), _) => text.into_bytes(),
            (None, Some(rest)) => rest.to_owned(),
            (None, None) => bytes,
        },
    )
}

/// Decodes a text that begins with a byte order mark of UTF-16, as PowerShell writes.
#[cfg(feature = "cli")]
fn utf_16(bytes: &[u8]) -> Option<String> {
    let (pairs, []) = bytes.as_chunks::<2>() else {
        return None;
    };
    let (mark, pairs) = pairs.split_first()?;
    let decode: fn([u8; 2]) -> u16 = match mark {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return None,
    };
    let units: Vec<u16> = pairs.iter().copied().map(decode).collect();
    String::from_utf16(&units).ok()
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match &self.file {
            Some(file) => write!(f, "{}:", file.display())?,
            None => f.write_str("scene:")?,
        }
        if let Some(position) = &self.position {
            write!(f, "{}:", position.line)?;
            if position.column > 0 {
                write!(f, "{}:", position.column)?;
            }
        }
        write!(f, " {}", self.kind)?;
        match &self.position {
            Some(position) => write!(f, "{position}"),
            None => Ok(()),
        }
    }
}

/// Prints the line with a mark under the column. A line that is too long for a terminal is not
/// printed.
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
        let position = TextPosition::of_value(text, "material", "red");
        let position = position.expect("the text contains this value");
        assert_eq!((position.line, position.column), (3, 16));
        assert_eq!(TextPosition::of_value(text, "file", "red"), None);
    }

    #[test]
    fn an_error_shows_the_line_and_a_mark_under_the_column() {
        let text = "{\n  \"radius\": -2\n}";
        let kind = SceneErrorKind::Syntax("-2 is not above 0".to_owned());
        let error = SceneError {
            file: Some(PathBuf::from("ball.json")),
            ..SceneError::new(Some(TextPosition::new(text, 2, 14)), kind)
        };
        let expected =
            "ball.json:2:14: -2 is not above 0\n    2 |   \"radius\": -2\n      |              ^";
        assert_eq!(error.to_string(), expected);
    }
}
