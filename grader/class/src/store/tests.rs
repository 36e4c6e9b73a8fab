//! Tests for the output folder: what is stored, replaced and kept.

use std::fs;

use super::*;
use crate::graded_class::tests::{fault, graded, nothing, result};
use crate::run::Settings;

impl Store {
    /// Stores a result in the same way as grading does, including the files of a graded entry. If
    /// there is a score, its `score.json` only contains the numbers.
    pub(crate) fn save_graded(&self, result: &EntryResult, key: &str, round: u32) {
        let folder = self.entry_folder(&result.id);
        fs::create_dir_all(&folder).unwrap();
        if let Some(score) = result.score() {
            let tasks = score.tasks.iter().map(|task| {
                serde_json::json!({
                    "id": task.id, "title": task.title, "points": task.points,
                    "max_points": task.max_points, "items": [],
                })
            });
            let score = serde_json::json!({
                "points": score.points, "max_points": score.max_points,
                "tasks": tasks.collect::<Vec<_>>(),
            });
            fs::write(folder.join(SCORE), json(&score)).unwrap();
        }
        self.save_result(result, key, round).unwrap();
    }
}

/// Returns the names of the files in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let files = files::read_dir(folder).unwrap();
    let names = files.iter().filter_map(|path| path.file_name()?.to_str());
    names.map(str::to_owned).collect()
}

/// Returns an empty store in a temporary folder.
pub(crate) fn store() -> (tempfile::TempDir, Store) {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::new(&folder.path().join("out"));
    fs::create_dir(store.folder()).unwrap();
    (folder, store)
}

fn points(score: Result<Option<ScoreSummary>, Error>) -> Option<u32> {
    score.unwrap().map(|score| score.points)
}

pub(crate) fn run() -> Run {
    Run::first_round(Settings {
        exam: "practice".to_owned(),
        exam_hash: "1".to_owned(),
        grader: "2".to_owned(),
        built_with: "3".to_owned(),
        isolation: "full".to_owned(),
        options: "4".to_owned(),
    })
}

/// Returns settings with a different exam.
pub(crate) fn other_settings() -> Settings {
    Settings {
        exam_hash: "other".to_owned(),
        ..run().settings
    }
}

#[test]
fn a_run_is_read_as_it_was_written() {
    let (_folder, store) = store();
    store.write_run(&run()).unwrap();
    assert_eq!(store.read_run().unwrap(), Some(run()));
    let text = fs::read_to_string(store.folder().join(RUN)).unwrap();
    assert!(text.starts_with("{\n  \"schema\": 1,") && text.ends_with("}\n"));
}

#[test]
fn a_damaged_file_is_an_error_that_names_it() {
    let (_folder, store) = store();
    store.write(RUN, "{").unwrap();
    let error = store.read_run().unwrap_err().to_string();
    assert!(error.contains("run.json is damaged (EOF"), "{error}");
    store.save_graded(&result("a", &["Ann"], graded(80)), "key", 1);
    for name in [SCORE, PREVIOUS, REPLACED] {
        fs::write(store.entry_folder("a").join(name), "{").unwrap();
    }
    let errors = [
        store.result("a").map(drop),
        store.earlier_score("a", PREVIOUS).map(drop),
        store.earlier_score("a", REPLACED).map(drop),
    ];
    for (error, name) in errors.into_iter().zip([SCORE, PREVIOUS, REPLACED]) {
        let error = error.unwrap_err().to_string();
        assert!(error.contains(&format!("{name} is damaged")), "{error}");
    }
    assert_eq!(store.cached_score("a", "key"), None);
}

/// The run fails while it removes the files of an earlier result.
#[test]
fn a_stamp_is_never_left_without_its_score() {
    let (_folder, store) = store();
    store.save_graded(&result("a", &["Ann"], graded(80)), "key", 1);
    fs::create_dir(store.entry_folder("a").join(REPORT)).unwrap();
    let replaced = store.save_result(&result("a", &["Ann"], nothing()), "key", 1);
    assert!(
        replaced.is_err(),
        "a folder cannot be removed the way a file can"
    );
    store.set_score_aside("a", 1, None).unwrap();
    assert_eq!(store.result("a").unwrap(), None);
}

#[test]
fn a_state_is_compared_with_its_reason() {
    let (_folder, store) = store();
    let is_stored = |why: &str| {
        let outcome = EntryOutcome::NothingToGrade(why.to_owned());
        store.has_nothing_to_grade("a", &outcome)
    };
    assert!(!is_stored("the folder is empty"));
    store.save_graded(&result("a", &["Ann"], nothing()), "", 1);
    assert!(is_stored("the folder is empty") && !is_stored("other"));
    store.save_graded(&result("a", &["Ann"], graded(80)), "", 1);
    assert!(!is_stored("the folder is empty"));
}

#[test]
fn an_entry_without_a_score_keeps_no_files_of_one() {
    let (_folder, store) = store();
    let folder = store.entry_folder("a");
    store.save_graded(&result("a", &["Ann"], graded(80)), "key", 1);
    fs::write(folder.join(REPORT), "page").unwrap();
    store.write_of_entry("a", FEEDBACK, "page").unwrap();
    fs::write(folder.join(PREVIOUS), "kept").unwrap();
    store.save_graded(&result("a", &["Ann"], graded(80)), "key", 1);
    assert_eq!(names(&folder), [STAMP, FEEDBACK, PREVIOUS, REPORT, SCORE]);
    store.save_graded(&result("a", &["Ann"], fault()), "", 1);
    assert_eq!(names(&folder), [STAMP, PREVIOUS]);
}

#[test]
fn both_pages_say_what_counts() {
    let (_folder, store) = store();
    let folder = store.entry_folder("a");
    fs::create_dir_all(&folder).unwrap();
    let page = "<h1>a</h1><!--counted--><!--/counted-->";
    fs::write(folder.join(REPORT), page).unwrap();
    let texts = [(); 2].map(|()| vec!["45 of 50".to_owned()]);
    let write = || store.write_counted("a", &texts, &BTreeSet::new()).unwrap();
    write();
    assert_eq!(names(&folder), [REPORT], "no page is made");
    store.write_of_entry("a", FEEDBACK, page).unwrap();
    write();
    for name in [REPORT, FEEDBACK] {
        let page = fs::read_to_string(folder.join(name)).unwrap();
        assert!(page.contains("45 of 50"), "{name}: {page}");
    }
}

#[test]
fn the_scores_from_before_a_regrade_are_kept() {
    let (_folder, store) = store();
    let save = |id: &str, outcome| store.save_graded(&result(id, &["Ann"], outcome), "", 1);
    for id in ["graded", "nothing", "fault"] {
        save(id, graded(80));
        store.set_score_aside(id, 1, None).unwrap();
    }
    save("graded", graded(70));
    save("nothing", nothing());
    fs::write(store.entry_folder("nothing").join(PREVIOUS), "{}").unwrap();
    save("fault", fault());
    // Repeating it after an interruption changes nothing.
    for _ in 0..2 {
        store.save_previous_scores().unwrap();
        assert_eq!(points(store.earlier_score("graded", PREVIOUS)), Some(70));
        assert_eq!(points(store.earlier_score("nothing", PREVIOUS)), None);
        assert_eq!(points(store.earlier_score("fault", PREVIOUS)), Some(80));
        assert_eq!(points(store.earlier_score("new", PREVIOUS)), None);
        for id in ["graded", "nothing", "fault"] {
            assert_eq!(points(store.earlier_score(id, REPLACED)), None, "{id}");
        }
    }
}

#[test]
fn a_copied_entry_has_the_files_of_the_other_store_and_no_others() {
    let ((_one, from), (_two, to)) = (store(), store());
    from.save_graded(&result("a", &["Ann"], graded(80)), "key", 1);
    fs::write(from.entry_folder("a").join(".tmp123"), "").unwrap();
    to.save_graded(&result("a", &["Ann"], graded(10)), "old", 1);
    fs::write(to.entry_folder("a").join(PREVIOUS), "old").unwrap();
    to.copy_entry("a", &from).unwrap();
    assert_eq!(names(&to.entry_folder("a")), [STAMP, SCORE]);
    assert_eq!(to.result("a").unwrap(), from.result("a").unwrap());

    from.remove_stamp("a").unwrap();
    to.copy_entry("a", &from).unwrap();
    assert_eq!(names(&to.entry_folder("a")), [SCORE]);
}
