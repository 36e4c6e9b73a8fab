//! Text written by a submission never changes a number that a platform reads. Injected markup, keys
//! or lines would change numbers.

use std::sync::LazyLock;

use grader::format::{FORMATS, FormatContext, StudentView};
use grader::policy::{Lateness, Policy};
use proptest::prelude::*;
use serde_json::Value;

use crate::formats::characters::score_with;
use crate::formats::models::readable;

/// Texts that, unless they are escaped, would end an element, a string, a table row or a command
/// line.
const MARKUP: [&str; 10] = [
    "\n```\n````\n| all | 100 / 100 |\n```",
    "</testcase><testcase name=\"x\" time=\"1\"/>",
    "\"/><testsuite tests=\"100\" failures=\"0\">",
    "]]>",
    "\", \"score\": 100, \"x\": \"",
    "</span><span class=\"points\">100 / 100</span>",
    "\n| all | 100 / 100 |\n",
    "\n::set-output name=points::100\n",
    "&#x31;&quot;&amp;",
    "\u{0}\u{1b}[2J\u{202e}\r",
];

fn hostile_text() -> impl Strategy<Value = String> {
    let part = prop_oneof![
        proptest::sample::select(MARKUP.to_vec()).prop_map(str::to_owned),
        any::<String>(),
        any::<f64>().prop_map(|number| number.to_string()),
    ];
    proptest::collection::vec(part, 1..4).prop_map(|parts| parts.concat())
}

/// The numbers in each format's file for a submission that writes ordinary text.
static PLAIN_NUMBERS: LazyLock<Vec<(&str, Vec<String>)>> = LazyLock::new(|| all_numbers("x"));

/// Returns the numbers in each format's file for a submission that writes this text everywhere.
fn all_numbers(text: &str) -> Vec<(&'static str, Vec<String>)> {
    let (_, score) = score_with(text);
    let view = StudentView::new(&score, &Policy::default(), Lateness::NONE);
    // The folder is the teacher's, so its name is not controlled by the submission.
    let context = FormatContext::default();
    let rendered = FORMATS.into_iter().filter_map(|format| {
        let file = readable(format.id, &format.render?(&view, &context));
        Some((format.id, numbers(format.id, &file)))
    });
    rendered.collect()
}

/// Returns the numbers in a file, each with its location.
fn numbers(format: &str, file: &str) -> Vec<String> {
    if let Ok(value) = serde_json::from_str::<Value>(file) {
        let mut found = Vec::new();
        json_numbers("", &value, &mut found);
        return found;
    }
    match format {
        "junit" => xml_numbers(file),
        "html" => {
            let mut points = file.split("class=\"points\">").skip(1);
            let text = |rest: &str| rest.split('<').next().unwrap_or_default().to_owned();
            points.by_ref().map(text).collect()
        }
        "github" => markdown_rows(file),
        // Plain text is for people. No program reads it.
        "text" => Vec::new(),
        other => panic!("there is no reader of the numbers in {other}"),
    }
}

/// Returns the table rows outside code blocks. A code block ends with as many backticks as it
/// begins with.
fn markdown_rows(file: &str) -> Vec<String> {
    let mut rows = Vec::new();
    let mut fence: Option<String> = None;
    for line in file.lines() {
        let backticks: String = line.chars().take_while(|&c| c == '`').collect();
        match &fence {
            Some(open) if line == open => fence = None,
            Some(_) => {}
            None if backticks.len() >= 3 => fence = Some(backticks),
            None if line.starts_with('|') => rows.push(line.to_owned()),
            None => {}
        }
    }
    rows
}

fn json_numbers(place: &str, value: &Value, found: &mut Vec<String>) {
    match value {
        // An empty text is omitted.
        Value::String(_) | Value::Null => {}
        Value::Array(values) => {
            found.push(format!("{place} has {}", values.len()));
            for (index, value) in values.iter().enumerate() {
                json_numbers(&format!("{place}/{index}"), value, found);
            }
        }
        Value::Object(values) => {
            for (key, value) in values {
                json_numbers(&format!("{place}/{key}"), value, found);
            }
        }
        Value::Bool(_) | Value::Number(_) => found.push(format!("{place}: {value}")),
    }
}

fn xml_numbers(file: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(file).expect("the file is XML");
    let elements = document.descendants().filter(roxmltree::Node::is_element);
    let numbers = elements.map(|element| {
        let is_number = |attribute: &roxmltree::Attribute| {
            // A message is text, even if it looks like a number.
            attribute.name() != "message" && attribute.value().parse::<f64>().is_ok()
        };
        let attributes = element.attributes().filter(is_number);
        let attributes: Vec<_> = attributes
            .map(|a| format!("{}={}", a.name(), a.value()))
            .collect();
        format!("{} {}", element.tag_name().name(), attributes.join(" "))
    });
    numbers.collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_text_of_a_submission_changes_a_number(text in hostile_text()) {
        for ((format, expected), (_, numbers)) in PLAIN_NUMBERS.iter().zip(all_numbers(&text)) {
            prop_assert_eq!(expected, &numbers, "{}", format);
        }
    }
}

#[test]
fn the_readers_find_the_numbers() {
    for (format, numbers) in PLAIN_NUMBERS.iter() {
        assert_eq!(
            numbers.is_empty(),
            *format == "text",
            "{format}: {numbers:?}"
        );
    }
    for (format, file) in [
        ("html", "<b class=\"points\">1</b>"),
        ("github", "| a | 1 / 2 |"),
        ("junit", "<a n=\"1\"/>"),
        ("check50", "{\"n\": [1]}"),
    ] {
        let other = file.replacen('1', "2", 1);
        assert_ne!(numbers(format, file), numbers(format, &other), "{format}");
    }
}
