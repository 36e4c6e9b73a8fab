//! Tests that the right rows are filled in and the others are left unchanged.

use grader::policy::Policy;
use serde_json::json;

use super::*;
use crate::graded_class::{Adjustments, GradeProblem, tests};
use crate::outcome::EntryOutcome;

fn person(name: &str, email: &str, sid: &str, number: &str) -> Person {
    tests::person(json!({ "name": name, "email": email, "sid": sid, "number": number }))
}

/// Returns a class where each person has 80 of 100 points.
fn class(people: &[(&str, Person)]) -> GradedClass {
    let class_row = |(id, person): &(&str, Person)| {
        let mut result = tests::result(id, &[], tests::graded(80));
        result.info.people.push(person.clone());
        ClassRow::new(
            result,
            &Policy::default(),
            vec![Adjustments::default()],
            &[],
        )
    };
    GradedClass {
        rows: people.iter().map(class_row).collect(),
        ..GradedClass::default()
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

fn canvas(text: &str, class: &GradedClass) -> FilledGradebook {
    fill_canvas(list(text).path(), Some("7"), class).unwrap()
}

fn moodle(text: &str, class: &GradedClass) -> FilledGradebook {
    fill_moodle(list(text).path(), class).unwrap()
}

fn gradescope(text: &str, class: &GradedClass) -> FilledGradebook {
    fill_gradescope(list(text).path(), class).unwrap()
}

fn cells(filled: &FilledGradebook) -> Vec<&str> {
    let rows = filled.table.rows.iter();
    rows.map(|row| row.last().unwrap().as_str()).collect()
}

#[test]
fn a_row_is_filled_in_if_it_is_clear_whose_it_is() {
    let named = |name: &str| person(name, "", "", "");
    let with_sid = |sid: &str| person("Ann Lee", "", sid, "");
    for (people, expected, warnings) in [
        // The second number is Jane's, but the name isn't.
        (
            vec![
                ("x", person("leeann", "", "", "7002")),
                ("y", person("Eve", "", "", "7001")),
            ],
            ["100", "", "80", ""],
            vec!["Eve's number belongs to Doe, Jane in this list: enter the points by hand"],
        ),
        (
            vec![
                ("a", named("Ann Lee")),
                ("b", person("", "", "u1", "")),
                ("c", named("Jane Doe")),
                ("d", named("Nobody")),
            ],
            ["100", "", "", ""],
            vec![
                "Ann Lee could be any of Lee, Ann (7002); Lee, Ann (7003): enter the points by \
                 hand",
                "Nobody is not in this list, so the copy has no row for them",
                "Doe, Jane has several submissions (b, c), so this row is left unchanged: keep only one submission",
            ],
        ),
        // A namesake with several submissions doesn't affect Jane's points.
        (
            vec![
                ("a", with_sid("u2")),
                ("b", with_sid("u3")),
                ("c", with_sid("u2")),
            ],
            ["100", "", "", "80"],
            vec![
                "Lee, Ann (7002) has several submissions (a, c), so this row is left unchanged: keep only one submission",
            ],
        ),
    ] {
        let filled = canvas(CANVAS, &class(&people));
        assert_eq!(cells(&filled), expected);
        assert_eq!(filled.warnings, warnings);
        // Other assignments must not be in the copy.
        assert_eq!(filled.table.header.len(), 6);
    }
    let table = CANVAS.replace("Doe, Jane", " Doe ,  Jane ");
    let filled = canvas(&table, &class(&[("x", named("jane doe"))]));
    assert_eq!(cells(&filled), ["100", "80", "", ""]);
}

/// A name is ignored if a number or a student id shows that the row is somebody else's.
#[test]
fn a_namesake_with_another_id_gets_no_points() {
    let moodles = "Identifier,Full name,ID number,Email address,Grade\n\
                   Participant 5,Jane Doe,u1,jane@x.edu,\n";
    for (person, is_other) in [
        (person("Jane Doe", "", "u9", ""), true),
        (person("Jane Doe", "", "", "9"), true),
        // Jane may use a different address, or less may be known about her.
        (person("Jane Doe", "jane@home.org", "", ""), false),
        (person("Jane Doe", "jane@home.org", "U1", ""), false),
    ] {
        let class = class(&[("x", person)]);
        let (of_canvas, of_moodle) = (canvas(CANVAS, &class), moodle(moodles, &class));
        for (filled, name) in [(of_canvas, "Doe, Jane"), (of_moodle, "Jane Doe")] {
            let mut wanted = Vec::new();
            if is_other {
                wanted.push(format!(
                    "Jane Doe was not matched to {name}, who has a different number or student id \
                     in this list: enter the points by hand"
                ));
            }
            assert_eq!(filled.warnings, wanted);
            assert_eq!(filled.changes.is_empty(), is_other);
        }
    }
}

#[test]
fn an_equal_grade_in_another_format_is_not_a_change() {
    let moodles = "Identifier;Full name;Grade;Maximum Grade\nTeilnehmer/in 5;Doe;80,00;50,00\n";
    let filled = moodle(moodles, &class(&[("x", person("", "", "", "5"))]));
    assert!(filled.changes.is_empty());
    assert_eq!(filled.table.to_csv(), moodles);
    let warning = "the gradebook's maximum is 50,00, but these points are out of 100: set `out_of` \
                   in the policy";
    assert_eq!(filled.warnings, [warning]);
}

#[test]
fn a_cell_is_filled_in_only_if_points_count_and_it_may_change() {
    let moodles = "Identifier,Full name,Grade,Maximum Grade,Grade can be changed
Participant 1,Ann,,100.00,Yes
Participant 2,Bob,12.50,100.00, no 
Participant 3,Carl, EX ,100.00,Yes
Participant 4,Dora, 80.00 ,100.00,Yes
Participant 5,Eve,,100.00,Yes
Participant 6,Finn,,100.00,Yes
";
    let people = [1, 2, 3, 4, 5, 6].map(|number| number.to_string());
    let people = people.map(|number| ("x", person("", "", "", &number)));
    let mut class = class(&people);
    for row in &mut class.rows[4..] {
        row.grades[0].counted = None;
    }
    class.rows[4].result.outcome = EntryOutcome::NothingToGrade("empty".to_owned());
    class.rows[5].grades[0].problem = Some(GradeProblem::SeveralAttempts(
        vec!["b".to_owned()],
        "remove one".to_owned(),
    ));
    let filled = moodle(moodles, &class);
    let change = CellChange {
        who: "Ann".to_owned(),
        was: String::new(),
        now: "80".to_owned(),
    };
    assert_eq!(filled.changes, [change]);
    insta::assert_snapshot!(filled.table.to_csv(), @"
    Identifier,Full name,Grade,Maximum Grade,Grade can be changed
    Participant 1,Ann,80,100.00,Yes
    Participant 2,Bob,12.50,100.00, no 
    Participant 3,Carl, EX ,100.00,Yes
    Participant 4,Dora, 80.00 ,100.00,Yes
    Participant 5,Eve,,100.00,Yes
    Participant 6,Finn,,100.00,Yes
    ");
    insta::assert_snapshot!(filled.warnings.join("\n"), @"
    Bob: the platform does not allow changes; left unchanged, so the gradebook still shows 12.50: if that is wrong, change it by hand
    Carl is excused; left unchanged
    Eve: nothing to grade; left unchanged
    Finn: the same person also submitted b: remove one; left unchanged
    ");
}

#[test]
fn an_attempt_that_does_not_count_is_not_filled_in_and_needs_no_warning() {
    let people = [
        ("a", person("", "", "u1", "")),
        ("b", person("", "", "u1", "")),
    ];
    let mut class = class(&people);
    let grade = &mut class.rows[0].grades[0];
    (grade.counted, grade.problem) = (None, Some(GradeProblem::OtherAttempt("b".to_owned())));
    let filled = canvas(CANVAS, &class);
    assert_eq!(cells(&filled), ["100", "80", "", ""]);
    assert_eq!(filled.warnings, Vec::<String>::new());
}

#[test]
fn every_key_of_a_platform_finds_its_row() {
    let login = |login: &str| tests::person(json!({ "login": login }));
    let at_canvas = [
        ("number", person("", "", "", "7001")),
        ("sid", person("", "", " U1 ", "")),
        ("login", login("jdoe")),
        // If people log in with their address, Canvas uses it instead of an account name.
        ("email", person("", "JDoe", "", "")),
        ("name", person("jane doe", "", "", "")),
    ];
    for (key, person) in at_canvas {
        let filled = canvas(CANVAS, &class(&[("x", person)]));
        assert_eq!(cells(&filled), ["100", "80", "", ""], "{key}");
    }
    let moodles = "Identifier,Full name,ID number,Email address,Grade\n\
                   Participant 5,Ann,u1,ann@x.edu,\nParticipant 6,Bob,u2,,\n";
    let gradescopes = "First Name,Last Name,SID,Email,Total Score,Max Points\n\
                       Ann,Lee,u1,ann@x.edu,,50\nBob,Kim,u2,bob@x.edu,,50\n";
    for (key, person) in [
        ("number", person("", "", "", "5")),
        ("sid", person("", "", "u1", "")),
        ("email", person("", "ann@x.edu", "", "")),
        ("name", person("Ann", "", "", "")),
    ] {
        let class = class(&[("x", person)]);
        let filled = moodle(moodles, &class);
        assert_eq!(cells(&filled), ["80", ""], "{key}");
        let filled = gradescope(gradescopes, &class);
        let warning = "the gradebook's maximum is 50, but these points are out of 100: set \
                       `out_of` in the policy";
        if ["sid", "email"].contains(&key) {
            assert_eq!(filled.changes[0].who, "Ann Lee", "{key}");
            assert_eq!(filled.table.rows[0][4], "80", "{key}");
            assert_eq!(filled.warnings, [warning], "{key}");
        } else {
            assert_eq!(filled.changes, [], "{key}");
        }
    }
}

#[test]
fn rows_that_are_not_of_people_match_nobody() {
    // Neither the row with the maximum nor the test student's row in Canvas has a number.
    let canvases = "Student,ID,SIS User ID,Section,Path (7)\n\
                  Points Possible,7001,u1,,100\nJane,,u1,A,\nJane,7002,u1,A,\n";
    let by_sid = class(&[("x", person("", "", "u1", ""))]);
    let filled = canvas(canvases, &by_sid);
    assert_eq!(cells(&filled), ["100", "", "80"]);
    let moodles = "Identifier,ID number,Grade\n,u1,\nParticipant 5,u1,\n";
    let filled = moodle(moodles, &by_sid);
    assert_eq!(cells(&filled), ["", "80"]);
    let gradescopes = "Email,SID,Total Score\n,u1,\nann@x.edu,u1,\n";
    let filled = gradescope(gradescopes, &by_sid);
    assert_eq!(cells(&filled), ["", "80"]);
    assert_eq!(filled.changes[0].who, "ann@x.edu", "there is no name");
    // An empty cell must not match people without identifiers.
    let unknown = class(&[("x", person("", "", "", ""))]);
    let filled = canvas(canvases, &unknown);
    assert_eq!(filled.changes, []);
}

#[test]
fn a_canvas_column_is_named_by_its_title_or_its_number() {
    let nobody = class(&[]);
    let find = |header: &str, column: Option<&str>| {
        let file = list(&format!("Student,ID,Section,{header}\n"));
        match fill_canvas(file.path(), column, &nobody) {
            Ok(filled) => filled.title,
            Err(error) => error.to_string(),
        }
    };
    let two = "Path (7),Quiz (8),Notes";
    for (header, column, expected) in [
        (two, Some("Path"), "Canvas, Path (7)"),
        (two, Some("7"), "Canvas, Path (7)"),
        (two, Some("Path (7)"), "Canvas, Path (7)"),
        (two, Some("Notes"), "Canvas, Notes"),
        ("Lab (a) (7)", Some("Lab (a)"), "Canvas, Lab (a) (7)"),
        (two, Some("P"), "has no column P: "),
        (two, Some("(7)"), "has no column (7): "),
        (two, Some("Section"), "has no column Section: "),
        (two, Some(""), "has no column : "),
        ("Path Final Score (7)", Some("7"), "Canvas ignores columns"),
        // Without a name, there must be exactly one assignment column.
        ("Notes,Path (7)", None, "Canvas, Path (7)"),
        ("Notes,Path (a7)", None, "--column"),
        (two, None, "choose one with --column: Path (7); Quiz (8)"),
    ] {
        let found = find(header, column);
        assert!(found.contains(expected), "{header} {column:?}: {found}");
    }
    let error = fill_canvas(list("a,b\n").path(), None, &nobody);
    let error = error.unwrap_err().to_string();
    assert!(error.contains("export the gradebook from Canvas"));
}

#[test]
fn only_a_known_maximum_that_differs_needs_a_warning() {
    let one = class(&[("x", person("", "", "", "5"))]);
    let warnings = |maximum: &str, class: &GradedClass| {
        let text = format!("Identifier;Grade;Maximum Grade\nP 5;;{maximum}\n");
        moodle(&text, class).warnings
    };
    assert_eq!(warnings("100,00", &one), Vec::<String>::new());
    assert_eq!(warnings(" ", &one), Vec::<String>::new());
    assert_eq!(warnings("99", &one).len(), 1);
    assert_eq!(warnings("99", &class(&[])), Vec::<String>::new());
    // Canvas lists the maximum in the row of possible points.
    let jane = class(&[("x", person("", "", "", "7001"))]);
    assert_eq!(canvas(CANVAS, &jane).warnings, Vec::<String>::new());
    let warning = "the gradebook's maximum is 50, but these points are out of 100: set `out_of` in \
                   the policy";
    let filled = canvas(&CANVAS.replace(",100,", ",50,"), &jane);
    assert_eq!(filled.warnings, [warning]);
}

#[test]
fn people_of_one_submission_who_share_a_row_are_told_apart_by_the_name() {
    let grades = "First Name,Last Name,SID,Email,Total Score,Max Points\nAnn,Lee,,a@x.edu,,100\n";
    let fill = |names: &[&str]| {
        let mut class = class(&[("x", person(names[0], "a@x.edu", "", ""))]);
        let row = &mut class.rows[0];
        for name in &names[1..] {
            row.result.info.people.push(person(name, "a@x.edu", "", ""));
            row.grades.push(row.grades[0].clone());
        }
        let filled = gradescope(grades, &class);
        (filled.table.rows[0][4].clone(), filled.warnings)
    };
    assert_eq!(fill(&["Ann Lee", "ann lee"]), ("80".to_owned(), vec![]));
    let wanted = |name: &str| {
        format!("the row for Ann Lee could also refer to {name} from x: enter the points by hand")
    };
    let (filled, warnings) = fill(&["Bob", "Ann Lee"]);
    assert_eq!((filled.as_str(), warnings), ("80", vec![wanted("Bob")]));
    let (filled, warnings) = fill(&["Bob", "Cid"]);
    assert_eq!((filled.as_str(), warnings), ("", vec![wanted("Cid")]));
}

#[test]
fn a_worksheet_in_another_language_is_named_as_such() {
    let fill = |text: &str| {
        let file = list(text);
        let error = fill_moodle(file.path(), &class(&[]))
            .unwrap_err()
            .to_string();
        error.contains("in a language other than English")
    };
    assert!(fill(
        "ID,Vollständiger Name,Bewertung\nTeilnehmer/in 301,José Núñez,\n"
    ));
    assert!(fill("ID,Nom complet,Note\nParticipant301,José Núñez,\n"));
    assert!(!fill("name,email\nJosé Núñez,jose@x.edu\n"));
    assert!(!fill("id,name\nu301,José Núñez\n"));
}
