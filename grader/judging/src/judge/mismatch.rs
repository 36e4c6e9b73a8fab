//! Mismatches: the wrong positions of a picture, used to draw its mask. They don't affect points.

use arrayvec::ArrayVec;

use super::Deviation;
use crate::symptom::PRESENCE;

/// The first error at one position of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mismatch {
    /// The aspect that is wrong.
    pub aspect: Aspect,
    /// The error as a multiple of its tolerance: above 1, or infinite if there is no tolerance.
    /// Never NaN.
    pub deviation: f64,
}

/// The deviations at one position of a picture, or `None` if the answer is missing.
pub(super) type Position = Option<ArrayVec<(Aspect, Deviation), 4>>;

impl Mismatch {
    /// Returns the first error at a position, if any.
    pub(super) fn first_at(position: &Position) -> Option<Self> {
        let Some(deviations) = position else {
            return Some(Mismatch {
                aspect: Aspect::NoAnswer,
                deviation: f64::INFINITY,
            });
        };
        let wrong = deviations.iter().find(|(_, one)| !one.is_right());
        wrong.map(|&(aspect, Deviation { value, .. })| Mismatch {
            aspect,
            deviation: value,
        })
    }
}

/// Kinds of errors at a position, the most serious first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Aspect {
    /// The answer is missing because the code panicked at this position, or the position was
    /// skipped after earlier panics.
    NoAnswer,
    /// The answer is a hit instead of a miss, or a miss instead of a hit.
    HitOrMiss,
    /// The distance to the hit along the ray is wrong.
    Depth,
    /// The surface normal is wrong.
    Normal,
    /// The texture coordinates are wrong.
    Uv,
    /// The direction of the camera ray is wrong.
    Direction,
    /// The radiance of the pixel is wrong.
    Radiance,
}

impl Aspect {
    /// Returns the human-readable name.
    pub fn name(self) -> &'static str {
        match self {
            Aspect::NoAnswer => "no answer",
            Aspect::HitOrMiss => PRESENCE,
            Aspect::Depth => "depth",
            Aspect::Normal => "normal",
            Aspect::Uv => "uv",
            Aspect::Direction => "direction",
            Aspect::Radiance => "light",
        }
    }
}
