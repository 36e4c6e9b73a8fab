//! A wrong answer that is a known mistake's earns its hint, and one that is like none earns none.

use insta::assert_snapshot;
use serde_json::Value;

use crate::harness::{Graded, Submission};

/// Whoever takes the far root, by other formulas than the catalogue's.
fn far_first() -> Submission {
    Submission::reference("far-first").changed(
        "sphere.rs",
        "let t = [near, far].into_iter().find(|&t| ray.range.contains(t))?;",
        "let both = [near, far].map(|t| t * ray.dir.length());
        let t = if ray.range.contains(both[1]) { both[1] } else { both[0] };
        if !ray.range.contains(t) {
            return None;
        }",
    )
}

fn hints(graded: &Graded) -> Vec<Value> {
    let score = graded.score();
    let tasks = score["tasks"].as_array().unwrap().iter();
    let items = tasks.flat_map(|task| task["items"].as_array().unwrap());
    items
        .flat_map(|item| item["hints"].as_array().unwrap().clone())
        .collect()
}

#[test]
fn a_known_mistake_is_nudged() {
    let graded = far_first().grade();
    assert_snapshot!(graded.report());
    assert!(!hints(&graded).is_empty());
    let staff = graded.score().to_string();
    assert!(staff.contains("answers like sphere.far_first"), "{staff}");
}

#[test]
fn hints_say_more_when_asked() {
    assert_snapshot!(far_first().grade_with(&["--hints"]).report());
}

#[test]
fn a_strange_mistake_gets_no_hint() {
    let graded = Submission::reference("strange")
        .changed("sphere.rs", "distance: t,", "distance: t + t.sin(),")
        .grade();
    assert!(graded.points()[2] < 15);
    assert_eq!(hints(&graded), [0; 0].map(Value::from));
}

#[test]
fn two_mistakes_in_one_task_are_each_recognised() {
    let graded = Submission::reference("two")
        .changed(
            "triangle.rs",
            "position: ray.at(t),",
            "position: t * ray.dir,",
        )
        .changed("triangle.rs", "material: self.material,", "material: 0,")
        .grade();
    let staff = graded.score().to_string();
    for known in ["triangle.position_without_origin", "triangle.material_zero"] {
        assert!(staff.contains(&format!("answers like {known}")), "{known}");
    }
}
