//! References to questions, as people write them.

use std::str::FromStr;

/// A reference to one question of an exam, such as `sphere.from_inside#7`, or to the first wrong
/// question of an item, such as `sphere.from_inside`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct QuestionRef {
    /// The item's id.
    pub item: String,
    /// The question's number, counted from 1 over all questions of the item, or `None` for the
    /// first wrong question.
    pub number: Option<usize>,
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
                "expected an item, such as sphere.from_inside, or one of its questions, \
                        such as sphere.from_inside#7"
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
