//! Generates the starter: the reference's files without the solutions.
//!
//! Solutions are marked with comments. The files are read line by line, without parsing any Rust:
//!
//! ```text
//! // solution          starts a region whose code is dropped
//! // starter: todo!()  this line is handed out instead, uncommented
//! // end solution      ends the region
//! ```
//!
//! `// starter:` also works outside a region. All other lines outside regions are copied unchanged.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grader::handed_out::HandedOut;

use crate::generated_file::GeneratedFile;

/// The reason why the starter cannot be generated.
#[derive(Debug, thiserror::Error)]
pub enum StarterError {
    /// A file of the reference cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Unreadable {
        /// The path of the file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A mark in a file of the reference is wrong.
    #[error("{}:{line}: {error}", path.display())]
    Mark {
        /// The path of the file.
        path: PathBuf,
        /// The number of the line with the mark, counted from 1.
        line: usize,
        /// The problem on that line.
        error: MarkError,
    },
}

/// A problem with a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MarkError {
    /// A region starts inside another.
    #[error("`// solution` inside a solution: end the previous one with `// end solution` first")]
    Nested,
    /// An end mark is not in a region.
    #[error("this `// end solution` has no `// solution` above it")]
    NotStarted,
    /// A region is never ended.
    #[error("this `// solution` has no `// end solution`")]
    NotEnded,
    /// A region has no line for the starter.
    #[error(
        "this `// solution` has no `// starter:` line: add one with the code that students get"
    )]
    NoStarterLine,
}

/// Generates every file of an assignment's starter from its reference in the workspace at `root`:
/// for the folder that students edit, and for the copy that is embedded in the grader.
pub fn generated_files(
    root: &Path,
    handed_out: &HandedOut,
) -> Result<Vec<GeneratedFile>, StarterError> {
    let folders = [
        format!("{}/src", handed_out.student),
        handed_out.starter.to_owned(),
    ];
    let mut generated = Vec::new();
    let given = handed_out.given.iter().chain([&handed_out.main]);
    let given = given.map(|file| file.name);
    for file in handed_out.files.iter().map(|file| file.name).chain(given) {
        let path = root.join(handed_out.reference).join(file);
        let source = match fs::read_to_string(&path) {
            Ok(source) => source,
            Err(source) => return Err(StarterError::Unreadable { path, source }),
        };
        let starter =
            project(&source).map_err(|(line, error)| StarterError::Mark { path, line, error })?;
        for folder in &folders {
            generated.push(GeneratedFile::new(format!("{folder}/{file}"), &*starter));
        }
    }
    Ok(generated)
}

/// The role of a line of a marked file.
enum LineKind<'a> {
    Begin,
    End,
    /// A line of the starter: its indentation and its text after the mark.
    Starter(&'a str, &'a str),
    Other,
}

fn classify(line: &str) -> LineKind<'_> {
    let text = line.trim_start();
    let indentation = &line[..line.len() - text.len()];
    match text {
        "// solution" => LineKind::Begin,
        "// end solution" => LineKind::End,
        "// starter:" => LineKind::Starter("", ""),
        _ => text
            .strip_prefix("// starter: ")
            .map_or(LineKind::Other, |rest| LineKind::Starter(indentation, rest)),
    }
}

/// Returns the starter's text for one marked file. An error comes with its line, counted from 1.
fn project(source: &str) -> Result<String, (usize, MarkError)> {
    /// An open region: its first line, and whether it has a line for the starter.
    struct Region {
        begin: usize,
        has_starter_line: bool,
    }

    let mut starter = String::with_capacity(source.len());
    let mut open: Option<Region> = None;
    for (number, line) in (1..).zip(source.lines()) {
        match (classify(line), &mut open) {
            (LineKind::Begin, None) => {
                open = Some(Region {
                    begin: number,
                    has_starter_line: false,
                });
            }
            (LineKind::Begin, Some(_)) => return Err((number, MarkError::Nested)),
            (LineKind::End, None) => return Err((number, MarkError::NotStarted)),
            (LineKind::End, Some(region)) if !region.has_starter_line => {
                return Err((region.begin, MarkError::NoStarterLine));
            }
            (LineKind::End, Some(_)) => open = None,
            (LineKind::Starter(indentation, rest), region) => {
                starter.extend([indentation, rest, "\n"]);
                if let Some(region) = region {
                    region.has_starter_line = true;
                }
            }
            (LineKind::Other, None) => starter.extend([line, "\n"]),
            (LineKind::Other, Some(_)) => {}
        }
    }
    match open {
        Some(region) => Err((region.begin, MarkError::NotEnded)),
        None => Ok(starter),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_a_solution_by_its_starter_lines() {
        let source = "fn f() {\n    // solution\n    // starter: todo!(\"1\")\n    // Why.\n    \
                      let x = 1;\n    // end solution\n}\n";
        assert_eq!(project(source).unwrap(), "fn f() {\n    todo!(\"1\")\n}\n");
    }

    #[test]
    fn starter_lines_work_outside_a_solution_and_may_be_empty() {
        let source = "// starter: #[ignore]\n#[test]\n// starter:\nfn f() {}\n";
        assert_eq!(
            project(source).unwrap(),
            "#[ignore]\n#[test]\n\nfn f() {}\n"
        );
    }

    #[test]
    fn marks_within_a_sentence_are_ignored() {
        let source = "// solution of the equation\n/// starter: no\n";
        assert_eq!(project(source).unwrap(), source);
    }

    #[test]
    fn reports_each_mark_error_with_its_line() {
        let cases = [
            ("\n// solution\n// starter: x\n", (2, MarkError::NotEnded)),
            ("\n// end solution\n", (2, MarkError::NotStarted)),
            (
                "// solution\n// starter:\n// solution\n",
                (3, MarkError::Nested),
            ),
            (
                "x\n// solution\ny\n// end solution\n",
                (2, MarkError::NoStarterLine),
            ),
        ];
        for (source, slip) in cases {
            assert_eq!(project(source), Err(slip), "{source:?}");
        }
    }
}
