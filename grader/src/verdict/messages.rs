//! Messages for items that were not run, and for files that do not compile.

use judging::sanitize::sanitize;

use super::item_outcome::NotRunReason;
use crate::build::NotCompiled;
use crate::probe::{Crash, Fault};

/// Maximum length of a file's compiler errors, in characters.
const MAX_COMPILER_CHARS: usize = 10_000;

pub(super) fn not_run_message(why: &NotRunReason) -> String {
    let why = match why {
        NotRunReason::TaskStopped(fault @ Fault::Crashed(Crash::NotStarted)) => {
            return fault.to_string();
        }
        NotRunReason::TaskStopped(Fault::TimedOut(_)) => {
            "not run because another item in this task took too long"
        }
        NotRunReason::TaskStopped(Fault::OutOfMemory | Fault::Crashed(_) | Fault::Protocol(_)) => {
            "not run because two other items in this task crashed"
        }
        NotRunReason::NeedsStoppedTask => {
            "not run because a task that this item depends on was stopped early"
        }
        NotRunReason::BudgetUsedUp => "not run because earlier items used up the submission's time",
    };
    why.to_owned()
}

pub(super) fn not_compiled_message(file: &str, why: &NotCompiled) -> String {
    match why {
        NotCompiled::Unreadable(_) | NotCompiled::MissingDeclaration(_) => file_message(file, why),
        NotCompiled::Error { .. } => format!("{file} does not compile"),
        NotCompiled::Compiler(_) => "the submission does not compile".to_owned(),
    }
}

/// Returns the line number of the compiler's error, if it has one.
pub fn file_line(why: &NotCompiled) -> Option<u32> {
    let NotCompiled::Error { line, .. } = why else {
        return None;
    };
    *line
}

/// Returns the compiler's error, or the reason nothing was compiled.
pub fn file_message(file: &str, why: &NotCompiled) -> String {
    match why {
        NotCompiled::Unreadable(unreadable) => unreadable.message(file),
        NotCompiled::MissingDeclaration(part) => {
            format!(
                "{file} has no `{part}`, which other files use: put it back, or restore the original \
                 file with `cargo grade --reset {file}`"
            )
        }
        NotCompiled::Error { text, .. } | NotCompiled::Compiler(text) => {
            sanitize(text, MAX_COMPILER_CHARS)
        }
    }
}
