//! What must not be handed out, and the search for it.
//!
//! A secret is a line of code: of a solution, a variant, a mistake, a mutant, an oracle. It is found
//! however it is indented or spaced. Lines that students are given anyway are no secrets, and
//! neither are those that compute nothing, such as `use std::fs;` or a lonely brace.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grader::exam::Exam;
use grader::given_files::TASK_FILES;

use crate::bundle::Bundle;
use crate::proof::catalogue::{CatalogueError, mistakes};
use crate::proof::sources::{ReadError, Sources};

/// Files, and folders with all below them.
const SECRET_PATHS: [&str; 4] = [
    "reference/src",
    "reference/carried/bvh.rs",
    "reference/mutants",
    "reference/variants",
];
/// The same in double precision. Only its formulas are secret: whoever turns a ray into doubles
/// writes what stands there, line by line.
const ORACLE_FOLDER: &str = "reference/author/src/oracle";
/// Where given code stands that solutions may well repeat.
const GIVEN_FOLDERS: [&str; 2] = ["student/src/", "student/protocol/"];
/// Shorter lines say too little to be anybody's. Counted without white space.
const MIN_LENGTH: usize = 21;
/// The exam that may be seen.
const PRACTICE_ID: &str = "practice";

/// All lines that must stay here, with the place where each stands.
#[derive(Clone, Debug)]
pub struct Secrets {
    lines: HashMap<String, String>,
}

/// A secret that was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Leak {
    /// A line.
    Line {
        /// The bundle's file and line, from 1.
        found: String,
        /// Where the line is from.
        source: String,
    },
    /// An exam that is not the practice exam.
    Exam {
        /// The bundle's file.
        found: String,
    },
}

/// The secrets can not be read.
#[derive(Debug, thiserror::Error)]
pub enum SecretsError {
    /// A file or folder of this repository.
    #[error("can not read {}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// One of the five solved files.
    #[error(transparent)]
    Reference(#[from] ReadError),
    /// The catalogue of mistakes.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
}

impl Secrets {
    /// Those of the workspace at `root`, without what this bundle's students are given.
    pub fn gather(root: &Path, bundle: &Bundle) -> Result<Self, SecretsError> {
        let mut secrets = Secrets {
            lines: HashMap::new(),
        };
        secrets.read(root, ORACLE_FOLDER)?;
        secrets.lines.retain(|line, _| is_formula(line));
        for path in SECRET_PATHS {
            secrets.read(root, path)?;
        }
        let reference = Sources::reference(root)?;
        for mistake in mistakes(root)? {
            let wrong = mistake.apply(&reference)?;
            for file in TASK_FILES {
                let source = format!("the mistake {}, {}", mistake.id, file.name);
                secrets.add(&source, wrong.text(file.name).unwrap_or_default());
            }
        }
        let given = bundle
            .text_files()
            .filter(|(path, _)| GIVEN_FOLDERS.iter().any(|given| path.starts_with(given)));
        let given: HashSet<String> = given
            .flat_map(|(_, text)| text.lines().filter_map(normalize))
            .collect();
        secrets.lines.retain(|line, _| !given.contains(line));
        Ok(secrets)
    }

    fn read(&mut self, root: &Path, path: &str) -> Result<(), SecretsError> {
        let place = root.join(path);
        let at = |source| SecretsError::Io {
            path: place.clone(),
            source,
        };
        if place.is_dir() {
            for entry in fs::read_dir(&place).map_err(at)? {
                let name = entry.map_err(at)?.file_name();
                self.read(root, &format!("{path}/{}", name.to_string_lossy()))?;
            }
        } else if !path.ends_with(".md") {
            let text = fs::read_to_string(&place).map_err(at)?;
            self.add(path, &text);
        }
        Ok(())
    }

    fn add(&mut self, source: &str, text: &str) {
        for (number, line) in (1..).zip(text.lines()) {
            if let Some(line) = normalize(line) {
                let place = || format!("{source}:{number}");
                self.lines.entry(line).or_insert_with(place);
            }
        }
    }

    /// Every secret in the bundle.
    pub fn search(&self, bundle: &Bundle) -> Vec<Leak> {
        let lines = bundle.text_files().flat_map(|(path, text)| {
            let numbered = (1..).zip(text.lines());
            numbered.filter_map(move |(number, line)| {
                let source = self.lines.get(&normalize(line)?)?.clone();
                let found = format!("{path}:{number}");
                Some(Leak::Line { found, source })
            })
        });
        let exams = bundle.files.iter().filter_map(|(path, contents)| {
            let exam: Exam = serde_json::from_slice(contents).ok()?;
            let found = path.clone();
            (exam.id != PRACTICE_ID).then_some(Leak::Exam { found })
        });
        lines.chain(exams).collect()
    }
}

/// A line without its spacing, if it is one that computes something.
fn normalize(line: &str) -> Option<String> {
    let computes = is_formula(line) || line.contains('(');
    let is_told = ["//", "use ", "pub use ", "#["]
        .iter()
        .any(|start| line.trim_start().starts_with(start));
    let line: String = line.split_whitespace().collect();
    (computes && !is_told && line.len() >= MIN_LENGTH).then_some(line)
}

/// Whether there is arithmetic in the line.
fn is_formula(line: &str) -> bool {
    line.replace("->", "").contains(['+', '-', '*', '/'])
}

impl fmt::Display for Secrets {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} lines of solutions", self.lines.len())
    }
}

impl fmt::Display for Leak {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Leak::Line { found, source } => write!(f, "{found} is a line of {source}"),
            Leak::Exam { found } => write!(f, "{found} is an exam that is not for students"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{is_formula, normalize};

    #[test]
    fn spacing_does_not_hide_a_line() {
        let plain = normalize("let place = (pixel + offset) / film - 0.5;");
        assert!(plain.is_some());
        assert_eq!(normalize("\tlet place=(pixel+offset)/film -0.5;"), plain);
    }

    #[test]
    fn lines_that_compute_nothing_are_not_secret() {
        assert!(!is_formula("origin: ray.origin.as_dvec3(),"));
        for line in [
            "}",
            "use std::collections::BTreeMap;",
            "/// The surface normal there, of length one.",
            "Shape::Sphere { center, radius, .. } => {",
            "fn hit() -> Option {",
        ] {
            assert_eq!(normalize(line), None, "{line}");
        }
    }
}
