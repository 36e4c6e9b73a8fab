//! Searches a bundle for secrets: lines of solutions, and final exams.
//!
//! A secret line is a line of code from a solution, variant, mistake, mutant or oracle. White space
//! is ignored when lines are compared. Lines of the given files aren't secret. Neither are lines
//! that compute nothing, e.g. `use std::fs;` or a closing brace.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::path::Path;

use anyhow::Result;
use grader::files;
use grader::handed_out::LIGHT;
use judging::exam::Exam;

use crate::authoring::Authoring;
use crate::bundle::Bundle;
use crate::light::LightFiles;
use crate::solutions::catalogue::mistakes;
use crate::solutions::sources::Sources;

/// The folders with the code that students are given. Solutions may repeat lines of this code.
const GIVEN_FOLDERS: [&str; 3] = ["student/src/", "student/protocol/", "student/framework/"];
/// The minimum length of a secret line, not counting white space. Shorter lines can match by
/// coincidence.
const MIN_LENGTH: usize = 21;
/// Lines, without white space, that occur in all kinds of Rust code.
const IDIOMS: [&str; 1] = ["thread::scope(|scope|{"];
/// The id of the only exam that students may have.
const PRACTICE_ID: &str = "practice";

/// All secret lines of a workspace.
#[derive(Clone, Debug)]
pub struct Secrets {
    /// The location of each secret line, as `file:line`, keyed by the normalised line.
    lines: HashMap<String, String>,
}

/// A secret found in a bundle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Leak {
    /// The bundle contains a secret line.
    Line {
        /// The location in the bundle, as `file:line`.
        found: String,
        /// The location of the secret line, as `file:line`.
        source: String,
    },
    /// The bundle contains an exam other than the practice exam.
    Exam {
        /// The path of the exam in the bundle.
        found: String,
    },
}

impl Secrets {
    /// Collects the secrets of an assignment in the workspace at `root`, except lines that also
    /// occur in the bundle's given files.
    ///
    /// Lines of part two's solution are only secret if students get its stubs.
    pub fn gather(
        root: &Path,
        authoring: &Authoring,
        light: LightFiles,
        bundle: &Bundle,
    ) -> Result<Self> {
        let handed_out = authoring.handed_out;
        let mut secrets = Secrets {
            lines: HashMap::new(),
        };
        // Only the oracles' formulas are secret. Other lines, e.g. the conversion of a ray to
        // `f64`, can occur in any code.
        for oracles in authoring.oracles {
            secrets.read(root, oracles)?;
        }
        secrets.lines.retain(|line, _| is_formula(line));
        secrets.read(root, handed_out.reference)?;
        let solutions = handed_out.solutions();
        let stems = handed_out
            .file_names()
            .map(|file| file.trim_end_matches(".rs"));
        let variants = stems.map(|stem| format!("{solutions}/variants/{stem}"));
        for folder in variants.chain([format!("{solutions}/mutants")]) {
            // Not every assignment has mutants, and not every file has variants.
            if root.join(&folder).is_dir() {
                secrets.read(root, &folder)?;
            }
        }
        // A substitution's folder contains a file that has the same name as the substituted file
        // and replaces some of that file's functions.
        for substituted in handed_out.substitutions {
            let (folder, file) = (substituted.folder(), substituted.file);
            secrets.read(root, &format!("{solutions}/{folder}/{file}"))?;
        }
        let reference = Sources::reference(root, handed_out)?;
        for mistake in mistakes(root, handed_out)? {
            let wrong = mistake.apply(&reference)?;
            for file in handed_out.files {
                let source = format!("the mistake {}, {}", mistake.id, file.name);
                secrets.add(&source, wrong.text(file.name).unwrap_or_default());
            }
        }
        if light == LightFiles::Stubs {
            secrets.read(root, LIGHT.reference)?;
        }
        let files = light.generate(root)?;
        let light = files.iter().map(|file| file.contents.as_str());
        let given = bundle
            .text_files()
            .filter(|(path, _)| GIVEN_FOLDERS.iter().any(|given| path.starts_with(given)));
        let given = given.map(|(_, text)| text).chain(light);
        let given: HashSet<String> = given
            .flat_map(|text| text.lines().filter_map(normalize))
            .collect();
        secrets.lines.retain(|line, _| !given.contains(line));
        Ok(secrets)
    }

    fn read(&mut self, root: &Path, path: &str) -> Result<()> {
        let full_path = root.join(path);
        if full_path.is_dir() {
            for entry in files::read_dir(&full_path)? {
                let name = entry.file_name().unwrap_or_default();
                self.read(root, &format!("{path}/{}", name.to_string_lossy()))?;
            }
        } else if !path.ends_with(".md") {
            let text = files::read_to_string(&full_path)?;
            self.add(path, &text);
        }
        Ok(())
    }

    fn add(&mut self, source: &str, text: &str) {
        for (number, line) in (1..).zip(text.lines()) {
            if let Some(line) = normalize(line) {
                let location = || format!("{source}:{number}");
                self.lines.entry(line).or_insert_with(location);
            }
        }
    }

    /// Returns every secret in the bundle.
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

/// Returns a line without white space, or `None` if it is too short or computes nothing.
fn normalize(line: &str) -> Option<String> {
    let computes = is_formula(line) || line.contains('(');
    let is_no_code = ["//", "use ", "pub use ", "#["]
        .iter()
        .any(|start| line.trim_start().starts_with(start));
    let line: String = line.split_whitespace().collect();
    let is_idiom = IDIOMS.contains(&line.as_str());
    (computes && !is_no_code && !is_idiom && line.len() >= MIN_LENGTH).then_some(line)
}

/// Returns whether the line contains arithmetic. An arrow, a dereferenced field or the name of a
/// handout section doesn't count as arithmetic.
fn is_formula(line: &str) -> bool {
    if line.contains(".md#") {
        return false;
    }
    let operators = line.replace("->", "").replace(": *", "").replace(":*", "");
    operators.contains(['+', '-', '*', '/'])
}

impl fmt::Display for Secrets {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} lines of solutions", self.lines.len())
    }
}

impl fmt::Display for Leak {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Leak::Line { found, source } => write!(f, "{found} is identical to {source}"),
            Leak::Exam { found } => write!(f, "{found} is not the practice exam"),
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
        assert!(!is_formula("max_leaf_size: *max_leaf_size,"));
        for line in [
            "}",
            "use std::collections::BTreeMap;",
            "/// The surface normal there, of length one.",
            "Shape::Sphere { center, radius, .. } => {",
            "fn hit() -> Option {",
            "section: \"camera.md#from-pixel-to-sensor\",",
            "        thread::scope(|scope| {",
        ] {
            assert_eq!(normalize(line), None, "{line}");
        }
    }
}
