//! Tests of what a stored score depends on. What is graded, kept and tried again is tested with whole
//! runs, in `tests/histories` and `tests/it`.

use std::fs;
use std::path::Path;

use grader::handed_out::RAYS;

use super::*;
use crate::entry::{Person, Source};
use crate::graded_class::tests::policy as policy_of;
use crate::store::tests::run;

/// Returns an entry with a task file in this folder.
fn written(id: &str, folder: &Path) -> Entry {
    let path = folder.join(format!("{id}.rs"));
    fs::write(&path, "new").unwrap();
    let source = Source::Files(vec![("sphere.rs".to_owned(), path)]);
    Entry::new(id, Person::named("Ann"), "", source)
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
    // Other rules are applied to finished scores.
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
