//! Tests that fill in the teacher's gradebooks with the points of a class.

use insta::assert_snapshot;

use crate::harness::{TestClass, assert_contains};

#[test]
fn rejects_an_ambiguous_gradebook_before_grading() {
    let class = TestClass::named("class").with_reference("ann");
    let exam = class.small_exam(&["camera.offset"]);
    let canvas = "Student,ID,SIS Login ID,Section,One (1),Two (2)\n";
    let canvas = class.write_beside("canvas-export.csv", canvas);
    let error = class.refused(&exam, &["--canvas", &canvas]);
    assert!(error.contains("choose one with --column"), "{error}");
    let error = class.refused(&exam, &["--canvas", &canvas, "--column", "Three"]);
    assert_contains(&error, &["at the end of its title: One (1); Two (2)"]);
    assert!(!class.out().exists(), "nothing must be graded");
}

#[test]
fn fills_each_gradebook_and_reports_changes_and_missing_people() {
    let metadata = "---
submission_1:
  :submitters:
  - :name: José Núñez
    :sid: u1
    :email: jose@example.edu
  - :name: Ann Lee
    :sid: u2
    :email: ann@example.edu
submission_2:
  :submitters:
  - :name: Stranger
    :sid: u9
    :email: stranger@example.edu
submission_3:
  :submitters:
  - :name: Empty
    :sid: u4
    :email: empty@example.edu
";
    let class = TestClass::named("export")
        .with("submission_metadata.yml", metadata)
        .with_reference("submission_1")
        .with_starter("submission_2")
        .with_folder("submission_3");
    let canvas =
        "Student,ID,SIS User ID,SIS Login ID,Section,Quiz (11),Path Tracer (4242),Final Score
    Points Possible,,,,,10,4,(read only)
\"Núñez, José\",7001,u1,jose,Lab 2,9,1,90
\"Lee, Ann\",7002,u2,ann,Lab 2,8,EX,80
\"Empty, E\",7004,u4,empty,Lab 1,7,3,70
\"Missing, M\",7005,u5,missing,Lab 1,6,2,60
";
    let moodle = "\u{feff}Identifier,Full name,ID number,Email address,Status,Grade,Maximum Grade,Grade can be changed,Last modified (submission),Last modified (grade),Feedback comments
Participant 301,José Núñez,u1,jose@example.edu,Submitted,,4.00,Yes,-,-,
Participant 302,Ann Lee,u2,ann@example.edu,Submitted,\"2,00\",4.00,No,-,-,
";
    let gradescope = "First Name,Last Name,SID,Email,Sections,Total Score,Max Points,Status
José,Núñez,u1,jose@example.edu,,1.0,4.0,Graded
Ann,Lee,u2,ann@example.edu,,4.0,4.0,Graded
";
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    let lists = [
        ("canvas", canvas),
        ("moodle", moodle),
        ("gradescope", gradescope),
    ];
    let text = class.graded_with(&exam, &lists, &["--column", "Path Tracer"]);
    let lists = text.split("Canvas, ").nth(1).unwrap();
    let here = class.path_beside("");
    let lists = lists.replace(here.to_str().unwrap(), "HERE/");
    let copies = ["canvas.csv", "moodle.csv", "gradescope.csv"].map(|name| class.read(name));
    assert_snapshot!(format!("{lists}\n{}", copies.join("\n")));
}
