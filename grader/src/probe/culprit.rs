//! Finds the element that crashes or hangs the program. The elements of an item are sent together,
//! so the fault doesn't identify the element that caused it.
//!
//! The result only helps to find the mistake. It doesn't affect points.

use std::io;
use std::ops::Range;
use std::time::Duration;

use judging::exam::{Item, question_subset};
use protocol::Question;

use super::{ItemLimits, Launcher, TimeUsed};

/// The time limits for each question. With correct code, most items take less time than this in
/// total, so a question that exceeds these limits is treated as hung.
const LIMITS: ItemLimits = ItemLimits {
    waiting: Duration::from_millis(300),
    ..ItemLimits::from_cpu(Duration::from_millis(100))
};
/// The CPU time limit of a process, which answers hundreds of questions.
const PROCESS_CPU: Duration = Duration::from_secs(60);

/// The element that crashes or hangs the program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Culprit {
    /// The indices of the first question that crashes or hangs a fresh program, and of the first
    /// element in that question that does so. `None` if the fault doesn't occur again.
    pub position: Option<(usize, usize)>,
    /// The time that the search took.
    pub used: TimeUsed,
}

impl Culprit {
    /// Finds the culprit in an item that made the program crash or hang.
    pub fn find(launcher: &Launcher, item: &Item) -> io::Result<Self> {
        let mut culprit = Culprit::default();
        culprit.position = culprit.search(launcher, item)?;
        Ok(culprit)
    }

    fn search(&mut self, launcher: &Launcher, item: &Item) -> io::Result<Option<(usize, usize)>> {
        let questions = item.questions.iter().map(|question| &question.question);
        let Some(number) = self.first_fault(launcher, questions.cloned())? else {
            return Ok(None);
        };
        let question = &item.questions[number].question;

        // Use two steps of about √n questions each instead of one question per element. Each step
        // ends at its first fault, because a hang uses up the entire time limit of its question.
        let mut suspects = 0..question.count();
        for length in [isqrt_up(suspects.len()), 1] {
            let parts: Vec<Range<usize>> = chunks(suspects, length).collect();
            let subsets = parts
                .iter()
                .map(|elements| question_subset(question, elements.clone()));
            match self.first_fault(launcher, subsets)? {
                Some(faulty) => suspects = parts[faulty].clone(),
                None => return Ok(None),
            }
        }
        Ok(Some((number, suspects.start)))
    }

    /// Returns the index of the first question without an answer.
    fn first_fault(
        &mut self,
        launcher: &Launcher,
        questions: impl Iterator<Item = Question>,
    ) -> io::Result<Option<usize>> {
        let mut probe = launcher.start(PROCESS_CPU)?;
        let mut faulty = None;
        for (number, question) in questions.enumerate() {
            match probe.ask([&question], LIMITS) {
                Ok(_) => {}
                // The question isn't to blame for the fault.
                Err(fault) if fault.is_doubtful() => break,
                Err(_) => {
                    faulty = Some(number);
                    break;
                }
            }
        }
        self.used += probe.take_time_used();
        Ok(faulty)
    }
}

fn chunks(range: Range<usize>, length: usize) -> impl Iterator<Item = Range<usize>> {
    let end = range.end;
    range
        .step_by(length)
        .map(move |start| start..end.min(start + length))
}

/// Returns the square root of `count`, rounded up, but at least 1.
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
