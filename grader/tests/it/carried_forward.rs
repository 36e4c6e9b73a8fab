//! One mistake costs once: what rests on a failed task is asked again with the reference's part.

use insta::assert_snapshot;

use crate::harness::{FULL, Submission};

const BOXES: usize = 3;
const WALKING: usize = 5;

/// A box test for rays that go up, right and back: it does not swap what they cross first.
fn no_swap() -> Submission {
    Submission::reference("no-swap").changed(
        "bbox.rs",
        "at_min.min(at_max).max_element()",
        "at_min.max_element()",
    )
}

#[test]
fn a_wrong_box_test_does_not_cost_the_walk() {
    let submission = no_swap();
    let points = submission.grade_with_reference().points();
    assert!(points[BOXES] < FULL[BOXES], "{points:?}");
    assert_eq!(points[WALKING], FULL[WALKING]);
    // Without the reference nobody can tell.
    assert!(submission.grade().points()[WALKING] < FULL[WALKING]);
    assert!(
        submission
            .grade()
            .verdicts("traverse")
            .contains(&"blocked".to_owned())
    );
}

#[test]
fn a_wrong_walk_on_a_wrong_box_test_costs_both() {
    let graded = no_swap()
        .changed(
            "bvh.rs",
            "if in_l.min <= in_r.min =>",
            "if in_l.min > in_r.min =>",
        )
        .grade_with_reference();
    let points = graded.points();
    assert!(
        points[BOXES] < FULL[BOXES] && points[WALKING] < FULL[WALKING],
        "{points:?}"
    );
    assert_snapshot!(graded.report());
}

#[test]
fn two_mistakes_that_hide_each_other_are_both_found() {
    // Boxes that do not look at `times`, and a walk that asks for the times from 0 to 0.
    let graded = Submission::reference("hiding")
        .changed(
            "bbox.rs",
            "(inside.min <= inside.max).then_some(inside)",
            "let (_, inside) = (inside, Interval::new(enter.max(0.0), leave));\n(inside.min <= inside.max).then_some(inside)",
        )
        .changed(
            "bvh.rs",
            "bbox.hit(ray, ray.range)",
            "bbox.hit(ray, protocol::Interval::new(0.0, 0.0))",
        );
    let points = graded.grade_with_reference().points();
    assert!(points[BOXES] < FULL[BOXES], "{points:?}");
    assert_eq!(points[WALKING], 0);
    // By itself, the walk goes well.
    assert!(graded.grade().points()[WALKING] > 15);
}

#[test]
fn what_does_not_compile_with_other_parts_stays_as_first_judged() {
    let graded = no_swap()
        .changed(
            "sphere.rs",
            "impl Sphere {",
            "/// Mine.\npub const ZERO: f32 = 0.0;\n\nimpl Sphere {",
        )
        .changed(
            "bvh.rs",
            "if in_l.min <= in_r.min =>",
            "if in_l.min <= in_r.min + crate::sphere::ZERO =>",
        )
        .grade_with_reference();
    assert!(graded.points()[WALKING] < FULL[WALKING]);
    assert!(!graded.verdicts("traverse").contains(&"blocked".to_owned()));
    assert!(
        !graded
            .score()
            .to_string()
            .contains("\"carried_forward\":true")
    );
}
