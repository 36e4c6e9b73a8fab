//! The recipe for Kubernetes, checked against the schema published by Kubernetes.

use std::fs;

use super::schema::{Schema, parse_yaml};
use super::{assert_exam_and_policy, recipe};

fn manifest() -> String {
    fs::read_to_string(recipe("kubernetes.yaml")).unwrap()
}

#[test]
fn the_manifest_matches_the_published_schema() {
    let (schema, text) = (Schema::read("kubernetes-job.json"), manifest());
    schema.check("kubernetes.yaml", &parse_yaml(&text));
    for (from, to) in [
        ("backoffLimitPerIndex:", "backoffLimitPerIndexes:"),
        ("parallelism: 8", "parallelism: eight"),
        ("kind: Job", "kind: Jobs"),
        ("mountPath:", "path:"),
        ("claimName:", "name:"),
    ] {
        schema.check_that_it_rejects(&text, from, to);
    }
}

/// Checks requirements that the schema doesn't enforce.
#[test]
fn each_completion_grades_one_shard_with_limits() {
    let job = parse_yaml(&manifest());
    assert_eq!(
        (&job["apiVersion"], &job["kind"]),
        (&"batch/v1".into(), &"Job".into())
    );
    let spec = &job["spec"];
    assert_eq!(spec["completionMode"], "Indexed");
    assert!(spec["parallelism"].as_u64() <= spec["completions"].as_u64());
    assert!(spec["backoffLimitPerIndex"].as_u64() > Some(0));
    assert!(spec["activeDeadlineSeconds"].as_u64() > Some(0));
    let pod = &spec["template"]["spec"];
    // A pod that restarts in place wouldn't be counted as a failure of its index.
    assert_eq!(pod["restartPolicy"], "Never");
    assert_eq!(pod["automountServiceAccountToken"], false);
    let [container] = pod["containers"].as_array().unwrap().as_slice() else {
        panic!("there must be one container")
    };
    // Kubernetes counts from 0, and shards are counted from 1.
    let shards = &container["env"][0];
    assert_eq!(shards["name"], "SHARDS");
    assert_eq!(shards["value"], spec["completions"].to_string());
    let command = container["command"].as_array().unwrap().iter();
    let command: Vec<&str> = command.map(|word| word.as_str().unwrap()).collect();
    let command = command.join(" ");
    assert!(command.contains("--shard \"$((JOB_COMPLETION_INDEX + 1))/$SHARDS\""));
    assert_exam_and_policy(&command);
    for kind in ["requests", "limits"] {
        let resources = &container["resources"][kind];
        assert!(resources["cpu"].is_string() && resources["memory"].is_string());
    }
    // The exam is larger than a Secret may be, so it is on the volume.
    assert_eq!(
        pod["volumes"][0]["name"],
        container["volumeMounts"][0]["name"]
    );
    assert!(pod["volumes"][0]["persistentVolumeClaim"].is_object());
}
