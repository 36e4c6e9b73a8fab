//! Submissions of part two that don't compile or that misbehave. Each gets a report, and the points
//! of other tasks don't change.

use grader::handed_out::LIGHT;
use insta::assert_snapshot;

use crate::harness::{GradeRun, Submission};

/// Returns the ids of the tasks that don't get full points.
fn tasks_that_lose_points(graded: &GradeRun) -> Vec<&'static str> {
    let points = graded.points();
    let tasks = LIGHT.assignment.tasks.iter();
    let lost = tasks.filter(|task| points[task.id] < u64::from(task.points));
    lost.map(|task| task.id).collect()
}

#[test]
fn a_file_that_does_not_compile_costs_its_own_tasks() {
    for file in LIGHT.file_names() {
        let broken = Submission::reference_of(file, &LIGHT).with(file, "fn (");
        let graded = broken.grade_with_reference();
        let tasks = LIGHT.assignment.tasks.iter();
        let own: Vec<&str> = tasks
            .filter(|task| task.file == file)
            .map(|task| task.id)
            .collect();
        assert_eq!(tasks_that_lose_points(&graded), own, "{file}");
        for task in own {
            assert_eq!(graded.points()[task], 0, "{task}");
            assert_eq!(graded.verdicts(task), ["not_compiled"], "{task}");
        }
    }
}

/// Returns the report on a task for the reference with a statement at the beginning of a function.
fn report_with([file, function, statement]: [&str; 3], task: &str) -> String {
    let submission = Submission::reference_of("bad", &LIGHT);
    let text = std::fs::read_to_string(submission.path().join(file)).unwrap();
    let start = text.find(&format!("fn {function}(")).unwrap();
    let line = text[start..].lines().next().unwrap();
    let changed = format!("{line}\n        {statement}");
    let submission = submission.with_replaced(file, line, &changed);
    let mut command = submission.command();
    let graded = submission.run(command.args(["--cpu-limit", "2", "--task", task]));
    graded.report()
}

#[test]
fn a_panic_an_endless_path_and_nonsense_are_named() {
    let endless = ["path.rs", "radiance", "if bounces > 0 { loop {} }"];
    let not_a_number = ["direct.rs", "direct", "if true { return Vec3::NAN; }"];
    let panicking = ["material.rs", "refract", "assert!(ior != 1.0);"];
    let reports = [
        report_with(endless, "path"),
        report_with(not_a_number, "direct"),
        report_with(panicking, "specular"),
    ];
    assert_snapshot!(reports.join("\n\n"));
}

/// Returns the reference without the last task, as in the middle of a student's work.
fn without_the_last_task() -> Submission {
    let last = LIGHT.task_file("environment.rs").expect("a task file");
    Submission::reference_of("evening", &LIGHT).with(last.name, last.starter)
}

#[test]
fn what_is_not_written_yet_hides_neither_a_hint_nor_the_next_step() {
    let half = ["direct.rs", "light += value *", "light += 0.5 * value *"];
    let counted_twice = ["path.rs", "= scattered.pdf.is_none();", "= true;"];
    let wrong = [half, counted_twice];
    let wrong = wrong.map(|[file, was, now]| without_the_last_task().with_replaced(file, was, now));
    let [direct, path] = wrong;
    let steps = [direct, path, without_the_last_task()].map(|submission| {
        let graded = submission.grade_with(&["--next", "--hints"]);
        graded.report()
    });
    assert_snapshot!(steps.join("\n"));
}
