//! All thresholds between correct and wrong answers.

use super::credit::TOLERATED_POSITIONS;
use super::first_hits::{DEPTH, NORMAL};
use super::measure::{DIRECTION, LENGTH, UV};
use super::radiance::RELATIVE_TOLERANCE;
use super::tree::{CONTAIN_TOLERANCE, FULL_MARKS_RATIO, TIGHT_TOLERANCE};

/// A threshold between correct and wrong. The steps of partial credit are not included, because
/// they separate wrong answers from other wrong answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Threshold {
    /// Distance of a hit along its ray, in a table.
    Distance,
    /// Position of a hit in a table.
    Position,
    /// Interval in which a ray is in a box, or start of a ray's range.
    Times,
    /// Origin of a ray.
    Origin,
    /// Direction of a camera ray.
    Direction,
    /// Normal of a hit in a table.
    Normal,
    /// Length of a unit direction or normal.
    UnitLength,
    /// Texture coordinates of a hit in a table.
    Uv,
    /// Depth at one position of a picture.
    PictureDepth,
    /// Normal at one position of a picture.
    PictureNormal,
    /// Texture coordinates at one position of a picture.
    PictureUv,
    /// Number of wrong positions of a picture.
    PicturePositions,
    /// Brightness of one pixel of a path-traced picture.
    Radiance,
    /// Number of wrong pixels of a path-traced picture.
    RadiancePixels,
    /// SAH cost of a tree.
    SahCost,
    /// Distance by which a box extends beyond its contents.
    BoxTooLarge,
    /// Distance by which a primitive extends beyond its box.
    BoxTooSmall,
}

impl Threshold {
    /// All thresholds: those of tables, then of pictures, then of trees.
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

    /// Returns a human-readable title.
    pub fn title(self) -> &'static str {
        match self {
            Threshold::Distance => "distance of a hit",
            Threshold::Position => "position of a hit",
            Threshold::Times => "interval in a box, start of a range",
            Threshold::Origin => "origin of a ray",
            Threshold::Direction => "direction of a camera ray",
            Threshold::Normal => "normal of a hit",
            Threshold::UnitLength => "length of a unit vector",
            Threshold::Uv => "uv of a hit",
            Threshold::PictureDepth => "depth in a picture",
            Threshold::PictureNormal => "normal in a picture",
            Threshold::PictureUv => "uv in a picture",
            Threshold::PicturePositions => "wrong positions of a picture",
            Threshold::Radiance => "radiance of a pixel",
            Threshold::RadiancePixels => "wrong pixels of a path-traced picture",
            Threshold::SahCost => "SAH cost of a tree",
            Threshold::BoxTooLarge => "excess of a box over its contents",
            Threshold::BoxTooSmall => "part of a primitive outside its box",
        }
    }

    /// Returns the value of the threshold, which corresponds to a deviation of 1.
    pub fn limit(self) -> String {
        match self {
            Threshold::Distance | Threshold::Position | Threshold::Times | Threshold::Origin => {
                format!("{LENGTH:e} of the scale")
            }
            Threshold::Direction | Threshold::Normal | Threshold::UnitLength => {
                format!("{DIRECTION:e}")
            }
            Threshold::Uv | Threshold::PictureUv => format!("{UV:e}"),
            Threshold::PictureDepth => format!("{DEPTH:e} of the scale"),
            Threshold::PictureNormal => format!("{NORMAL:e}"),
            Threshold::PicturePositions => format!("{TOLERATED_POSITIONS}, or 1e-4 of all"),
            Threshold::Radiance => format!("{RELATIVE_TOLERANCE}, relative"),
            Threshold::RadiancePixels => "set by the key".to_owned(),
            Threshold::SahCost => format!("{FULL_MARKS_RATIO} times the exact sweep's"),
            Threshold::BoxTooLarge => format!("{TIGHT_TOLERANCE:e} diagonals"),
            Threshold::BoxTooSmall => format!("{CONTAIN_TOLERANCE:e} diagonals"),
        }
    }

    /// Returns the file and constant that define the threshold, relative to
    /// `grader/judging/src/judge`, or the field of an exam's key.
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
            Threshold::PicturePositions => "credit.rs: TOLERATED_POSITIONS",
            Threshold::Radiance => "radiance.rs: RELATIVE_TOLERANCE",
            Threshold::RadiancePixels => "the exam's key: max_wrong_pixels",
            Threshold::SahCost => "tree/mod.rs: FULL_MARKS_RATIO",
            Threshold::BoxTooLarge => "tree/mod.rs: TIGHT_TOLERANCE",
            Threshold::BoxTooSmall => "tree/mod.rs: CONTAIN_TOLERANCE",
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::fs;
    use std::path::Path;

    use super::*;

    #[test]
    fn each_threshold_has_its_own_title_and_a_limit() {
        let titles: BTreeSet<&str> = Threshold::ALL.iter().map(|one| one.title()).collect();
        assert_eq!(titles.len(), Threshold::ALL.len());
        assert_eq!(Threshold::Normal.title(), "normal of a hit");
        for threshold in Threshold::ALL {
            let limit = threshold.limit();
            let is_number = limit.starts_with(|first: char| first.is_ascii_digit());
            assert!(is_number || limit == "set by the key", "{limit}");
        }
    }

    #[test]
    fn each_threshold_is_where_it_says() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/judge");
        for threshold in Threshold::ALL {
            let (place, name) = threshold.location().split_once(": ").unwrap();
            if place == "the exam's key" {
                continue;
            }
            let text = fs::read_to_string(folder.join(place)).unwrap();
            assert!(text.contains(&format!("const {name}: ")), "{place}: {name}");
        }
    }
}
