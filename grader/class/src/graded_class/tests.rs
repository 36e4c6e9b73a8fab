//! Tests for each person's grade and the explanation of the grade.

use tempfile::TempDir;

use super::*;
use crate::cli::Lists;
use crate::entry::EntryInfo;
use crate::late::ONLY_A_FLAG;
use crate::list_kind::ListKind;
use crate::outcome::{FileNotes, TaskScore};

/// Returns a result with this outcome for a submission by these people.
pub(crate) fn result(id: &str, people: &[&str], outcome: EntryOutcome) -> EntryResult {
    EntryResult {
        id: id.to_owned(),
        info: EntryInfo {
            people: people.iter().map(|name| Person::named(*name)).collect(),
            ..EntryInfo::default()
        },
        outcome,
    }
}

/// Returns a person with these fields.
pub(crate) fn person(fields: serde_json::Value) -> Person {
    serde_json::from_value(fields).unwrap()
}

/// Returns an outcome with this many points out of 100, all of them for spheres.
pub(crate) fn graded(points: u32) -> EntryOutcome {
    EntryOutcome::Graded(Box::new(ScoreSummary {
        points,
        max_points: 100,
        build: FileNotes::default(),
        tasks: vec![TaskScore {
            id: "sphere".to_owned(),
            title: "Spheres".to_owned(),
            points,
            max_points: 100,
            items: Vec::new(),
        }],
    }))
}

/// Returns an exam with this many points, all of them for spheres.
fn exam(max_points: u32) -> [TaskScore; 1] {
    [TaskScore {
        id: "sphere".to_owned(),
        max_points,
        ..TaskScore::default()
    }]
}

pub(crate) fn nothing() -> EntryOutcome {
    EntryOutcome::NothingToGrade("the folder is empty".to_owned())
}

pub(crate) fn fault() -> EntryOutcome {
    EntryOutcome::Fault("the disk is full".to_owned())
}

/// Writes lists into a temporary folder.
pub(crate) fn lists(texts: &[(ListKind, &str)]) -> (TempDir, Lists) {
    let folder = tempfile::tempdir().unwrap();
    let mut lists = Lists::default();
    for (kind, text) in texts {
        let path = folder.path().join(kind.name());
        std::fs::write(&path, text).unwrap();
        *lists.path(*kind) = Some(path);
    }
    (folder, lists)
}

pub(crate) fn policy(text: &str) -> Policy {
    Policy::from_text("policy.toml".as_ref(), text).unwrap()
}

fn points_by_hand(delta: i32) -> ManualPoints {
    ManualPoints {
        row: 2,
        student: "Ann".to_owned(),
        task: "sphere".to_owned(),
        delta,
        comment: "nice".to_owned(),
        author: "Lee".to_owned(),
        date: String::new(),
        is_for_attempt: false,
    }
}

/// Returns the row for a submission by these people, who also have manual points.
fn row(outcome: EntryOutcome, policy_text: &str, people: &[(&str, &[i32])]) -> ClassRow {
    let names: Vec<&str> = people.iter().map(|(name, _)| *name).collect();
    let adjustments = |(_, deltas): &(&str, &[i32])| Adjustments {
        manual: deltas.iter().copied().map(points_by_hand).collect(),
        ..Adjustments::default()
    };
    ClassRow::new(
        result("a", &names, outcome),
        &policy(policy_text),
        people.iter().map(adjustments).collect(),
        &exam(100),
    )
}

fn problems() -> [GradeProblem; 3] {
    [
        GradeProblem::UnclearTime(UnclearTime::new(ONLY_A_FLAG)),
        GradeProblem::OtherAttempt("b".to_owned()),
        GradeProblem::SeveralAttempts(
            vec!["b".to_owned(), "c".to_owned()],
            "remove one".to_owned(),
        ),
    ]
}

/// Returns a grade that isn't used because of this problem.
fn with_problem(problem: GradeProblem) -> PersonGrade {
    PersonGrade {
        problem: Some(problem),
        ..PersonGrade::default()
    }
}

#[test]
fn the_status_and_the_reason_follow_from_the_outcome_and_the_problem() {
    let mut lines = Vec::new();
    for outcome in [graded(80), nothing(), fault()] {
        let row = row(outcome, "", &[("Ann", &[])]);
        for problem in [None].into_iter().chain(problems().map(Some)) {
            let grade = PersonGrade {
                problem,
                ..PersonGrade::default()
            };
            let why: String = row.why(&grade).chars().take(40).collect();
            lines.push(format!("{} ({why})", row.status(&grade)));
        }
    }
    insta::assert_snapshot!(lines.join("\n"), @r"
    graded ()
    time unclear (the platform marks the submission as lat)
    another attempt counts (submission b from the same person counts)
    several attempts (the same person also submitted b and c: )
    nothing to grade (the folder is empty)
    time unclear (the platform marks the submission as lat)
    another attempt counts (submission b from the same person counts)
    several attempts (the folder is empty)
    not graded (the disk is full)
    not graded (the disk is full)
    another attempt counts (the disk is full)
    several attempts (the disk is full)
    ");
}

#[test]
fn other_points_are_explained_to_students_and_only_late_or_manual_ones_to_staff() {
    let halved = row(graded(80), "[points]\nout_of = 50", &[("Ann", &[])]);
    assert_eq!(
        halved.counted_texts(),
        ["40 of 50 points count towards the grade: 80 of 100 points earned."]
    );
    assert_eq!(halved.notes(), Vec::<String>::new());

    let changed = row(graded(80), "", &[("Ann", &[2])]);
    let texts = [
        "82 of 100 points count towards the grade: 80 of 100 points earned, 2 points added by hand.",
        "sphere: +2 points by Lee: nice",
    ];
    assert_eq!(changed.counted_texts(), texts);
    assert_eq!(changed.notes(), texts);

    let mut late = result("a", &["Ann"], graded(80));
    late.info.late = true;
    let late = ClassRow::new(late, &Policy::default(), vec![Adjustments::default()], &[]);
    let texts = [
        "80 of 100 points count towards the grade: 80 of 100 points earned, handed in late \
         (counted as 1 day, because the submission time is unknown), with no deduction.",
    ];
    assert_eq!(late.counted_texts(), texts);
    assert_eq!(late.notes(), texts);
}

#[test]
fn texts_name_people_only_if_they_differ() {
    let same = row(graded(80), "", &[("Ann", &[2]), ("Bob", &[2])]);
    assert_eq!(same.counted_texts().len(), 2);
    let different = row(graded(80), "", &[("Ann", &[2]), ("Bob", &[])]);
    let texts = [
        "Ann: 82 of 100 points count towards the grade: 80 of 100 points earned, 2 points added by \
         hand.",
        "Ann: sphere: +2 points by Lee: nice",
    ];
    assert_eq!(different.counted_texts(), texts);
    assert_eq!(different.notes(), texts);
    let nobody = row(graded(80), "", &[]);
    assert_eq!(nobody.counted_texts(), Vec::<String>::new());
}

#[test]
fn notes_give_the_reason_why_there_are_no_points() {
    let notes = |outcome| row(outcome, "", &[("Ann", &[1])]).notes();
    let by_hand = "sphere: +1 point by Lee: nice";
    assert_eq!(
        notes(nothing()),
        [
            "points by hand: the folder is empty",
            "1 of 100 points count towards the grade: 0 of 100 points earned, 1 point added by \
             hand.",
            by_hand
        ]
    );
    assert_eq!(notes(fault()), ["not graded: the disk is full", by_hand]);
    let mut row = row(graded(80), "", &[("Ann", &[1])]);
    row.grades[0].problem = Some(GradeProblem::OtherAttempt("b".to_owned()));
    assert_eq!(
        row.notes(),
        [
            "another attempt counts: submission b from the same person counts instead",
            by_hand
        ]
    );
}

#[test]
fn a_problem_is_explained_instead_of_points() {
    let texts = problems().map(|problem| with_problem(problem).explanation().join("\n"));
    insta::assert_snapshot!(texts.join("\n"), @"
    None of the points count yet: the course staff still have to review this submission.
    None of the points count towards the grade: submission b from the same person counts instead.
    None of the points count yet: the course staff still have to review this submission.
    ");
    assert_eq!(PersonGrade::default().explanation(), Vec::<String>::new());
}

#[test]
fn a_submission_is_superseded_if_others_count_for_all_of_its_people() {
    let mut row = row(graded(80), "", &[("Ann", &[]), ("Bob", &[])]);
    assert!(!row.is_superseded());
    assert_eq!(row.problem(), None);
    let [unclear, other, several] = problems();
    row.grades[1] = with_problem(other.clone());
    assert!(!row.is_superseded());
    assert_eq!(row.problem(), Some(&other));
    row.grades[0] = with_problem(unclear.clone());
    assert!(!row.is_superseded());
    assert_eq!(row.problem(), Some(&unclear));
    row.grades[0] = with_problem(several);
    assert!(!row.is_superseded());
    row.grades[0] = with_problem(other);
    assert!(row.is_superseded());
    row.grades.clear();
    assert!(!row.is_superseded(), "nobody has another one");
}

#[test]
fn superseded_submissions_and_faults_are_not_among_the_scores() {
    let mut superseded = row(graded(10), "", &[("Ann", &[])]);
    superseded.grades[0] = with_problem(GradeProblem::OtherAttempt("b".to_owned()));
    let outcomes = [graded(80), nothing(), fault(), graded(70), fault()];
    let rows = outcomes.map(|outcome| row(outcome, "", &[("Ann", &[])]));
    // The names Canvas uses for its test student in files and in the gradebook.
    let tests = ["studenttest", "Student, Test"];
    let tests = tests.map(|name| row(graded(0), "", &[(name, &[])]));
    let class = GradedClass {
        rows: [superseded].into_iter().chain(rows).chain(tests).collect(),
        ..GradedClass::default()
    };
    let points: Vec<u32> = class.scores().map(|(_, score)| score.points).collect();
    assert_eq!(points, [80, 70]);
    assert_eq!(class.fault_count(), 2);
    assert_eq!(GradedClass::default().fault_count(), 0);
}

#[test]
fn a_submission_without_a_time_counts_as_on_time_and_is_marked() {
    let due = "[late]\ndue = 2026-11-20T23:59:59Z\npercent_per_day = 10";
    let grade = |info: EntryInfo, outcome| {
        let mut result = result("a", &["Ann"], outcome);
        result.info = EntryInfo {
            people: result.info.people,
            ..info
        };
        ClassRow::new(result, &policy(due), vec![Adjustments::default()], &[])
            .grades
            .remove(0)
    };
    let undated = grade(EntryInfo::default(), graded(80));
    assert_eq!(
        (
            undated.counted.as_ref().unwrap().points,
            undated.is_undated()
        ),
        (80, true)
    );
    assert!(!grade(EntryInfo::default(), nothing()).is_undated());
    let at = |time: &str| EntryInfo {
        submitted: Some(time.to_owned()),
        ..EntryInfo::default()
    };
    let late = grade(at("2026-11-21T10:00:00Z"), graded(80));
    assert_eq!(
        (late.counted.as_ref().unwrap().points, late.is_undated()),
        (72, false)
    );
    let unclear = grade(at("yesterday"), graded(80));
    assert_eq!((&unclear.counted, unclear.is_undated()), (&None, false));
    let is_unclear = |problem| matches!(problem, Some(GradeProblem::UnclearTime(_)));
    assert!(is_unclear(unclear.problem));
}
