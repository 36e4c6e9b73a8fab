//! The package that is a zip: Gradescope's.

use std::path::Path;

use crate::doctor::package_contents::{
    EXAM, GRADE, POLICY, PackageContents, SCRIPTS, policy_problem,
};
use crate::exam_file::{self, ExamFile};

/// What the grader is built from, and the solution: folders that are not empty.
const REQUIRED_FOLDERS: [&str; 4] = [
    "pathtracing/grader/src/",
    "pathtracing/student/framework/src/",
    "pathtracing/reference/src/",
    "pathtracing/reference/carried/",
];
/// The crates, so that nothing is fetched.
const CRATE_CACHE: &str = "pathtracing/crates/registry/cache/";
/// What is told of them, without which cargo does not look for them.
const CRATE_INDEX: &str = "pathtracing/crates/registry/index/";
/// One that only Linux needs, and that no other system has fetched.
const LINUX_ONLY_CRATE: &str = "/landlock-";

impl PackageContents {
    /// What is wrong, as Gradescope will see it.
    pub(super) fn problems(&self) -> Vec<String> {
        let mut complaints = self.damage_problems();
        complaints.extend(SCRIPTS.iter().flat_map(|name| self.script_problems(name)));
        // Of a zip that Gradescope can not even start, the rest says nothing.
        if complaints.is_empty() {
            complaints.extend(self.script_problems(GRADE));
            complaints.extend(self.exam_and_policy_problems());
            complaints.extend(self.build_input_problems());
        }
        complaints
    }

    /// What the grader is built from.
    fn build_input_problems(&self) -> Vec<String> {
        let mut complaints = self.empty_folder_problems(&REQUIRED_FOLDERS, "gradescope");
        let is_for_linux =
            |name: &String| name.starts_with(CRATE_CACHE) && name.contains(LINUX_ONLY_CRATE);
        match [CRATE_CACHE, CRATE_INDEX].into_iter().find(|part| !self.has_files_in(part)) {
            Some(empty) => complaints.push(format!(
                "{empty} is empty: the grader could not be built without a network; write the package where `cargo build` has run"
            )),
            None if !self.permissions.keys().any(is_for_linux) => complaints.push(format!(
                "{CRATE_CACHE} lacks what only Linux needs, on which Gradescope runs: write the package on Linux"
            )),
            None => {}
        }
        complaints
    }

    fn script_problems(&self, name: &'static str) -> Vec<String> {
        let Some(text) = self.inspected.get(name) else {
            let below = self
                .permissions
                .keys()
                .find(|path| path.ends_with(&format!("/{name}")));
            return vec![match below {
                Some(path) => format!(
                    "{name} is at {path}: Gradescope looks at the root of the zip; zip what is in the folder, not the folder"
                ),
                None if name == GRADE => {
                    format!("there is no {name}: `cargo author package gradescope` writes it")
                }
                None => format!("there is no {name} at the root of the zip: Gradescope starts it"),
            }];
        };
        let is_executable = |mode: u32| mode & 0o111 != 0;
        let mode = self.permissions.get(name).copied();
        let faults = [
            (
                !text.starts_with(b"#!"),
                "does not begin with #!, so nothing runs it",
            ),
            (
                text.contains(&b'\r'),
                "has the line ends of Windows, on which bash fails: pack it elsewhere, or with `cargo author package`",
            ),
            (
                mode.is_some_and(|mode| !is_executable(mode)),
                "is not executable: `chmod +x` it before it is packed",
            ),
        ];
        let faults = faults.into_iter().filter(|(is_there, _)| *is_there);
        faults.map(|(_, fault)| format!("{name} {fault}")).collect()
    }

    fn exam_and_policy_problems(&self) -> Vec<String> {
        let (exam, policy) = match (self.inspected.get(EXAM), self.inspected.get(POLICY)) {
            (Some(exam), Some(policy)) => (exam, policy),
            (exam, _) => {
                let missing = if exam.is_none() { EXAM } else { POLICY };
                return vec![format!(
                    "there is no {missing}: `cargo author package gradescope` writes it"
                )];
            }
        };
        let exam = match exam_file::parse(Path::new(EXAM), exam) {
            Ok(ExamFile { exam, .. }) => exam,
            Err(error) => return vec![error.to_string()],
        };
        let mut complaints = Vec::new();
        if exam.id == "practice" {
            complaints.push(
                "it asks the practice exam, which students have with all its keys: name another with --exam-seed".to_owned(),
            );
        }
        complaints.extend(policy_problem(policy, &exam));
        complaints
    }
}
