//! Classes that are graded in shards, and the recipes for schedulers, which are run or checked
//! against strict schemas.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::harness::{
    TestClass, class_command, comparable_files, exit_code_and_stderr, successful_stdout, workspace,
};

const ITEMS: [&str; 1] = ["camera.offset"];

/// Creates a class of three submissions, in a folder with a name such as Moodle uses.
fn three_submissions() -> TestClass {
    TestClass::named("CG-Path tracing (2)")
        .with_reference("ann")
        .with_starter("bob")
        .with("carl.zip", "no archive")
}

fn grade_shard(class: &TestClass, exam: &str, which: &str, more: &[&str]) -> String {
    let out = class.path_beside(&format!("shard-{}", which.replace('/', "-")));
    let output = class_command()
        .arg(class.input())
        .args(["--exam", exam, "--no-reference", "--isolation", "none"])
        .args(["--shard", which])
        .args(more)
        .arg("--out")
        .arg(&out)
        .output()
        .unwrap();
    successful_stdout(&output);
    out.to_str().unwrap().to_owned()
}

fn merge(shards: &[&str], out: &Path) -> Output {
    let mut merge = class_command();
    merge.arg("merge").args(shards).arg("--out").arg(out);
    merge.output().unwrap()
}

#[test]
fn merged_shards_equal_an_unsharded_run() {
    let class = three_submissions();
    let exam = class.small_exam(&ITEMS);
    let policy = class.write_beside("policy.toml", "[points]\nout_of = 7\n");
    let more = ["--policy", policy.as_str()];
    successful_stdout(&class.grade(&exam, &more));
    let shards = ["1/2", "2/2"].map(|which| grade_shard(&class, &exam, which, &more));
    let [one, two] = shards.each_ref().map(String::as_str);
    let out = class.path_beside("merged");
    successful_stdout(&merge(&[one, two], &out));
    // The merge takes the policy from the shards.
    assert_eq!(comparable_files(&out), comparable_files(&class.out()));
    assert!(class.read("grades.csv").contains("graded,7,"));

    let refused = |shards: &[&str], why: &str| {
        let (code, error) = exit_code_and_stderr(&merge(shards, &out));
        assert_eq!(code, 2);
        assert!(error.contains(why), "{error}");
    };
    refused(&[one, two, one], "were both given the same --shard?");
    refused(&[one], "results are missing for 2/2");
    for out in [one.to_owned(), format!("{two}/merged")] {
        let before = comparable_files(Path::new(one));
        let merged = merge(&[one, two], Path::new(&out));
        let (code, error) = exit_code_and_stderr(&merged);
        assert_eq!(code, 2);
        assert!(error.contains("choose another folder for --out"), "{error}");
        assert_eq!(comparable_files(Path::new(one)), before);
    }
    let other = class.write_beside("other.toml", "[points]\nout_of = 8\n");
    grade_shard(&class, &exam, "2/2", &["--policy", &other]);
    refused(&[one, two], "different policies");
}

/// Sets the variables of a recipe, so that it runs the binary instead of `cargo class`.
fn set_recipe_variables(command: &mut Command, class: &TestClass, exam: &str) {
    command
        .current_dir(workspace())
        .env("CLASS", env!("CARGO_BIN_EXE_class"))
        .env("INPUT", class.input())
        .env("OUT", class.out())
        .env("EXAM", exam)
        .env("OPTIONS", "--no-reference --isolation none");
}

fn recipe(name: &str) -> std::path::PathBuf {
    workspace().join("grader/class/recipes").join(name)
}

/// A replacement for `sbatch` that runs all tasks of an array, or a script without an array.
const SBATCH: &str = r#"#!/bin/bash
set -euo pipefail
for word in "$@"; do case "$word" in
    --array=*) range=${word#--array=} ;;
    --*) ;;
    *) script=$word; break ;;
esac; done
echo 1
if [[ -n "${range:-}" ]]; then
    for part in ${range//,/ }; do
        for id in $(seq "${part%-*}" "${part#*-}"); do
            # A task that fails is no failure of sbatch.
            SLURM_ARRAY_TASK_ID=$id bash "$script" >&2 || true
        done
    done
else
    bash "$script" >&2
fi
"#;

/// A replacement for the binary that is killed when it grades the second part for the first time.
const DYING_ONCE: &str = r#"#!/bin/bash
if [[ "$*" == *"--shard 2/2"* && ! -e "$OUT/died" ]]; then
    touch "$OUT/died"
    kill -9 $$
fi
exec "$REAL_CLASS" "$@"
"#;

#[cfg(unix)]
#[test]
fn the_recipe_for_slurm_grades_a_dead_part_again_and_merges() {
    use std::os::unix::fs::PermissionsExt;

    let class = three_submissions();
    let exam = class.small_exam(&ITEMS);
    let bin = class.path_beside("bin");
    fs::create_dir(&bin).unwrap();
    for (name, text) in [("sbatch", SBATCH), ("dying", DYING_ONCE)] {
        fs::write(bin.join(name), text).unwrap();
        fs::set_permissions(bin.join(name), fs::Permissions::from_mode(0o755)).unwrap();
    }
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());

    let mut submit = Command::new("bash");
    submit
        .arg(recipe("slurm.sh"))
        .env("PATH", path)
        .env("SHARDS", "2");
    set_recipe_variables(&mut submit, &class, &exam);
    submit
        .env("REAL_CLASS", env!("CARGO_BIN_EXE_class"))
        .env("CLASS", bin.join("dying"));
    let output = submit.output().unwrap();
    let text = successful_stdout(&output);
    assert!(text.contains("submitted the parts 1-2 as job 1"), "{text}");
    let log = String::from_utf8(output.stderr).unwrap();
    assert!(
        log.contains("the parts 2 are not finished: they are graded again"),
        "{log}"
    );
    let grades = class.read("grades.csv");
    assert_eq!(grades.lines().count(), 4, "{grades}");

    // Another number of parts would mix up the submissions.
    let output = submit.env("SHARDS", "3").output().unwrap();
    let (code, error) = exit_code_and_stderr(&output);
    assert_eq!(code, 2);
    assert!(error.contains("has parts of 2; set SHARDS=2"), "{error}");
}

#[test]
fn results_of_another_part_or_among_the_submissions_are_refused() {
    let class = three_submissions();
    let exam = class.small_exam(&ITEMS);
    grade_shard(&class, &exam, "1/2", &[]);
    let grade = |out: &Path, more: &[&str]| {
        let mut command = class_command();
        command
            .arg(class.input())
            .args(["--exam", &exam, "--isolation", "none"]);
        command
            .arg("--no-reference")
            .args(more)
            .arg("--out")
            .arg(out);
        exit_code_and_stderr(&command.output().unwrap())
    };
    let shard = class.path_beside("shard-1-2");
    for more in [&["--shard", "1/3"][..], &[]] {
        let (code, error) = grade(&shard, more);
        assert_eq!(code, 2);
        assert!(
            error.contains("has the results of part 1/2, and not of"),
            "{error}"
        );
    }
    let (code, error) = grade(&class.input().join("graded"), &[]);
    assert_eq!(code, 2);
    assert!(error.contains("would be taken for submissions"), "{error}");
    assert!(!class.input().join("graded").exists());
}

#[test]
fn an_estimate_grades_a_few_submissions_and_keeps_their_results() {
    let class = three_submissions()
        .with_reference("dora")
        .with_reference("eve");
    let exam = class.small_exam(&ITEMS);
    let estimate = || successful_stdout(&class.grade(&exam, &["--estimate", "--jobs", "1"]));
    let text = estimate();
    assert!(text.contains("estimate from 2 submissions"), "{text}");
    assert!(text.contains("2 more submissions, 1 at a time"), "{text}");
    assert!(
        text.contains("64 machines like this") && text.contains("core-hours"),
        "{text}"
    );
    assert!(!class.out().join("grades.csv").exists());
    let text = estimate();
    assert!(text.contains("0 more submissions"), "{text}");
    let text = estimate();
    assert!(text.contains("nothing to estimate"), "{text}");
    let graded = class.grade(&exam, &[]);
    let lines = String::from_utf8_lossy(&graded.stderr);
    assert!(!lines.contains(" of "), "all results were kept: {lines}");
    assert!(successful_stdout(&graded).contains("4 graded"));
}

#[test]
fn the_recipe_for_gnu_parallel_grades_and_merges() {
    let is_there = Command::new("parallel").arg("--version").output();
    if !is_there.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).contains("GNU")) {
        assert!(std::env::var_os("CI").is_none(), "GNU parallel is missing");
        return eprintln!("SKIPPED: GNU parallel is not installed");
    }
    let class = three_submissions();
    let exam = class.small_exam(&ITEMS);
    let mut run = Command::new("bash");
    run.arg(recipe("parallel.sh")).env("SHARDS", "2");
    set_recipe_variables(&mut run, &class, &exam);
    successful_stdout(&run.output().unwrap());
    assert_eq!(class.read("grades.csv").lines().count(), 4);
}

mod recipe_schemas {
    use std::collections::BTreeMap;

    use serde::Deserialize;
    use serde_json::Value;

    use super::{fs, recipe};

    fn read<T: serde::de::DeserializeOwned>(name: &str) -> T {
        let text = fs::read_to_string(recipe(name)).unwrap();
        serde_saphyr::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Without these options, a class would be graded with the practice exam, which students have.
    fn assert_exam_and_policy(command: &str) {
        for option in ["--exam ", "--policy "] {
            assert!(command.contains(option), "{option}: {command}");
        }
    }

    /// The schema of a Kubernetes Job (batch/v1), as far as the recipe needs it.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "camelCase")]
    struct Job {
        api_version: String,
        kind: String,
        metadata: BTreeMap<String, String>,
        spec: JobSpec,
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "camelCase")]
    struct JobSpec {
        completion_mode: String,
        completions: u32,
        parallelism: u32,
        backoff_limit_per_index: u32,
        active_deadline_seconds: u32,
        template: Template,
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Template {
        spec: PodSpec,
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "camelCase")]
    struct PodSpec {
        restart_policy: String,
        automount_service_account_token: bool,
        containers: Vec<Container>,
        volumes: Vec<Value>,
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "camelCase")]
    struct Container {
        #[serde(rename = "name")]
        _name: String,
        #[serde(rename = "image")]
        _image: String,
        working_dir: String,
        command: Vec<String>,
        env: Vec<BTreeMap<String, String>>,
        resources: Value,
        volume_mounts: Vec<Value>,
    }

    #[test]
    fn the_kubernetes_recipe_is_an_indexed_job_with_one_shard_per_completion() {
        let job: Job = read("kubernetes.yaml");
        assert_eq!(
            (job.api_version.as_str(), job.kind.as_str()),
            ("batch/v1", "Job")
        );
        assert!(job.metadata.contains_key("name"));
        assert_eq!(job.spec.completion_mode, "Indexed");
        assert!(job.spec.parallelism <= job.spec.completions);
        assert!(job.spec.backoff_limit_per_index > 0);
        let pod = job.spec.template.spec;
        assert_eq!(pod.restart_policy, "Never");
        assert!(job.spec.active_deadline_seconds > 0);
        assert!(!pod.automount_service_account_token);
        let [container] = pod.containers.as_slice() else {
            panic!("there must be one container")
        };
        // Kubernetes counts from 0, and shards are counted from 1.
        let shards = &container.env[0];
        assert_eq!(shards["name"], "SHARDS");
        assert_eq!(shards["value"], job.spec.completions.to_string());
        let command = container.command.join(" ");
        assert!(command.contains("--shard \"$((JOB_COMPLETION_INDEX + 1))/$SHARDS\""));
        assert_exam_and_policy(&command);
        assert!(
            container.working_dir.starts_with('/') && container.resources["limits"].is_object()
        );
        assert_eq!(container.volume_mounts.len(), pod.volumes.len());
    }

    /// The schema of a GitHub workflow, as far as the recipe needs it.
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Workflow {
        #[serde(rename = "name")]
        _name: String,
        on: Value,
        permissions: BTreeMap<String, String>,
        jobs: BTreeMap<String, WorkflowJob>,
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "kebab-case")]
    struct WorkflowJob {
        runs_on: String,
        timeout_minutes: u32,
        #[serde(default)]
        needs: Option<String>,
        #[serde(default)]
        strategy: Option<Strategy>,
        steps: Vec<Step>,
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "kebab-case")]
    struct Strategy {
        fail_fast: bool,
        matrix: BTreeMap<String, Vec<u32>>,
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Step {
        #[serde(default)]
        uses: Option<String>,
        #[serde(default)]
        run: Option<String>,
        #[serde(default, rename = "env")]
        _env: BTreeMap<String, String>,
        #[serde(default, rename = "with")]
        _with: Option<BTreeMap<String, Value>>,
    }

    #[test]
    fn the_workflow_for_github_grades_every_part_and_then_merges() {
        let workflow: Workflow = read("github-matrix.yml");
        assert!(workflow.on["workflow_dispatch"].is_object() || workflow.on == "workflow_dispatch");
        assert_eq!(workflow.permissions["contents"], "read");
        let shard = &workflow.jobs["shard"];
        let strategy = shard.strategy.as_ref().unwrap();
        assert!(
            !strategy.fail_fast,
            "a failing part must not stop the others"
        );
        let parts = &strategy.matrix["part"];
        let wanted: Vec<u32> = (1..=parts.len() as u32).collect();
        assert_eq!(*parts, wanted);
        let runs = |job: &WorkflowJob| -> String {
            job.steps
                .iter()
                .filter_map(|step| step.run.clone())
                .collect()
        };
        let option = format!("--shard ${{{{ matrix.part }}}}/{}", parts.len());
        assert!(runs(shard).contains(&option), "{}", runs(shard));
        let merge = &workflow.jobs["merge"];
        assert_eq!(merge.needs.as_deref(), Some("shard"));
        assert!(runs(merge).contains("cargo class merge"));
        assert_exam_and_policy(&runs(shard));
        assert!(workflow.jobs.values().all(|job| job.timeout_minutes > 0));
        for job in workflow.jobs.values() {
            assert!(job.runs_on.starts_with("ubuntu-"));
            assert!(
                job.steps
                    .iter()
                    .all(|step| step.uses.is_some() != step.run.is_some())
            );
        }
    }
}
