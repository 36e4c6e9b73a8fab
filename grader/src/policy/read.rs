//! Reads policies. An invalid policy is rejected with a message that shows the line and says what
//! to do.

use std::path::{Path, PathBuf};

use jiff::Timestamp;
use jiff::tz::TimeZone;
use judging::exam::Exam;
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use toml::value::Datetime;

use crate::files::{self, PathError};
use crate::policy::Policy;

/// Reasons why a policy cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum PolicyError {
    /// The file cannot be read.
    #[error("{0}; `cargo grade --policy-default` prints one to start from")]
    File(#[source] PathError),
    /// The file is not TOML, or not a valid policy.
    #[error(
        "the policy {}, line {line}: {problem}\n  {text}\n`cargo grade --policy-default` prints all keys with explanations",
        path.display()
    )]
    Invalid {
        /// Path of the policy file.
        path: PathBuf,
        /// Line number, counted from 1.
        line: usize,
        /// Text of the line.
        text: String,
        /// The problem with the line.
        problem: String,
    },
    /// An exception refers to an unknown task or item.
    #[error(
        "the policy {}: [visibility.items] names `{name}`, but the exam `{exam}` has no task or item of that name: correct it or remove the line",
        path.display()
    )]
    UnknownItem {
        /// Path of the policy file.
        path: PathBuf,
        /// The unknown name.
        name: String,
        /// The exam's id.
        exam: String,
    },
}

impl Policy {
    /// Reads the policy at `path`.
    pub fn read(path: &Path) -> Result<Policy, PolicyError> {
        Policy::from_text(path, &Policy::read_text(path)?)
    }

    /// Reads the text of the policy at `path`, which need not be valid.
    pub fn read_text(path: &Path) -> Result<String, PolicyError> {
        files::read_to_string(path).map_err(|error| {
            PolicyError::File(PathError {
                action: "read the policy",
                ..error
            })
        })
    }

    /// Parses a policy. `path` is used in error messages only.
    pub fn from_text(path: &Path, text: &str) -> Result<Policy, PolicyError> {
        Policy::parse(text).map_err(|problem| problem.into_error(path, text))
    }

    /// Rejects exceptions for items that the exam does not contain. Otherwise a misspelt name would
    /// go unnoticed.
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

    /// Returns the key with an invalid value, and the problem with it.
    fn problem(&self) -> Option<(&'static str, &'static str)> {
        let late = &self.late;
        [
            (self.points.out_of == Some(0), "out_of", "must not be 0"),
            (
                late.percent_per_day > 100,
                "percent_per_day",
                "must not exceed 100",
            ),
            (
                late.most_percent > 100,
                "most_percent",
                "must not exceed 100",
            ),
        ]
        .into_iter()
        .find_map(|(is_wrong, key, problem)| is_wrong.then_some((key, problem)))
    }
}

/// Reads a due time. TOML also has dates, and times without an offset, which are no points in time.
pub(super) fn due_time<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Timestamp>, D::Error> {
    let time = Datetime::deserialize(deserializer)?.to_string().parse();
    time.map(Some).map_err(|_| {
        D::Error::custom(
            "must be a date and time with an offset, such as 2026-11-20T23:59:59+01:00",
        )
    })
}

/// Reads the name of a time zone.
pub(super) fn time_zone<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<TimeZone>, D::Error> {
    let name = String::deserialize(deserializer)?;
    TimeZone::get(&name).map(Some).map_err(|_| {
        D::Error::custom("must be the name of a time zone, such as America/New_York or UTC")
    })
}

/// A problem at a byte offset of the text.
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

/// Returns the byte offset of the line that starts with this key.
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
        let lines_with_examples = lines.map(|line| shown(line).unwrap_or_else(|| line.to_owned()));
        let lines_with_examples: Vec<String> = lines_with_examples.collect();
        let policy = Policy::parse(&lines_with_examples.join("\n")).ok().unwrap();
        assert_eq!(policy.points.out_of, Some(50));
        assert!(policy.late.due.is_some() && policy.late.closed_after_days.is_some());
        assert_eq!(policy.late.extensions.len(), 2);
        assert_eq!(policy.visibility.items.len(), 2);
    }
}
