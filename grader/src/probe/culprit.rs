//! Which element of an item it is that has no answer: an item is asked in one go, and when the
//! program ends or hangs, all that is known is that one of them did it.
//!
//! For whoever looks for the mistake; no point hangs on it.

use std::io;
use std::ops::Range;
use std::time::Duration;

use protocol::Question;

use super::subset::subset;
use super::{Budget, Launcher};
use crate::exam::Item;

/// Most honest items take less in all, so a single element of one that takes so long hangs.
const BUDGET: Budget = Budget {
    cpu: Duration::from_millis(250),
};

/// The question and the first element of it that end or hang a fresh program, if they still do
/// when they are asked alone.
pub fn culprit(launcher: &Launcher, item: &Item) -> io::Result<Option<(usize, usize)>> {
    let questions = item.questions.iter().map(|asked| &asked.question);
    let Some(number) = first_fault(launcher, questions.clone().cloned())? else {
        return Ok(None);
    };
    let question = &item.questions[number].question;

    // In two steps, each of which meets one fault: a hang costs its whole budget.
    let mut within = 0..question.count();
    for length in [isqrt_up(within.len()), 1] {
        let parts: Vec<Range<usize>> = chunks(within, length).collect();
        let asked = parts
            .iter()
            .map(|elements| subset(question, elements.clone()));
        match first_fault(launcher, asked)? {
            Some(faulty) => within = parts[faulty].clone(),
            None => return Ok(None),
        }
    }
    Ok(Some((number, within.start)))
}

/// The first of these that has no answer.
fn first_fault(
    launcher: &Launcher,
    questions: impl Iterator<Item = Question>,
) -> io::Result<Option<usize>> {
    let mut probe = launcher.start(BUDGET)?;
    for (number, question) in questions.enumerate() {
        if probe.ask([&question], BUDGET).is_err() {
            return Ok(Some(number));
        }
    }
    Ok(None)
}

fn chunks(range: Range<usize>, length: usize) -> impl Iterator<Item = Range<usize>> {
    let end = range.end;
    range
        .step_by(length)
        .map(move |start| start..end.min(start + length))
}

/// The square root, rounded up; 1 for nothing.
fn isqrt_up(count: usize) -> usize {
    count.saturating_sub(1).isqrt() + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_cover_the_range() {
        let parts: Vec<_> = chunks(3..10, 3).collect();
        assert_eq!(parts, [3..6, 6..9, 9..10]);
        assert_eq!([0, 1, 2, 4, 5, 9, 10].map(isqrt_up), [1, 1, 2, 2, 3, 3, 4]);
    }
}
