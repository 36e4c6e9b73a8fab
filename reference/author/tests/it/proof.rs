//! The exam catches every known mistake and gives full marks to every known correct solution. The
//! checks themselves are also tested. Correct answers and mistakes are far enough from every
//! threshold.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

use author::authoring::RAYS;
use author::exams::load_practice;
use author::proof::grade::{GradedSolution, variant_losses};
use author::proof::recognition::{
    Recognition, recognise, recognise_independent, recognise_unknown,
};
use author::solutions::Solutions;
use author::solutions::catalogue::{Change, Mistake, independent_mistakes, unknown_mistakes};
use author::solutions::methods::wrong_methods;
use author::solutions::variants::variants;
use author::solutions::workbench::Workbench;
use judging::exam::Exam;
use projection::replacements;

use crate::harness::{author_succeeds, lock_builds, root, text};

/// The committed table of margins.
const CALIBRATION: &str = "reference/calibration.md";

static SOLUTIONS: LazyLock<Solutions> = LazyLock::new(|| {
    let workbench = Workbench::open(&RAYS).expect("a toolchain and a workspace are available");
    Solutions::load(workbench).expect("every mistake applies to the reference")
});

fn practice_exam() -> Exam {
    load_practice(&root(), &RAYS).expect("the practice exam is committed")
}

#[test]
fn all_margins_are_wide_enough_for_one_seed() {
    let before = text(CALIBRATION);
    let one_seed = ["calibrate", "--check", "--seeds", "2..3"];
    let summary = author_succeeds(&[&one_seed[..], &["--mistakes", "1"]].concat());
    assert!(summary.contains("seeds 1, "), "{summary}");
    assert_eq!(text(CALIBRATION), before, "a check changes nothing");
}

#[test]
fn the_committed_table_covers_thirty_seeds() {
    let table = text(CALIBRATION);
    assert!(table.contains("of 30 seeds (0 to 29)"), "{table}");
}

/// Grades a fixed sample of the mutants. Without `--fast`, `cargo author mutants` grades all of
/// them.
#[test]
fn sampled_mutants_are_caught_or_equivalent() {
    let summary = author_succeeds(&["mutants", "--fast"]);
    assert!(summary.contains("selected: one in 8"), "{summary}");
    assert!(summary.trim_end().ends_with(", 0 surviving"), "{summary}");
}

/// Checks that at least `count` mistakes are measured, that at least 85% of them are recognised,
/// and that at most `with_false_hint` of them get a false hint.
fn assert_recognised(recognition: &Recognition, count: usize, with_false_hint: usize) {
    assert_eq!(recognition.problems, [""; 0]);
    assert!(recognition.count >= count, "{recognition}");
    let is_most = recognition.recognised * 100 >= recognition.count * 85;
    assert!(is_most, "{recognition}");
    assert!(
        recognition.with_false_hint <= with_false_hint,
        "{recognition}"
    );
}

#[test]
fn known_mistakes_are_recognised_and_unknown_ones_mostly_get_no_hint() {
    // The mistakes that aren't recognised give no answers at all, so there is little to recognise
    // them by.
    let _lock = lock_builds();
    let recognition = recognise(&SOLUTIONS, &practice_exam()).unwrap();
    // Three mistakes overflow the stack and get the hint for another mistake that overflows it with
    // the same lists. That hint's description of the answers is also true of these three mistakes.
    assert_recognised(&recognition, 100, 3);
}

#[test]
fn mistakes_in_other_solutions_cost_points_and_most_are_recognised() {
    let _lock = lock_builds();
    let recognition = recognise_independent(&SOLUTIONS, &practice_exam()).unwrap();
    assert_recognised(&recognition, 102, 0);
}

#[test]
fn mistakes_of_no_known_kind_cost_points_and_get_no_false_hint() {
    // Grading all of them would take as long as all the other tests of this package together.
    const STEP: usize = 8;
    let _lock = lock_builds();
    let recognition = recognise_unknown(&SOLUTIONS, &practice_exam(), STEP).unwrap();
    assert_eq!(recognition.problems, [""; 0]);
    assert!(recognition.count >= 45, "{recognition}");
    assert_eq!(recognition.with_false_hint, 0, "{recognition}");
}

#[test]
fn no_two_mistakes_of_no_known_kind_have_the_same_id() {
    let mut all = unknown_mistakes(&SOLUTIONS).expect("every unknown mistake applies");
    all.extend(wrong_methods(&SOLUTIONS).expect("every wrong method completes its file"));
    let ids: BTreeSet<&String> = all.iter().map(|mistake| &mistake.id).collect();
    assert_eq!(ids.len(), all.len());
}

#[test]
fn each_mistake_is_in_one_other_solution_at_most() {
    let all = independent_mistakes(&SOLUTIONS).expect("every independent mistake applies");
    let known = all.iter().map(|mistake| &mistake.expected.true_hints[0]);
    let ids: BTreeSet<&String> = known.collect();
    assert_eq!(ids.len(), all.len());
}

#[test]
fn reports_an_independent_mistake_that_does_not_apply() {
    let mistake = |id: &str, variant: &str| Mistake {
        id: id.to_owned(),
        variant: Some(variant.to_owned()),
        changes: vec![Change {
            file: None,
            was: "discriminant".to_owned(),
            now: String::new(),
        }],
        ..Mistake::default()
    };
    let message = |mistake: Mistake| mistake.in_variant(&SOLUTIONS).unwrap_err().to_string();
    let in_sphere = message(mistake("sphere.far_first", "sphere.full_quadratic"));
    let expected = "sphere.far_first in sphere.full_quadratic no longer applies: its `was` must \
                    occur once in the variant's sphere.rs, but occurs 4 times; update `was` in \
                    mistakes/independent";
    assert_eq!(in_sphere, expected);

    let names = [
        ("sphere.no_such_mistake", "sphere.full_quadratic"),
        ("sphere.far_first", "sphere.no_such_variant"),
        ("sphere.far_first", "bvh.queue"),
    ];
    for (id, variant) in names {
        let expected = format!(
            "{id} in {variant}: the catalogue of mistakes must contain the mistake and its \
             `true_hints`, and variants.toml must contain a variant with this id that solves the \
             mistake's task"
        );
        assert_eq!(message(mistake(id, variant)), expected);
    }
}

#[test]
fn every_variant_file_is_used() {
    let folder = root().join("reference/variants");
    let stems = RAYS
        .handed_out
        .file_names()
        .map(|file| file.trim_end_matches(".rs"));
    // A file without variants doesn't have a folder.
    let has_variants = |stem: &PathBuf| folder.join(stem).is_dir();
    let mut folders: Vec<PathBuf> = stems.map(PathBuf::from).filter(has_variants).collect();
    let mut files = BTreeSet::new();
    while let Some(subfolder) = folders.pop() {
        for entry in fs::read_dir(folder.join(&subfolder)).unwrap().flatten() {
            let path = subfolder.join(entry.file_name());
            if entry.path().is_dir() {
                folders.push(path);
            } else {
                files.insert(path);
            }
        }
    }
    let variants = variants(&root(), RAYS.handed_out).unwrap().into_iter();
    let used: BTreeSet<PathBuf> = variants
        .flat_map(|variant| replacements(&folder, &variant.id, &variant.parts).unwrap())
        .flat_map(|replacement| replacement.files.into_iter().map(|(path, _)| path))
        .collect();
    assert_eq!(files, used);
}

#[test]
fn reports_a_mistake_that_changes_nothing() {
    let mut mistake = SOLUTIONS.catalogue[0].clone();
    let file = root()
        .join("reference/src")
        .join(RAYS.handed_out.assignment.info(mistake.task()).file);
    let line = "//! Task 1: rays from the camera.";
    assert!(fs::read_to_string(file).unwrap().contains(line));
    mistake.changes = vec![Change {
        file: None,
        was: line.to_owned(),
        now: "//! Task 1.".to_owned(),
    }];
    let mut solution = mistake.solution(SOLUTIONS.recorder.reference()).unwrap();
    solution.expected = SOLUTIONS.mistakes[0].expected.clone();
    let built = SOLUTIONS
        .workbench
        .build(&solution.sources, &solution.id)
        .unwrap();
    let graded = GradedSolution::new(&solution, &built, &practice_exam()).unwrap();
    let problems = graded.problems();
    assert!(
        problems[0].ends_with("costs no points in its own task"),
        "{problems:?}"
    );
    assert_eq!(problems.len(), 1 + solution.expected.fails.len());
}

#[test]
fn reports_a_mistake_that_no_longer_applies() {
    let mut mistake = SOLUTIONS.catalogue[0].clone();
    mistake.changes[0].was = "no such text".to_owned();
    let error = mistake.apply(SOLUTIONS.recorder.reference()).unwrap_err();
    let expected = format!(
        "{} no longer applies: its `was` must occur once in reference/src/camera.rs, but occurs 0 \
            times; update `was` in the catalogue of mistakes",
        mistake.id
    );
    assert_eq!(error.to_string(), expected);
}

#[test]
fn reports_a_wrong_variant() {
    let mistake = &SOLUTIONS.mistakes[0];
    let lost = variant_losses(&SOLUTIONS.workbench, mistake, &practice_exam());
    assert!(!lost.unwrap().is_empty());
}
