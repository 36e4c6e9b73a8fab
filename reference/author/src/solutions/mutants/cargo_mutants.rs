//! Runs `cargo mutants`, <https://mutants.rs>, if it is installed. Only its list of mutants is
//! used: the exam decides whether a mutant is caught, not unit tests.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::process::{Command, Output};

use grader::handed_out::{HandedOut, TaskFile};
use serde::Deserialize;

use crate::solutions::mutants::list::{self, FileMutants, MutantList, UnnamedMutant};
use crate::solutions::mutants::span::{SourcePosition, SourceSpan};
use crate::solutions::sources::Sources;

/// The reason why the list of an installed cargo-mutants cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CargoMutantsError {
    /// Cargo cannot be started.
    #[error("cannot run cargo: {0}")]
    Cargo(#[from] io::Error),
    /// cargo-mutants failed.
    #[error("`cargo mutants --list` failed: {0}")]
    Failed(String),
    /// The list is not in the format of version 27.1.
    #[error(
        "cannot read the list of {made_by} ({reason}): install the version named in {path}",
        path = list::PATH
    )]
    UnknownFormat {
        /// The name and version of the program that made the list.
        made_by: String,
        /// The part of the list that does not have the expected format.
        reason: String,
    },
}

/// A mutant in the list of cargo-mutants.
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

/// Returns the name and version of cargo-mutants, or `None` if it is not installed.
pub fn version() -> Option<String> {
    let output = Command::new("cargo")
        .args(["mutants", "--version"])
        .output();
    let output = output.ok().filter(|output| output.status.success())?;
    let version = String::from_utf8(output.stdout).ok()?;
    Some(version.trim().to_owned())
}

/// Lists the mutants of the reference in the workspace at `root`.
pub fn list(
    made_by: &str,
    handed_out: &HandedOut,
    root: &Path,
    reference: &Sources,
) -> Result<MutantList, CargoMutantsError> {
    let output = run(handed_out, root)?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr);
        return Err(CargoMutantsError::Failed(message.trim().to_owned()));
    }
    parse_list(made_by, &output.stdout, handed_out, reference).map_err(|reason| {
        CargoMutantsError::UnknownFormat {
            made_by: made_by.to_owned(),
            reason,
        }
    })
}

fn run(handed_out: &HandedOut, root: &Path) -> io::Result<Output> {
    let mut cargo = Command::new("cargo");
    cargo.args(["mutants", "--list", "--json", "--no-config"]);
    cargo.args(["--package", "reference", "--dir"]).arg(root);
    for file in handed_out.files {
        cargo.args(["--file", &path(handed_out, file)]);
    }
    cargo.output()
}

/// Returns the path of a file as it is written in the list.
fn path(handed_out: &HandedOut, file: &TaskFile) -> String {
    format!("{}/{}", handed_out.reference, file.name)
}

fn parse_list(
    made_by: &str,
    json: &[u8],
    handed_out: &HandedOut,
    reference: &Sources,
) -> Result<MutantList, String> {
    let all: Vec<ListedMutant> = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    let mut by_file: BTreeMap<String, Vec<UnnamedMutant>> = BTreeMap::new();
    for listed in all {
        let file = listed.file.clone();
        by_file
            .entry(file)
            .or_default()
            .push(listed.into_unnamed()?);
    }
    let files = handed_out.files.iter().map(|file| {
        let text = reference.text(file.name).unwrap_or_default();
        match by_file.remove(&path(handed_out, file)) {
            Some(unnamed) => Ok(FileMutants::new(file.name, text, unnamed)),
            None => Err(format!("it has no mutants of {}", file.name)),
        }
    });
    Ok(MutantList {
        made_by: made_by.to_owned(),
        files: files.collect::<Result<_, String>>()?,
    })
}

impl ListedMutant {
    /// Removes the position from the name.
    fn into_unnamed(self) -> Result<UnnamedMutant, String> {
        let ListedSpan { start, end } = self.span;
        let position = format!("{}:{}:{}: ", self.file, start.line, start.column);
        match self.name.strip_prefix(&position) {
            Some(what) => Ok(UnnamedMutant {
                what: what.to_owned(),
                span: SourceSpan { start, end },
                now: self.replacement,
            }),
            None => Err(format!("`{}` does not begin with its position", self.name)),
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
        serde_json::from_str(&json).expect("the format is correct")
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
            .expect_err("the name does not begin with its position");
    }
}
