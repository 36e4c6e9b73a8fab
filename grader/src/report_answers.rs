//! What a page can show of an item beside its line in the score: the answers themselves. They are
//! not for the score file, which is read by programs and shall stay small.

use std::collections::BTreeMap;

use protocol::Answer;

use crate::exam::Item;
use crate::picture;
use crate::score::{ItemScore, Verdict};

/// The answers to whole items, by the items' ids.
#[derive(Clone, Debug, Default)]
pub struct ReportAnswers(BTreeMap<String, Vec<Answer>>);

impl ReportAnswers {
    /// Keeps the answers that `line` speaks of, if there is something to be seen in them.
    pub fn record(&mut self, item: &Item, line: &ItemScore, answers: Vec<Answer>) {
        let is_judged = match line.verdict {
            Verdict::Pass | Verdict::Partial | Verdict::Wrong | Verdict::Panicked => true,
            Verdict::Unimplemented
            | Verdict::TimedOut
            | Verdict::OutOfMemory
            | Verdict::Crashed
            | Verdict::Protocol
            | Verdict::NotCompiled
            | Verdict::Blocked { .. }
            | Verdict::Pending => false,
        };
        let is_shown =
            line.evidence.is_some() || item.questions.iter().any(picture::asks_for_picture);
        if is_judged && is_shown {
            self.0.insert(item.id.clone(), answers);
        }
    }

    /// The answer to one question of an item, counted from 0.
    pub fn answer(&self, item: &str, question: usize) -> Option<&Answer> {
        self.0.get(item)?.get(question)
    }
}
