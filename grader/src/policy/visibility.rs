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
    /// The points, what went wrong, and hints. No questions or answers, from which students could
    /// reconstruct the exam, and nothing that the submission's program wrote or chose.
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
    /// Returns what students see of an item of this exam.
    pub fn visibility(&self, exam: &ExamName, item: &str) -> Visibility {
        let task = item.split('.').next().unwrap_or(item);
        let exceptions = &self.visibility.items;
        let exception = exceptions.get(item).or_else(|| exceptions.get(task));
        exception.copied().unwrap_or(match exam.id.as_str() {
            PRACTICE_ID => self.visibility.practice,
            _ => self.visibility.other_exams,
        })
    }

    /// Returns an exception that matches neither a task nor an item, if there is one.
    pub(super) fn unmatched_exception<'a>(
        &self,
        items: impl Iterator<Item = &'a str> + Clone,
    ) -> Option<&str> {
        let matches = |name: &str, item: &str| {
            item == name || item.split('.').next().is_some_and(|task| task == name)
        };
        let mut names = self.visibility.items.keys();
        names
            .find(|name| !items.clone().any(|item| matches(name, item)))
            .map(String::as_str)
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
    fn answers_are_shown_only_for_the_practice_exam_by_default() {
        assert_eq!(of("", "practice", "bbox.flat"), Visibility::All);
        assert_eq!(of("", "final", "bbox.flat"), Visibility::Feedback);
    }

    #[test]
    fn item_exception_overrides_task_exception() {
        let policy = "[visibility.items]\nbbox = 'points'\n'bbox.flat' = 'hidden'";
        assert_eq!(of(policy, "final", "bbox.flat"), Visibility::Hidden);
        assert_eq!(of(policy, "final", "bbox.inside"), Visibility::Points);
        assert_eq!(of(policy, "final", "sphere.miss"), Visibility::Feedback);
    }

    #[test]
    fn reports_an_exception_that_matches_nothing() {
        let policy = "[visibility.items]\nbbox = 'points'\n'bbox.flat' = 'hidden'";
        let policy: Policy = toml::from_str(policy).unwrap();
        let items = ["bbox.flat", "sphere.miss"];
        assert_eq!(policy.unmatched_exception(items.into_iter()), None);
        assert_eq!(
            policy.unmatched_exception(["bbox.x"].into_iter()),
            Some("bbox.flat")
        );
    }

    #[test]
    fn only_what_is_not_hidden_is_shown_now() {
        for shown in [Visibility::All, Visibility::Feedback, Visibility::Points] {
            assert!(shown.is_shown_now(), "{shown:?}");
        }
        for hidden in [
            Visibility::AfterDue,
            Visibility::AfterPublished,
            Visibility::Hidden,
        ] {
            assert!(!hidden.is_shown_now(), "{hidden:?}");
        }
    }
}
