//! References to questions, as users write them.

use std::str::FromStr;

use judging::exam::{Exam, Item};

use crate::inputs::nearest_name::suggestion;

/// A reference to one question in an exam, such as `sphere.from_inside#7`, or to the first wrong
/// question in an item, such as `sphere.from_inside`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct QuestionRef {
    /// The item's id.
    pub item: String,
    /// The question's number, counted from 1 over all questions of the item, or `None` for the
    /// first wrong question.
    pub number: Option<usize>,
}

impl QuestionRef {
    /// Returns the exam's item with this id or, failing that, the only item whose id consists of a
    /// task and this name, such as `from_inside`.
    ///
    /// # Errors
    ///
    /// A message that lists the items the user may have meant: the items with this name in several
    /// tasks, the items of the named task, or all items.
    pub fn find_item<'a>(&self, exam: &'a Exam) -> Result<&'a Item, String> {
        let id = &self.item;
        if let Some(item) = exam.items.iter().find(|item| item.id == *id) {
            return Ok(item);
        }
        let ids = || exam.items.iter().map(|item| item.id.as_str());
        let name_of = |item: &Item| item.id.split_once('.').map(|(_, name)| name.to_owned());
        let named = exam.items.iter();
        let named: Vec<&Item> = named
            .filter(|item| name_of(item).as_ref() == Some(id))
            .collect();
        match named[..] {
            [] => {}
            [item] => return Ok(item),
            [..] => {
                let ids: Vec<&str> = named.iter().map(|item| item.id.as_str()).collect();
                let ids = ids.join(" or ");
                return Err(format!("the exam has no item `{id}` (did you mean {ids}?)"));
            }
        }
        let task = id.split('.').next().unwrap_or_default();
        let of_task = exam.items.iter().filter(|item| item.task.id() == task);
        let of_task: Vec<&str> = of_task.map(|item| item.id.as_str()).collect();
        let (whose, known) = if of_task.is_empty() {
            ("the items", ids().collect())
        } else {
            ("the items in this task", of_task)
        };
        let nearest = suggestion(id, ids());
        let known = known.join(", ");
        Err(format!(
            "the exam has no item `{id}`{nearest}; {whose} are: {known}"
        ))
    }
}

impl FromStr for QuestionRef {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (item, number) = match text.split_once('#') {
            Some((item, number)) => (item, number.parse().ok().filter(|number| *number > 0)),
            None => (text, None),
        };
        if item.is_empty() || (number.is_none() && text.contains('#')) {
            return Err(
                "expected an item, such as sphere.from_inside, or one of its questions, such as sphere.from_inside#7"
                    .to_owned(),
            );
        }
        Ok(QuestionRef {
            item: item.to_owned(),
            number,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::QuestionRef;

    #[test]
    fn parses_an_item_and_a_number_from_one() {
        let question: QuestionRef = "sphere.from_inside#7".parse().unwrap();
        assert_eq!(
            (question.item.as_str(), question.number),
            ("sphere.from_inside", Some(7))
        );
        let item: QuestionRef = "sphere.from_inside".parse().unwrap();
        assert_eq!(item.number, None);
        for bad in ["", "sphere#0", "sphere#x", "sphere#", "#", "#7"] {
            assert!(bad.parse::<QuestionRef>().is_err(), "{bad}");
        }
    }
}
