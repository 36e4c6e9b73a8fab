//! Guarantees about the score file.

use grader::handed_out::{ASSIGNMENTS, RAYS};
use insta::assert_snapshot;
use serde_json::Value;

use crate::cases::{EXITING, NOT_COMPILING, PANICKING, STARTER};
use crate::harness::{
    FULL_POINTS, GradeRun, Submission, full_points_except, grade_into, grader, no_points, workspace,
};

#[test]
fn the_reference_gets_full_points() {
    for assignment in ASSIGNMENTS {
        let out = tempfile::TempDir::new().unwrap();
        let mut command = grade_into("reference".as_ref(), out.path());
        command.args(["--assignment", assignment.assignment.id]);
        let graded = command.output().unwrap();
        assert!(graded.status.success(), "{graded:?}");
        let score = std::fs::read(out.path().join("score.json")).unwrap();
        let score: Value = serde_json::from_slice(&score).unwrap();
        assert_eq!(score["points"], 100);
        assert_eq!(score["max_points"], 100);
        assert_eq!(score["complete"], true);
        // The reference's variants contain files with the same names, which must not be treated as
        // copies.
        assert_eq!(score["build"]["notes"], serde_json::json!([]));
    }
}

#[test]
fn windows_line_endings_and_byte_order_marks_change_nothing() {
    let windows = |text: String| format!("\u{feff}{}", text.replace('\n', "\r\n"));
    let read = |path: &str| std::fs::read_to_string(workspace().join(path)).unwrap();
    let mut submission = Submission::reference("windows");
    for file in RAYS.file_names() {
        submission = submission.with(file, windows(read(&format!("reference/src/{file}"))));
    }
    let world = read("grader/starter/world.rs").replace('\n', "\r\n");
    let graded = submission.with("world.rs", world).grade();
    assert_eq!(graded.points(), *FULL_POINTS);
    assert_eq!(graded.score()["build"]["notes"], serde_json::json!([]));
}

#[test]
fn the_starter_gets_no_points_and_each_task_says_why() {
    assert_eq!(STARTER.points(), no_points());
    assert_snapshot!(STARTER.report());
}

#[test]
fn without_a_bvh_the_other_tasks_keep_their_points() {
    let bvh = std::fs::read(workspace().join("grader/starter/bvh.rs")).unwrap();
    let graded = Submission::reference("no-bvh").with("bvh.rs", bvh).grade();
    assert_eq!(graded.points(), full_points_except(&["build", "traverse"]));
    assert_snapshot!(graded.report());
}

#[test]
fn constant_answers_earn_nothing() {
    let ray = "return Ray::new(Vec3::ZERO, Vec3::NEG_Z); todo!";
    let trace = "return Some(Trace {
            distance: 1.0,
            position: ray.at(1.0),
            normal: self.p0.normal,
            uv: self.p0.uv,
            origin: ray.origin,
            shape: self.shape,
        }); todo!";
    let one_leaf = "let mut bbox = BBox::EMPTY;
        for primitive in &primitives {
            bbox.enclose(primitive.bbox());
        }
        let leaf = Node::leaf(bbox, 0, primitives.len());
        Bvh::from_nodes(primitives, vec![leaf], 0)";
    let graded = Submission::starter("constant")
        .with_replaced("camera.rs", "todo!", ray)
        .with_replaced("triangle.rs", "todo!", trace)
        .with_replaced("sphere.rs", "todo!", "return None; todo!")
        .with_replaced("bbox.rs", "todo!", "return Some(times); todo!")
        .with_replaced(
            "bvh.rs",
            "Bvh::from_nodes(primitives, Vec::new(), 0)",
            one_leaf,
        )
        .with_replaced("bvh.rs", "traces.fold(None, Trace::nearer)", "None")
        .grade();
    assert_eq!(graded.points(), no_points());
}

#[test]
fn a_second_run_differs_only_in_timings() {
    let without_timings = |graded: &GradeRun| {
        let mut score = graded.score();
        score["timings"] = Value::Null;
        score.to_string()
    };
    let second = Submission::panicking().grade();
    assert_eq!(without_timings(&PANICKING), without_timings(&second));
}

#[test]
fn every_score_file_matches_the_published_schema() {
    let schema = grader().arg("--schema").output().unwrap().stdout;
    let schema: Value = serde_json::from_slice(&schema).unwrap();
    let (mut schemas, mut compiler) = (boon::Schemas::new(), boon::Compiler::new());
    compiler.add_resource("score.json", schema).unwrap();
    let schema = compiler.compile("score.json", &mut schemas).unwrap();
    for graded in [&STARTER, &NOT_COMPILING, &EXITING] {
        if let Err(error) = schemas.validate(&graded.score(), schema) {
            panic!("{error}");
        }
    }
    // An invalid score must fail the validation.
    let mut score = STARTER.score();
    score["tasks"][0]["items"][0]["verdict"] = "splendid".into();
    assert!(schemas.validate(&score, schema).is_err());
}
