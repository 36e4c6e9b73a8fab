//! The sentences that students read about the items of an exam that they do not have.
//!
//! When a submission's program is graded, it sees the questions. Whatever it chooses and a student
//! reads later could therefore carry questions out: the text of a panic, an exit code, the number
//! of wrong answers. So the sentence about an item follows from its verdict alone, and contains
//! nothing else but the id of an item of the exam.

use std::fmt;

use crate::policy::Visibility;
use crate::score::Verdict;

/// The part of an item's result that students may read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Disclosure<'a> {
    /// Everything, including what the submission's program wrote.
    Everything,
    /// The points, the exam's own texts, and a sentence.
    Feedback(Sentence<'a>),
    /// The title and the points.
    Points,
}

impl<'a> Disclosure<'a> {
    /// Returns what students may read about an item with this verdict. `by_reference` says whether
    /// it was graded with the reference's parts.
    pub fn new(verdict: &'a Verdict, by_reference: bool, visibility: Visibility) -> Self {
        match visibility {
            Visibility::All => Disclosure::Everything,
            Visibility::Feedback | Visibility::AfterDue | Visibility::AfterPublished => {
                Disclosure::Feedback(Sentence::new(verdict, by_reference))
            }
            Visibility::Points | Visibility::Hidden => Disclosure::Points,
        }
    }
}

/// A sentence about an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sentence<'a> {
    verdict: &'a Verdict,
    by_reference: bool,
}

impl<'a> Sentence<'a> {
    /// Returns the sentence about an item with this verdict. `by_reference` says whether it was
    /// graded with the reference's parts.
    pub fn new(verdict: &'a Verdict, by_reference: bool) -> Self {
        Sentence {
            verdict,
            by_reference,
        }
    }

    /// Writes the reason why the item has its points.
    fn write_reason(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self.verdict {
            Verdict::Pass | Verdict::Pending => "",
            Verdict::Partial => "some answers are wrong",
            Verdict::Wrong => "an answer is wrong",
            Verdict::Panicked => "the code panicked",
            Verdict::Unimplemented => "the method still contains `todo!`",
            Verdict::TimedOut => "the code took too long: is there an endless loop?",
            Verdict::OutOfMemory => "out of memory: does something grow without limit?",
            Verdict::Crashed => {
                "the program crashed: is there an endless recursion, or a huge `static`?"
            }
            Verdict::Protocol => "the program sent an invalid answer",
            Verdict::NotCompiled => "the file is missing or does not compile",
            Verdict::Blocked { by } => return write!(f, "depends on {by}: fix that first"),
        })
    }
}

impl fmt::Display for Sentence<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        const BY_REFERENCE: &str = "graded with the reference's other files, because an item that \
                                    it depends on failed";
        self.write_reason(f)?;
        match (self.verdict, self.by_reference) {
            (_, false) => Ok(()),
            (Verdict::Pass, true) => f.write_str(BY_REFERENCE),
            (_, true) => write!(f, "; {BY_REFERENCE}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score::tests::verdicts;

    #[test]
    fn each_verdict_has_its_sentence() {
        let line = |verdict: &Verdict| {
            let sentence = Sentence::new(verdict, false);
            format!("{}: {sentence}", verdict.label())
        };
        insta::assert_snapshot!(verdicts().each_ref().map(line).join("\n"));
    }

    #[test]
    fn an_item_graded_with_the_reference_says_so() {
        let sentence = |verdict| Sentence::new(verdict, true).to_string();
        let passed = sentence(&Verdict::Pass);
        assert!(passed.starts_with("graded with the reference's other files"));
        let wrong = sentence(&Verdict::Wrong);
        assert_eq!(wrong, format!("an answer is wrong; {passed}"));
    }
}
