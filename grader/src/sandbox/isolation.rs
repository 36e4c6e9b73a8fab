//! Levels of isolation between a submission and the machine.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A level of isolation between submissions and the machine. The levels are in ascending order.
/// `grader/SECURITY.md` says what each level promises.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum,
)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Isolation {
    /// Limits on time and memory only, for your own work.
    None,
    /// The program is limited to a few system calls, and the program and the compiler can open only
    /// the files that they need.
    NoNamespaces,
    /// In addition, the program and the compiler cannot see other files, processes or networks.
    Full,
}

impl Isolation {
    /// All levels, from the best isolation to none.
    pub const ALL: [Self; 3] = [Isolation::Full, Isolation::NoNamespaces, Isolation::None];

    /// Returns the name used on the command line and in `score.json`.
    pub fn name(self) -> &'static str {
        match self {
            Isolation::None => "none",
            Isolation::NoNamespaces => "no-namespaces",
            Isolation::Full => "full",
        }
    }
}

impl fmt::Display for Isolation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}
