//! The `Status` column of Moodle's grading worksheet: sentences in the language of the person who
//! downloaded it, joined with ` - ` (`col_status` in Moodle's `mod/assign/gradingtable.php`).

use crate::names::are_equal;

/// Sentences that don't affect the grade, from Moodle's `mod/assign/lang/en/assign.php`.
const KNOWN: [&str; 14] = [
    "Submitted for grading",
    "Submitted",
    "No submission",
    "Submission changes not allowed",
    "Graded",
    "Not graded",
    // This follows `Graded - `.
    "follow up submission received",
    "Not marked",
    "In marking",
    "Marking completed",
    "In review",
    "Ready for release",
    "Released",
    "No attempt",
];
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
            let is_one_of = |known: &[&str]| known.iter().any(|known| are_equal(known, sentence));
            if let Some(until) = sentence.strip_prefix(EXTENSION) {
                status.extension = Some(until.trim());
            } else if is_one_of(&UNSUBMITTED) {
                status.unsubmitted = Some(sentence);
            } else if sentence.ends_with(LATE) {
                status.is_late = true;
            } else if !is_one_of(&KNOWN) && !sentence.starts_with(OVERDUE) {
                status.unknown = Some(sentence);
            }
        }
        status
    }
}
