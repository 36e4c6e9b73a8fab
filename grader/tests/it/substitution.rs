//! A mistake only costs points once: items that depend on a failed task are graded again with the
//! reference's parts.

use insta::assert_snapshot;

use crate::harness::{FULL_POINTS, GradeRun, Submission};

/// An interval that begins and ends at the origin of a ray.
const NEVER: &str = "protocol::Interval::new(0.0, 0.0)";

/// The condition for visiting the left child first.
const LEFT_FIRST: &str = "if in_l.min <= in_r.min {";

/// Returns a submission whose box test only works for rays with positive directions, since it
/// doesn't swap entry and exit.
fn without_swap() -> Submission {
    let (swapped, kept) = ("at_min.min(at_max).max_element()", "at_min.max_element()");
    Submission::reference("no-swap").with_replaced("bbox.rs", swapped, kept)
}

/// Asserts that this many items of `traverse` are blocked and all others pass.
#[track_caller]
fn assert_costs_blocked_items(graded: &GradeRun, count: usize) {
    let items = graded.items("traverse");
    let blocked = items.iter().filter(|item| item["verdict"] == "blocked");
    let points: Vec<u64> = blocked
        .map(|item| item["max_points"].as_u64().unwrap())
        .collect();
    assert_eq!(points.len(), count, "{items:?}");
    let lost = FULL_POINTS["traverse"] - graded.points()["traverse"];
    assert_eq!(lost, points.iter().sum::<u64>());
    assert_eq!(graded.verdicts("traverse"), ["blocked", "pass"]);
}

#[test]
fn a_wrong_box_test_does_not_cost_traversal_points() {
    let submission = without_swap();
    let points = submission.grade_with_reference().points();
    assert!(points["bbox"] < FULL_POINTS["bbox"], "{points:?}");
    assert_eq!(points["traverse"], FULL_POINTS["traverse"]);
    // Without the reference, the traversal cannot be judged.
    let graded = submission.grade();
    assert!(graded.points()["traverse"] < FULL_POINTS["traverse"]);
    let verdicts = graded.verdicts("traverse");
    assert!(verdicts.contains(&"blocked".to_owned()), "{verdicts:?}");
}

#[test]
fn a_wrong_traversal_with_a_wrong_box_test_costs_both() {
    let graded = without_swap()
        .with_replaced("bvh.rs", LEFT_FIRST, "if in_l.min > in_r.min {")
        .grade_with_reference();
    let points = graded.points();
    for task in ["bbox", "traverse"] {
        assert!(points[task] < FULL_POINTS[task], "{points:?}");
    }
    assert_snapshot!(graded.report());
}

#[test]
fn finds_two_mistakes_that_hide_each_other() {
    // The box test ignores `times`, and the traversal passes it an empty interval.
    let graded = Submission::reference("hiding")
        .with_replaced(
            "bbox.rs",
            "(inside.min <= inside.max).then_some(inside)",
            "let (_, inside) = (inside, Interval::new(enter.max(0.0), leave));\n\
             (inside.min <= inside.max).then_some(inside)",
        )
        .with_replaced(
            "bvh.rs",
            "root.bbox.hit(ray, ray.range)",
            &format!("root.bbox.hit(ray, {NEVER})"),
        )
        .with_replaced(
            "bvh.rs",
            "(l.bbox.hit(ray, ray.range), r.bbox.hit(ray, ray.range))",
            &format!("(l.bbox.hit(ray, {NEVER}), r.bbox.hit(ray, {NEVER}))"),
        );
    let points = graded.grade_with_reference().points();
    assert!(points["bbox"] < FULL_POINTS["bbox"], "{points:?}");
    assert_eq!(points["traverse"], 0);
    // On its own, the traversal seems correct.
    assert!(4 * graded.grade().points()["traverse"] > 3 * FULL_POINTS["traverse"]);
}

/// The tree contains cycles, so traversing the submission's own trees never ends.
#[test]
fn a_tree_without_end_does_not_cost_traversal_points() {
    let (right, cyclic) = ("interior(bbox, l, r)", "interior(bbox, start, middle)");
    let endless = Submission::reference("endless").with_replaced("bvh.rs", right, cyclic);
    let [graded, alone] = endless.grade_impatiently();
    let points = graded.points();
    assert_eq!(points["build"], 0);
    assert_eq!(points["traverse"], FULL_POINTS["traverse"]);
    // Without the reference, the items that build a tree cannot be judged.
    assert_costs_blocked_items(&alone, 2);
}

/// A triangle without area makes the triangle task hang, so its last items aren't run. An item of
/// another task that depends on one of them isn't run either, even if it wouldn't hang itself.
#[test]
fn what_depends_on_a_stopped_task_is_not_run() {
    let hanging = Submission::reference("hanging").with_replaced(
        "triangle.rs",
        "let e1_x_d = e1.cross(ray.dir);",
        "while e1.cross(e2) == glam::Vec3::ZERO { std::hint::spin_loop(); }\n\
         let e1_x_d = e1.cross(ray.dir);",
    );
    let [graded, alone] = hanging.grade_impatiently();
    let points = graded.points();
    assert!(points["triangle"] < FULL_POINTS["triangle"], "{points:?}");
    assert_eq!(points["traverse"], FULL_POINTS["traverse"]);
    // Without the reference, the items about complete traces, pictures and radiance cannot be
    // judged.
    assert_costs_blocked_items(&alone, 5);
}

#[test]
fn keeps_the_first_result_if_substitution_does_not_compile() {
    let helper = "/// Mine.\npub const ZERO: f32 = 0.0;\n\nimpl Sphere {";
    let with_helper = "if in_l.min <= in_r.min + crate::sphere::ZERO {";
    let graded = without_swap()
        .with_replaced("sphere.rs", "impl Sphere {", helper)
        .with_replaced("bvh.rs", LEFT_FIRST, with_helper)
        .grade_with_reference();
    assert!(graded.points()["traverse"] < FULL_POINTS["traverse"]);
    assert!(!graded.verdicts("traverse").contains(&"blocked".to_owned()));
    let score = graded.score().to_string();
    assert!(!score.contains("\"carried_forward\":true"), "{score}");
}
