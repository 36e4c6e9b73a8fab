//! The program that makes mutants, <https://mutants.rs>, where it is installed. Only its list is
//! wanted: what becomes of a mutant, the exam says, and no unit test.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::process::{Command, Output};

use grader::given_files::{TASK_FILES, TaskFile};
use serde::Deserialize;

use crate::proof::mutants::list::{self, FileMutants, MutantList, UnnamedMutant};
use crate::proof::mutants::span::{SourcePosition, SourceSpan};
use crate::proof::sources::Sources;

/// There is no list, though there is cargo-mutants.
#[derive(Debug, thiserror::Error)]
pub enum CargoMutantsError {
    /// Cargo can not be started.
    #[error("can not run cargo: {0}")]
    Cargo(#[from] io::Error),
    /// It did not end well.
    #[error("`cargo mutants --list` failed: {0}")]
    Failed(String),
    /// Its list has another form than that of 27.1.
    #[error(
        "can not read the list of {made_by} ({why}): install the version that {path} names",
        path = list::PATH
    )]
    UnknownFormat {
        /// The program and its version.
        made_by: String,
        /// What is strange.
        why: String,
    },
}

/// A mutant, as it is listed.
#[derive(Debug, Deserialize)]
struct ListedMutant {
    name: String,
    file: String,
    span: ListedSpan,
    replacement: String,
}

#[derive(Debug, Deserialize)]
struct ListedSpan {
    start: SourcePosition,
    end: SourcePosition,
}

/// The program and its version, if it is installed.
pub fn version() -> Option<String> {
    let output = Command::new("cargo")
        .args(["mutants", "--version"])
        .output();
    let output = output.ok().filter(|output| output.status.success())?;
    let version = String::from_utf8(output.stdout).ok()?;
    Some(version.trim().to_owned())
}

/// What it makes of the reference of the workspace at `root`.
pub fn list(
    made_by: &str,
    root: &Path,
    reference: &Sources,
) -> Result<MutantList, CargoMutantsError> {
    let output = run(root)?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(CargoMutantsError::Failed(said.trim().to_owned()));
    }
    parse_list(made_by, &output.stdout, reference).map_err(|why| CargoMutantsError::UnknownFormat {
        made_by: made_by.to_owned(),
        why,
    })
}

fn run(root: &Path) -> io::Result<Output> {
    let mut cargo = Command::new("cargo");
    cargo.args(["mutants", "--list", "--json", "--no-config"]);
    cargo.args(["--package", "reference", "--dir"]).arg(root);
    for file in TASK_FILES {
        cargo.args(["--file", &path(file)]);
    }
    cargo.output()
}

/// As the list calls it.
fn path(file: TaskFile) -> String {
    format!("reference/src/{}", file.name)
}

fn parse_list(made_by: &str, json: &[u8], reference: &Sources) -> Result<MutantList, String> {
    let all: Vec<ListedMutant> = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    let mut by_file: BTreeMap<String, Vec<UnnamedMutant>> = BTreeMap::new();
    for listed in all {
        let file = listed.file.clone();
        by_file
            .entry(file)
            .or_default()
            .push(listed.into_unnamed()?);
    }
    let files = TASK_FILES.into_iter().map(|file| {
        let text = reference.text(file.name).unwrap_or_default();
        match by_file.remove(&path(file)) {
            Some(unnamed) => Ok(FileMutants::new(file.name, text, unnamed)),
            None => Err(format!("there is none of {}", file.name)),
        }
    });
    Ok(MutantList {
        made_by: made_by.to_owned(),
        files: files.collect::<Result<_, String>>()?,
    })
}

impl ListedMutant {
    /// Without the place in its name.
    fn into_unnamed(self) -> Result<UnnamedMutant, String> {
        let ListedSpan { start, end } = self.span;
        let place = format!("{}:{}:{}: ", self.file, start.line, start.column);
        match self.name.strip_prefix(&place) {
            Some(what) => Ok(UnnamedMutant {
                what: what.to_owned(),
                span: SourceSpan { start, end },
                now: self.replacement,
            }),
            None => Err(format!("`{}` does not begin with its place", self.name)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(name: &str) -> ListedMutant {
        let json = format!(
            r#"{{"name": "{name}", "file": "reference/src/bvh.rs", "replacement": "-", "genre": "x",
                "span": {{"start": {{"line": 7, "column": 9}}, "end": {{"line": 7, "column": 10}}}}}}"#
        );
        serde_json::from_str(&json).expect("it has the form")
    }

    #[test]
    fn removes_the_position_from_a_name() {
        let unnamed =
            listed("reference/src/bvh.rs:7:9: replace + with - in Bvh::hit").into_unnamed();
        let unnamed = unnamed.expect("a mutant");
        assert_eq!(unnamed.what, "replace + with - in Bvh::hit");
        assert_eq!(unnamed.span.to_string(), "7:9-7:10");
    }

    #[test]
    fn rejects_a_name_without_a_position() {
        listed("+ to - at 7:9")
            .into_unnamed()
            .expect_err("no place in front");
    }
}
