//! Every number of the exam that stands between right and wrong.

use super::credit::TOLERATED_POSITIONS;
use super::first_hits::{DEPTH, NORMAL};
use super::measure::{DIRECTION, LENGTH, UV};
use super::radiance::RELATIVE_TOLERANCE;
use super::tree::{CONTAIN_TOLERANCE, FULL_MARKS_RATIO, TIGHT_TOLERANCE};

/// What an answer is held against. The steps of partial credit are not among them: they stand
/// between wrong and wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Threshold {
    /// How far along its ray a hit of a table is.
    Distance,
    /// Where a hit of a table is.
    Position,
    /// When a ray is in a box, or begins to count.
    Times,
    /// Where a ray starts.
    Origin,
    /// Where a camera's ray goes.
    Direction,
    /// Where the normal of a hit of a table points.
    Normal,
    /// How long a direction or a normal is.
    UnitLength,
    /// The texture coordinates of a hit of a table.
    Uv,
    /// The depth at one position of a picture.
    PictureDepth,
    /// The normal there.
    PictureNormal,
    /// The texture coordinates there.
    PictureUv,
    /// How many positions of a picture are wrong.
    PicturePositions,
    /// How bright one pixel of the path-traced picture is.
    Radiance,
    /// How many of its pixels are not.
    RadiancePixels,
    /// What a tree costs.
    SahCost,
    /// How far a box exceeds what it holds.
    BoxTooLarge,
    /// How far a primitive sticks out of its box.
    BoxTooSmall,
}

impl Threshold {
    /// All of them, from tables over pictures to trees.
    pub const ALL: [Threshold; 17] = [
        Threshold::Distance,
        Threshold::Position,
        Threshold::Times,
        Threshold::Origin,
        Threshold::Direction,
        Threshold::Normal,
        Threshold::UnitLength,
        Threshold::Uv,
        Threshold::PictureDepth,
        Threshold::PictureNormal,
        Threshold::PictureUv,
        Threshold::PicturePositions,
        Threshold::Radiance,
        Threshold::RadiancePixels,
        Threshold::SahCost,
        Threshold::BoxTooLarge,
        Threshold::BoxTooSmall,
    ];

    /// What people read.
    pub fn title(self) -> &'static str {
        match self {
            Threshold::Distance => "distance of a hit",
            Threshold::Position => "position of a hit",
            Threshold::Times => "times in a box, start of a range",
            Threshold::Origin => "origin of a ray",
            Threshold::Direction => "direction of a camera's ray",
            Threshold::Normal => "normal of a hit",
            Threshold::UnitLength => "length of what should have length one",
            Threshold::Uv => "uv of a hit",
            Threshold::PictureDepth => "depth in a picture",
            Threshold::PictureNormal => "normal in a picture",
            Threshold::PictureUv => "uv in a picture",
            Threshold::PicturePositions => "wrong positions of a picture",
            Threshold::Radiance => "radiance of a pixel",
            Threshold::RadiancePixels => "pixels of wrong radiance",
            Threshold::SahCost => "SAH cost of a tree",
            Threshold::BoxTooLarge => "how far a box exceeds what it holds",
            Threshold::BoxTooSmall => "how far a primitive sticks out of its box",
        }
    }

    /// Its value: what 1 is a multiple of.
    pub fn limit(self) -> String {
        match self {
            Threshold::Distance | Threshold::Position | Threshold::Times | Threshold::Origin => {
                format!("{LENGTH:e}, relative above 1")
            }
            Threshold::Direction | Threshold::Normal | Threshold::UnitLength => {
                format!("{DIRECTION:e}")
            }
            Threshold::Uv | Threshold::PictureUv => format!("{UV:e}"),
            Threshold::PictureDepth => format!("{DEPTH:e}, relative above 1"),
            Threshold::PictureNormal => format!("{NORMAL:e}"),
            Threshold::PicturePositions => format!("{TOLERATED_POSITIONS}, or 1e-4 of all"),
            Threshold::Radiance => format!("{RELATIVE_TOLERANCE}, relative"),
            Threshold::RadiancePixels => "as the key allows".to_owned(),
            Threshold::SahCost => format!("{FULL_MARKS_RATIO} times the exact sweep's"),
            Threshold::BoxTooLarge => format!("{TIGHT_TOLERANCE:e} diagonals"),
            Threshold::BoxTooSmall => format!("{CONTAIN_TOLERANCE:e} diagonals"),
        }
    }

    /// Where it can be changed, below `grader/judging/src/judge`, or in an exam.
    pub fn location(self) -> &'static str {
        match self {
            Threshold::Distance | Threshold::Position | Threshold::Times | Threshold::Origin => {
                "measure.rs: LENGTH"
            }
            Threshold::Direction | Threshold::Normal | Threshold::UnitLength => {
                "measure.rs: DIRECTION"
            }
            Threshold::Uv | Threshold::PictureUv => "measure.rs: UV",
            Threshold::PictureDepth => "first_hits/mod.rs: DEPTH",
            Threshold::PictureNormal => "first_hits/mod.rs: NORMAL",
            Threshold::PicturePositions => "share.rs: STRAGGLERS",
            Threshold::Radiance => "radiance.rs: RELATIVE",
            Threshold::RadiancePixels => "the exam's key: allowed",
            Threshold::SahCost => "tree/mod.rs: FULL",
            Threshold::BoxTooLarge => "tree/mod.rs: LOOSE",
            Threshold::BoxTooSmall => "tree/mod.rs: ROUNDING",
        }
    }
}
