//! Score files, as a class reads them again: of other machines, or of a run that was killed.

use class::entry::About;
use class::model::{Class, Line};
use class::outcome::{Outcome, Row, Stamp, Told};
use class::report::{grades, page, text};
use class::run::Run;
use class::summary::Summary;
use grader::policy::Policy;

/// A score that is taken can be told of in all of a class's files. What is kept beside it is read too.
pub fn read(bytes: &[u8]) {
    let words = String::from_utf8_lossy(bytes);
    let stamp: Result<Stamp, _> = serde_json::from_str(&words);
    let run: Result<Run, _> = serde_json::from_str(&words);
    if let Ok(run) = &run {
        assert!(run.settings.differences(&run.settings).is_empty());
    }
    let about = stamp.map_or_else(|_| About::default(), |stamp| stamp.about);
    let Ok(told) = Told::read(&words) else {
        return;
    };
    let row = |id: &str| Row {
        id: id.to_owned(),
        about: about.clone(),
        outcome: Outcome::Graded(Box::new(told.clone())),
    };
    let policy = Policy::default();
    let class = Class {
        exam: "any".to_owned(),
        exam_hash: "any".to_owned(),
        isolation: "none".to_owned(),
        lines: ["alice", "bob"].map(|id| Line::of(row(id), &policy)).into(),
        missing: Vec::new(),
    };
    let summary = Summary::of(&class);
    assert!(page::page(&class, &summary).ends_with("</html>"));
    assert!(!grades::grades(&class).text().is_empty());
    assert!(!text::summary(&summary).is_empty());
}
