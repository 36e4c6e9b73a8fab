//! JUnit's XML: a suite for each task, a case for each item.

use quick_junit::{NonSuccessKind, Property, Report, TestCase, TestCaseStatus, TestSuite};

use crate::format::said::{said, what};
use crate::format::{Around, Seen};
use crate::score::{ItemScore, TaskScore, Verdict};

/// The whole file.
pub fn text(seen: &Seen, around: &Around) -> String {
    let score = &seen.now;
    let mut report = Report::new(format!("pathtracing, {} exam", score.exam.id));
    for task in &score.tasks {
        report.add_test_suite(suite(seen, task, around));
    }
    let text = report.to_string();
    text.expect("a report is text, and text takes text")
}

fn suite(seen: &Seen, task: &TaskScore, around: &Around) -> TestSuite {
    let mut suite = TestSuite::new(task.id.id());
    suite.add_property(Property::new("title", &*task.title));
    suite.add_property(Property::new("complete", seen.now.complete.to_string()));
    add_points(
        &mut |property| _ = suite.add_property(property),
        task.points,
        task.max_points,
    );
    for item in &task.items {
        let mut case = TestCase::new(&*item.id, status(seen, item, around));
        case.set_classname(task.id.id());
        case.add_property(Property::new("title", &*item.title));
        add_points(
            &mut |property| _ = case.add_property(property),
            item.points,
            item.max_points,
        );
        suite.add_test_case(case);
    }
    if let Some(printed) = &task.printed {
        suite.set_system_out(&**printed);
    }
    suite
}

fn add_points(add: &mut dyn FnMut(Property), points: u32, max_points: u32) {
    add(Property::new("points", points.to_string()));
    add(Property::new("max_points", max_points.to_string()));
}

/// A wrong answer is a failure; none at all is an error; what was not asked is skipped.
fn status(seen: &Seen, item: &ItemScore, around: &Around) -> TestCaseStatus {
    let mut status = match &item.verdict {
        Verdict::Pass => return TestCaseStatus::success(),
        Verdict::Partial | Verdict::Wrong | Verdict::Panicked | Verdict::Unimplemented => {
            TestCaseStatus::non_success(NonSuccessKind::Failure)
        }
        Verdict::TimedOut
        | Verdict::OutOfMemory
        | Verdict::Crashed
        | Verdict::Protocol
        | Verdict::NotCompiled => TestCaseStatus::non_success(NonSuccessKind::Error),
        Verdict::Blocked { .. } | Verdict::Pending => TestCaseStatus::skipped(),
    };
    status.set_type(item.verdict.words());
    status.set_message(what(item));
    status.set_description(said(seen, item, around));
    status
}
