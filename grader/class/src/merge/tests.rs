//! Tests for matching and merging shards.

use std::fs;

use grader::handed_out::RAYS;

use super::*;
use crate::entry::ListedTime;
use crate::graded_class::tests::{graded, result};
use crate::list_kind::ListKind;
use crate::outcome::EntryOutcome;
use crate::store::tests::run;

/// A class in two shards, in a temporary folder.
struct Shards {
    folder: tempfile::TempDir,
}

impl Shards {
    /// Creates a class with Ann in the first shard and Bob in the second.
    fn new() -> Self {
        let shards = Shards {
            folder: tempfile::tempdir().unwrap(),
        };
        for (part, id) in [(1, "ann"), (2, "bob")] {
            shards.write(part, |_| {});
            let shard = shards.store(part);
            shard.save_graded(&result(id, &[id], graded(80)), "key", 1);
        }
        shards
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn store(&self, part: usize) -> Store {
        Store::new(&self.path(&part.to_string()))
    }

    /// Writes the finished run of a shard after applying `change` to it.
    fn write(&self, part: usize, change: impl FnOnce(&mut Run)) {
        let mut run = Run {
            state: RoundState::Finished,
            shard: Some(format!("{part}/2").parse().unwrap()),
            entries: vec![["ann", "bob"][part - 1].to_owned()],
            class: "class".to_owned(),
            ..run()
        };
        change(&mut run);
        let store = self.store(part);
        fs::create_dir_all(store.folder()).unwrap();
        store.write_run(&run).unwrap();
    }

    /// Writes a list and returns the lists of a run that uses it.
    fn list(&self, kind: ListKind, text: &str) -> Lists {
        let path = self.path("given");
        fs::write(&path, text).unwrap();
        let mut given = Lists::default();
        *given.path(kind) = Some(path);
        given
    }

    /// Writes the run of a shard that was graded with this list.
    fn give(&self, part: usize, kind: ListKind, text: &str) {
        let used = UsedLists::choose(self.list(kind, text), None, &[]).unwrap();
        self.write(part, |run| run.lists = used.kept.clone());
        let run = self.store(part).read_run().unwrap().unwrap();
        used.save(&self.store(part), &run).unwrap();
    }

    fn arguments(&self) -> MergeArguments {
        MergeArguments {
            assignment: None,
            shards: vec![self.path("1"), self.path("2")],
            out: self.path("out"),
            policy: None,
            lists: Lists::default(),
        }
    }

    /// Returns the arguments for a merge that uses this list.
    fn given(&self, kind: ListKind, text: &str) -> MergeArguments {
        let lists = self.list(kind, text);
        MergeArguments {
            policy: lists.policy.clone(),
            lists,
            ..self.arguments()
        }
    }

    fn merge(&self) -> Result<Completion, Error> {
        merge_shards(&self.arguments(), &RAYS)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path("out").join(name)).unwrap()
    }

    /// Merges the shards. Returns Ann's final points.
    fn points(&self, arguments: &MergeArguments) -> String {
        merge_shards(arguments, &RAYS).unwrap();
        let grades = self.read("grades.csv");
        let ann = grades.lines().find(|line| line.starts_with("ann,"));
        ann.unwrap().split(',').nth(6).unwrap().to_owned()
    }
}

#[test]
fn a_shard_with_a_fault_makes_the_class_incomplete() {
    let shards = Shards::new();
    let fault = EntryOutcome::Fault("disk".to_owned());
    shards
        .store(2)
        .save_graded(&result("bob", &["bob"], fault), "", 1);
    assert_eq!(shards.merge().unwrap(), Completion::Incomplete);
}

#[test]
fn those_who_left_are_not_merged_but_named_once() {
    let shards = Shards::new();
    for part in [1, 2] {
        let left = result("eve", &["Eve"], graded(50));
        shards.store(part).save_graded(&left, "key", 1);
    }
    shards.merge().unwrap();
    let out = Store::new(&shards.path("out"));
    assert_eq!(out.ids().unwrap(), ["ann", "bob"]);
    let page = shards.read("class.html");
    assert_eq!(page.matches("eve (Eve): 50 points").count(), 1, "{page}");
}

#[test]
fn shards_that_do_not_belong_together_are_refused() {
    let refused = |change: &dyn Fn(&Shards)| {
        let shards = Shards::new();
        change(&shards);
        let error = shards.merge().unwrap_err();
        assert!(!shards.path("out/run.json").exists());
        let folder = shards.folder.path().display().to_string();
        error.to_string().replace(&folder, "")
    };
    let errors = [
        refused(&|shards| fs::remove_file(shards.path("2/run.json")).unwrap()),
        refused(&|shards| shards.write(2, |run| run.state = RoundState::Started)),
        refused(&|shards| shards.write(2, |run| run.class.push('x'))),
        refused(&|shards| shards.write(2, |run| run.settings.exam_hash.push('x'))),
        refused(&|shards| shards.give(2, ListKind::Policy, "")),
        refused(&|shards| shards.write(2, |run| run.shard = "1/2".parse().ok())),
        refused(&|shards| {
            shards.write(2, |run| run.entries.push("ann".to_owned()));
            let twice = result("ann", &["ann"], graded(80));
            shards.store(2).save_graded(&twice, "key", 1);
        }),
    ];
    insta::assert_snapshot!(errors.join("\n"));
}

#[test]
fn machines_may_differ_in_their_grader_and_compiler() {
    let shards = Shards::new();
    shards.write(2, |run| {
        run.settings.grader.push('x');
        run.settings.built_with.push('x');
    });
    shards.merge().unwrap();
}

#[test]
fn a_given_policy_counts_instead_of_those_of_the_shards() {
    let shards = Shards::new();
    for part in [1, 2] {
        shards.give(part, ListKind::Policy, "[points]\nout_of = 50\n");
    }
    assert_eq!(shards.points(&shards.arguments()), "40");
    let tenth = shards.given(ListKind::Policy, "[points]\nout_of = 10\n");
    assert_eq!(shards.points(&tenth), "8");
}

/// In the roster that the shards were graded with, Eve is in Ann's group and the submission time is
/// different.
#[test]
fn the_groups_and_times_of_a_new_roster_count() {
    let shards = Shards::new();
    let mut ann = result("ann", &["ann", "eve"], graded(80));
    ann.info.people[1].is_from_group = true;
    ann.info.listed = Some(ListedTime {
        submitted: "2026-11-25T12:00:00Z".to_owned(),
        late: true,
    });
    shards.store(1).save_graded(&ann, "key", 1);
    let merged = |arguments: &MergeArguments| {
        merge_shards(arguments, &RAYS).unwrap();
        let grades = shards.read("grades.csv");
        ["eve", "dan", "11-25", "11-20"].map(|text| grades.contains(text))
    };
    assert_eq!(merged(&shards.arguments()), [true, false, true, false]);
    let roster = "name,group,datetime\nann,One,2026-11-20T12:00:00Z\ndan,One,\n";
    let given = shards.given(ListKind::Roster, roster);
    assert_eq!(merged(&given), [false, true, false, true]);
}

#[test]
fn the_merged_class_may_not_be_in_a_shard() {
    let shards = Shards::new();
    let check = |out: &str| {
        let arguments = MergeArguments {
            out: shards.path(out),
            ..shards.arguments()
        };
        check_out(&arguments)
    };
    assert!(check("out").is_ok() && check("new/out").is_ok());
    for out in ["1", "2/new"] {
        let error = check(out).unwrap_err().to_string();
        assert!(error.contains("a different folder for --out"), "{error}");
    }
}

#[test]
fn the_lists_of_the_shards_count_and_a_merge_has_those_that_it_was_given() {
    let shards = Shards::new();
    let text = |delta| format!("student,task,delta,comment,author\nann,sphere,{delta},,Lee\n");
    shards.give(1, ListKind::ManualPoints, &text(5));
    let error = shards.merge().unwrap_err().to_string();
    assert!(error.contains("one with --manual-points"), "{error}");
    shards.give(2, ListKind::ManualPoints, &text(5));
    assert_eq!(shards.points(&shards.arguments()), "85");
    // The parts are graded with another list.
    for part in [1, 2] {
        shards.give(part, ListKind::ManualPoints, &text(6));
    }
    assert_eq!(shards.points(&shards.arguments()), "86");
    assert_eq!(
        shards.points(&shards.given(ListKind::ManualPoints, &text(7))),
        "87"
    );
    assert_eq!(shards.points(&shards.arguments()), "87");
    let refused = merge_shards(&shards.given(ListKind::ManualPoints, &text(50)), &RAYS);
    let error = refused.unwrap_err().to_string();
    assert!(error.contains("is out of range"), "{error}");
    assert_eq!(shards.points(&shards.arguments()), "87");
    let mut dropped = shards.arguments();
    dropped.lists.drop_list = vec![ListKind::ManualPoints];
    assert_eq!(shards.points(&dropped), "80");
}

#[test]
fn manual_points_for_nobody_stop_the_merge() {
    let shards = Shards::new();
    let rows = "student,task,delta,comment,author\nanne,build,-2,copied,TA\n";
    let arguments = shards.given(ListKind::ManualPoints, rows);
    let error = merge_shards(&arguments, &RAYS).unwrap_err().to_string();
    assert!(error.contains("nobody called"), "{error}");
    assert!(!shards.path("out/grades.csv").exists());
}
