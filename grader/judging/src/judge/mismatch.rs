//! Mismatches: the wrong positions of a picture, from which a mask is drawn. They do not affect
//! points.

/// The first error at one position of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mismatch {
    /// The aspect that is wrong.
    pub aspect: Aspect,
    /// The error as a multiple of its tolerance: above 1, or infinite if there is no tolerance.
    /// Never NaN.
    pub deviation: f64,
}

impl Mismatch {
    /// The mismatch at a position without an answer.
    pub(super) const NO_ANSWER: Mismatch = Mismatch {
        aspect: Aspect::NoAnswer,
        deviation: f64::INFINITY,
    };
}

/// Kinds of errors at a position, the most serious first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Aspect {
    /// The answer is missing: the code panicked at the position, or the position was skipped after
    /// earlier panics.
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
    /// Returns the name for people.
    pub fn name(self) -> &'static str {
        match self {
            Aspect::NoAnswer => "no answer",
            Aspect::HitOrMiss => "hit or miss",
            Aspect::Depth => "depth",
            Aspect::Normal => "normal",
            Aspect::Uv => "uv",
            Aspect::Direction => "direction",
            Aspect::Radiance => "light",
        }
    }
}
