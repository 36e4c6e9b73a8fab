//! Checks the package for Gradescope, which is a zip file.

use std::path::Path;

use judging::exam_file::{self, ExamFile};

use crate::doctor::package::{EXAM, GRADE, POLICY, PackageContents, SCRIPTS, policy_problem};
use crate::handed_out::HandedOut;
use crate::inputs::exam_source::PRACTICE_ID;

/// The folders that the grader and the solution are built from.
const REQUIRED_FOLDERS: [&str; 4] = [
    "pathtracing/grader/src/",
    "pathtracing/student/framework/src/",
    "pathtracing/reference/src/",
    "pathtracing/reference/substitution/",
];
/// The folder that contains the crates, so that nothing has to be downloaded.
const CRATE_CACHE: &str = "pathtracing/crates/registry/cache/";
/// The index of these crates. Cargo cannot find them without it.
const CRATE_INDEX: &str = "pathtracing/crates/registry/index/";
/// Part of the path of a crate that Cargo only downloads on Linux.
const LINUX_ONLY_CRATE: &str = "/landlock-";

/// Options and commands that are followed by the name of a Rust toolchain.
const INSTALLERS: [&str; 2] = ["--default-toolchain ", "toolchain install "];

/// Returns whether a script installs a toolchain without a fixed version, such as `stable`.
fn installs_floating(script: &[u8], installer: &str) -> bool {
    let script = String::from_utf8_lossy(script);
    let mut toolchains = script.split(installer).skip(1);
    toolchains.any(|toolchain| !toolchain.starts_with(|c: char| c.is_ascii_digit()))
}

impl PackageContents {
    /// Returns a message for each problem that Gradescope would have with the package.
    pub(super) fn problems(&self, handed_out: &HandedOut) -> Vec<String> {
        let mut problems = self.damage_problems();
        problems.extend(SCRIPTS.iter().flat_map(|name| self.script_problems(name)));
        // As long as Gradescope cannot run these scripts, other problems don't matter.
        if problems.is_empty() {
            problems.extend(self.script_problems(GRADE));
            problems.extend(self.exam_and_policy_problems(handed_out));
            problems.extend(self.build_input_problems());
        }
        problems
    }

    /// Returns a message for each problem with the files that the grader is built from.
    fn build_input_problems(&self) -> Vec<String> {
        let mut problems = self.empty_folder_problems(&REQUIRED_FOLDERS, "gradescope");
        let is_for_linux =
            |name: &String| name.starts_with(CRATE_CACHE) && name.contains(LINUX_ONLY_CRATE);
        match [CRATE_CACHE, CRATE_INDEX].into_iter().find(|part| !self.has_files_in(part)) {
            Some(empty) => problems.push(format!(
                "{empty} is empty, so the grader cannot be built without network access: create the package on a machine where `cargo build` has run"
            )),
            None if !self.permissions.keys().any(is_for_linux) => problems.push(format!(
                "{CRATE_CACHE} lacks the crates that only Linux needs, and Gradescope runs on Linux: create the package on Linux"
            )),
            None => {}
        }
        problems
    }

    fn script_problems(&self, name: &'static str) -> Vec<String> {
        let Some(text) = self.inspected.get(name) else {
            let below = self
                .permissions
                .keys()
                .find(|path| path.ends_with(&format!("/{name}")));
            return vec![match below {
                Some(path) => format!(
                    "{name} is at {path}, but Gradescope looks for it at the root of the zip: zip \
                     the contents of the folder, not the folder itself"
                ),
                None if name == GRADE => {
                    format!("{name} is missing: `cargo author package gradescope` creates it")
                }
                None => format!(
                    "{name} is missing from the root of the zip, where Gradescope looks for it"
                ),
            }];
        };
        let is_floating = INSTALLERS
            .iter()
            .any(|installer| installs_floating(text, installer));
        let is_executable = |mode: u32| mode & 0o111 != 0;
        let mode = self.permissions.get(name).copied();
        let faults = [
            (
                !text.starts_with(b"#!"),
                "does not begin with #!, so it cannot be run: add a first line, such as \
                 #!/usr/bin/env bash",
            ),
            (
                is_floating,
                "installs the latest Rust version, so scores may differ between images: pin a \
                 version, such as 1.95.0",
            ),
            (
                text.contains(&b'\r'),
                "has Windows line endings, which bash can't handle: pack it on a different system, or with \
                 `cargo author package`",
            ),
            (
                mode.is_some_and(|mode| !is_executable(mode)),
                "is not executable: run `chmod +x` on it before packing",
            ),
        ];
        let faults = faults.into_iter().filter(|(is_there, _)| *is_there);
        faults.map(|(_, fault)| format!("{name} {fault}")).collect()
    }

    fn exam_and_policy_problems(&self, handed_out: &HandedOut) -> Vec<String> {
        let (exam, policy) = match (self.inspected.get(EXAM), self.inspected.get(POLICY)) {
            (Some(exam), Some(policy)) => (exam, policy),
            (exam, _) => {
                let missing = if exam.is_none() { EXAM } else { POLICY };
                return vec![format!(
                    "{missing} is missing: `cargo author package gradescope` creates it"
                )];
            }
        };
        let exam = match exam_file::parse(Path::new(EXAM), exam, handed_out.assignment) {
            Ok(ExamFile { exam, .. }) => exam,
            Err(error) => return vec![error.to_string()],
        };
        let mut problems = Vec::new();
        if exam.id == PRACTICE_ID {
            problems.push(
                "the package runs the practice exam, whose answers students already have: choose a \
                 different exam with --exam-seed"
                    .to_owned(),
            );
        }
        problems.extend(policy_problem(policy, &exam));
        problems
    }
}
