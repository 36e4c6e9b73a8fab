//! Packages are complete, and packages that students can read contain no secrets.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use author::bundle::secrets::Secrets;
use author::bundle::{Bundle, archive};
use author::package::{Course, Platform, collect};
use grader::doctor::package::problems;
use grader::handed_out::RAYS;

/// A course with a substitute for a final exam: the practice exam with another id.
static FINAL: LazyLock<Course> = LazyLock::new(|| {
    let exam = std::fs::read_to_string(root().join("grader/exams/practice.json")).unwrap();
    let mut course = Course::new(&RAYS, None, None, None).unwrap();
    course.exam = Some(exam.replacen("\"practice\"", "\"final\"", 1));
    course
});

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn without_exam() -> Course {
    Course::new(&RAYS, None, None, None).unwrap()
}

#[test]
fn the_gradescope_zip_is_complete_and_has_no_needless_files() {
    let package = collect(&root(), &RAYS, Platform::Gradescope, FINAL.clone()).unwrap();
    let folder = tempfile::TempDir::new().unwrap();
    let zip = folder.path().join("gradescope.zip");
    std::fs::write(&zip, archive::zip_with_prefix(&package, "").unwrap()).unwrap();
    assert_eq!(problems(&zip, &RAYS).unwrap(), [""; 0]);
    for path in package.files.keys() {
        for staff in [
            "mistakes", "variants", "mutants", "author", "tests/", "handout/",
        ] {
            assert!(!path.contains(staff), "{path}");
        }
    }
    assert!(package.text("pathtracing/reference/src/bvh.rs").is_some());
}

#[test]
fn packages_that_students_can_read_hold_no_solution_and_no_final_exam() {
    for platform in [Platform::Classroom50, Platform::Github] {
        let refused = collect(&root(), &RAYS, platform, FINAL.clone()).unwrap_err();
        let message = "only a package for gradescope can contain a final exam";
        assert!(refused.to_string().contains(message), "{refused}");
    }
    let package = collect(&root(), &RAYS, Platform::Classroom50, without_exam()).unwrap();
    let unpacked = archive::unzip(&package.files["pathtracing.zip"]).unwrap();
    let students = Bundle::collect(&root(), &RAYS, None).unwrap();
    let secrets = Secrets::gather(&root(), &RAYS, &students).unwrap();
    assert_eq!(secrets.search(&unpacked), []);
    let size: usize = package.files.values().map(Vec::len).sum();
    assert!(size < 10 << 20, "classroom50 takes 10 MiB: {size}");
}

#[test]
fn written_folders_are_complete() {
    let folder = tempfile::TempDir::new().unwrap();
    for platform in ["classroom50", "github"] {
        let out = folder.path().join(platform);
        let output = Command::new(env!("CARGO_BIN_EXE_author"))
            .args(["package", platform, "--out"])
            .arg(&out)
            .output()
            .unwrap();
        assert!(output.status.success(), "{output:?}");
        assert_eq!(problems(&out, &RAYS).unwrap(), [""; 0], "{platform}");
    }
}

#[test]
fn a_gradescope_package_needs_a_final_exam() {
    let refused = collect(&root(), &RAYS, Platform::Gradescope, without_exam()).unwrap_err();
    let message = "the final exam is missing: add --exam-seed S";
    assert!(refused.to_string().starts_with(message), "{refused}");
}

/// The version of Rust that packages install. A newer one may only be entered here after CI has
/// passed with it.
const RUST: &str = "1.95.0";

#[test]
fn packages_install_one_fixed_version_of_rust() {
    let gradescope = collect(&root(), &RAYS, Platform::Gradescope, FINAL.clone()).unwrap();
    let github = collect(&root(), &RAYS, Platform::Github, without_exam()).unwrap();
    let setup = gradescope.text("setup.sh").unwrap();
    assert!(setup.contains(&format!("--default-toolchain {RUST}\n")));
    let workflow = github.text(".github/workflows/grade.yml").unwrap();
    assert!(workflow.contains(&format!("rustup toolchain install {RUST} ")));
    let manifest = std::fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let minimum = manifest.split("rust-version = \"").nth(1).unwrap();
    let numbers = |version: &str| -> Vec<u32> {
        let parts = version.split(['.', '"']);
        parts.map_while(|part| part.parse().ok()).collect()
    };
    assert!(numbers(RUST) >= numbers(minimum), "{minimum:.10}");
}
