//! Reading a policy. One that says what can not be meant is refused, with line and remedy.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::exam::Exam;
use crate::policy::Policy;
use crate::policy::late::unix_seconds;

/// Why a policy can not be used.
#[derive(Debug, thiserror::Error)]
pub enum PolicyError {
    /// The file can not be read.
    #[error(
        "can not read the policy {}: {source}; `cargo grade --policy-default` prints one to begin with",
        path.display()
    )]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// The file is not TOML, or not a policy.
    #[error(
        "the policy {}, line {line}: {problem}\n  {text}\n`cargo grade --policy-default` prints all keys and what they mean",
        path.display()
    )]
    Invalid {
        /// Which.
        path: PathBuf,
        /// Counted from 1.
        line: usize,
        /// What stands there.
        text: String,
        /// What is wrong with it.
        problem: String,
    },
    /// An exception for something that the exam does not hold.
    #[error(
        "the policy {}: [visibility.items] names `{name}`, and the exam {exam} has no such task or item",
        path.display()
    )]
    UnknownItem {
        /// Which.
        path: PathBuf,
        /// What it names.
        name: String,
        /// The exam's id.
        exam: String,
    },
}

impl Policy {
    /// Reads the file at `path`.
    pub fn read(path: &Path) -> Result<Policy, PolicyError> {
        let text = fs::read_to_string(path).map_err(|source| PolicyError::Io {
            path: path.to_owned(),
            source,
        })?;
        Policy::from_text(path, &text)
    }

    /// Reads a policy that `path` is the name of.
    pub fn from_text(path: &Path, text: &str) -> Result<Policy, PolicyError> {
        Policy::parse(text).map_err(|complaint| complaint.into_error(path, text))
    }

    /// Refuses exceptions for what this exam does not hold: nobody would miss them.
    pub fn check(&self, path: &Path, exam: &Exam) -> Result<(), PolicyError> {
        let items = exam.items.iter().map(|item| item.id.as_str());
        match self.unmatched_exception(items) {
            None => Ok(()),
            Some(name) => Err(PolicyError::UnknownItem {
                path: path.to_owned(),
                name: name.to_owned(),
                exam: exam.id.clone(),
            }),
        }
    }

    fn parse(text: &str) -> Result<Policy, Problem> {
        let policy: Policy = toml::from_str(text).map_err(|error| Problem {
            offset: error.span().map_or(0, |span| span.start),
            problem: error.message().to_owned(),
        })?;
        match policy.problem() {
            None => Ok(policy),
            Some((key, problem)) => Err(Problem {
                offset: line_offset(text, key),
                problem: problem.to_owned(),
            }),
        }
    }

    /// The key whose value can not be meant, and what is wrong with it.
    fn problem(&self) -> Option<(&'static str, &'static str)> {
        let late = &self.late;
        let is_moment = late
            .due
            .as_ref()
            .is_none_or(|due| unix_seconds(due).is_some());
        [
            (
                self.points.out_of == Some(0),
                "out_of",
                "nothing is out of 0",
            ),
            (
                !is_moment,
                "due",
                "a moment is meant, such as 2026-11-20T23:59:59+01:00",
            ),
            (
                late.percent_per_day > 100,
                "percent_per_day",
                "more than 100 percent",
            ),
            (
                late.most_percent > 100,
                "most_percent",
                "more than 100 percent",
            ),
        ]
        .into_iter()
        .find_map(|(is_wrong, key, problem)| is_wrong.then_some((key, problem)))
    }
}

/// What is wrong, and at which byte.
struct Problem {
    offset: usize,
    problem: String,
}

impl Problem {
    fn into_error(self, path: &Path, text: &str) -> PolicyError {
        let before = text.get(..self.offset).unwrap_or(text);
        let line = before.matches('\n').count();
        PolicyError::Invalid {
            path: path.to_owned(),
            line: line + 1,
            text: text.lines().nth(line).unwrap_or_default().trim().to_owned(),
            problem: self.problem,
        }
    }
}

/// The byte where the line of this key begins.
fn line_offset(text: &str, key: &str) -> usize {
    let mut begin = 0;
    for line in text.split_inclusive('\n') {
        if line.trim_start().starts_with(key) {
            return begin;
        }
        begin += line.len();
    }
    0
}

#[cfg(test)]
mod tests {
    use crate::policy::{DEFAULT, Policy};

    #[test]
    fn documented_default_equals_the_built_in_default() {
        assert_eq!(Policy::parse(DEFAULT).ok(), Some(Policy::default()));
    }

    #[test]
    fn commented_examples_are_valid() {
        let shown = |line: &str| {
            let line = line.strip_prefix("# ")?;
            line.split_once(" = ").map(|_| line.to_owned())
        };
        let lines = DEFAULT.lines();
        let said = lines.map(|line| shown(line).unwrap_or_else(|| line.to_owned()));
        let said: Vec<String> = said.collect();
        let policy = Policy::parse(&said.join("\n")).ok().unwrap();
        assert_eq!(policy.points.out_of, Some(50));
        assert!(policy.late.due.is_some() && policy.late.closed_after_days.is_some());
        assert_eq!(policy.visibility.items.len(), 2);
    }
}
