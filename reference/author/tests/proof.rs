//! The exam catches every known mistake and fails no known right solution; and the checks that say
//! so can fail.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::LazyLock;

use author::exams::practice;
use author::proof::catalogue::Change;
use author::proof::exhibits::Exhibits;
use author::proof::recognition::recognise;
use author::proof::variants::Variant;
use author::proof::workbench::Workbench;
use grader::exam::Exam;

static EXHIBITS: LazyLock<Exhibits> = LazyLock::new(|| {
    let workbench = Workbench::open().expect("a toolchain and the workspace");
    Exhibits::prepare(workbench).expect("every mistake applies to the reference")
});

fn root() -> &'static Path {
    EXHIBITS.workbench.root()
}

fn practice_exam() -> Exam {
    practice(root()).expect("it is committed")
}

#[test]
fn some_seeds_are_proven() {
    let output = Command::new(env!("CARGO_BIN_EXE_author"))
        .args(["prove", "--seeds", "1..4", "--mistakes", "1"])
        .output()
        .expect("the binary was built for this test");
    let said = String::from_utf8_lossy(&output.stdout);
    let complaints = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaints}");
    assert!(said.contains("seeds 3, false fails 0"), "{said}");
}

#[test]
fn known_mistakes_are_recognised_and_strangers_mostly_get_no_hint() {
    let found = recognise(&EXHIBITS, &practice_exam()).unwrap();
    println!("{found}");
    assert!(found.share() >= 0.95, "{found}");
    // Many of these are true of both: they differ in how far they go.
    assert!(
        found.mistaken.len() * 10 <= EXHIBITS.mistakes.len(),
        "{found}"
    );
}

#[test]
fn every_kind_of_task_has_mistakes_and_variants_enough() {
    assert!(
        EXHIBITS.mistakes.len() >= 100,
        "{}",
        EXHIBITS.mistakes.len()
    );
    assert!(EXHIBITS.variants.len() >= 25, "{}", EXHIBITS.variants.len());
}

#[test]
fn each_file_of_a_variant_is_in_the_list() {
    let folder = root().join("reference/variants");
    let mut files = BTreeSet::new();
    for stem in ["camera", "triangle", "sphere", "bbox", "bvh"] {
        for entry in fs::read_dir(folder.join(stem)).unwrap().flatten() {
            let name = entry.file_name().into_string().unwrap();
            files.insert(format!("{stem}.{}", name.trim_end_matches(".rs")));
        }
    }
    let listed: BTreeSet<String> = EXHIBITS
        .variants
        .iter()
        .map(|(v, _)| v.id.clone())
        .collect();
    assert_eq!(files, listed);
}

#[test]
fn a_mistake_that_is_none_is_complained_of() {
    let (mut mistake, _) = EXHIBITS.mistakes[0].clone();
    let file = root().join("reference/src").join(mistake.task().file());
    let line = "//! Task 1: rays from the camera.";
    assert!(fs::read_to_string(file).unwrap().contains(line));
    mistake.changes = vec![Change {
        file: None,
        was: line.to_owned(),
        now: "//! Task 1.".to_owned(),
    }];
    let reference = EXHIBITS.recorder.reference();
    let sources = mistake.apply(reference).unwrap();
    let tried = EXHIBITS
        .tried(&mistake, &sources, &practice_exam())
        .unwrap();
    let problems = tried.problems();
    assert!(
        problems[0].ends_with("costs nothing in its own task"),
        "{problems:?}"
    );
    assert_eq!(problems.len(), 1 + mistake.fails.len());
}

#[test]
fn a_mistake_that_does_not_apply_any_more_says_so() {
    let (mut mistake, _) = EXHIBITS.mistakes[0].clone();
    mistake.changes[0].was = "no such text".to_owned();
    let error = mistake.apply(EXHIBITS.recorder.reference()).unwrap_err();
    let wanted = format!(
        "{} does not apply any more: its `was` stands 0 times in reference/src/camera.rs; adapt it \
         in reference/mistakes",
        mistake.id
    );
    assert_eq!(error.to_string(), wanted);
}

#[test]
fn a_variant_that_is_wrong_is_found() {
    let (mistake, sources) = &EXHIBITS.mistakes[0];
    let variant = Variant {
        id: mistake.id.clone(),
        title: String::new(),
        source: None,
        may_lose: Vec::new(),
        crates: Vec::new(),
    };
    let lost = EXHIBITS.variant_losses(&variant, sources, &practice_exam());
    assert!(!lost.unwrap().is_empty());
}
