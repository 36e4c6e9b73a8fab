//! Packages are complete, and packages that students can read contain no secrets.

use std::ffi::OsStr;
use std::sync::LazyLock;

use author::authoring;
use author::bundle::archive;
use author::bundle::secrets::Secrets;
use author::light::LightFiles;
use author::package::{CourseFiles, Platform, collect};
use grader::doctor::package::problems;
use grader::handed_out::RAYS;

use crate::harness::{BUNDLE, author_succeeds, root, text};

/// A course whose final exam is the practice exam with a different id.
static FINAL: LazyLock<CourseFiles> = LazyLock::new(|| {
    let exam = RAYS.practice_exam.replacen("\"practice\"", "\"final\"", 1);
    let exam = Some(exam);
    CourseFiles {
        exam,
        ..without_exam()
    }
});

fn without_exam() -> CourseFiles {
    CourseFiles::new(&authoring::RAYS, None, None, None, LightFiles::Solved).unwrap()
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
        let message = "so it must not contain a final exam";
        assert!(refused.to_string().contains(message), "{refused}");
    }
    let package = collect(&root(), &RAYS, Platform::Classroom50, without_exam()).unwrap();
    let unpacked = archive::unzip(&package.files["pathtracing.zip"]).unwrap();
    let secrets = Secrets::gather(&root(), &authoring::RAYS, LightFiles::Solved, &BUNDLE).unwrap();
    assert_eq!(secrets.search(&unpacked), []);
    let size: usize = package.files.values().map(Vec::len).sum();
    assert!(size < 10 << 20, "classroom50 takes 10 MiB: {size}");
}

#[test]
fn written_folders_are_complete() {
    let folder = tempfile::TempDir::new().unwrap();
    for platform in ["classroom50", "github"] {
        let out = folder.path().join(platform);
        let write = ["package", platform, "--out"].map(OsStr::new);
        author_succeeds(&[&write, &[out.as_os_str()][..]].concat());
        assert_eq!(problems(&out, &RAYS).unwrap(), [""; 0], "{platform}");
    }
}

#[test]
fn a_gradescope_package_needs_a_final_exam() {
    let refused = collect(&root(), &RAYS, Platform::Gradescope, without_exam()).unwrap_err();
    let message = "the final exam is missing: add --exam-seed S";
    assert!(refused.to_string().starts_with(message), "{refused}");
}

/// The version of Rust that packages install. Don't enter a newer version here until CI has passed
/// with it.
const RUST: &str = "1.95.0";

#[test]
fn packages_install_one_fixed_version_of_rust() {
    let gradescope = collect(&root(), &RAYS, Platform::Gradescope, FINAL.clone()).unwrap();
    let github = collect(&root(), &RAYS, Platform::Github, without_exam()).unwrap();
    let setup = gradescope.text("setup.sh").unwrap();
    assert!(setup.contains(&format!("--default-toolchain {RUST}\n")));
    let workflow = github.text(".github/workflows/grade.yml").unwrap();
    assert!(workflow.contains(&format!("rustup toolchain install {RUST} ")));
    let manifest = text("Cargo.toml");
    let minimum = manifest.split("rust-version = \"").nth(1).unwrap();
    let numbers = |version: &str| -> Vec<u32> {
        let parts = version.split(['.', '"']);
        parts.map_while(|part| part.parse().ok()).collect()
    };
    assert!(numbers(RUST) >= numbers(minimum), "{minimum:.10}");
}
