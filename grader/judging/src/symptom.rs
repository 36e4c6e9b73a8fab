//! Symptoms: the quantity that is wrong in an answer, and whether it is too small or too large.
//! Advice is chosen by symptom.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

/// The name of the quantity that says whether a ray hits anything.
pub const PRESENCE: &str = "hit or miss";
/// The name of the quantity that says whether a function that isn't about hits returns a value.
pub const SOME_OR_NONE: &str = "`Some` or `None`";
/// The name of the quantity that says how evenly directions are spread.
pub const SPREAD: &str = "spread";

/// A wrong quantity, and the side on which it is wrong. In the data of an assignment or an item, a
/// symptom without a side stands for any answer that is neither reversed nor NaN.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Symptom {
    /// The quantity, such as `distance`, `hit or miss` or `box too small`.
    pub what: Cow<'static, str>,
    /// The side, for a quantity that has two sides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side: Option<Side>,
}

/// Whether a quantity is too small, too large, reversed or not a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The answer is too small or is missing.
    Less,
    /// The answer is too large, or there should be none.
    More,
    /// The answer is 0, and the expected answer is positive.
    Zero,
    /// The answer is positive, and the expected answer is 0.
    NotZero,
    /// The answer is the opposite direction.
    Reversed,
    /// The answer is NaN, or a vector that contains NaN.
    NotANumber,
}

impl Symptom {
    /// A miss where a hit is expected.
    pub const MISS: Symptom = Symptom::less(PRESENCE);
    /// A hit where a miss is expected.
    pub const HIT: Symptom = Symptom::more(PRESENCE);

    /// Creates the symptom of a quantity that is wrong on either side.
    pub const fn of(what: &'static str) -> Self {
        Symptom {
            what: Cow::Borrowed(what),
            side: None,
        }
    }

    /// Creates the symptom of a quantity that is too small or missing.
    pub const fn less(what: &'static str) -> Self {
        Symptom {
            side: Some(Side::Less),
            what: Cow::Borrowed(what),
        }
    }

    /// Creates the symptom of a quantity that is too large or shouldn't be there.
    pub const fn more(what: &'static str) -> Self {
        Symptom {
            side: Some(Side::More),
            what: Cow::Borrowed(what),
        }
    }

    /// Creates the symptom of a quantity that is 0 where it should be positive.
    pub const fn zero(what: &'static str) -> Self {
        Symptom {
            side: Some(Side::Zero),
            what: Cow::Borrowed(what),
        }
    }

    /// Creates the symptom of a quantity that is positive where it should be 0.
    pub const fn not_zero(what: &'static str) -> Self {
        Symptom {
            side: Some(Side::NotZero),
            what: Cow::Borrowed(what),
        }
    }

    /// Returns whether the answer is 0 and shouldn't be, or the other way round.
    pub fn is_about_zero(&self) -> bool {
        matches!(self.side, Some(Side::Zero | Side::NotZero))
    }

    /// Creates the symptom of a direction that points the opposite way.
    pub const fn reversed(what: &'static str) -> Self {
        Symptom {
            side: Some(Side::Reversed),
            what: Cow::Borrowed(what),
        }
    }

    /// Returns whether this symptom, which comes from an assignment's or an item's data, covers the
    /// observed symptom.
    pub fn includes(&self, observed: &Symptom) -> bool {
        let is_side = match self.side {
            Some(Side::Less) => matches!(observed.side, Some(Side::Less | Side::Zero)),
            Some(Side::More) => matches!(observed.side, Some(Side::More | Side::NotZero)),
            Some(Side::Zero | Side::NotZero | Side::Reversed | Side::NotANumber) => {
                self.side == observed.side
            }
            None => !matches!(observed.side, Some(Side::Reversed | Side::NotANumber)),
        };
        self.what == observed.what && is_side
    }
}

impl Side {
    /// Returns the side for an answer that is present when it shouldn't be, or missing when it
    /// should be present.
    pub fn of_presence(is_there: bool) -> Self {
        if is_there { Side::More } else { Side::Less }
    }

    /// Returns the side on which an amount is wrong. Amounts are never negative: a density, a fraction
    /// or the light in a colour.
    pub fn of_amount(got: f32, wanted: f32) -> Option<Self> {
        let side = Side::of(got, wanted)?;
        Some(if side == Side::Less && got == 0.0 {
            Side::Zero
        } else if side == Side::More && wanted == 0.0 {
            Side::NotZero
        } else {
            side
        })
    }

    /// Returns the side on which a value is wrong, or `None` if it equals the expected value.
    pub fn of(got: f32, wanted: f32) -> Option<Self> {
        if got.is_nan() {
            Some(Side::NotANumber)
        } else if got < wanted {
            Some(Side::Less)
        } else if got > wanted {
            Some(Side::More)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_amount_that_is_or_should_be_zero_is_a_side_of_its_own() {
        for (got, wanted, side) in [
            (0.0, 2.0, Side::Zero),
            (2.0, 0.0, Side::NotZero),
            (1.0, 2.0, Side::Less),
            (-1.0, 0.0, Side::Less),
            (2.0, 1.0, Side::More),
            (f32::NAN, 0.0, Side::NotANumber),
        ] {
            assert_eq!(Side::of_amount(got, wanted), Some(side), "{got}, {wanted}");
        }
        assert_eq!(Side::of_amount(0.0, 0.0), None);
        // Zero is also too small.
        assert!(Symptom::less("pdf").includes(&Symptom::zero("pdf")));
        assert!(Symptom::of("pdf").includes(&Symptom::zero("pdf")));
        assert!(Symptom::more("pdf").includes(&Symptom::not_zero("pdf")));
        assert!(!Symptom::more("pdf").includes(&Symptom::zero("pdf")));
        assert!(!Symptom::zero("pdf").includes(&Symptom::less("pdf")));
    }
}
