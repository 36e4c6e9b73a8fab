//! Parses the compiler's messages, which are in JSON.

use serde::Deserialize;

use judging::section::Section;

use super::compiler_help;
use crate::handed_out::TaskFile;

/// A message from `rustc --error-format=json`.
#[derive(Clone, Debug, Deserialize)]
pub struct Diagnostic {
    message: String,
    level: String,
    #[serde(default)]
    code: Option<ErrorCode>,
    #[serde(default)]
    spans: Vec<Span>,
    #[serde(default)]
    children: Vec<Diagnostic>,
    #[serde(default)]
    rendered: Option<String>,
}

/// The code of an error, such as `E0308`. Syntax errors have no code.
#[derive(Clone, Debug, Deserialize)]
struct ErrorCode {
    code: String,
}

#[derive(Clone, Debug, Deserialize)]
struct Span {
    file_name: String,
    is_primary: bool,
    #[serde(default)]
    line_start: Option<u32>,
    #[serde(default)]
    label: Option<String>,
    #[serde(default)]
    text: Vec<SourceLine>,
}

/// A line of source code that a span covers.
#[derive(Clone, Debug, Deserialize)]
struct SourceLine {
    text: String,
}

/// The warnings that can explain a wrong answer or an infinite loop. The compiler is told to report
/// only these.
pub const WARNINGS: [&str; 8] = [
    "path_statements",
    "unconditional_recursion",
    "unreachable_code",
    "unused_assignments",
    "unused_comparisons",
    "unused_must_use",
    "unused_mut",
    "unused_variables",
];

/// Returns the errors among the compiler's messages.
pub fn errors(messages: &str) -> Vec<Diagnostic> {
    of_level(messages, "error")
}

/// Returns the warnings among the compiler's messages. They don't affect points.
pub fn warnings(messages: &str) -> Vec<Diagnostic> {
    of_level(messages, "warning")
}

fn of_level(messages: &str, level: &str) -> Vec<Diagnostic> {
    messages
        .lines()
        .filter_map(|line| serde_json::from_str::<Diagnostic>(line).ok())
        .filter(|diagnostic| diagnostic.level.starts_with(level))
        .collect()
}

impl Diagnostic {
    /// Returns the task file to fix, which is usually the file with the error. For an error in a
    /// given file, it is the task file that the message refers to ("method not found for this
    /// struct") or, failing that, the task file whose name appears first in the line with the
    /// error.
    pub fn blamed_file(&self, task_files: &[TaskFile]) -> Option<&'static str> {
        let mut spans = self.spans_in_order();
        let named =
            spans.find_map(|span| task_files.iter().find(|file| file.name == span.file_name));
        named.map(|file| file.name).or_else(|| {
            let mut lines = self.primary().flat_map(|span| &span.text);
            lines.find_map(|line| called_file(&line.text, task_files))
        })
    }

    /// Returns the spans of the error itself.
    fn primary(&self) -> impl Iterator<Item = &Span> {
        self.spans.iter().filter(|span| span.is_primary)
    }

    /// Returns all spans that the message refers to: first the spans of the error itself, then the
    /// spans that only explain it.
    fn spans_in_order(&self) -> impl Iterator<Item = &Span> {
        let secondary = self.spans.iter().filter(|span| !span.is_primary);
        let explaining = self.children.iter().flat_map(|child| &child.spans);
        self.primary().chain(secondary).chain(explaining)
    }

    /// Returns the 1-based line number of the error if it is in this file, or else the number of
    /// the first line in this file that the message refers to. If a brace isn't closed, it is the
    /// line of that brace, since the error itself is at the end of the file.
    pub fn line_in(&self, file: &str) -> Option<u32> {
        let mut spans = self.spans_in_order().filter(|span| span.file_name == file);
        let labelled = |text: &str| {
            let mut spans = self.spans.iter().filter(|span| span.file_name == file);
            spans.find(|span| {
                span.label
                    .as_ref()
                    .is_some_and(|label| label.contains(text))
            })
        };
        let brace =
            labelled("might not be properly closed").or_else(|| labelled("unclosed delimiter"));
        brace.or_else(|| spans.next())?.line_start
    }

    /// Returns whether the error is in this file and isn't caused by something missing in another
    /// file.
    pub fn originates_in(&self, file: &str) -> bool {
        /// Codes of unresolved imports and paths.
        const UNRESOLVED: [&str; 2] = ["E0432", "E0433"];
        let code = self.code.as_ref().map(|code| code.code.as_str());
        self.primary().any(|span| span.file_name == file)
            && code.is_none_or(|code| !UNRESOLVED.contains(&code))
    }

    /// Returns whether the message is about source code, rather than the linker or the machine.
    pub fn is_about_source(&self) -> bool {
        self.spans_in_order().next().is_some()
    }

    /// Returns the section of the handout that explains an error, if any.
    pub fn section(&self) -> Option<Section> {
        let code = self.code.as_ref().map(|code| code.code.as_str());
        compiler_help::section(code, self.text())
    }

    /// Returns the message and its location in this file, on one line. Returns `None` if the
    /// message is about another file.
    pub fn line_of_text(&self, file: &str) -> Option<String> {
        let is_in_file = self.primary().any(|span| span.file_name == file);
        let line = self.line_in(file).filter(|_| is_in_file)?;
        Some(format!("{file}:{line}: {}", self.message))
    }

    /// Returns the complete message as printed by the compiler.
    pub fn text(&self) -> &str {
        self.rendered.as_deref().unwrap_or(&self.message).trim_end()
    }
}

/// Returns the task file whose name appears first in a line of a given file, such as `triangle.rs`
/// for `triangle.bbox()`.
fn called_file(line: &str, task_files: &[TaskFile]) -> Option<&'static str> {
    let line = line.to_lowercase();
    let position = |name: &str| line.find(name.trim_end_matches(".rs"));
    let called = task_files
        .iter()
        .filter_map(|file| Some((position(file.name)?, file.name)));
    called.min().map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handed_out::RAYS;

    fn blame_one(spans: &str, children: &str) -> Option<&'static str> {
        let line = format!(
            r#"{{"message":"m","level":"error","spans":[{spans}],"children":[{children}],"rendered":"r"}}"#
        );
        errors(&line)[0].blamed_file(RAYS.files)
    }

    #[test]
    fn line_comes_from_the_primary_span() {
        let spans = r#"{"file_name":"sphere.rs","is_primary":false,"line_start":1},
            {"file_name":"sphere.rs","is_primary":true,"line_start":7}"#;
        let line = format!(r#"{{"message":"m","level":"error","spans":[{spans}]}}"#);
        let error = &errors(&line.replace('\n', ""))[0];
        assert_eq!(error.line_in("sphere.rs"), Some(7));
        assert_eq!(error.line_in("bvh.rs"), None);
    }

    #[test]
    fn a_brace_that_is_not_closed_is_named_instead_of_the_end_of_the_file() {
        let span = |line: u32, label: &str, is_primary: bool| {
            format!(
                r#"{{"file_name":"bvh.rs","is_primary":{is_primary},"line_start":{line},"label":"{label}"}}"#
            )
        };
        let outer = span(2, "unclosed delimiter", false);
        let inner = span(4, "this delimiter might not be properly closed...", false);
        let end = span(14, "", true);
        for (spans, line) in [
            (format!("{outer},{end}"), 2),
            (format!("{outer},{inner},{end}"), 4),
        ] {
            let message = format!(r#"{{"message":"m","level":"error","spans":[{spans}]}}"#);
            assert_eq!(errors(&message)[0].line_in("bvh.rs"), Some(line));
        }
    }

    const IN_SPHERE: &str = r#"{"file_name":"sphere.rs","is_primary":true}"#;
    const IN_WORLD: &str = r#"{"file_name":"world.rs","is_primary":true}"#;

    #[test]
    fn blames_the_file_with_the_error_or_else_the_one_that_a_given_file_points_to_or_calls() {
        let child = r#"{"message":"defined here","level":"note","spans":[{"file_name":"bvh.rs","is_primary":true}]}"#;
        let call = r#"{"file_name":"primitive.rs","is_primary":true,"text":[{"text":"Primitive::Triangle(triangle) => triangle.bbox(),"}]}"#;
        for (span, child, file) in [
            (IN_SPHERE, "", Some("sphere.rs")),
            (IN_WORLD, child, Some("bvh.rs")),
            (IN_WORLD, "", None),
            (call, "", Some("triangle.rs")),
        ] {
            assert_eq!(blame_one(span, child), file, "{span}");
        }
    }

    #[test]
    fn ignores_noise_and_separates_warnings() {
        let messages = "{\"message\":\"m\",\"level\":\"warning\"}\nnot json";
        assert!(errors(messages).is_empty());
        assert_eq!(warnings(messages).len(), 1);
    }
}
