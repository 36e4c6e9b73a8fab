//! `cargo author mutants` and `cargo author systematic`.

use std::path::Path;

use super::{CommandResult, HANDED_OUT, PRACTICE, generate, record_result, report};
use crate::cli::RecordArgs;
use crate::generated_file::Mode;
use crate::proof::mutants::{self, MutantSelection};

/// Writes or checks the list of the reference's mutants, and grades them.
pub(super) fn mutants(root: &Path, fast: bool, mode: Mode, record: RecordArgs) -> CommandResult {
    let selection = MutantSelection::new(fast);
    let list = mutants::list(HANDED_OUT, root, mode)?;
    generate(&[list.generated_file()], mode, "mutants")?;
    let findings = mutants::run(HANDED_OUT, &list, selection)?;
    println!("{}", selection.description());
    let line = format!("mutants: {}", findings.summary_line());
    record_result(record, "mutants of the reference", PRACTICE, &line)?;
    report(&findings.problems(), &line)
}

/// Makes systematic mistakes, and grades them.
pub(super) fn systematic(fast: bool, record: RecordArgs) -> CommandResult {
    let selection = MutantSelection::new(fast);
    let findings = mutants::run_systematic(HANDED_OUT, selection)?;
    println!("{}", selection.description());
    let line = format!("systematic mistakes: {}", findings.summary_line());
    record_result(record, "systematic", PRACTICE, &line)?;
    report(&findings.problems(), &line)
}
