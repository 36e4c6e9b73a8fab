//! The visibility of an item's results to students.

use judging::exam_file::ExamName;
use serde::Deserialize;

use crate::inputs::exam_source::PRACTICE_ID;
use crate::policy::Policy;

/// The part of an item that students see, from everything to nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Visibility {
    /// The question, the submission's answer and the expected answer.
    All,
    /// The points, the kind of failure, and hints. Questions and answers are left out, since
    /// students could reconstruct the exam from them. Everything that the submission's program
    /// wrote or chose is left out too.
    Feedback,
    /// Title and points.
    Points,
    /// Hidden until the late due date.
    AfterDue,
    /// Hidden until grades are published.
    AfterPublished,
    /// Always hidden.
    Hidden,
}

impl Visibility {
    /// Returns whether students see the item as soon as it is graded.
    pub fn is_shown_now(self) -> bool {
        match self {
            Visibility::All | Visibility::Feedback | Visibility::Points => true,
            Visibility::AfterDue | Visibility::AfterPublished | Visibility::Hidden => false,
        }
    }
}

impl Policy {
    /// Returns how much of an item in this exam students see.
    pub fn visibility(&self, exam: &ExamName, item: &str) -> Visibility {
        let task = item.split('.').next().unwrap_or(item);
        let exceptions = &self.visibility.items;
        let exception = exceptions.get(item).or_else(|| exceptions.get(task));
        exception.copied().unwrap_or(match exam.id.as_str() {
            PRACTICE_ID => self.visibility.practice,
            _ => self.visibility.other_exams,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(policy: &str, exam: &str, item: &str) -> Visibility {
        let exam = ExamName {
            id: exam.to_owned(),
            hash: String::new(),
        };
        let policy: Policy = toml::from_str(policy).unwrap();
        policy.visibility(&exam, item)
    }

    #[test]
    fn an_exception_for_an_item_counts_before_one_for_its_task_and_before_the_exams() {
        let exceptions = "[visibility.items]\nbbox = 'points'\n'bbox.flat' = 'hidden'";
        for (policy, exam, item, visibility) in [
            ("", "practice", "bbox.flat", Visibility::All),
            ("", "final", "bbox.flat", Visibility::Feedback),
            (exceptions, "final", "bbox.flat", Visibility::Hidden),
            (exceptions, "final", "bbox.inside", Visibility::Points),
            (exceptions, "final", "sphere.miss", Visibility::Feedback),
        ] {
            assert_eq!(of(policy, exam, item), visibility, "{exam}, {item}");
        }
    }

    #[test]
    fn only_what_is_not_hidden_is_shown_now() {
        use Visibility::{AfterDue, AfterPublished, All, Feedback, Hidden, Points};
        let is_shown = |all: [Visibility; 3]| all.map(Visibility::is_shown_now);
        assert_eq!(is_shown([All, Feedback, Points]), [true; 3]);
        assert_eq!(is_shown([AfterDue, AfterPublished, Hidden]), [false; 3]);
    }
}
