//! Submissions with files that are missing, don't compile or depend on each other. Each gets a
//! report, and the points of other tasks don't change.

use grader::handed_out::RAYS;
use insta::assert_snapshot;

use crate::cases::NOT_COMPILING;
use crate::harness::{FULL_POINTS, GradeRun, Submission, full_points_except, no_points, without};

/// Asserts that a submission gets no points for spheres and full points for every other task except
/// `traverse`.
#[track_caller]
fn assert_other_tasks_keep_their_points(graded: &GradeRun) {
    let without_traverse = |points| without(points, &["traverse"]);
    let expected = full_points_except(&["sphere"]);
    assert_eq!(
        without_traverse(graded.points()),
        without_traverse(expected)
    );
}

/// Returns the report of a submission whose spheres don't compile. Panics if another task loses
/// points, except for the one item of `traverse` that needs spheres.
#[track_caller]
fn report_without_spheres(graded: &GradeRun) -> String {
    assert_eq!(graded.verdicts("sphere"), ["not_compiled"]);
    assert_other_tasks_keep_their_points(graded);
    graded.report()
}

/// Grades the reference with these replacements in `sphere.rs`.
fn grade_sphere_with(edits: &[(&str, &str)]) -> GradeRun {
    let submission = edits
        .iter()
        .fold(Submission::reference("edited"), |submission, (from, to)| {
            submission.with_replaced("sphere.rs", from, to)
        });
    submission.grade()
}

#[test]
fn a_file_that_is_not_compiled_costs_its_own_task() {
    let missing = Submission::reference("missing").without("sphere.rs");
    let not_text = Submission::reference("not-text").with("sphere.rs", b"struct \xff");
    let reports = [
        report_without_spheres(&missing.grade()),
        report_without_spheres(&not_text.grade()),
        report_without_spheres(&NOT_COMPILING),
    ];
    assert_snapshot!(reports.join("\n\n"));
    // This line is printed early, before the other files are compiled without `sphere.rs`, because
    // that compilation takes four times as long.
    let line =
        "sphere.rs:71: error[E0609]: no field `direction` on type `&Ray`; grading the rest\n";
    let error = NOT_COMPILING.error();
    assert!(error.ends_with(line), "{error}");
}

#[test]
fn a_renamed_file_counts_as_missing_and_is_noted() {
    let text = std::fs::read(Submission::reference("x").path().join("sphere.rs")).unwrap();
    let submission = Submission::reference("renamed").without("sphere.rs");
    let graded = submission.with("sphere_final.rs", text).grade();
    assert_eq!(graded.verdicts("sphere"), ["not_compiled"]);
    let note = &graded.score()["build"]["ignored_copies"][0];
    let points = FULL_POINTS["sphere"];
    let expected = format!(
        "sphere_final.rs is not graded because its name is not sphere.rs; this costs {points} \
         points"
    );
    assert_eq!(*note, expected);
}

#[test]
fn an_empty_file_costs_its_own_task_even_if_other_files_use_it() {
    let graded = Submission::reference("empty").with("bbox.rs", "").grade();
    assert_eq!(graded.verdicts("bbox"), ["not_compiled"]);
    assert_snapshot!(graded.report());
}

#[test]
fn a_changed_signature_costs_its_own_task_though_a_given_file_fails_to_compile() {
    let bbox = "BBox::new(self.center - self.radius, self.center + self.radius)";
    let graded = grade_sphere_with(&[
        ("bbox(&self) -> BBox {", "bbox(&self) -> Option<BBox> {"),
        (bbox, &format!("Some({bbox})")),
    ]);
    assert_eq!(graded.verdicts("sphere"), ["not_compiled"]);
    assert_other_tasks_keep_their_points(&graded);
    let text = graded.report();
    let advice =
        "  │ Restore the starter's declaration in sphere.rs, which the given code relies on:
  │   now         pub fn bbox(&self) -> Option<BBox>
  │   handed out  pub fn bbox(&self) -> BBox
";
    assert!(text.contains(advice), "{text}");
}

/// The compiler's errors are in given files, in the starter's version of another file, or in several
/// task files, and some of them name no task file at all.
#[test]
fn a_change_that_breaks_other_files_costs_its_own_task_only() {
    let changes = [
        (
            "bbox.rs",
            "#[derive(Clone, Copy, Debug, PartialEq)]",
            "#[derive(Clone, Debug, PartialEq)]",
        ),
        ("bbox.rs", "pub fn hit(", "fn hit("),
        (
            "bbox.rs",
            "pub fn enclose_point(",
            "pub fn enclose_a_point(",
        ),
        (
            "bvh.rs",
            "pub primitives: Vec<Primitive>",
            "primitives: Vec<Primitive>",
        ),
    ];
    for (index, (file, from, to)) in changes.into_iter().enumerate() {
        let changed = Submission::reference(&format!("declaration-{index}"));
        let graded = changed.with_replaced(file, from, to).grade();
        let score = graded.score();
        let not_compiled = score["build"]["not_compiled"].as_array().unwrap();
        let files: Vec<&str> = not_compiled
            .iter()
            .filter_map(|file| file["file"].as_str())
            .collect();
        assert_eq!(files, [file], "{from} -> {to}");
        let report = graded.report();
        assert!(report.contains("│ Restore "), "{report}");
    }
}

#[test]
fn an_error_in_ones_own_code_is_not_laid_to_a_changed_declaration() {
    let graded = grade_sphere_with(&[
        ("bbox(&self) -> BBox {", "bbox(self) -> BBox {"),
        ("let root = ", "let root: u8 = "),
    ]);
    let report = graded.report();
    assert!(
        !report.contains("which the given code relies on"),
        "{report}"
    );
}

/// With the typo, the file contains no `struct Sphere`, but the compiler's message is more helpful.
#[test]
fn a_typo_in_a_declaration_is_reported_with_the_compilers_words_and_line() {
    let (right, wrong) = ("pub struct Sphere {", "pub strct Sphere {");
    let typo = Submission::reference("typo").with_replaced("sphere.rs", right, wrong);
    let sphere = typo.path().join("sphere.rs");
    let text = std::fs::read_to_string(&sphere).unwrap();
    let line = 1 + text.lines().position(|line| line == wrong).unwrap();
    let graded = typo.grade();
    assert_eq!(graded.verdicts("sphere"), ["not_compiled"]);
    assert_eq!(graded.verdicts("triangle"), ["pass"]);
    let file = &graded.score()["build"]["not_compiled"][0];
    assert_eq!(file["line"], line);
    let message = file["message"].as_str().unwrap();
    assert!(message.contains("| pub strct Sphere {"), "{message}");
    assert!(message.contains(&format!("sphere.rs:{line}:")), "{message}");
    let begin = format!("{}:{line}: error: ", sphere.display());
    assert!(graded.error().starts_with(&begin), "{}", graded.error());

    // A declaration with unusual formatting isn't an error.
    let spaced = grade_sphere_with(&[(right, "pub struct\n    Sphere {")]);
    assert_eq!(spaced.verdicts("sphere"), ["pass"]);
}

#[test]
fn every_error_of_a_file_is_shown_with_a_path_that_an_editor_can_open() {
    let graded = grade_sphere_with(&[
        ("self.center - self.radius", "self.centre - self.radius"),
        ("self.center + self.radius", "self.center + self.radios"),
    ]);
    let report = graded.report();
    for error in ["no field `centre` on type", "no field `radios` on type"] {
        assert!(report.contains(error), "{report}");
    }
    let places = report.split("--> ").skip(1);
    let places = places.filter_map(|rest| rest.lines().next());
    let places: Vec<&str> = places.collect();
    assert_eq!(places.len(), 2, "{report}");
    for place in places {
        let numbers = place.strip_prefix("SUBMISSION/sphere.rs:").expect("a path");
        let parts: Vec<&str> = numbers.split(':').collect();
        let are_numbers = parts.iter().all(|part| part.parse::<u32>().is_ok());
        assert!(parts.len() == 2 && are_numbers, "{place}");
    }
}

#[test]
fn finds_errors_that_the_compiler_reports_one_after_the_other() {
    // The compiler stops at the first error, before it sees the second.
    let typo = "struct Camera fn new fn sample_ray (";
    let graded = Submission::not_compiling().with("camera.rs", typo).grade();
    assert_eq!(graded.verdicts("camera"), ["not_compiled"]);
    assert_eq!(graded.verdicts("sphere"), ["not_compiled"]);
    assert_eq!(graded.points()["triangle"], FULL_POINTS["triangle"]);
}

#[test]
fn writes_a_report_if_nothing_compiles() {
    let submission = Submission::reference("nothing");
    let nothing = |submission: Submission, file| submission.with(file, "fn (");
    let graded = RAYS.file_names().fold(submission, nothing).grade();
    assert_eq!(graded.points(), no_points());
    assert_snapshot!(graded.report());
}

#[test]
fn a_helper_in_another_task_file_and_a_changed_given_method_cost_nothing() {
    let (given, changed) = ("0.5 * (self.min + self.max)", "(self.min + self.max) / 2.0");
    let graded = Submission::with_helper_in_another_file()
        .with_replaced("bbox.rs", given, changed)
        .grade();
    assert_eq!(graded.points(), *FULL_POINTS);
    let note = &graded.score()["build"]["notes"][0];
    assert_eq!(
        note,
        "bbox.rs: the given method center was changed, which may cause items in any task to fail"
    );
}

#[test]
fn a_broken_file_also_fails_the_files_that_use_its_helpers() {
    let helped = Submission::with_helper_in_another_file();
    let broken = helped.with_replaced("bbox.rs", "enter > times.min", "oops");
    let graded = broken.grade();
    assert_eq!(graded.verdicts("bbox"), ["not_compiled"]);
    assert_eq!(graded.verdicts("build"), ["not_compiled"]);
    let points = graded.points();
    for task in ["camera", "triangle", "sphere"] {
        assert_eq!(points[task], FULL_POINTS[task], "{task}");
    }
}

#[test]
fn unsafe_code_does_not_compile() {
    let root = "discriminant.sqrt()";
    let graded = grade_sphere_with(&[(root, &format!("unsafe {{ {root} }}"))]);
    assert_eq!(graded.points()["sphere"], 0);
}

#[test]
fn does_not_reuse_a_build_of_files_with_the_same_modification_time() {
    // Archives restore old modification times. A build that compared these would reuse the other
    // submission's program.
    let old = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(315_532_800);
    let points_of_aged = |submission: Submission| {
        for file in RAYS.file_names() {
            let file = submission.path().join(file);
            let file = std::fs::File::options().append(true).open(file);
            file.unwrap().set_modified(old).unwrap();
        }
        submission.grade().points()
    };
    let starter = Submission::starter("same-name");
    assert_eq!(points_of_aged(starter), no_points());
    let reference = Submission::reference("same-name");
    assert_eq!(points_of_aged(reference), *FULL_POINTS);
}
