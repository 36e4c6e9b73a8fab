//! What is wrong where in a picture: for whoever draws a mask, never for points.

/// What is wrong first at one position of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mismatch {
    /// What of it.
    pub aspect: Aspect,
    /// How far off it is, in units of what is tolerated: above 1, infinite where nothing lies
    /// between right and wrong. Never NaN.
    pub deviation: f64,
}

impl Mismatch {
    /// Where there is no answer to be wrong.
    pub(super) const NO_ANSWER: Mismatch = Mismatch {
        aspect: Aspect::NoAnswer,
        deviation: f64::INFINITY,
    };
}

/// What can be wrong at a position, the gravest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Aspect {
    /// The code panicked there, or was not asked any more.
    NoAnswer,
    /// A hit that is none, or the other way round.
    HitOrMiss,
    /// How far along the ray the hit is.
    Depth,
    /// The surface normal.
    Normal,
    /// The texture coordinates.
    Uv,
    /// Where the camera's ray goes.
    Direction,
    /// How bright the pixel is.
    Radiance,
}
