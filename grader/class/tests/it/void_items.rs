//! Items and tasks that the policy removes or reweights after the class has been graded. Each final
//! grade that changes is listed with its cause, pages explain the final points, and nothing is
//! graded again.

use std::fs;

use serde_json::Value;

use crate::harness::{TestClass, cell};

const ITEMS: [&str; 3] = ["camera.offset", "camera.unit_length", "sphere.radius"];
/// Manual points for the submission that cannot be graded.
const MANUAL: &str = "student,task,delta,comment,author\ncarl,sphere,1,drawn on paper,Tess\n";

/// Returns a graded class. Ann gets full marks. Bob fails `camera.offset`, which blocks
/// `sphere.radius`. His code for the sphere is wrong too.
fn graded() -> (TestClass, String) {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_offset_mistake("bob")
        .with_replaced("bob/sphere.rs", "self.radius * self.radius", "self.radius")
        .with_folder("carl");
    let exam = class.small_exam(&ITEMS);
    let text = fs::read_to_string(&exam).unwrap();
    let mut parsed: Value = serde_json::from_str(&text).unwrap();
    parsed["items"][2]["needs"] = vec![ITEMS[0]].into();
    fs::write(&exam, parsed.to_string()).unwrap();
    class.graded_with(&exam, &[("manual-points", MANUAL)], &["--hand-back"]);
    (class, exam)
}

#[test]
fn final_grades_follow_the_policy_and_each_change_is_listed_with_its_cause() {
    let (class, exam) = graded();
    let score = || fs::read(class.out().join("students/bob/score.json")).unwrap();
    let first_score = score();
    let mut texts = Vec::new();
    for points in [
        "void = [\"camera.offset\"]\nvoid_points = \"give\"",
        "void = [\"camera.offset\"]",
        "void = [\"camera.offset\"]\nvoid_points = \"scale\"",
        "tasks = { camera = 20, sphere = 0 }",
        "void = [\"camera.offset\"]\ntasks = { camera = 20, sphere = 10 }",
        "out_of = 10",
    ] {
        let policy = class.write_beside("policy.toml", &format!("[points]\n{points}\n"));
        let text = class.graded(&exam, &["--policy", &policy]);
        let lines = text.lines();
        let lines = lines.skip_while(|line| !line.contains("final grade"));
        let lines: Vec<&str> = lines.take_while(|line| !line.is_empty()).collect();
        let counts = |id| format!("{id} {}", cell(&class, id, id, "counts"));
        let counts = ["ann", "bob", "carl"].map(counts).join(", ");
        let page = class.read("students/bob/feedback.html");
        let (_, told) = page.split_once("<!--counted-->").unwrap();
        let (told, _) = told.split_once("<!--/counted-->").unwrap();
        let told = told.replace("<p class=\"total\"><strong>", "");
        let told = told.replace("</strong></p>", "");
        texts.push(format!(
            "{points}\n{}\n  {counts}\n  page of bob: {told}\n",
            lines.join("\n")
        ));
        assert_eq!(score(), first_score, "nothing is graded again");
    }
    insta::assert_snapshot!(texts.join("\n"));
}

/// Returns a class where Hank's camera and sphere are both wrong.
fn two_mistakes() -> (TestClass, String) {
    let class = TestClass::named("class")
        .with_offset_mistake("hank")
        .with_replaced("hank/sphere.rs", "self.radius * self.radius", "self.radius");
    let exam = class.small_exam(&ITEMS);
    (class, exam)
}

/// Returns the id of the item that a page says to fix first. It is empty if there is none.
fn next_step(class: &TestClass, page: &str) -> String {
    let page = class.read(&format!("students/hank/{page}"));
    let steps = page.split("<div data-step=\"").skip(1);
    let shown = steps.filter_map(|step| Some(step.split_once("\">")?.0));
    let shown: Vec<&str> = shown.filter(|step| !step.contains('"')).collect();
    let [only] = shown.as_slice() else {
        panic!("{shown:?}")
    };
    assert!(only.is_empty() || page.contains(&format!("id=\"{only}\"")));
    (*only).to_owned()
}

#[test]
fn the_next_step_on_a_page_is_never_about_an_item_that_does_not_count() {
    let (class, exam) = two_mistakes();
    for (points, expected) in [
        ("void = []", "camera.offset"),
        ("void = [\"camera.offset\"]", "sphere.radius"),
        ("tasks = { camera = 0 }", "sphere.radius"),
        ("void = [\"camera.offset\", \"sphere.radius\"]", ""),
        ("void = [\"sphere.radius\"]", "camera.offset"),
    ] {
        let policy = class.write_beside("policy.toml", &format!("[points]\n{points}\n"));
        class.graded(&exam, &["--policy", &policy, "--hand-back"]);
        for page in ["report.html", "feedback.html"] {
            assert_eq!(next_step(&class, page), expected, "{points}: {page}");
        }
    }
}

/// Staff give Hank points for the camera, which must not make up for the sphere. The root causes and failure rates only cover what counts.
#[test]
fn what_does_not_count_has_no_effect_on_points_by_hand_or_root_causes() {
    let (class, exam) = two_mistakes();
    let manual = "student,task,delta,comment,author\nhank,camera,2,nearly,Tess\n";
    class.graded_with(&exam, &[("manual-points", manual)], &[]);
    let lines = [
        "void_points = \"shrink\"",
        "void = [\"camera.offset\"]",
        "void = [\"camera.offset\"]\nvoid_points = \"give\"",
        "void = [\"camera.offset\"]\ntasks = { camera = 20, sphere = 10 }",
        "tasks = { sphere = 0 }",
    ]
    .map(|points| {
        let policy = class.write_beside("policy.toml", &format!("[points]\n{points}\n"));
        class.graded(&exam, &["--policy", &policy]);
        let counts = ["counts", "counts_max"].map(|column| cell(&class, "hank", "hank", column));
        let summary: Value = serde_json::from_str(&class.read("class.json")).unwrap();
        let causes = summary["causes"].as_array().unwrap().iter();
        let causes: Vec<String> = causes.map(|cause| cause["items"].to_string()).collect();
        let failed = summary["failed"].as_array().unwrap().iter();
        let failed = failed.map(|rate| format!("{} {}", rate["id"], rate["counts"]["all"]));
        let failed: Vec<String> = failed.collect();
        let (counts, causes) = (counts.join(" of "), causes.join(" "));
        let (points, failed) = (points.replace('\n', "; "), failed.join(", "));
        let text = format!("points: {points}\n  {counts}, causes {causes}, failed {failed}");
        text.replace('"', "")
    });
    insta::assert_snapshot!(lines.join("\n"), @r"
    points: void_points = shrink
      3 of 4, causes [camera.offset] [sphere.radius], failed camera 1, camera.offset 1, camera.unit_length 0, sphere 1, sphere.radius 1
    points: void = [camera.offset]
      1 of 2, causes [sphere.radius], failed camera 0, camera.unit_length 0, sphere 1, sphere.radius 1
    points: void = [camera.offset]; void_points = give
      3 of 4, causes [sphere.radius], failed camera 0, camera.unit_length 0, sphere 1, sphere.radius 1
    points: void = [camera.offset]; tasks = { camera = 20, sphere = 10 }
      20 of 30, causes [sphere.radius], failed camera 0, camera.unit_length 0, sphere 1, sphere.radius 1
    points: tasks = { sphere = 0 }
      3 of 3, causes [camera.offset], failed camera 1, camera.offset 1, camera.unit_length 0
    ");
}

#[test]
fn an_item_or_task_that_the_exam_does_not_have_is_an_error() {
    let (class, exam) = graded();
    let before = class.read("grades.csv");
    let refused = |text: &str| {
        let policy = class.write_beside("policy.toml", text);
        let error = class.refused(&exam, &["--policy", &policy]);
        let error = error[error.find("the policy /").unwrap()..].to_owned();
        error.replace(&policy, "policy.toml")
    };
    let errors = [
        "[points]\nvoid = [\"camera.ofset\"]\n",
        "[points]\nvoid = [\"camera\"]\n",
        "[points]\nvoid_points = \"double\"\n",
        "[points.tasks]\nbuild = 10\n",
        "[points.tasks]\ncamera = 0\nsphere = 0\n",
    ];
    insta::assert_snapshot!(errors.map(refused).concat());
    assert_eq!(class.read("grades.csv"), before);
}
