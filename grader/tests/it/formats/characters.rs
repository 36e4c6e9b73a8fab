//! Characters that could affect the text around them, such as escape sequences and direction marks.
//! Nothing a submission writes may put them in a terminal, a page or a file for a platform.

use grader::exam_source::ExamSource;
use grader::format::{FormatContext, StudentView};
use grader::handed_out::RAYS;
use grader::policy::{Lateness, Policy};
use grader::report::html::{self, Reload};
use grader::report::text::{HintDetail, report};
use grader::report_answers::ReportAnswers;
use grader::rerun_command::RerunCommand;
use grader::score::{Evidence, FileReport, Score, Verdict};
use grader::task_selection::TaskSelection;
use grader::verdict::pending_score;
use judging::exam::Exam;
use judging::sanitize::affects_surroundings;
use serde_json::Value;

use crate::formats::models::readable;
use crate::formats::rendered;

const NONE: [char; 0] = [];

/// Returns a score with this text in every place where text from a submission or its folder's name
/// can end up.
pub fn score_with(text: &str) -> (Exam, Score) {
    let file = ExamSource::Practice.load(&RAYS).unwrap();
    let mut score = pending_score(&file.exam, file.name(), text, &RAYS);
    score.rerun_command = RerunCommand {
        submission: Some(text.into()),
        exam: Some(text.into()),
        assignment: None,
        is_untrusted: false,
    };
    score.build.notes.push(text.to_owned());
    score.build.not_compiled.push(FileReport {
        file: "sphere.rs".to_owned(),
        line: Some(1),
        message: format!("{text}\n{text}"),
        is_missing: false,
    });
    for task in &mut score.tasks {
        task.printed = Some(text.to_owned());
        task.items.truncate(2);
        for item in &mut task.items {
            item.verdict = Verdict::Panicked;
            item.message = text.to_owned();
            item.evidence = Some(Evidence {
                number: 1,
                asked: text.to_owned(),
                got: text.to_owned(),
                wanted: text.to_owned(),
                can_be_shown: true,
            });
        }
    }
    (file.exam, score)
}

/// Returns all strings in a JSON value.
fn texts(value: &Value) -> Vec<String> {
    match value {
        Value::String(text) => vec![text.clone()],
        Value::Array(values) => values.iter().flat_map(texts).collect(),
        Value::Object(values) => values.values().flat_map(texts).collect(),
        Value::Null | Value::Bool(_) | Value::Number(_) => Vec::new(),
    }
}

/// Returns every text about a score that people can read, paired with the name of its output.
fn outputs(text: &str) -> Vec<(&'static str, String)> {
    let (exam, score) = score_with(text);
    let view = StudentView::new(&score, &Policy::default(), Lateness::NONE);
    let context = FormatContext {
        folder: text.to_owned(),
        ..FormatContext::default()
    };
    let outputs = rendered(&view, &context).into_iter().map(|(output, text)| {
        let text = readable(output, &text);
        // JSON escapes control characters, and platforms restore them.
        let text = match serde_json::from_str::<Value>(&text) {
            Ok(value) => texts(&value).join("\n"),
            Err(_) => text,
        };
        (output, text)
    });
    let mut outputs: Vec<(&str, String)> = outputs.collect();
    let answers = ReportAnswers::default();
    let page = html::page(&score, &exam, &answers, Reload::Never);
    outputs.push(("report.html", readable("html", &page)));
    outputs.push((
        "terminal",
        report(&score, &TaskSelection::All, HintDetail::Full),
    ));
    outputs
}

/// Returns the characters in `text` that could affect the text around them, except line breaks.
fn dangerous(text: &str) -> Vec<char> {
    let characters = text.chars();
    let dangerous = characters.filter(|c| *c != '\n' && affects_surroundings(*c));
    dangerous.collect()
}

/// Returns a text that contains every character that could affect the text around it.
fn hostile_text() -> String {
    let characters = (0..=u32::from(char::MAX)).filter_map(char::from_u32);
    let hostile: String = characters.filter(|c| affects_surroundings(*c)).collect();
    format!("a{hostile}z\n{hostile}")
}

#[test]
fn no_output_has_a_character_that_affects_the_text_around_it() {
    let hostile = hostile_text();
    assert!(hostile.chars().count() > 200);
    for (output, text) in outputs(&hostile) {
        // The terminal's own colours don't depend on the text.
        let text = match output {
            "terminal" => without_own_styles(&text),
            _ => text,
        };
        assert_eq!(dangerous(&text), NONE, "{output}: {text:?}");
    }
}

/// Removes the styles that the report itself uses.
fn without_own_styles(text: &str) -> String {
    let styles = ["0", "1", "2", "31", "32", "33"];
    styles.iter().fold(text.to_owned(), |text, style| {
        text.replace(&format!("\u{1b}[{style}m"), "")
    })
}

#[test]
fn the_search_finds_dangerous_characters() {
    assert_eq!(dangerous("a\nb"), NONE);
    assert_eq!(dangerous("\u{1b}[2J\u{202e}"), ['\u{1b}', '\u{202e}']);
    // Every output that shows a submission's harmless text must show a hostile text escaped.
    let showing = |text: &str, shown: &str| -> Vec<&str> {
        let found = outputs(text).into_iter();
        let found = found.filter(|(_, text)| text.contains(shown));
        found.map(|(output, _)| output).collect()
    };
    let escaped = showing("\u{1b}[2J\u{202e}Zaphod", "\\u{1b}[2J\\u{202e}Zaphod");
    assert_eq!(escaped, showing("Zaphod", "Zaphod"));
    for output in ["text", "html", "log", "report.html", "terminal"] {
        assert!(escaped.contains(&output), "{output}");
    }
}
