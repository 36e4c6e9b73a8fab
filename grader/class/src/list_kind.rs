//! The lists that staff provide for a class (the policy, the roster, manual points and gradebooks),
//! and how an output folder records them.

use std::collections::BTreeMap;
use std::ops::Not;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// A list that staff provide for a class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum ListKind {
    /// The policy.
    Policy,
    /// The roster.
    Roster,
    /// The manual points.
    ManualPoints,
    /// The gradebook from Canvas.
    Canvas,
    /// The worksheet from Moodle.
    Moodle,
    /// The grades from Gradescope.
    Gradescope,
    /// The list of people that comes with the submissions in the platform's download.
    Downloaded,
}

impl ListKind {
    /// The gradebooks.
    pub const GRADEBOOKS: [ListKind; 3] =
        [ListKind::Canvas, ListKind::Moodle, ListKind::Gradescope];

    /// Returns the name that is used on the command line: the option without its dashes.
    pub fn name(self) -> String {
        let value = self.to_possible_value().expect("no list is hidden");
        value.get_name().to_owned()
    }

    /// Returns the title for messages.
    pub fn title(self) -> &'static str {
        match self {
            ListKind::Policy => "the policy",
            ListKind::Roster => "the roster",
            ListKind::ManualPoints => "the table of manual points",
            ListKind::Canvas => "the Canvas gradebook",
            ListKind::Moodle => "the Moodle worksheet",
            ListKind::Gradescope => "the list from Gradescope",
            ListKind::Downloaded => "the list of people in the download",
        }
    }
}

/// A list that has a copy in the output folder.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListCopy {
    /// The hash of the file.
    pub hash: String,
    /// The path on the command line, for messages.
    pub given_as: String,
    /// The column to fill in if the list is a gradebook from Canvas.
    pub column: Option<String>,
    /// Whether the list comes from the merged shards rather than from the merge's command line.
    #[serde(default, skip_serializing_if = "Not::not")]
    pub is_of_parts: bool,
}

/// The lists by kind, as stored in `run.json`.
pub type ListCopies = BTreeMap<ListKind, ListCopy>;

impl ListCopy {
    /// Returns whether the contents of both lists are the same.
    pub fn is_same(&self, other: &ListCopy) -> bool {
        (&self.hash, &self.column) == (&other.hash, &other.column)
    }
}
