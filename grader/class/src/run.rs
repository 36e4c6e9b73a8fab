//! The settings that all scores in an output folder depend on. They are stored with the scores so
//! that scores from different settings are never mixed.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::layout_kind::LayoutChoice;
use crate::list_kind::ListCopies;
use crate::shard::Shard;

/// The contents of `run.json`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Run {
    /// The format version of `run.json`.
    pub schema: u32,
    /// The number of the round, counting from 1. `--regrade` starts the next round.
    pub round: u32,
    /// The state of the round.
    pub state: RoundState,
    /// The shard that is graded. `None` for the whole class.
    pub shard: Option<Shard>,
    /// The policy, the roster and the other lists. The folder contains copies of them.
    pub lists: ListCopies,
    /// The chosen layout.
    pub choice: LayoutChoice,
    /// The maximum points for each item in the exam.
    pub items: BTreeMap<String, u32>,
    /// The ids of the entries. The folder may contain other entries, from students who are no
    /// longer in the input.
    pub entries: Vec<String>,
    /// The hash of all entry ids in the class, including those in other shards. It prevents merging
    /// shards of different classes, which could leave somebody out.
    pub class: String,
    /// The settings that the scores depend on.
    pub settings: Settings,
    /// The settings of the last finished round before this one.
    pub before: Option<Settings>,
}

/// The state of a round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RoundState {
    /// The scores from before a regrade have yet to be saved. Until then, nothing is graded.
    SavesPrevious,
    /// Some entries may not be graded yet.
    #[default]
    Started,
    /// Every entry is graded.
    Finished,
    /// Every entry was graded once, and a later run of the round has started.
    Resumed,
}

/// Everything that scores depend on, other than the submissions.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// The exam's name.
    pub exam: String,
    /// The hash of the exam file.
    pub exam_hash: String,
    /// The hash of this executable.
    pub grader: String,
    /// The hash of the compiler, the dependencies and the reference.
    pub built_with: String,
    /// The isolation level used to grade the submissions.
    pub isolation: String,
    /// The command-line options that affect scores.
    pub options: String,
}

/// The format version of `run.json`.
pub const SCHEMA: u32 = 1;

impl Run {
    /// Returns the first round in a new folder. Nothing is graded yet.
    pub fn first_round(settings: Settings) -> Self {
        Run {
            schema: SCHEMA,
            round: 1,
            settings,
            ..Run::default()
        }
    }

    /// Returns the next round, in which nothing is graded yet. It will be compared with the last
    /// finished round. An abandoned regrade has already replaced some scores, so the scores saved
    /// before it are kept for the comparison.
    pub fn next_round(&self, settings: Settings) -> Self {
        let (before, state) = if self.is_unfinished_regrade() {
            (self.before.clone(), self.state)
        } else {
            (Some(self.settings.clone()), RoundState::SavesPrevious)
        };
        Run {
            round: self.round + 1,
            state,
            before,
            ..Run::first_round(settings)
        }
    }

    /// Returns the resumed run. If the round was finished, its state becomes
    /// [`RoundState::Resumed`]. Otherwise, the state doesn't change.
    #[must_use]
    pub fn resume(mut self) -> Self {
        if self.was_finished() {
            self.state = RoundState::Resumed;
        }
        self
    }

    /// Returns whether the round was finished, in this run or in an earlier one.
    pub fn was_finished(&self) -> bool {
        matches!(self.state, RoundState::Finished | RoundState::Resumed)
    }

    /// Returns whether this is a regrade that was never finished.
    pub fn is_unfinished_regrade(&self) -> bool {
        !self.was_finished() && self.before.is_some()
    }
}

impl Settings {
    /// Returns the names of the settings that differ.
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
        differ.map(|(name, _, _)| name).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::tests::{other_settings, run};

    #[test]
    fn a_regrade_is_compared_with_the_last_finished_round() {
        let first = Run {
            state: RoundState::Finished,
            entries: vec!["a".to_owned()],
            ..run()
        };
        assert!(!first.is_unfinished_regrade());
        assert!(!run().is_unfinished_regrade(), "there is nothing before it");
        let second = first.next_round(other_settings());
        assert_eq!((second.round, second.state), (2, RoundState::SavesPrevious));
        assert_eq!(second.before, Some(first.settings.clone()));
        assert_eq!(second.settings, other_settings());
        assert!(second.is_unfinished_regrade());
        assert!(second.entries.is_empty());

        // If the regrade is stopped after the scores were saved, the saved scores are kept.
        let saved = Run {
            state: RoundState::Started,
            ..second.clone()
        };
        let third = saved.next_round(first.settings.clone());
        assert_eq!((third.round, third.state), (3, RoundState::Started));
        assert_eq!(third.before, Some(first.settings.clone()));

        // Once this regrade is finished, the next one is compared with it.
        let finished = Run {
            state: RoundState::Resumed,
            ..saved
        };
        assert!(!finished.is_unfinished_regrade());
        let third = finished.next_round(first.settings);
        assert_eq!((third.round, third.state), (3, RoundState::SavesPrevious));
        assert_eq!(third.before, Some(other_settings()));
    }

    #[test]
    fn settings_that_differ_are_named() {
        let own = run().settings;
        assert_eq!(own.differences(&own), Vec::<&str>::new());
        assert_eq!(own.differences(&other_settings()), ["the exam"]);
        let other = Settings {
            // The exam's name says nothing about its questions.
            exam: "x".to_owned(),
            grader: "x".to_owned(),
            built_with: "x".to_owned(),
            isolation: "x".to_owned(),
            options: "x".to_owned(),
            ..own.clone()
        };
        assert_eq!(
            own.differences(&other),
            [
                "the grader",
                "the compiler, the dependencies or the reference",
                "the isolation",
                "the options"
            ]
        );
    }
}
