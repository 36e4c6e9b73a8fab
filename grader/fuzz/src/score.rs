//! Score files, as a class reads them again: of other machines, or of a run that was killed.

use class::entry::EntryInfo;
use class::model::{ClassRow, GradedClass};
use class::outcome::{EntryOutcome, EntryResult, ScoreSummary, Stamp};
use class::report::{grades, page, text};
use class::run::Run;
use class::summary::ClassSummary;
use grader::policy::Policy;

/// A score that is taken can be told of in all of a class's files. What is kept beside it is read too.
pub fn read(bytes: &[u8]) {
    let words = String::from_utf8_lossy(bytes);
    let stamp: Result<Stamp, _> = serde_json::from_str(&words);
    let run: Result<Run, _> = serde_json::from_str(&words);
    if let Ok(run) = &run {
        assert!(run.settings.differences(&run.settings).is_empty());
    }
    let about = stamp.map_or_else(|_| EntryInfo::default(), |stamp| stamp.info);
    let Ok(told) = ScoreSummary::parse(&words) else {
        return;
    };
    let row = |id: &str| EntryResult {
        id: id.to_owned(),
        info: about.clone(),
        outcome: EntryOutcome::Graded(Box::new(told.clone())),
    };
    let policy = Policy::default();
    let class = GradedClass {
        exam: "any".to_owned(),
        exam_hash: "any".to_owned(),
        isolation: "none".to_owned(),
        rows: ["alice", "bob"]
            .map(|id| ClassRow::new(row(id), &policy))
            .into(),
        missing: Vec::new(),
    };
    let summary = ClassSummary::new(&class);
    assert!(page::render_page(&class, &summary).ends_with("</html>"));
    assert!(!grades::grades_table(&class).to_csv().is_empty());
    assert!(!text::render_summary(&summary).is_empty());
}
