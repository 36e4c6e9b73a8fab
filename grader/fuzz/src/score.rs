//! Score files that `cargo class` reads back. They may come from other machines or from a killed
//! run.

use std::collections::BTreeSet;

use class::entry::EntryInfo;
use class::graded_class::{Adjustments, ClassRow, GradedClass};
use class::outcome::{EntryOutcome, EntryResult, ScoreSummary, Stamp};
use class::regrade_diff::Changes;
use class::report::{grades, page, text};
use class::run::{Run, Settings};
use class::summary::ClassSummary;
use grader::policy::Policy;

/// Reads the bytes as a score, and also as every other kind of file that belongs to an entry or a
/// run. If the bytes are a valid score, it must be possible to write all of a class's files from
/// that score.
pub fn read(bytes: &[u8]) {
    let json = String::from_utf8_lossy(bytes);
    let stamp: Result<Stamp, _> = serde_json::from_str(&json);
    let run: Result<Run, _> = serde_json::from_str(&json);
    if let Ok(run) = &run {
        assert!(run.settings.differences(&run.settings).is_empty());
    }
    let info = stamp.map_or_else(|_| EntryInfo::default(), |stamp| stamp.result.info);
    let Ok(summary) = ScoreSummary::parse(&json) else {
        return;
    };
    let row = |id: &str| EntryResult {
        id: id.to_owned(),
        info: info.clone(),
        outcome: EntryOutcome::Graded(Box::new(summary.clone())),
    };
    let policy = Policy::default();
    let class = GradedClass {
        settings: Settings::default(),
        rows: ["alice", "bob"]
            .map(|id| {
                let own = vec![Adjustments::default(); info.people.len()];
                ClassRow::new(row(id), &policy, own, &[])
            })
            .into(),
        missing: Vec::new(),
    };
    let class_summary = ClassSummary::new(&class, &policy, &BTreeSet::new());
    assert!(
        page::render_page(&class, &class_summary, &Changes::default(), &[]).ends_with("</html>")
    );
    assert!(!grades::grades_table(&class).to_csv().is_empty());
    assert!(!text::render_summary(&class_summary).is_empty());
}
