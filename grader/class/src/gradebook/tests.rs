//! Tests that the right rows are filled in, and the others left unchanged.

use grader::policy::Policy;

use super::*;
use crate::entry::EntryInfo;
use crate::outcome::{EntryOutcome, EntryResult, ScoreSummary};

fn person(name: &str, email: &str, sid: &str, number: &str) -> Person {
    Person {
        name: name.to_owned(),
        email: email.to_owned(),
        sid: sid.to_owned(),
        number: number.to_owned(),
        ..Person::default()
    }
}

fn class(people: &[(&str, Person)]) -> GradedClass {
    let class_row = |(id, person): &(&str, Person)| {
        let row = EntryResult {
            id: (*id).to_owned(),
            info: EntryInfo {
                people: vec![person.clone()],
                ..EntryInfo::default()
            },
            outcome: EntryOutcome::Graded(Box::new(ScoreSummary {
                points: 80,
                max_points: 100,
                tasks: Vec::new(),
            })),
        };
        ClassRow::new(row, &Policy::default(), vec![Vec::new()])
    };
    GradedClass {
        exam: String::new(),
        exam_hash: String::new(),
        isolation: String::new(),
        rows: people.iter().map(class_row).collect(),
        missing: Vec::new(),
    }
}

fn list(text: &str) -> tempfile::NamedTempFile {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), text).unwrap();
    file
}

const CANVAS: &str = "Student,ID,SIS User ID,SIS Login ID,Section,Path (7),Quiz (8)
    Points Possible,,,,,100,5
\"Doe, Jane\",7001,u1,jdoe,A,,1
\"Lee, Ann\",7002,u2,ann,A,,2
\"Lee, Ann\",7003,u3,ann2,B,,3
";

fn cells(filled: &FilledGradebook) -> Vec<&str> {
    let rows = filled.table.rows.iter();
    rows.map(|row| row.last().unwrap().as_str()).collect()
}

#[test]
fn the_most_reliable_key_wins_over_the_name() {
    let file = list(CANVAS);
    // The number is Jane's, although the name is Ann's.
    let class = class(&[("x", person("Ann Lee", "", "", "7001"))]);
    let filled = fill_canvas(file.path(), Some("7"), &class).unwrap();
    assert_eq!(cells(&filled), ["100", "80", "", ""]);
    assert_eq!(
        filled.table.header.len(),
        6,
        "other assignments must not be in the copy"
    );
}

#[test]
fn ambiguous_people_and_duplicate_submissions_are_not_filled_in() {
    let file = list(CANVAS);
    let people = [
        ("a", person("Ann Lee", "", "", "")),
        ("b", person("", "", "u1", "")),
        ("c", person("Jane Doe", "", "", "")),
        ("d", person("Nobody", "", "", "")),
    ];
    let filled = fill_canvas(file.path(), Some("Path"), &class(&people)).unwrap();
    assert_eq!(cells(&filled), ["100", "", "", ""]);
    let wanted = [
        "Ann Lee could be any of Lee, Ann, Lee, Ann: fill in by hand",
        "Nobody is not in this list",
        "Doe, Jane has two submissions, b and c: keep one",
    ];
    assert_eq!(filled.warnings, wanted);
}

#[test]
fn rejects_ambiguous_and_ignored_columns() {
    let file = list(CANVAS);
    let nobody = class(&[]);
    let error = |text: &str, column: Option<&str>| {
        fill_canvas(list(text).path(), column, &nobody)
            .unwrap_err()
            .to_string()
    };
    assert!(error(CANVAS, None).contains("choose one with --column: Path (7); Quiz (8)"));
    assert!(error(CANVAS, Some("Exam")).contains("has no column Exam"));
    let dropped = CANVAS.replace("Path (7)", "Path Final Score (7)");
    assert!(error(&dropped, Some("7")).contains("Canvas ignores columns"));
    assert!(error("a,b\n", None).contains("export the gradebook from Canvas"));
    assert!(fill_canvas(file.path(), Some("Quiz (8)"), &nobody).is_ok());
}

#[test]
fn an_equal_grade_in_another_format_is_not_a_change() {
    let moodles = "Identifier;Full name;Grade;Maximum Grade\nTeilnehmer/in 5;Doe;80,00;50,00\n";
    let file = list(moodles);
    let filled = fill_moodle(file.path(), &class(&[("x", person("", "", "", "5"))])).unwrap();
    assert!(filled.changes.is_empty());
    assert_eq!(filled.table.to_csv(), moodles);
    let warning = "the gradebook's maximum is 50,00, but these points are out of 100: \
                   set out_of in the policy";
    assert_eq!(filled.warnings, [warning]);
}
