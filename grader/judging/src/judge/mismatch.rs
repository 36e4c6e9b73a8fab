//! Wrong positions of a picture, for drawing a mask. They do not affect points.

/// The first error at one position of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mismatch {
    /// The wrong aspect.
    pub aspect: Aspect,
    /// The error as a multiple of its tolerance: above 1, or infinite if there is no tolerance.
    /// Never NaN.
    pub deviation: f64,
}

impl Mismatch {
    /// There is no answer at the position.
    pub(super) const NO_ANSWER: Mismatch = Mismatch {
        aspect: Aspect::NoAnswer,
        deviation: f64::INFINITY,
    };
}

/// Kinds of errors at a position, the most serious first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Aspect {
    /// The code panicked there, or the position was skipped after earlier panics.
    NoAnswer,
    /// A hit instead of a miss, or a miss instead of a hit.
    HitOrMiss,
    /// Distance of the hit along the ray.
    Depth,
    /// The surface normal.
    Normal,
    /// The texture coordinates.
    Uv,
    /// Direction of the camera ray.
    Direction,
    /// Brightness of the pixel.
    Radiance,
}
