//! The recipe for Slurm, run on a real cluster.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use test_support::programs::make_executable;

use super::cluster::Cluster;
use super::{ITEMS, is_installed, recipe_command};
use crate::harness::{TestClass, assert_contains, comparable_files, successful_stdout};

/// A script that runs in place of the binary and kills it once, in the middle of the second shard.
/// A submission in that shard contains an infinite loop, so the shard takes longer than the CPU
/// time limit.
const DYING_ONCE: &str = r#"#!/bin/bash
if [[ "$*" == *"--shard 2/3"* && ! -e "$DIED" ]]; then
    touch "$DIED"
    "$REAL_CLASS" "$@" &
    while kill -0 $! && [[ ! -e "$OUT/shards/2/run.json" ]]; do sleep 0.02; done
    kill -9 $!
    wait $!
    exit
fi
exec "$REAL_CLASS" "$@"
"#;

/// A class, graded by a program that dies once for each output folder.
struct SlurmClass {
    class: TestClass,
    exam: String,
    policy: String,
}

impl SlurmClass {
    fn new() -> Self {
        // The second shard is `bob`, since each shard gets every third submission.
        let head = "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {";
        let class = TestClass::of_three()
            .with_reference("bob")
            .with_replaced("bob/camera.rs", head, &format!("{head}\n        loop {{}}"))
            .with_starter("dora");
        let exam = class.small_exam(&ITEMS);
        let policy = class.write_beside("policy.toml", "[points]\nout_of = 7\n");
        let dying = class.write_beside("dying", DYING_ONCE);
        make_executable(dying.as_ref());
        SlurmClass {
            class,
            exam,
            policy,
        }
    }

    /// Returns the command that submits the class.
    fn recipe(&self, cluster: &Cluster, out: &Path, retries: &str) -> Command {
        let mut submit = recipe_command("slurm.sh", &self.class, &self.exam, out);
        cluster
            .configure(&mut submit)
            .env("POLICY", &self.policy)
            .env("SHARDS", "3")
            .env("CORES", "1")
            .env("MEMORY", "100M")
            .env("TIME", "00:10:00")
            .env("WAIT", "1hour")
            .env("RETRIES", retries)
            .env("CLASS", self.class.path_beside("dying"))
            .env("REAL_CLASS", env!("CARGO_BIN_EXE_class"))
            .env("DIED", out.with_extension("died"));
        submit
    }

    /// Asserts that a folder contains the same results as a single run that grades the whole class.
    fn assert_same_results(&self, out: &Path) {
        let mut files = comparable_files(out);
        let of_recipe = |path: &PathBuf| path.starts_with("shards") || path.starts_with("logs");
        files.retain(|path, _| !of_recipe(path));
        let expected = comparable_files(&self.class.out());
        assert_eq!(
            files.keys().collect::<Vec<_>>(),
            expected.keys().collect::<Vec<_>>()
        );
        for (path, bytes) in &expected {
            let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
            assert_eq!(text(&files[path]), text(bytes), "{}", path.display());
        }
        let grades = fs::read_to_string(out.join("grades.csv")).unwrap();
        assert_eq!(grades.lines().count(), 5, "{grades}");
    }
}

/// Returns the job numbers of the array and the merge, as printed by the recipe.
fn submitted(output: &Output) -> (String, String) {
    let text = successful_stdout(output);
    println!("{text}");
    let number_after = |words: &str| -> String {
        let (_, rest) = text.split_once(words).unwrap_or_else(|| panic!("{text}"));
        rest.chars().take_while(char::is_ascii_digit).collect()
    };
    assert!(text.contains("submitted the parts 1-3"), "{text}");
    (number_after("as job "), number_after("their merge as job "))
}

/// Returns the logs of all merges, in the order they ran.
fn merge_logs(out: &Path) -> Vec<String> {
    let logs = fs::read_dir(out.join("logs")).unwrap();
    let paths = logs.map(|log| log.unwrap().path());
    let mut merges: Vec<PathBuf> = paths
        .filter(|path| path.to_string_lossy().ends_with("-merge.txt"))
        .collect();
    merges.sort_by_key(|path| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        name.trim_end_matches("-merge.txt").parse::<u32>().unwrap()
    });
    let read = |path: &PathBuf| fs::read_to_string(path).unwrap();
    merges.iter().map(read).collect()
}

#[test]
fn a_killed_part_is_graded_again_and_the_results_equal_one_run() {
    if !is_installed("Slurm", Cluster::is_installed()) {
        return;
    }
    let slurm = SlurmClass::new();
    let cluster = Cluster::start();
    let retried = slurm.class.path_beside("retried");
    let output = slurm.recipe(&cluster, &retried, "2").output().unwrap();
    let (array, merge) = submitted(&output);
    // The same class, but a shard that dies isn't retried.
    let failed = slurm.class.path_beside("failed");
    let output = slurm.recipe(&cluster, &failed, "0").output().unwrap();
    let (_, failed_merge) = submitted(&output);
    cluster.wait_for_jobs();

    let shown = cluster.describe(&array);
    println!("{shown}");
    assert_eq!(shown.matches("JobState=COMPLETED").count(), 2, "{shown}");
    assert_eq!(shown.matches("JobState=FAILED").count(), 1, "{shown}");
    let requests = ["NumCPUs=1 ", "mem=100M", "TimeLimit=00:10:00", "Requeue=1"];
    assert_contains(&shown, &requests);
    assert!(!shown.contains("Deadline=N/A"), "{shown}");
    let shown = cluster.describe(&merge);
    println!("{shown}");
    let expected = ["KillOInInvalidDependent=Yes", "TimeLimit=00:10:00"];
    assert_contains(&shown, &expected);

    let logs = merge_logs(&retried);
    println!("logs of the merges: {logs:#?}");
    let [first, second] = logs.as_slice() else {
        panic!("{logs:?}")
    };
    let again = "parts 2 are not finished and will be graded again";
    assert_contains(first, &[again, "submitted the parts 2 as job"]);
    assert_contains(second, &["3 graded"]);
    successful_stdout(&slurm.class.grade(
        &slurm.exam,
        &["--policy", &slurm.policy, "--cpu-limit", "1"],
    ));
    slurm.assert_same_results(&retried);

    // The merge fails and says which shard is missing. Repeating the command then grades it.
    assert_contains(&cluster.describe(&failed_merge), &["JobState=FAILED"]);
    let logs = merge_logs(&failed);
    println!("log of the merge without retries: {logs:#?}");
    assert_contains(&logs[0], &["not finished"]);
    assert!(!failed.join("grades.csv").exists());
    submitted(&slurm.recipe(&cluster, &failed, "0").output().unwrap());
    cluster.wait_for_jobs();
    slurm.assert_same_results(&failed);
}
