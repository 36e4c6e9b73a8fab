//! How people name one question.

use std::str::FromStr;

/// One question of an exam: `sphere.from_inside#7`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct QuestionRef {
    /// The item's id.
    pub item: String,
    /// Counted from 1 over all questions of the item.
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
            _ => Err("an item and a number are meant, such as sphere.from_inside#7".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::QuestionRef;

    #[test]
    fn parses_an_item_and_a_number_from_one() {
        let place: QuestionRef = "sphere.from_inside#7".parse().unwrap();
        assert_eq!(
            (place.item.as_str(), place.number),
            ("sphere.from_inside", 7)
        );
        for bad in ["sphere.from_inside", "sphere#0", "sphere#x", "#"] {
            assert!(bad.parse::<QuestionRef>().is_err(), "{bad}");
        }
    }
}
