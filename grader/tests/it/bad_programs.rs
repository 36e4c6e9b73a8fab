//! Submissions that compile and then misbehave: they panic, do not end, crash, or answer nonsense. Each gets
//! a report, and the points of other tasks do not change.

use insta::assert_snapshot;

use crate::harness::{
    BBOX, FULL_POINTS, GradeRun, SPHERE, Submission, TRAVERSE, full_points_except,
    points_of_other_tasks,
};

#[test]
fn a_panic_costs_the_items_that_trigger_it() {
    let graded = Submission::panicking().grade();
    assert!(graded.verdicts("sphere").contains(&"panicked".to_owned()));
    // One point of `traverse` is for a tree that contains spheres.
    assert_eq!(points_of_other_tasks(&graded.points(), SPHERE), 84);
    assert_snapshot!(graded.report());
}

#[test]
fn a_panic_in_a_constructor_is_reported_like_any_other() {
    let asserting = "        assert!(aspect_ratio <= 1.0, \"too wide\");\n        Camera {\n            vertical_fov,";
    let graded = Submission::reference("asserting")
        .with_replaced(
            "camera.rs",
            "        Camera {\n            vertical_fov,",
            asserting,
        )
        .grade();
    assert!(graded.verdicts("camera").contains(&"panicked".to_owned()));
    assert_eq!(graded.points()[1..5], FULL_POINTS[1..5]);
}

#[test]
fn an_endless_loop_is_stopped() {
    let graded = Submission::looping().grade_with(&["--cpu-limit", "1"]);
    assert!(graded.verdicts("sphere").contains(&"timed_out".to_owned()));
    assert_eq!(graded.points()[..2], FULL_POINTS[..2]);
    assert_snapshot!(graded.report());
}

/// Returns the messages of all items of a task.
fn messages(graded: &GradeRun, task: &str) -> Vec<String> {
    graded.texts(task, "message")
}

#[test]
fn one_time_out_stops_a_task_and_what_needs_it() {
    let hanging = Submission::reference("hanging").with_replaced(
        "bbox.rs",
        "let inverse = dir.recip();",
        "while std::hint::black_box(true) {} let inverse = dir.recip();",
    );
    let alone = hanging.grade_with(&["--cpu-limit", "1"]);
    let boxes = messages(&alone, "bbox");
    assert!(boxes[0].starts_with("stopped, because"), "{boxes:?}");
    let not_run = "not run, because another item of this task took too long";
    assert!(boxes[1..].iter().all(|message| message == not_run));
    let traverse = messages(&alone, "traverse");
    let depends = "depends on bbox.through: fix that first";
    assert!(traverse.iter().all(|message| message == depends));
    assert_eq!(points_of_other_tasks(&alone.points(), BBOX), 70);

    let by_reference = hanging.grade_with_reference();
    assert_eq!(by_reference.points(), [15, 20, 15, 0, 20, 20]);
}

#[test]
fn two_crashes_stop_a_task() {
    let graded = Submission::reference("aborting")
        .with_replaced(
            "bbox.rs",
            "let inverse = dir.recip();",
            "if dir.x < 0.0 { std::process::abort() } let inverse = dir.recip();",
        )
        .grade();
    let boxes = messages(&graded, "bbox");
    let crashed = |message: &&String| message.starts_with("the program was killed");
    assert_eq!(boxes.iter().filter(crashed).count(), 2, "{boxes:?}");
    let not_run = "not run, because two other items of this task crashed";
    assert_eq!(boxes.last().unwrap(), not_run);
}

/// Sleeps at each new camera, triangle and sphere, below the limit of an item.
#[cfg(target_os = "linux")]
#[test]
fn a_slow_submission_has_a_budget_and_keeps_the_points_before() {
    let slow = "{ static LAST: std::sync::Mutex<String> = std::sync::Mutex::new(String::new());
        let (mut last, now) = (LAST.lock().unwrap(), format!(\"{self:?}\"));
        if *last != now {
            std::thread::sleep(std::time::Duration::from_millis(500));
            *last = now;
        } }";
    let within = |head: &str| format!("{head} {slow}");
    let camera = "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {";
    let shape = "pub fn hit(&self, ray: &Ray) -> Option<Trace> {";
    let graded = Submission::reference("slow")
        .with_replaced("camera.rs", camera, &within(camera))
        .with_replaced("triangle.rs", shape, &within(shape))
        .with_replaced("sphere.rs", shape, &within(shape))
        .grade();
    // Forty seconds in all.
    assert_eq!(graded.points()[0], FULL_POINTS[0], "{}", graded.report());
    let not_run = "not run, because the items before it have used up the time of the whole \
                   submission";
    assert_eq!(messages(&graded, "build")[0], not_run);
    assert!(graded.score()["points"].as_u64().unwrap() > 25);
}

#[test]
fn endless_recursion_ends_the_process_but_not_the_exam() {
    let graded = Submission::reference("recursing")
        .with_replaced(
            "bvh.rs",
            "self.build_node(start, middle)",
            "self.build_node(start, end)",
        )
        .grade();
    assert_eq!(graded.verdicts("build"), ["crashed"]);
    assert_eq!(graded.points()[..4], FULL_POINTS[..4]);
    assert_snapshot!(graded.report());
}

#[test]
fn exiting_early_does_not_count_as_an_answer() {
    let graded = Submission::exiting().grade();
    assert!(graded.verdicts("camera").contains(&"crashed".to_owned()));
    assert_eq!(graded.points()[1..5], FULL_POINTS[1..5]);
    assert_snapshot!(graded.report());
}

#[test]
fn printing_is_harmless() {
    let graded = Submission::reference("printing")
        .with_replaced(
            "bbox.rs",
            "let inverse = dir.recip();",
            "println!(\"asking {self:?} for {ray:?}\"); let inverse = dir.recip();",
        )
        .grade();
    assert_eq!(graded.points(), *FULL_POINTS);
    assert_snapshot!(graded.report());
}

#[test]
fn nan_is_a_wrong_answer() {
    let graded = Submission::not_a_number().grade();
    assert!(graded.verdicts("sphere").contains(&"wrong".to_owned()));
    assert_eq!(graded.points()[3..5], FULL_POINTS[3..5]);
    assert_snapshot!(graded.report());
}

#[cfg(target_os = "linux")]
#[test]
fn allocating_without_bound_is_stopped() {
    let hoard = "let mut hoard = vec![*ray];
        while !hoard.is_empty() {
            hoard.extend_from_within(..);
        }";
    let graded = Submission::reference("hoarding")
        .with_replaced(
            "bvh.rs",
            "root.bbox.hit(ray, ray.range)?;",
            &format!("{hoard} root.bbox.hit(ray, ray.range)?;"),
        )
        .grade();
    assert_eq!(graded.verdicts("traverse"), ["out_of_memory"]);
    assert_eq!(graded.points(), full_points_except(&[TRAVERSE]));
    assert_snapshot!(graded.report());
}
