//! How far a submission is kept apart from the machine.

use std::fmt;

use serde::{Deserialize, Serialize};

/// How submissions were kept apart from the machine, from none to best. What each level promises
/// stands in `grader/SECURITY.md`.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum,
)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Isolation {
    /// Limits on time and memory only: for one's own work.
    None,
    /// The program may call little of the system; the compiler may read what its user may.
    SeccompOnly,
    /// The same, and neither can open files but those that it needs.
    NoNamespaces,
    /// The same, and neither sees other files, processes or networks at all.
    Full,
}

impl Isolation {
    /// From best to none.
    pub const ALL: [Self; 4] = [
        Isolation::Full,
        Isolation::NoNamespaces,
        Isolation::SeccompOnly,
        Isolation::None,
    ];

    /// As it is written on the command line and in `score.json`.
    pub fn name(self) -> &'static str {
        match self {
            Isolation::None => "none",
            Isolation::SeccompOnly => "seccomp-only",
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
