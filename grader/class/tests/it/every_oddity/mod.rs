//! Sixty submissions: the same twelve odd submissions in the export formats of five platforms.
//! Every person is graded or listed with a reason, and all files agree on the numbers.

mod cases;
mod platforms;

use std::collections::BTreeMap;

use serde_json::Value;

use self::cases::{PART, cases};
use self::platforms::{Platform, Student, students};
use crate::harness::{TestClass, assert_contains, table};

const ITEMS: [&str; 2] = ["camera.offset", "sphere.radius"];
const POLICY: &str = "[points]\nout_of = 100\n[late]\ndue = 2026-11-20T23:59:59+01:00\n\
                      timezone = \"Europe/Berlin\"\npercent_per_day = 10\n";

/// Grades a class exported from a platform. Every person must be graded or listed with a reason,
/// and the totals must add up.
fn check(platform: Platform) {
    let cases = cases();
    assert_eq!(Platform::ALL.len() * cases.len(), 60);
    let students = students(&cases);
    let class = platform.export(&students);
    let exam = class.small_exam(&ITEMS);
    let lists = platform.lists(&students);
    let lists = lists.iter().map(|(list, text)| (*list, text.as_str()));
    let lists: Vec<(&str, &str)> = lists.chain([("policy", POLICY)]).collect();
    let text = class.graded_with(&exam, &lists, &[]);
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
            Some(PART) => {
                let counts = row["counts"].parse().unwrap();
                assert!((1..100).contains(&counts), "{title}");
            }
            counts => assert_eq!(row["counts"], counts.unwrap_or_default(), "{title}"),
        }
        // A submission without a grade needs a reason.
        let needs_reason = case.is_some_and(|case| case.counts.is_none());
        assert_eq!(!row["why"].is_empty(), needs_reason, "{title}");
    }
}

/// Checks that the terminal, `class.json` and the page show the same numbers as the table.
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
    for (key, expected) in [
        ("graded", graded),
        ("nothing_to_grade", nothing),
        ("not_graded", 0),
        ("missing", missing),
        ("unclear_times", unclear),
    ] {
        assert_eq!(summary[key], expected, "{platform:?}, {key}");
    }
    let texts = [
        format!("{graded} graded, small exam"),
        format!("{nothing} with nothing to grade"),
        format!("{missing} on a roster, but without a submission"),
        format!("{unclear} without final points"),
    ];
    assert_contains(text, &texts.each_ref().map(String::as_str));
    assert!(!text.contains("not graded because"), "{text}");
    let page = class.read("class.html");
    let head = format!(
        "{graded} graded, {nothing} with nothing to grade, 0 not graded, {missing} without a submission."
    );
    let submissions = format!("<h1>{} submissions", rows.len() - missing);
    assert_contains(&page, &[&head, &submissions]);
    let bins = summary["points"]["bins"].as_array().unwrap();
    let in_bins: u64 = bins.iter().map(|count| count.as_u64().unwrap()).sum();
    assert_eq!(in_bins, graded as u64, "{platform:?}");

    let (_, section) = page.split_once("<table class=\"sortable\">").unwrap();
    let (section, _) = section.split_once("</table>").unwrap();
    assert_eq!(section.matches("<th scope=\"row\">").count(), rows.len());
}

/// Checks that the gradebook contains exactly the final points.
fn check_gradebook(platform: Platform, class: &TestClass, students: &[Student]) {
    let (name, key, points) = platform.gradebook();
    let text = class.read(name);
    let gradebook = table(&text);
    let grades = table(&class.read("grades.csv"));
    let row = |table: &[BTreeMap<String, String>], column: &str, key: &str| {
        let row = table.iter().find(|row| row[column] == key).cloned();
        row.unwrap_or_else(|| panic!("{platform:?}, {key}: {text}"))
    };
    let number = |text: &str| text.replace(',', ".").parse::<f64>().ok();
    for student in students {
        let written = number(&row(&gradebook, key, &platform.key(student))[points]);
        let counts = number(&row(&grades, "name", &student.name)["counts"]);
        assert_eq!(written, counts, "{platform:?}, {}", student.name);
    }
}
