//! Submissions that compile and then misbehave: they panic, hang, crash or give nonsensical
//! answers. Each gets a report, and the points for other tasks don't change.

use insta::assert_snapshot;

use crate::cases::{EXITING, PANICKING};
use crate::harness::{FULL_POINTS, GradeRun, Submission, full_points_except, without};

/// Returns the reference with this statement inserted before the box test.
fn before_box_test(name: &str, statement: &str) -> Submission {
    let test = "let inverse = dir.recip();";
    Submission::reference(name).with_replaced("bbox.rs", test, &format!("{statement} {test}"))
}

/// Returns the report, which includes the points for all tasks. Panics unless some item of `task`
/// has this verdict.
fn report_with(graded: &GradeRun, task: &str, verdict: &str) -> String {
    let verdicts = graded.verdicts(task);
    assert!(verdicts.contains(&verdict.to_owned()), "{verdicts:?}");
    graded.report()
}

#[test]
fn a_panic_a_crash_and_nonsense_cost_the_items_that_trigger_them() {
    // One point in `traverse` is for a tree that contains spheres.
    let not_a_number = Submission::not_a_number().grade();
    let reports = [
        report_with(&PANICKING, "sphere", "panicked"),
        report_with(&EXITING, "camera", "crashed"),
        report_with(&not_a_number, "sphere", "wrong"),
    ];
    assert_snapshot!(reports.join("\n\n"));
}

#[test]
fn an_endless_loop_is_stopped() {
    let graded = Submission::looping().grade_with(&["--cpu-limit", "1"]);
    assert_snapshot!(report_with(&graded, "sphere", "timed_out"));
}

/// The left side of each split is built twice, and a given method is changed.
#[test]
fn the_next_step_shows_notes_and_does_not_blame_the_given_code() {
    let left = "self.build_node(start, middle)";
    let submission = Submission::reference("twice")
        .with_replaced("bvh.rs", left, &format!("{{ {left}; {left} }}"))
        .with_replaced("bbox.rs", "0.5 * (self.min + self.max)", "self.min");
    let graded = submission.grade_with(&["--next"]);
    assert_snapshot!(graded.report());
}

#[test]
fn a_compiler_error_leads_to_the_task_whose_method_contains_it() {
    for (from, to, task) in [
        (
            "root.bbox.hit(ray, ray.range)?;",
            "root.bbox.hit(ray)?;",
            "traverse",
        ),
        (
            "max_leaf_size: max_leaf_size.max(1),",
            "max_leaf_size: -1,",
            "build",
        ),
    ] {
        let submission = Submission::reference("error").with_replaced("bvh.rs", from, to);
        let step = submission.grade_with(&["--next"]).report();
        assert!(step.contains(&format!("\n  what    {task}.")), "{step}");
        assert!(step.contains(&format!(" --task {task}")), "{step}");
        let graded = submission.grade();
        let page = graded.page();
        let (_, next) = page.split_once("What to do next").unwrap();
        let link = next.split_once("href=\"#").unwrap().1;
        assert!(link.starts_with(&format!("{task}.")), "{link:.80}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn allocating_without_bound_is_stopped() {
    let root = "root.bbox.hit(ray, ray.range)?;";
    let hoard = "let mut hoard = vec![*ray];
        while !hoard.is_empty() {
            hoard.extend_from_within(..);
        }";
    let hoarding = Submission::reference("hoarding");
    let hoarding = hoarding.with_replaced("bvh.rs", root, &format!("{hoard} {root}"));
    let graded = hoarding.grade();
    assert_eq!(graded.verdicts("traverse"), ["out_of_memory"]);
    assert_snapshot!(graded.report());
}

#[test]
fn endless_recursion_ends_the_process_but_not_the_exam() {
    let (right, endless) = (
        "self.build_node(start, middle)",
        "self.build_node(start, end)",
    );
    let recursing = Submission::reference("recursing").with_replaced("bvh.rs", right, endless);
    let graded = recursing.grade();
    assert_eq!(graded.verdicts("build"), ["crashed"]);
    assert_snapshot!(graded.report());
}

#[test]
fn printing_is_harmless() {
    let print = "println!(\"asking {self:?} for {ray:?}\");";
    let graded = before_box_test("printing", print).grade();
    assert_eq!(graded.points(), *FULL_POINTS);
    assert_snapshot!(graded.report());
}

#[test]
fn a_panic_in_a_constructor_is_reported_like_any_other() {
    let camera = "        Camera {\n            vertical_fov,";
    let asserting = format!("        assert!(aspect_ratio <= 1.0, \"too wide\");\n{camera}");
    let submission = Submission::reference("asserting");
    let graded = submission
        .with_replaced("camera.rs", camera, &asserting)
        .grade();
    assert!(graded.verdicts("camera").contains(&"panicked".to_owned()));
    let others = |points| without(points, &["camera", "traverse"]);
    assert_eq!(others(graded.points()), others(FULL_POINTS.clone()));
}

/// Returns the messages of all items of a task.
fn messages(graded: &GradeRun, task: &str) -> Vec<String> {
    graded.texts(task, "message")
}

#[test]
fn one_time_out_stops_a_task_and_what_needs_it() {
    let hanging = before_box_test("hanging", "while std::hint::black_box(true) {}");
    let [by_reference, alone] = hanging.grade_impatiently();
    let boxes = messages(&alone, "bbox");
    assert!(boxes[0].starts_with("stopped because"), "{boxes:?}");
    let not_run = "not run because another item in this task took too long";
    assert!(boxes[1..].iter().all(|message| message == not_run));
    let traverse = messages(&alone, "traverse");
    let waits = "waits for bbox.through: fix that first";
    assert!(traverse.iter().all(|message| message == waits));
    let expected = full_points_except(&["traverse"]);
    let others = |points| without(points, &["bbox"]);
    assert_eq!(others(alone.points()), others(expected));
    assert_eq!(by_reference.points(), full_points_except(&["bbox"]));
}

#[test]
fn two_crashes_stop_a_task() {
    let abort = "if dir.x < 0.0 { std::process::abort() }";
    let graded = before_box_test("aborting", abort).grade();
    let boxes = messages(&graded, "bbox");
    let crashed = |message: &&String| message.starts_with("the program was killed");
    assert_eq!(boxes.iter().filter(crashed).count(), 2, "{boxes:?}");
    let not_run = "not run because two other items in this task crashed";
    assert_eq!(boxes.last().unwrap(), not_run);
}

/// Sleeps for each new triangle, sphere and box, but for less than an item's time limit.
#[cfg(target_os = "linux")]
#[test]
fn a_slow_submission_has_a_budget_and_keeps_the_points_before() {
    let slow = "{ static LAST: std::sync::Mutex<String> = std::sync::Mutex::new(String::new());
        let (mut last, now) = (LAST.lock().unwrap(), format!(\"{self:?}\"));
        if *last != now {
            std::thread::sleep(std::time::Duration::from_millis(135));
            *last = now;
        } }";
    let shape = "pub fn hit(&self, ray: &Ray) -> Option<Trace> {";
    let bounds = "pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {";
    let methods = [
        ("triangle.rs", shape),
        ("sphere.rs", shape),
        ("bbox.rs", bounds),
    ];
    let submission = Submission::reference("slow");
    let slow = methods.iter().fold(submission, |submission, (file, head)| {
        submission.with_replaced(file, head, &format!("{head} {slow}"))
    });
    let graded = slow.grade();
    // A submission may wait for forty seconds in total.
    let points = graded.points();
    assert_eq!(points["camera"], FULL_POINTS["camera"], "{points:?}");
    let not_run = "not run because earlier items used up the submission's time";
    assert_eq!(messages(&graded, "build")[0], not_run);
    assert!(graded.score()["points"].as_u64().unwrap() > 25);
}
