//! Tests of what is graded, what is taken from earlier runs, and what becomes of faults.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use grader::error::Error;
use grader::handed_out::{HandedOut, RAYS};
use grader::score::Score;

use super::*;
use crate::entry::{EntryInfo, Person, Source};
use crate::graded_class::tests::{graded, result};
use crate::run::Settings;
use crate::store::tests::run;

/// A grader that cannot start the program of any submission, and counts how often it was asked.
#[derive(Default)]
pub(crate) struct FailingGrader {
    policy: Policy,
    pub(crate) asked: AtomicUsize,
}

impl SubmissionGrader for FailingGrader {
    fn handed_out(&self) -> &'static HandedOut {
        &RAYS
    }

    fn policy(&self) -> &Policy {
        &self.policy
    }

    fn settings(&self) -> Result<Settings, Error> {
        Ok(run().settings)
    }

    fn task_points(&self) -> BTreeMap<String, u32> {
        BTreeMap::new()
    }

    fn grade(
        &self,
        _: &Submission,
        _: &mut ReportFiles,
        _: &dyn Fn(&str),
    ) -> Result<(Score, String), Error> {
        self.asked.fetch_add(1, Ordering::Relaxed);
        Err(io::Error::other("no\u{1b} program").into())
    }
}

/// A grader that looks at the stored result of entry `a` while it grades.
struct WatchingGrader<'a> {
    inner: FailingGrader,
    store: &'a Store,
    has_result: AtomicBool,
}

impl SubmissionGrader for WatchingGrader<'_> {
    fn handed_out(&self) -> &'static HandedOut {
        self.inner.handed_out()
    }

    fn policy(&self) -> &Policy {
        self.inner.policy()
    }

    fn settings(&self) -> Result<Settings, Error> {
        self.inner.settings()
    }

    fn task_points(&self) -> BTreeMap<String, u32> {
        self.inner.task_points()
    }

    fn grade(
        &self,
        submission: &Submission,
        files: &mut ReportFiles,
        show_status: &dyn Fn(&str),
    ) -> Result<(Score, String), Error> {
        let has_result = self.store.result("a").unwrap().is_some();
        self.has_result.fetch_or(has_result, Ordering::Relaxed);
        self.inner.grade(submission, files, show_status)
    }
}

fn entry(id: &str, source: Source) -> Entry {
    Entry {
        id: id.to_owned(),
        info: EntryInfo {
            people: vec![Person::named("Ann")],
            ..EntryInfo::default()
        },
        source,
    }
}

/// Returns an entry with a task file in this folder.
pub(crate) fn written(id: &str, folder: &Path) -> Entry {
    let path = folder.join(format!("{id}.rs"));
    fs::write(&path, "new").unwrap();
    entry(id, Source::Files(vec![("sphere.rs".to_owned(), path)]))
}

/// Returns an entry with nothing to grade.
pub(crate) fn missing(id: &str) -> Entry {
    entry(id, Source::Missing("nothing was handed in".to_owned()))
}

#[test]
fn a_submission_that_cannot_be_graded_is_tried_again_and_then_a_fault() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::new(&folder.path().join("out"));
    let (grader, run) = (FailingGrader::default(), run());
    let entry_grader = EntryGrader {
        grader: &grader,
        store: &store,
        run: &run,
        progress: &Progress::new(1, 1),
    };
    let entry = written("a", folder.path());
    let found = entry_grader.grade(0, &entry).unwrap();
    let EntryOutcome::Fault(why) = &found.outcome else {
        panic!("{found:?}");
    };
    assert!(why.ends_with("no\\u{1b} program"), "{why}");
    assert_eq!(grader.asked.load(Ordering::Relaxed), ATTEMPTS);
    assert_eq!(store.result("a").unwrap(), Some(found));
    assert!(!is_done(&grader, &store, &run, &entry));
}

#[test]
fn a_submission_with_a_valid_score_is_not_graded_again() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::new(&folder.path().join("out"));
    let (grader, run) = (FailingGrader::default(), run());
    let entry = written("a", folder.path());
    assert!(!is_done(&grader, &store, &run, &entry));
    let submission = collect_submission(&entry, &RAYS).unwrap();
    let key = cache_key(&run, grader.policy(), &submission);
    store.save_graded(&result("a", &["Ann"], graded(80)), &key, 1);
    assert!(is_done(&grader, &store, &run, &entry));
    let entry_grader = EntryGrader {
        grader: &grader,
        store: &store,
        run: &run,
        progress: &Progress::new(1, 1),
    };
    let found = entry_grader.grade(0, &entry).unwrap();
    assert_eq!(found, result("a", &["Ann"], graded(80)));
    assert_eq!(grader.asked.load(Ordering::Relaxed), 0);

    // After an edit, the score is set aside.
    fs::write(folder.path().join("a.rs"), "newer").unwrap();
    assert!(!is_done(&grader, &store, &run, &entry));
    let found = entry_grader.grade(0, &entry).unwrap();
    assert_eq!(found.score(), None);
    assert_eq!(store.replaced_score("a").unwrap().unwrap().points, 80);
}

/// Otherwise a run that is killed between two files of an entry would leave an old stamp beside a new
/// score, which would count if the submission became the old one again.
#[test]
fn an_entry_has_no_result_while_it_is_graded_again() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::new(&folder.path().join("out"));
    store.save_graded(&result("a", &["Ann"], graded(80)), "old key", 1);
    assert!(store.result("a").unwrap().is_some());
    let run = run();
    let grader = WatchingGrader {
        inner: FailingGrader::default(),
        store: &store,
        has_result: AtomicBool::new(false),
    };
    let entry_grader = EntryGrader {
        grader: &grader,
        store: &store,
        run: &run,
        progress: &Progress::new(1, 1),
    };
    entry_grader.grade(0, &written("a", folder.path())).unwrap();
    assert_eq!(grader.inner.asked.load(Ordering::Relaxed), ATTEMPTS);
    assert!(!grader.has_result.load(Ordering::Relaxed));
}

#[test]
fn an_entry_with_nothing_to_grade_is_done_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::new(folder.path());
    let (grader, run) = (FailingGrader::default(), run());
    assert!(is_done(&grader, &store, &run, &missing("a")));
    let entry_grader = EntryGrader {
        grader: &grader,
        store: &store,
        run: &run,
        progress: &Progress::new(1, 1),
    };
    let found = entry_grader.grade(0, &missing("a")).unwrap();
    let nothing = EntryOutcome::NothingToGrade("nothing was handed in".to_owned());
    assert_eq!(found, result("a", &["Ann"], nothing));
    assert_eq!(store.result("a").unwrap(), Some(found));
}

#[test]
fn every_input_of_a_score_changes_its_key() {
    let folder = tempfile::tempdir().unwrap();
    let submission = collect_submission(&written("a", folder.path()), &RAYS).unwrap();
    let (run, policy) = (run(), Policy::default());
    let key = cache_key(&run, &policy, &submission);
    assert_eq!(cache_key(&run, &policy, &submission), key);
    let other_round = Run {
        round: 2,
        ..run.clone()
    };
    assert_ne!(cache_key(&other_round, &policy, &submission), key);
    let mut other_exam = run.clone();
    other_exam.settings.exam_hash.push('x');
    assert_ne!(cache_key(&other_exam, &policy, &submission), key);
    let text = |text: &str| Policy::from_text("policy.toml".as_ref(), text).unwrap();
    let hidden = text("[visibility]\nfinal = 'hidden'");
    assert_ne!(cache_key(&run, &hidden, &submission), key);
    // Other rules are applied to finished scores.
    let halved = text("[points]\nout_of = 50");
    assert_eq!(cache_key(&run, &halved, &submission), key);
    let changes: [fn(&mut Submission); 5] = [
        |changed| changed.name.push('x'),
        |changed| changed.notes.push("x".to_owned()),
        |changed| changed.ignored_copies.push("x".to_owned()),
        |changed| changed.files[2].1 = Ok("newer".to_owned()),
        |changed| changed.files[2].1 = changed.files[0].1.clone(),
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut changed = submission.clone();
        change(&mut changed);
        assert_ne!(cache_key(&run, &policy, &changed), key, "change {number}");
    }
}
