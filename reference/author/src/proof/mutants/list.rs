//! The list of all mutants, `reference/mutants/list.json`: as cargo-mutants makes them, and as it is
//! committed for where that is not installed.

use grader::given_files::{TASK_FILES, TaskFile};
use serde::{Deserialize, Serialize};

use crate::generated_file::GeneratedFile;
use crate::proof::mutants::span::SourceSpan;
use crate::proof::sources::Sources;

/// Where the list stands, from the workspace's root.
pub const PATH: &str = "reference/mutants/list.json";

/// One small change to the reference.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mutant {
    /// The file, and what is changed in which function. Lines are not part of it: it stays while
    /// the function does. Where one function has several alike, they are numbered as they stand.
    pub name: String,
    /// What is replaced.
    pub span: SourceSpan,
    /// By what.
    pub now: String,
}

/// The mutants of one of the five files.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileMutants {
    /// Its name.
    pub file: String,
    /// The text that the spans are meant for: the first digits of its BLAKE2b hash, as `b2sum` prints it.
    pub blake2b: String,
    /// As they stand in it.
    pub mutants: Vec<Mutant>,
}

/// All mutants.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MutantList {
    /// The program that made them, and its version.
    pub made_by: String,
    /// In lecture order.
    pub files: Vec<FileMutants>,
}

/// The list is of another reference than the present one.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{PATH} does not fit reference/src/{file}, which has changed since: install cargo-mutants \
     (`cargo install cargo-mutants --locked`) and run `cargo author mutants`"
)]
pub struct OutdatedListError {
    /// The file that the list does not fit.
    pub file: String,
}

/// A mutant before it has a name that no other has.
#[derive(Clone, Debug)]
pub struct UnnamedMutant {
    /// What is changed in which function.
    pub what: String,
    /// What is replaced.
    pub span: SourceSpan,
    /// By what.
    pub now: String,
}

impl FileMutants {
    /// The mutants of a file with this text, put in order and named.
    pub fn new(file: &str, text: &str, mut unnamed: Vec<UnnamedMutant>) -> Self {
        unnamed.sort_by(|a, b| (a.span, &a.what).cmp(&(b.span, &b.what)));
        let alike = |others: &[UnnamedMutant], what: &str| {
            let alike = others.iter().filter(|other| other.what == what);
            alike.count()
        };
        let name = |place: usize| {
            let what = &unnamed[place].what;
            match alike(&unnamed, what) {
                1 => format!("{file}: {what}"),
                all => {
                    let number = 1 + alike(&unnamed[..place], what);
                    format!("{file}: {what}, {number} of {all}")
                }
            }
        };
        let mutants = unnamed.iter().enumerate().map(|(place, mutant)| Mutant {
            name: name(place),
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
    blake2b_simd::blake2b(text.as_bytes()).to_hex()[..16].to_owned()
}

impl MutantList {
    /// Every mutant with the reference that has it, by name.
    pub fn solutions(
        &self,
        reference: &Sources,
    ) -> Result<Vec<(&Mutant, Sources)>, OutdatedListError> {
        let mut solutions = Vec::new();
        for TaskFile { name: file, .. } in TASK_FILES {
            let no_fit = || OutdatedListError {
                file: file.to_owned(),
            };
            let text = reference.text(file).unwrap_or_default();
            let of_file = self.files.iter().find(|of_file| of_file.file == file);
            let of_file = of_file.filter(|of_file| of_file.blake2b == hash(text));
            for mutant in &of_file.ok_or_else(no_fit)?.mutants {
                let text = mutant.span.replace(text, &mutant.now).ok_or_else(no_fit)?;
                solutions.push((mutant, reference.clone().with_file(file, text)));
            }
        }
        solutions.sort_by_key(|(mutant, _)| &mutant.name);
        Ok(solutions)
    }

    /// The file that holds it: a line for each mutant, so that changes are easy to read.
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
    serde_json::to_string(value).expect("texts and numbers can be written")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn reference() -> Sources {
        Sources::reference(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
            .expect("the reference is there")
    }

    /// One mutant in each file: the first character becomes another.
    fn list(reference: &Sources) -> MutantList {
        let of_file = |file: TaskFile| {
            let text = reference.text(file.name).unwrap_or_default();
            FileMutants::new(file.name, text, vec![unnamed("spoil", "1:1-1:2")])
        };
        MutantList {
            made_by: "hand".to_owned(),
            files: TASK_FILES.into_iter().map(of_file).collect(),
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
        for (mutant, sources) in list.solutions(&reference).expect("it fits") {
            for TaskFile { name, .. } in TASK_FILES {
                let text = reference.text(name).unwrap_or_default();
                let wanted = match mutant.name.starts_with(name) {
                    true => format!("#{}", &text[1..]),
                    false => text.to_owned(),
                };
                assert_eq!(sources.text(name), Some(wanted.as_str()));
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
        let error = list.solutions(&later).expect_err("a line was added");
        assert_eq!(error.file, "sphere.rs");
        let said = error.to_string();
        assert!(said.contains("install cargo-mutants"), "{said}");
        assert!(said.contains("run `cargo author mutants`"), "{said}");
    }

    #[test]
    fn rejects_a_list_without_one_of_the_files() {
        let mut list = list(&reference());
        list.files.remove(1);
        let error = list.solutions(&reference()).expect_err("it is not whole");
        assert_eq!(error.file, "triangle.rs");
    }

    #[test]
    fn a_written_list_is_read_back() {
        let list = list(&reference());
        let again: MutantList =
            serde_json::from_str(&list.generated_file().contents).expect("it is JSON");
        assert_eq!(again, list);
    }
}
