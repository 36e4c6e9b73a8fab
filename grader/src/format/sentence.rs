//! The sentences about an item for students who don't have the exam.
//!
//! When a submission's program is graded, it sees the questions. Anything that the program can
//! influence and that a student later reads could leak the questions: the text of a panic, an exit
//! code or the number of wrong answers. So the sentence about an item depends only on the item's
//! verdict. The only other thing it may contain is an item's id.

use crate::score::Verdict;

/// Returns the sentence about an item with this verdict. `by_reference` says whether the item was
/// graded with the reference's parts.
pub fn sentence(verdict: &Verdict, by_reference: bool) -> String {
    const BY_REFERENCE: &str = "graded with the reference's other files because an item that it \
                                depends on failed";
    let reason = match verdict {
        Verdict::Pass | Verdict::Pending => "",
        Verdict::Partial => "some answers are wrong",
        Verdict::Wrong => "an answer is wrong",
        Verdict::Panicked => "the code panicked",
        Verdict::Unimplemented => "the method still contains `todo!`",
        Verdict::TimedOut => "the code took too long: is there an infinite loop?",
        Verdict::OutOfMemory => "out of memory: does something grow without limit?",
        Verdict::Crashed => "the program crashed: is there infinite recursion, or a huge `static`?",
        Verdict::Protocol => "the program sent an invalid answer",
        Verdict::NotCompiled => "the file is missing or does not compile",
        Verdict::Blocked { by } => &format!("depends on {by}: fix that first"),
    };
    match (verdict, by_reference) {
        (_, false) => reason.to_owned(),
        (Verdict::Pass, true) => BY_REFERENCE.to_owned(),
        (_, true) => format!("{reason}; {BY_REFERENCE}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score::tests::verdicts;

    #[test]
    fn each_verdict_has_its_sentence() {
        let line = |verdict: &Verdict| format!("{}: {}", verdict.label(), sentence(verdict, false));
        insta::assert_snapshot!(verdicts().each_ref().map(line).join("\n"));
    }

    #[test]
    fn an_item_graded_with_the_reference_says_so() {
        let passed = sentence(&Verdict::Pass, true);
        assert!(passed.starts_with("graded with the reference's other files"));
        let wrong = sentence(&Verdict::Wrong, true);
        assert_eq!(wrong, format!("an answer is wrong; {passed}"));
    }
}
