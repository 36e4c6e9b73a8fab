//! The list of all mutants, `reference/mutants/list.json`. It is committed, so that the mutants can
//! be graded without installing cargo-mutants.

use grader::handed_out::{HandedOut, TaskFile};
use judging::content_hash::file_hash;
use serde::{Deserialize, Serialize};

use crate::generated_file::GeneratedFile;
use crate::solutions::mutants::span::SourceSpan;
use crate::solutions::sources::Sources;

/// The list's file, relative to the workspace's root.
pub const PATH: &str = "reference/mutants/list.json";

/// A small mechanical change to the reference.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mutant {
    /// The name: the file, the change, and the function. The name has no line number, so that it
    /// does not change while the function stays the same. Identical changes in one function are
    /// numbered in order.
    pub name: String,
    /// The span that is replaced.
    pub span: SourceSpan,
    /// The text that replaces the span.
    pub now: String,
}

/// The mutants of one task file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileMutants {
    /// The file's name.
    pub file: String,
    /// The version of the file that the spans refer to: the first digits of its BLAKE2b hash, as
    /// printed by `b2sum`.
    pub blake2b: String,
    /// The mutants, in the order of the file.
    pub mutants: Vec<Mutant>,
}

/// All mutants.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MutantList {
    /// The program that generated the mutants, and its version.
    pub made_by: String,
    /// The mutants of each file, in lecture order.
    pub files: Vec<FileMutants>,
}

/// An error returned if the list was generated before the reference changed.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{PATH} is out of date, because reference/src/{file} has changed: install cargo-mutants \
     (`cargo install cargo-mutants --locked`) and run `cargo author mutants`"
)]
pub struct OutdatedListError {
    /// The file that has changed.
    pub file: String,
}

/// A mutant without a unique name.
#[derive(Clone, Debug)]
pub struct UnnamedMutant {
    /// A description of the change, and the function that it is in.
    pub what: String,
    /// The span that is replaced.
    pub span: SourceSpan,
    /// The text that replaces the span.
    pub now: String,
}

impl FileMutants {
    /// Sorts and names the mutants of the file `file`, whose contents are `text`.
    pub fn new(file: &str, text: &str, mut unnamed: Vec<UnnamedMutant>) -> Self {
        unnamed.sort_by(|a, b| (a.span, &a.what).cmp(&(b.span, &b.what)));
        let count = |others: &[UnnamedMutant], what: &str| {
            let identical = others.iter().filter(|other| other.what == what);
            identical.count()
        };
        let name = |index: usize| {
            let what = &unnamed[index].what;
            match count(&unnamed, what) {
                1 => format!("{file}: {what}"),
                all => {
                    let number = 1 + count(&unnamed[..index], what);
                    format!("{file}: {what}, {number} of {all}")
                }
            }
        };
        let mutants = unnamed.iter().enumerate().map(|(index, mutant)| Mutant {
            name: name(index),
            span: mutant.span,
            now: mutant.now.clone(),
        });
        FileMutants {
            file: file.to_owned(),
            blake2b: hash(text),
            mutants: mutants.collect(),
        }
    }
}

fn hash(text: &str) -> String {
    file_hash(text.as_bytes())[..16].to_owned()
}

impl MutantList {
    /// Returns every mutant with its sources, sorted by name.
    pub fn solutions(
        &self,
        handed_out: &HandedOut,
        reference: &Sources,
    ) -> Result<Vec<(&Mutant, Sources)>, OutdatedListError> {
        let mut solutions = Vec::new();
        for &TaskFile { name: file, .. } in handed_out.files {
            let outdated = || OutdatedListError {
                file: file.to_owned(),
            };
            let text = reference.text(file).unwrap_or_default();
            let of_file = self.files.iter().find(|of_file| of_file.file == file);
            let of_file = of_file.filter(|of_file| of_file.blake2b == hash(text));
            for mutant in &of_file.ok_or_else(outdated)?.mutants {
                let text = mutant
                    .span
                    .replace(text, &mutant.now)
                    .ok_or_else(outdated)?;
                solutions.push((mutant, reference.clone().with_file(file, text)));
            }
        }
        solutions.sort_by_key(|(mutant, _)| &mutant.name);
        Ok(solutions)
    }

    /// Returns the list's file. Every mutant is on a separate line, so that diffs are readable.
    pub fn generated_file(&self) -> GeneratedFile {
        let files = self.files.iter().map(|of_file| {
            let mutants: Vec<String> = of_file.mutants.iter().map(to_json).collect();
            format!(
                "    {{\"file\": {}, \"blake2b\": {}, \"mutants\": [\n      {}\n    ]}}",
                to_json(&of_file.file),
                to_json(&of_file.blake2b),
                mutants.join(",\n      "),
            )
        });
        let files: Vec<String> = files.collect();
        let text = format!(
            "{{\n  \"made_by\": {},\n  \"files\": [\n{}\n  ]\n}}\n",
            to_json(&self.made_by),
            files.join(",\n")
        );
        GeneratedFile::new(PATH, text)
    }
}

fn to_json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("strings and numbers can be serialised")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use grader::handed_out::RAYS;

    use super::*;

    fn reference() -> Sources {
        Sources::reference(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."), &RAYS)
            .expect("the reference can be read")
    }

    /// Returns a list with one mutant per file, which replaces the first character.
    fn list(reference: &Sources) -> MutantList {
        let of_file = |file: &TaskFile| {
            let text = reference.text(file.name).unwrap_or_default();
            FileMutants::new(file.name, text, vec![unnamed("replace", "1:1-1:2")])
        };
        MutantList {
            made_by: "hand".to_owned(),
            files: RAYS.files.iter().map(of_file).collect(),
        }
    }

    fn unnamed(what: &str, span: &str) -> UnnamedMutant {
        UnnamedMutant {
            what: what.to_owned(),
            span: span.to_owned().try_into().expect("a span"),
            now: "#".to_owned(),
        }
    }

    #[test]
    fn identical_mutants_are_numbered_in_order() {
        let unnamed = vec![
            unnamed("replace + with -", "7:2-7:3"),
            unnamed("delete !", "8:1-8:2"),
            unnamed("replace + with -", "6:9-6:10"),
        ];
        let of_file = FileMutants::new("a.rs", "", unnamed);
        let names: Vec<String> = of_file
            .mutants
            .iter()
            .map(|mutant| format!("{} {}", mutant.span, mutant.name))
            .collect();
        assert_eq!(
            names,
            [
                "6:9-6:10 a.rs: replace + with -, 1 of 2",
                "7:2-7:3 a.rs: replace + with -, 2 of 2",
                "8:1-8:2 a.rs: delete !",
            ]
        );
    }

    #[test]
    fn each_mutant_changes_its_own_file_only() {
        let reference = reference();
        let list = list(&reference);
        for (mutant, sources) in list
            .solutions(&RAYS, &reference)
            .expect("the list is up to date")
        {
            for &TaskFile { name, .. } in RAYS.files {
                let text = reference.text(name).unwrap_or_default();
                let expected = if mutant.name.starts_with(name) {
                    format!("#{}", &text[1..])
                } else {
                    text.to_owned()
                };
                assert_eq!(sources.text(name), Some(expected.as_str()));
            }
        }
    }

    #[test]
    fn rejects_a_list_of_an_older_reference() {
        let list = list(&reference());
        let text = reference()
            .text("sphere.rs")
            .map(|text| format!("{text}\n"));
        let later = reference().with_file("sphere.rs", text.unwrap_or_default());
        let error = list.solutions(&RAYS, &later).expect_err("a line was added");
        assert_eq!(error.file, "sphere.rs");
        let message = error.to_string();
        assert!(message.contains("install cargo-mutants"), "{message}");
        assert!(message.contains("run `cargo author mutants`"), "{message}");
    }

    #[test]
    fn rejects_a_list_without_one_of_the_files() {
        let mut list = list(&reference());
        list.files.remove(1);
        let error = list
            .solutions(&RAYS, &reference())
            .expect_err("a file is missing");
        assert_eq!(error.file, "triangle.rs");
    }

    #[test]
    fn a_written_list_is_read_back() {
        let list = list(&reference());
        let read: MutantList =
            serde_json::from_str(&list.generated_file().contents).expect("the list is JSON");
        assert_eq!(read, list);
    }
}
