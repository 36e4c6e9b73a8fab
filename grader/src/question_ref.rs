//! References to questions, as people write them.

use std::str::FromStr;

/// A reference to one question of an exam, such as `sphere.from_inside#7`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct QuestionRef {
    /// The item's id.
    pub item: String,
    /// The question's number, counted from 1 over all questions of the item.
    pub number: usize,
}

impl FromStr for QuestionRef {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parsed = text
            .split_once('#')
            .and_then(|(item, number)| Some((item, number.parse().ok()?)));
        match parsed {
            Some((item, number @ 1..)) => Ok(QuestionRef {
                item: item.to_owned(),
                number,
            }),
            _ => Err("expected an item and a number, such as sphere.from_inside#7".to_owned()),
        }
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
            ("sphere.from_inside", 7)
        );
        for bad in ["sphere.from_inside", "sphere#0", "sphere#x", "#"] {
            assert!(bad.parse::<QuestionRef>().is_err(), "{bad}");
        }
    }
}
