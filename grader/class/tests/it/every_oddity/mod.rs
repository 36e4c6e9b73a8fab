//! Sixty submissions: twelve oddities, as each of five platforms exports them. Every person is
//! graded or listed with a reason, and all files agree on the numbers.

mod cases;
mod platforms;

use std::collections::BTreeMap;

use serde_json::Value;

use self::cases::{PART, cases};
use self::platforms::{Platform, Student, students};
use crate::harness::TestClass;

const ITEMS: [&str; 2] = ["camera.offset", "sphere.radius"];
const POLICY: &str = "[points]\nout_of = 100\n[late]\ndue = 2026-11-20T23:59:59+01:00\n\
                      timezone = \"Europe/Berlin\"\npercent_per_day = 10\n";

/// Returns the rows of a table, each by the titles of its columns.
fn table(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(text.trim_start_matches('\u{feff}').as_bytes());
    reader.deserialize().map(Result::unwrap).collect()
}

/// Returns the number before these words, or 0 if a text does not contain them.
fn count_before(text: &str, words: &str) -> usize {
    let (before, _) = match text.split_once(words) {
        Some(parts) => parts,
        None => return 0,
    };
    let digits = before.trim_end().rsplit(|c: char| !c.is_ascii_digit());
    let digits = digits.into_iter().next().unwrap();
    digits.parse().unwrap_or_else(|_| panic!("{words}: {text}"))
}

/// Grades the class of a platform. Every person must be graded or listed with a reason, and the
/// counts must add up.
fn check(platform: Platform) {
    let cases = cases();
    assert_eq!(Platform::ALL.len() * cases.len(), 60);
    let students = students(&cases);
    let class = platform.export(&students);
    let policy = class.write_beside("policy.toml", POLICY);
    let exam = class.small_exam(&ITEMS);
    let lists = platform.lists(&class, &students);
    let lists = lists.iter().map(String::as_str);
    let options: Vec<&str> = ["--policy", &policy].into_iter().chain(lists).collect();
    let text = class.graded(&exam, &options);
    check_grades(platform, &class, &students);
    check_counts(platform, &class, &text);
    check_gradebook(platform, &class, &students);
}

#[test]
fn gradescope() {
    check(Platform::Gradescope);
}

#[test]
fn canvas() {
    check(Platform::Canvas);
}

#[test]
fn moodle() {
    check(Platform::Moodle);
}

#[test]
fn github() {
    check(Platform::GitHub);
}

#[test]
fn folders_and_archives() {
    check(Platform::Plain);
}

/// Checks the row of each person.
fn check_grades(platform: Platform, class: &TestClass, students: &[Student]) {
    let grades = class.read("grades.csv");
    let rows = table(&grades);
    assert_eq!(rows.len(), students.len(), "{platform:?}: {grades}");
    for student in students {
        let mut own = rows.iter().filter(|row| row["name"] == student.name);
        let (Some(row), None) = (own.next(), own.next()) else {
            panic!("{platform:?}: not one row for {}: {grades}", student.name)
        };
        let case = student.case;
        let title = format!("{platform:?}, {}: {row:?}", student.name);
        let status = case.map_or("nothing submitted", |case| case.status);
        assert_eq!(row["status"], status, "{title}");
        match case.and_then(|case| case.counts) {
            Some(PART) => assert!(
                (1..100).contains(&row["counts"].parse().unwrap()),
                "{title}"
            ),
            counts => assert_eq!(row["counts"], counts.unwrap_or_default(), "{title}"),
        }
        // A submission without a grade has a reason.
        let needs_reason = case.is_some_and(|case| case.counts.is_none());
        assert_eq!(!row["why"].is_empty(), needs_reason, "{title}");
    }
}

/// Checks that the terminal, `class.json` and the page have the same numbers as the table.
fn check_counts(platform: Platform, class: &TestClass, text: &str) {
    let grades = class.read("grades.csv");
    let rows = table(&grades);
    let count = |status: &str| rows.iter().filter(|row| row["status"] == status).count();
    let unclear = count("time unclear");
    // A score without final points is still a score.
    let graded = count("graded") + unclear;
    let (nothing, missing) = (count("nothing to grade"), count("nothing submitted"));
    assert_eq!(graded + nothing + missing, rows.len(), "{grades}");

    let summary: Value = serde_json::from_str(&class.read("class.json")).unwrap();
    let page = class.read("class.html");
    for (key, expected, in_text, in_page) in [
        ("graded", graded, "graded, small exam", "graded, "),
        (
            "nothing_to_grade",
            nothing,
            "without anything that can be graded",
            "with nothing to grade",
        ),
        ("not_graded", 0, "not graded because", "not graded, "),
        (
            "missing",
            missing,
            "on a roster, but submitted nothing",
            "without a submission",
        ),
    ] {
        let title = format!("{platform:?}, {key}");
        assert_eq!(summary[key], expected, "{title}");
        assert_eq!(count_before(text, in_text), expected, "{title}: {text}");
        let (_, head) = page.split_once("</h1>").unwrap();
        assert_eq!(count_before(head, in_page), expected, "{title}");
    }
    assert_eq!(summary["unclear_times"], unclear, "{platform:?}");
    assert_eq!(
        count_before(text, "without final points"),
        unclear,
        "{text}"
    );
    let bins = summary["points"]["bins"].as_array().unwrap();
    let in_bins: u64 = bins.iter().map(|count| count.as_u64().unwrap()).sum();
    assert_eq!(in_bins, graded as u64, "{platform:?}");

    let submissions = format!("<h1>{} submissions", rows.len() - missing);
    assert!(page.contains(&submissions), "{platform:?}");
    let (_, section) = page.split_once("<table class=\"sortable\">").unwrap();
    let (section, _) = section.split_once("</table>").unwrap();
    assert_eq!(section.matches("<th scope=\"row\">").count(), rows.len());
}

/// Checks that the gradebook has exactly the points that count.
fn check_gradebook(platform: Platform, class: &TestClass, students: &[Student]) {
    let (name, key, points) = platform.gradebook();
    let text = class.read(name);
    let gradebook = table(&text);
    let grades = table(&class.read("grades.csv"));
    for student in students {
        let row = |table: &[BTreeMap<String, String>], column: &str, key: &str| {
            let row = table.iter().find(|row| row[column] == key);
            row.unwrap_or_else(|| panic!("{platform:?}, {key}: {text}"))
                .clone()
        };
        let written = &row(&gradebook, key, &platform.key(student))[points];
        let counts = &row(&grades, "name", &student.name)["counts"];
        let number = |text: &str| text.replace(',', ".").parse::<f64>().ok();
        assert_eq!(
            number(written),
            number(counts),
            "{platform:?}, {}",
            student.name
        );
    }
}
