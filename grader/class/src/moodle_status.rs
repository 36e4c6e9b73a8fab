//! The `Status` column of Moodle's grading worksheet: sentences in the language of the person who
//! downloaded it, joined with ` - ` (`col_status` in Moodle's `mod/assign/gradingtable.php`).

use crate::names::are_equal;

/// Sentences that don't affect the grade, from Moodle's `mod/assign/lang/en/assign.php`.
const KNOWN: &str = include_str!("moodle_status.txt");
/// Sentences about files that the student hasn't submitted.
const UNSUBMITTED: [&str; 2] = ["Draft (not submitted)", "Reopened"];
const EXTENSION: &str = "Extension granted until:";
const LATE: &str = " late";
const OVERDUE: &str = "Assignment is overdue by:";

/// The meaning of a submission's status.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MoodleStatus<'a> {
    /// Whether the submission is late.
    pub is_late: bool,
    /// The sentence that says that the files are only a draft.
    pub unsubmitted: Option<&'a str>,
    /// The end of an extension, in Moodle's format.
    pub extension: Option<&'a str>,
    /// A sentence that isn't recognised.
    pub unknown: Option<&'a str>,
}

impl<'a> MoodleStatus<'a> {
    /// Parses a cell of the column.
    pub fn parse(cell: &'a str) -> Self {
        let mut status = MoodleStatus::default();
        let sentences = cell.split(" - ").map(str::trim);
        for sentence in sentences.filter(|sentence| !sentence.is_empty()) {
            let is_sentence = |known: &str| are_equal(known, sentence);
            if let Some(until) = sentence.strip_prefix(EXTENSION) {
                status.extension = Some(until.trim());
            } else if UNSUBMITTED.into_iter().any(is_sentence) {
                status.unsubmitted = Some(sentence);
            } else if sentence.ends_with(LATE) {
                status.is_late = true;
            } else if !KNOWN.lines().any(is_sentence) && !sentence.starts_with(OVERDUE) {
                status.unknown = Some(sentence);
            }
        }
        status
    }
}
