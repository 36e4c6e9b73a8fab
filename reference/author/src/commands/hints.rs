//! `cargo author hints`.

use std::path::Path;

use super::{CommandResult, PRACTICE, record_result, report, solutions, written};
use crate::cli::HintsArgs;
use crate::exams;
use crate::proof::recognition::{
    recognise, recognise_independent, recognise_pairs, recognise_unknown, recognise_with_seeds,
};

/// Measures how mistakes are recognised, prints the result, and records it if asked to.
pub(super) fn hints(root: &Path, args: HintsArgs) -> CommandResult {
    let solutions = solutions()?;
    let practice = exams::load_practice(root)?;
    let seeds = args.seeds.as_ref().map(written);
    let (run, recognition) = if let Some(seeds) = args.seeds {
        ("hints", recognise_with_seeds(&solutions, seeds)?)
    } else if args.independent {
        let recognition = recognise_independent(&solutions, &practice)?;
        ("hints --independent", recognition)
    } else if args.unknown {
        let recognition = recognise_unknown(&solutions, &practice)?;
        ("hints --unknown", recognition)
    } else if let Some(count) = args.pairs {
        let recognition = recognise_pairs(&solutions, &practice, count)?;
        ("hints --pairs", recognition)
    } else {
        ("hints, one exam", recognise(&solutions, &practice)?)
    };
    let exams = seeds.as_deref().unwrap_or(PRACTICE);
    record_result(args.record, run, exams, &recognition.summary_line)?;
    report(&recognition.problems, &recognition.to_string())
}
