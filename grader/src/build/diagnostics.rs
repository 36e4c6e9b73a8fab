//! What the compiler says, in its own typed form.

use serde::Deserialize;

use crate::given::TASK_FILES;

/// One message of `rustc --error-format=json`.
#[derive(Clone, Debug, Deserialize)]
pub struct Diagnostic {
    message: String,
    level: String,
    #[serde(default)]
    spans: Vec<Span>,
    #[serde(default)]
    children: Vec<Diagnostic>,
    #[serde(default)]
    rendered: Option<String>,
}

#[derive(Clone, Debug, Deserialize)]
struct Span {
    file_name: String,
    is_primary: bool,
    #[serde(default)]
    line_start: Option<u32>,
    #[serde(default)]
    text: Vec<Line>,
}

/// A line of source that a span touches.
#[derive(Clone, Debug, Deserialize)]
struct Line {
    text: String,
}

/// All errors among the compiler's messages; warnings are a matter between it and the student.
pub fn errors(messages: &str) -> Vec<Diagnostic> {
    messages
        .lines()
        .filter_map(|line| serde_json::from_str::<Diagnostic>(line).ok())
        .filter(|diagnostic| diagnostic.level.starts_with("error"))
        .collect()
}

impl Diagnostic {
    /// Which of the five files has to be mended: the one that the error is in. An error in a given
    /// file is told of the file that it points to for an explanation ("method not found for this
    /// struct"), else of the one that its line calls.
    pub fn blamed(&self) -> Option<&'static str> {
        let primary = || self.spans.iter().filter(|span| span.is_primary);
        let secondary = self.spans.iter().filter(|span| !span.is_primary);
        let explaining = self.children.iter().flat_map(|child| &child.spans);
        primary()
            .chain(secondary)
            .chain(explaining)
            .find_map(|span| TASK_FILES.iter().find(|file| file.name == span.file_name))
            .map(|file| file.name)
            .or_else(|| {
                primary()
                    .flat_map(|span| &span.text)
                    .find_map(|line| called(&line.text))
            })
    }

    /// The first line of the error in this file, counted from 1. None if it is in another.
    pub fn line_in(&self, file: &str) -> Option<u32> {
        let mut spans = self.spans.iter().filter(|span| span.is_primary);
        spans.find(|span| span.file_name == file)?.line_start
    }

    /// The whole message, as the compiler prints it.
    pub fn text(&self) -> &str {
        self.rendered.as_deref().unwrap_or(&self.message).trim_end()
    }
}

/// The file that a line of a given file calls first, by its name: `triangle.bbox()`.
fn called(line: &str) -> Option<&'static str> {
    let line = line.to_lowercase();
    let place = |name: &str| line.find(name.trim_end_matches(".rs"));
    let named = TASK_FILES
        .iter()
        .filter_map(|file| Some((place(file.name)?, file.name)));
    named.min().map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(spans: &str, children: &str) -> Option<&'static str> {
        let line = format!(
            r#"{{"message":"m","level":"error","spans":[{spans}],"children":[{children}],"rendered":"r"}}"#
        );
        errors(&line)[0].blamed()
    }

    #[test]
    fn the_line_is_that_of_the_error_itself() {
        let spans = r#"{"file_name":"sphere.rs","is_primary":false,"line_start":1},
            {"file_name":"sphere.rs","is_primary":true,"line_start":7}"#;
        let line = format!(r#"{{"message":"m","level":"error","spans":[{spans}]}}"#);
        let error = &errors(&line.replace('\n', ""))[0];
        assert_eq!(error.line_in("sphere.rs"), Some(7));
        assert_eq!(error.line_in("bvh.rs"), None);
    }

    const IN_SPHERE: &str = r#"{"file_name":"sphere.rs","is_primary":true}"#;
    const IN_WORLD: &str = r#"{"file_name":"world.rs","is_primary":true}"#;

    #[test]
    fn the_file_with_the_error_is_blamed() {
        assert_eq!(one(IN_SPHERE, ""), Some("sphere.rs"));
    }

    #[test]
    fn an_error_in_a_given_file_is_told_of_what_it_points_to() {
        let child = r#"{"message":"defined here","level":"note","spans":[{"file_name":"bvh.rs","is_primary":true}]}"#;
        assert_eq!(one(IN_WORLD, child), Some("bvh.rs"));
        assert_eq!(one(IN_WORLD, ""), None);
    }

    #[test]
    fn an_error_that_points_nowhere_is_told_of_what_its_line_calls() {
        let span = r#"{"file_name":"primitive.rs","is_primary":true,"text":[{"text":"Primitive::Triangle(triangle) => triangle.bbox(),"}]}"#;
        assert_eq!(one(span, ""), Some("triangle.rs"));
    }

    #[test]
    fn warnings_and_noise_are_passed_over() {
        assert!(errors("{\"message\":\"m\",\"level\":\"warning\"}\nnot json").is_empty());
    }
}
