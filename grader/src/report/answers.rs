//! The answers drawn in an HTML report. They aren't part of the score file, which is for programs
//! and should stay small.

use std::collections::BTreeMap;

use judging::exam::Item;
use judging::picture;
use protocol::Answer;

use crate::score::{ItemScore, VerdictKind};

/// The answers to items, keyed by the item's id.
#[derive(Clone, Debug, Default)]
pub struct ReportAnswers(BTreeMap<String, Vec<Answer>>);

impl ReportAnswers {
    /// Keeps the answers to an item if the report may draw them.
    pub fn record(&mut self, item: &Item, line: &ItemScore, answers: Vec<Answer>) {
        let is_judged = matches!(
            line.verdict.kind(),
            VerdictKind::Passed | VerdictKind::Failed
        );
        let is_shown =
            line.evidence.is_some() || item.questions.iter().any(picture::asks_for_picture);
        if is_judged && is_shown {
            self.0.insert(item.id.clone(), answers);
        }
    }

    /// Returns the answer to the question with this index in the item.
    pub fn answer(&self, item: &str, question: usize) -> Option<&Answer> {
        self.0.get(item)?.get(question)
    }
}
