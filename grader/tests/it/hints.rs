//! Hints and clues in reports.

use insta::assert_snapshot;
use serde_json::Value;

use crate::harness::{FULL_POINTS, GradeRun, Submission};

/// Grades the reference with a replacement in a file.
fn grade_with(name: &str, file: &str, from: &str, to: &str) -> GradeRun {
    let submission = Submission::reference(name);
    submission.with_replaced(file, from, to).grade()
}

/// Returns a solution that takes the far root first, but with formulas that differ from the ones in
/// the catalogue of mistakes.
fn far_first() -> Submission {
    Submission::reference("far-first").with_replaced(
        "sphere.rs",
        "let t = [near, far].into_iter().find(|&t| ray.range.contains(t))?;",
        "let both = [near, far].map(|t| t * ray.dir.length());
        let t = if ray.range.contains(both[1]) { both[1] } else { both[0] };
        if !ray.range.contains(t) {
            return None;
        }",
    )
}

/// Grades a single task where one hint explains several items.
#[test]
fn a_hint_that_explains_several_items_is_shown_once() {
    let graded = far_first().grade_with(&["--task", "sphere"]);
    assert_snapshot!(graded.report());
}

fn hints(graded: &GradeRun) -> Vec<Value> {
    let hints = |item: Value| item["hints"].as_array().unwrap().clone();
    graded.all_items().into_iter().flat_map(hints).collect()
}

#[test]
fn a_known_mistake_gets_a_nudge() {
    let graded = far_first().grade();
    assert_snapshot!(graded.report());
    assert!(!hints(&graded).is_empty());
    let staff = graded.score().to_string();
    assert!(
        staff.contains("the answers match those of sphere.far_first"),
        "{staff}"
    );
}

/// Returns the clues for all items in a score.
fn clues(graded: &GradeRun) -> Vec<String> {
    let clue = |item: Value| item["clue"].as_str().map(str::to_owned);
    graded.all_items().into_iter().filter_map(clue).collect()
}

#[test]
fn an_answer_that_is_right_when_asked_alone_is_said_to_depend_on_earlier_calls() {
    let with_distance = |distance: &str| {
        let graded = grade_with("state", "sphere.rs", "distance: t,", distance);
        assert!(graded.points()["sphere"] < FULL_POINTS["sphere"]);
        clues(&graded)
    };
    let kept = with_distance(
        "distance: {
            static CALLS: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(0);
            t + CALLS.fetch_add(1, std::sync::atomic::Ordering::Relaxed) as f32
        },",
    );
    assert!(!kept.is_empty());
    for clue in kept {
        assert_eq!(clue, grader::clue::KEPT_STATE);
    }
    // This code gives the same answers, but keeps no state.
    assert_eq!(with_distance("distance: t + 1.0,"), [""; 0]);
}

#[test]
fn code_that_hits_nothing_is_told_what_to_compare_for_every_ray() {
    let never_inside = (
        "triangle.rs",
        "if glam::vec3(w, u, v).min_element() < 0.0 {",
        "if glam::vec3(w, u, v).min_element() < 1.0 {",
    );
    let too_late = (
        "bbox.rs",
        "if enter > times.min { enter } else { times.min },",
        "if leave > times.min { leave } else { times.min } + 1e6,",
    );
    // If some rays hit, the mistake is different from one that makes every ray miss.
    let some_hit = (
        "sphere.rs",
        "let t = [near, far].into_iter().find(|&t| ray.range.contains(t))?;",
        "let t = [near, far].into_iter().find(|&t| t > 5.0)?;",
    );
    let not_one = |(file, from, to): (&str, &str, &str)| {
        let graded = grade_with("misses", file, from, to);
        let clues = clues(&graded).into_iter();
        let not_one =
            clues.filter(|clue| clue.starts_with("Your code returns a miss for every ray"));
        let items = graded.all_items().into_iter();
        let alike = items.filter(|item| {
            let clue = item["symptom_clue"].as_str().unwrap_or_default();
            clue.ends_with(" fails in the same way: fix that first.")
        });
        (not_one.count(), alike.count())
    };
    // Only the first item says it, and the others name that item.
    let (first, others) = not_one(never_inside);
    assert!(first == 1 && others >= 10, "{first} {others}");
    assert_eq!(not_one(too_late), (1, 9));
    assert_eq!(not_one(some_hit).0, 0);
}
