//! Tests for grading entries, reusing earlier results and handling faults.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use grader::error::Error;
use grader::handed_out::{HandedOut, RAYS};
use grader::score::Score;
use tempfile::TempDir;

use super::*;
use crate::entry::{Person, Source};
use crate::graded_class::tests::{graded, policy as policy_of, result};
use crate::run::Settings;
use crate::store::tests::run;

/// A grader that cannot start the program of any submission.
#[derive(Default)]
struct FailingGrader {
    policy: Policy,
    /// The number of times the grader was called.
    asked: AtomicUsize,
    /// The store in which the grader looks for a result of entry `a` when it is called.
    watched: Option<Store>,
    has_seen_result: AtomicBool,
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

    fn item_points(&self) -> BTreeMap<String, u32> {
        BTreeMap::new()
    }

    fn grade(
        &self,
        _: &Submission,
        _: &mut ReportFiles,
        _: &dyn Fn(&str),
    ) -> Result<(Score, String), Error> {
        self.asked.fetch_add(1, Ordering::Relaxed);
        let has_result = |store: &Store| store.result("a").unwrap().is_some();
        let has_result = self.watched.as_ref().is_some_and(has_result);
        self.has_seen_result.fetch_or(has_result, Ordering::Relaxed);
        Err(io::Error::other("no\u{1b} program").into())
    }
}

/// A folder for submissions, a store in it, and a grader.
struct Folder {
    folder: TempDir,
    store: Store,
    grader: FailingGrader,
}

impl Folder {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::new(&folder.path().join("out"));
        let grader = FailingGrader {
            watched: Some(store.clone()),
            ..FailingGrader::default()
        };
        Folder {
            folder,
            store,
            grader,
        }
    }

    /// Calls a function with a grader for the folder's entries.
    fn with<T>(&self, call: impl FnOnce(&EntryGrader) -> T) -> T {
        call(&EntryGrader {
            grader: &self.grader,
            store: &self.store,
            run: &run(),
        })
    }

    fn is_done(&self, entry: &Entry) -> bool {
        self.with(|grader| grader.is_done(entry))
    }

    fn grade(&self, entry: &Entry) -> EntryResult {
        self.with(|grader| grader.grade(entry, &|_| {}).unwrap().0)
    }

    fn asked(&self) -> usize {
        self.grader.asked.load(Ordering::Relaxed)
    }
}

/// Returns an entry with a task file in this folder.
fn written(id: &str, folder: &Path) -> Entry {
    let path = folder.join(format!("{id}.rs"));
    fs::write(&path, "new").unwrap();
    let source = Source::Files(vec![("sphere.rs".to_owned(), path)]);
    Entry::new(id, Person::named("Ann"), "", source)
}

#[test]
fn a_submission_that_cannot_be_graded_is_tried_again_and_then_a_fault() {
    let folder = Folder::new();
    let entry = written("a", folder.folder.path());
    let found = folder.grade(&entry);
    let EntryOutcome::Fault(why) = &found.outcome else {
        panic!("{found:?}");
    };
    assert!(why.ends_with("no\\u{1b} program"), "{why}");
    assert_eq!(folder.asked(), ATTEMPTS);
    assert_eq!(folder.store.result("a").unwrap(), Some(found));
    assert!(!folder.is_done(&entry));
}

/// If an old result were kept, a run that is killed while writing an entry's files could leave an
/// old stamp next to a new score. That score would be used if the submission was changed back to
/// the old version.
#[test]
fn an_entry_has_no_result_while_it_is_graded_again() {
    let folder = Folder::new();
    let graded = result("a", &["Ann"], graded(80));
    folder.store.save_graded(&graded, "old key", 1);
    assert!(folder.store.result("a").unwrap().is_some());
    folder.grade(&written("a", folder.folder.path()));
    assert_eq!(folder.asked(), ATTEMPTS);
    assert!(!folder.grader.has_seen_result.load(Ordering::Relaxed));
}

#[test]
fn every_input_of_a_score_changes_its_key() {
    let folder = tempfile::tempdir().unwrap();
    let submission = collect_submission(&written("a", folder.path()), &RAYS).unwrap();
    let (run, policy) = (run(), Policy::default());
    let key = |run: &Run, policy: &Policy| cache_key(run, policy, &submission);
    let usual = key(&run, &policy);
    assert_eq!(key(&run, &policy), usual);
    let (mut other_round, mut other_exam) = (run.clone(), run.clone());
    other_round.round = 2;
    other_exam.settings.exam_hash.push('x');
    let hidden = policy_of("[visibility]\nfinal = 'hidden'");
    for other in [
        key(&other_round, &policy),
        key(&other_exam, &policy),
        key(&run, &hidden),
    ] {
        assert_ne!(other, usual);
    }
    // Other rules are only applied to finished scores.
    assert_eq!(key(&run, &policy_of("[points]\nout_of = 50")), usual);
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
        assert_ne!(cache_key(&run, &policy, &changed), usual, "change {number}");
    }
}
