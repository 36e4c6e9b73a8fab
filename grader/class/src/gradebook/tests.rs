//! Whom a list means, and what is left alone.

use grader::policy::Policy;

use super::*;
use crate::entry::About;
use crate::outcome::{Outcome, Row, Told};

fn person(name: &str, email: &str, sid: &str, number: &str) -> Person {
    Person {
        name: name.to_owned(),
        email: email.to_owned(),
        sid: sid.to_owned(),
        number: number.to_owned(),
        login: String::new(),
    }
}

fn class(people: &[(&str, Person)]) -> Class {
    let line = |(id, person): &(&str, Person)| {
        let row = Row {
            id: (*id).to_owned(),
            about: About {
                people: vec![person.clone()],
                ..About::default()
            },
            outcome: Outcome::Graded(Box::new(Told {
                points: 80,
                max_points: 100,
                tasks: Vec::new(),
            })),
        };
        Line::of(row, &Policy::default())
    };
    Class {
        exam: String::new(),
        exam_hash: String::new(),
        isolation: String::new(),
        lines: people.iter().map(line).collect(),
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

fn cells(filled: &Filled) -> Vec<&str> {
    let rows = filled.table.rows.iter();
    rows.map(|row| row.last().unwrap().as_str()).collect()
}

#[test]
fn the_surest_key_decides_and_a_name_only_where_nothing_else_does() {
    let file = list(CANVAS);
    // The number is Jane's, whatever the name says.
    let class = class(&[("x", person("Ann Lee", "", "", "7001"))]);
    let filled = canvas(file.path(), Some("7"), &class).unwrap();
    assert_eq!(cells(&filled), ["100", "80", "", ""]);
    assert_eq!(
        filled.table.header.len(),
        6,
        "no other assignment goes back"
    );
}

#[test]
fn two_of_one_name_and_two_submissions_of_one_person_are_left_to_a_person() {
    let file = list(CANVAS);
    let people = [
        ("a", person("Ann Lee", "", "", "")),
        ("b", person("", "", "u1", "")),
        ("c", person("Jane Doe", "", "", "")),
        ("d", person("Nobody", "", "", "")),
    ];
    let filled = canvas(file.path(), Some("Path"), &class(&people)).unwrap();
    assert_eq!(cells(&filled), ["100", "", "", ""]);
    let wanted = [
        "Ann Lee could be any of Lee, Ann, Lee, Ann: fill in by hand",
        "Nobody is not in this list",
        "Doe, Jane has two submissions, b and c: keep one",
    ];
    assert_eq!(filled.warnings, wanted);
}

#[test]
fn a_column_is_named_where_there_are_several_and_one_that_canvas_drops_is_refused() {
    let file = list(CANVAS);
    let nobody = class(&[]);
    let error = |text: &str, meant: Option<&str>| {
        canvas(list(text).path(), meant, &nobody)
            .unwrap_err()
            .to_string()
    };
    assert!(error(CANVAS, None).contains("name it with --column: Path (7); Quiz (8)"));
    assert!(error(CANVAS, Some("Exam")).contains("has no column Exam"));
    let dropped = CANVAS.replace("Path (7)", "Path Final Score (7)");
    assert!(error(&dropped, Some("7")).contains("Canvas ignores columns"));
    assert!(error("a,b\n", None).contains("export the gradebook from Canvas"));
    assert!(canvas(file.path(), Some("Quiz (8)"), &nobody).is_ok());
}

#[test]
fn grades_that_are_right_already_are_no_change_in_whatever_form() {
    let moodles = "Identifier;Full name;Grade;Maximum Grade\nTeilnehmer/in 5;Doe;80,00;50,00\n";
    let file = list(moodles);
    let filled = moodle(file.path(), &class(&[("x", person("", "", "", "5"))])).unwrap();
    assert!(filled.changes.is_empty());
    assert_eq!(filled.table.text(), moodles);
    let warning =
        "the list is out of 50,00, and these points are out of 100: set out_of in the policy";
    assert_eq!(filled.warnings, [warning]);
}
