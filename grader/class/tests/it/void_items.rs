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
