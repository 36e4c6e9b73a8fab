//! `cargo author hints`.

use std::path::Path;

use super::{CommandResult, HANDED_OUT, PRACTICE, record_result, report, solutions, written};
use crate::cli::HintsArgs;
use crate::exams;
use crate::proof::recognition::{
    recognise, recognise_independent, recognise_pairs, recognise_unknown, recognise_with_seeds,
};
use crate::solutions::sources::Sources;

/// The result of measuring hints.
struct Measured {
    /// The name in the table of long runs.
    run: &'static str,
    /// The seeds of the final exams, or the practice exam.
    exams: String,
    /// The result in one line, for the table.
    line: String,
    /// The whole result, to print.
    text: String,
    /// The reasons why the command fails.
    problems: Vec<String>,
}

/// Measures how mistakes are recognised, prints the result, and records it if asked to.
pub(super) fn hints(root: &Path, args: HintsArgs) -> CommandResult {
    let record = args.record;
    let measured = measure(root, args)?;
    record_result(record, measured.run, &measured.exams, &measured.line)?;
    report(&measured.problems, &measured.text)
}

fn measure(root: &Path, args: HintsArgs) -> Result<Measured, Box<dyn std::error::Error>> {
    let solutions = solutions()?;
    if let Some(seeds) = args.seeds {
        let exams = written(&seeds);
        let recognition = recognise_with_seeds(&solutions, seeds)?;
        return Ok(Measured {
            run: "hints",
            exams,
            line: recognition.summary_line(),
            text: recognition.to_string(),
            problems: Vec::new(),
        });
    }
    let practice = exams::load_practice(root)?;
    let (run, line, text, problems) = if args.independent {
        let recognition = recognise_independent(&solutions, &practice)?;
        let (line, text) = (recognition.summary_line(), recognition.to_string());
        ("hints --independent", line, text, recognition.problems())
    } else if args.unknown {
        let reference = Sources::reference(root, HANDED_OUT)?;
        let recognition = recognise_unknown(&solutions, &practice, &reference)?;
        let (line, text) = (recognition.summary_line(), recognition.to_string());
        ("hints --unknown", line, text, recognition.problems)
    } else if let Some(count) = args.pairs {
        let reference = Sources::reference(root, HANDED_OUT)?;
        let recognition = recognise_pairs(&solutions, &practice, &reference, count)?;
        let (line, text) = (recognition.summary_line(), recognition.to_string());
        ("hints --pairs", line, text, Vec::new())
    } else {
        let recognition = recognise(&solutions, &practice)?;
        let (line, text) = (recognition.summary_line(), recognition.to_string());
        ("hints, one exam", line, text, Vec::new())
    };
    Ok(Measured {
        run,
        exams: PRACTICE.to_owned(),
        line,
        text,
        problems,
    })
}
