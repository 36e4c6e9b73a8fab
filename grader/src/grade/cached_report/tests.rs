//! Tests which changes make a cached report stale, using reports in temporary folders.

use std::fs;

use tempfile::TempDir;

use super::*;
use crate::grade::options::Dependents;
use crate::handed_out::RAYS;
use crate::inputs::task_selection::TaskSelection;
use crate::probe::Budget;
use crate::report::html::Reload;
use crate::report::text::HintDetail;
use crate::score::tests::small_exam::{exam, pending};
use crate::score::tests::verdicts;
use crate::submission::TaskFileError;

fn submission() -> Submission {
    let files = RAYS.files.iter();
    let files = files.map(|file| (*file, Ok(file.starter.to_owned())));
    Submission {
        handed_out: &RAYS,
        name: "alice".to_owned(),
        files: files.collect(),
        ignored_copies: Vec::new(),
        notes: Vec::new(),
    }
}

fn key(options: &GradeOptions, submission: &Submission) -> CacheKey {
    CacheKey::new(options, submission, "exam", "compiler").unwrap()
}

fn own_key() -> CacheKey {
    key(&GradeOptions::default(), &submission())
}

/// Returns a complete score for two items. The second item has this verdict.
fn score_with(verdict: Verdict) -> Score {
    let mut score = pending(&exam(&["sphere.uv", "bbox.flat"]));
    score.complete = true;
    score.points = 7;
    score.tasks[0].items[0].verdict = Verdict::Pass;
    score.tasks[1].items[0].verdict = verdict;
    score
}

/// Returns a folder with the files of a report.
fn report() -> (TempDir, ReportFiles) {
    let folder = tempfile::tempdir().unwrap();
    let files = ReportFiles::new(folder.path(), Reload::Never);
    for path in files.paths() {
        fs::write(path, "text").unwrap();
    }
    (folder, files)
}

/// Stores a report with this score and returns the cached report, if there is one.
fn stored(score: &Score) -> Option<CachedReport> {
    let (_folder, files) = report();
    store(&own_key(), score, "the report", &files);
    CachedReport::read(&files)
}

#[test]
fn only_verdicts_that_are_the_same_the_next_time_are_stored() {
    let is_stored = |verdict: &Verdict| stored(&score_with(verdict.clone())).is_some();
    let (kept, others): (Vec<_>, Vec<_>) = verdicts().into_iter().partition(is_stored);
    let others: Vec<&str> = others.iter().map(Verdict::label).collect();
    let expected = [
        "out of time",
        "out of memory",
        "crashed",
        "no answer",
        "not graded yet",
    ];
    assert_eq!((kept.len(), &*others), (7, &expected[..]));
}

#[test]
fn the_report_of_a_stopped_grader_is_not_stored() {
    let mut score = score_with(Verdict::Pass);
    score.complete = false;
    assert!(stored(&score).is_none());
}

#[test]
fn a_report_is_stale_after_one_of_its_files_has_changed() {
    let (_folder, files) = report();
    store(&own_key(), &score_with(Verdict::Pass), "", &files);
    let cached = CachedReport::read(&files).unwrap();
    for path in files.paths() {
        fs::write(path, "other").unwrap();
        assert!(!cached.is_current(&own_key(), &files), "{path:?}");
        fs::remove_file(path).unwrap();
        assert!(!cached.is_current(&own_key(), &files), "{path:?}");
        fs::write(path, "text").unwrap();
        assert!(cached.is_current(&own_key(), &files), "{path:?}");
    }
}

#[test]
fn every_part_of_a_submission_changes_the_key() {
    let (_folder, files) = report();
    store(&own_key(), &score_with(Verdict::Pass), "", &files);
    let cached = CachedReport::read(&files).unwrap();
    let is_stale_after = |change: fn(&mut Submission)| {
        let mut changed = submission();
        change(&mut changed);
        let key = key(&GradeOptions::default(), &changed);
        let is_for_it = cached.is_for(&changed);
        assert_eq!(is_for_it, cached.is_current(&key, &files));
        !is_for_it
    };
    assert!(!is_stale_after(|_| {}));
    let changes: [fn(&mut Submission); 5] = [
        |changed| changed.name.push('x'),
        |changed| changed.files[2].1.as_mut().unwrap().push('\n'),
        |changed| changed.files[2].1 = Err(TaskFileError::Missing),
        |changed| changed.notes.push("x".to_owned()),
        |changed| changed.ignored_copies.push("x".to_owned()),
    ];
    assert!(changes.into_iter().all(is_stale_after));
}

/// Returns the default options after applying a change.
fn options_with(change: fn(&mut GradeOptions)) -> GradeOptions {
    let mut options = GradeOptions::default();
    change(&mut options);
    options
}

#[test]
fn the_options_the_exam_and_the_compiler_change_the_key() {
    let own = own_key();
    let changes: [fn(&mut GradeOptions); 5] = [
        |options| options.submission = Some("alice.zip".into()),
        |options| options.exam = ExamSource::File("final.json".into()),
        |options| options.dependents = Dependents::Block,
        |options| options.budget = Budget::from_seconds(7),
        |options| options.hints = HintDetail::Full,
    ];
    for changed in changes.map(options_with) {
        assert!(CacheKey::is_cacheable(&changed));
        assert_ne!(key(&changed, &submission()), own, "{changed:?}");
    }
    let options = GradeOptions::default();
    let with = |exam, compiler| CacheKey::new(&options, &submission(), exam, compiler);
    assert_eq!(with("exam", "compiler").as_ref(), Some(&own));
    assert_ne!(with("other", "compiler").as_ref(), Some(&own));
    assert_ne!(with("exam", "other").as_ref(), Some(&own));
}

#[test]
fn only_all_of_a_students_own_work_in_the_default_folder_is_cached() {
    assert!(CacheKey::is_cacheable(&GradeOptions::default()));
    let changes: [fn(&mut GradeOptions); 7] = [
        |options| options.exam = ExamSource::StandardInput,
        |options| options.tasks = TaskSelection::Only(Vec::new()),
        |options| options.policy = Some("policy.toml".into()),
        |options| options.gradescope_metadata = Some("submission_metadata.json".into()),
        |options| options.isolation = IsolationRequest::Untrusted,
        |options| options.out = Some("folder".into()),
        |options| options.formats = vec!["text".parse().unwrap()],
    ];
    for not_cached in changes.map(options_with) {
        assert!(!CacheKey::is_cacheable(&not_cached), "{not_cached:?}");
        let key = CacheKey::new(&not_cached, &submission(), "exam", "compiler");
        assert_eq!(key, None, "{not_cached:?}");
    }
}
