//! What all scores of a folder follow from, so that no two kinds are ever mixed.

use serde::{Deserialize, Serialize};

use crate::shard::Shard;

/// What is kept of a run beside its entries.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Run {
    /// The version of this file.
    pub schema: u32,
    /// Counted from 1; `--regrade` begins the next.
    pub round: u32,
    /// Whether every entry of the round was looked at.
    pub finished: bool,
    /// Whether that held once, even if somebody was killed while looking again.
    #[serde(default)]
    pub was_finished: bool,
    /// Which part of the class it is. None if it is all of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<Shard>,
    /// The text of the policy. None if it is the default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub policy: Option<String>,
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
    pub fn first_round(settings: Settings) -> Self {
        Run {
            schema: SCHEMA,
            round: 1,
            finished: false,
            was_finished: false,
            shard: None,
            policy: None,
            settings,
            before: None,
        }
    }

    /// The next, of which nothing is graded yet. One that was never finished is no round to compare
    /// with.
    pub fn next_round(&self, settings: Settings) -> Self {
        let before = match self.is_unfinished_regrade() {
            true => self.before.clone(),
            false => Some(self.settings.clone()),
        };
        Run {
            schema: SCHEMA,
            round: self.round + 1,
            finished: false,
            was_finished: false,
            shard: None,
            policy: None,
            settings,
            before,
        }
    }

    /// Whether the scores before it are kept already, and its own are not complete.
    pub fn is_unfinished_regrade(&self) -> bool {
        !self.was_finished && self.before.is_some()
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
