//! What all scores of a folder follow from, so that no two kinds are ever mixed.

use serde::{Deserialize, Serialize};

/// What is kept of a run beside its entries.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Run {
    /// The version of this file.
    pub schema: u32,
    /// Counted from 1; `--regrade` begins the next.
    pub round: u32,
    /// Whether every entry of the round was looked at.
    pub finished: bool,
    /// What its scores follow from.
    pub settings: Settings,
    /// What those of the round before followed from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before: Option<Settings>,
}

/// What scores follow from, beside the submissions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// The exam's name.
    pub exam: String,
    /// Of the exam file's bytes.
    pub exam_hash: String,
    /// Of this program's bytes.
    pub grader: String,
    /// Of the compiler, the dependencies and the reference.
    pub built_with: String,
    /// How submissions were kept apart from the machine.
    pub isolation: String,
    /// The options that change a score.
    pub options: String,
}

/// The version of the file.
pub const SCHEMA: u32 = 1;

impl Run {
    /// The first of a folder.
    pub fn first(settings: Settings) -> Self {
        Run {
            schema: SCHEMA,
            round: 1,
            finished: false,
            settings,
            before: None,
        }
    }

    /// The next, of which nothing is graded yet.
    pub fn next(&self, settings: Settings) -> Self {
        Run {
            schema: SCHEMA,
            round: self.round + 1,
            finished: false,
            settings,
            before: Some(self.settings.clone()),
        }
    }
}

impl Settings {
    /// In words, what is not the same in both.
    pub fn differences(&self, other: &Settings) -> Vec<&'static str> {
        let pairs = [
            ("the exam", &self.exam_hash, &other.exam_hash),
            ("the grader", &self.grader, &other.grader),
            (
                "the compiler, the dependencies or the reference",
                &self.built_with,
                &other.built_with,
            ),
            ("the isolation", &self.isolation, &other.isolation),
            ("the options", &self.options, &other.options),
        ];
        let differ = pairs.into_iter().filter(|(_, mine, theirs)| mine != theirs);
        differ.map(|(words, _, _)| words).collect()
    }
}
