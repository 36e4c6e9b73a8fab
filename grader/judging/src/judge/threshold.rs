//! All thresholds between correct and wrong answers.

use glam::{Vec2, Vec3};
use protocol::{Color, Fraction, Interval, Ray, Record, Scattered, Trace};

use super::credit::TOLERATED_POSITIONS;
use super::first_hits::{DEPTH, NORMAL};
use super::radiance::RELATIVE_TOLERANCE;
use super::tree::{CONTAIN_TOLERANCE, FULL_MARKS_RATIO, TIGHT_TOLERANCE};
use crate::types::{self, Tolerance, direction, length, portion, uv};

/// A threshold between correct and wrong answers. The steps of partial credit aren't listed here,
/// because they only distinguish between wrong answers of different quality.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Threshold {
    /// The field with this name in a table.
    Field(&'static str, Tolerance),
    /// Length of a direction vector in a table.
    UnitLength,
    /// Depth at one position in a picture.
    PictureDepth,
    /// Normal at one position in a picture.
    PictureNormal,
    /// Texture coordinates at one position in a picture.
    PictureUv,
    /// Number of wrong positions in a picture.
    PicturePositions,
    /// Brightness of one pixel of a rendered picture.
    Radiance,
    /// Number of wrong pixels in a rendered picture.
    RadiancePixels,
    /// How unevenly directions are spread over the sphere.
    Spread,
    /// SAH cost of a tree.
    SahCost,
    /// How far a box extends beyond its contents.
    BoxTooLarge,
    /// How far a primitive extends beyond its box.
    BoxTooSmall,
}

/// The thresholds that don't belong to a single field.
const OTHER: [Threshold; 11] = [
    Threshold::UnitLength,
    Threshold::PictureDepth,
    Threshold::PictureNormal,
    Threshold::PictureUv,
    Threshold::PicturePositions,
    Threshold::Radiance,
    Threshold::RadiancePixels,
    Threshold::Spread,
    Threshold::SahCost,
    Threshold::BoxTooLarge,
    Threshold::BoxTooSmall,
];

impl Threshold {
    /// Returns all thresholds: first for fields in tables, then for pictures, then for trees.
    pub fn all() -> Vec<Threshold> {
        let trace = Trace {
            distance: 0.0,
            position: Vec3::ZERO,
            normal: Vec3::ZERO,
            uv: Vec2::ZERO,
            origin: Vec3::ZERO,
            shape: 0,
        };
        let ray = Ray::new(Vec3::ZERO, Vec3::Z);
        let scattered = Scattered {
            direction: Vec3::ZERO,
            attenuation: Vec3::ZERO,
            pdf: None,
        };
        let color = Color { value: Vec3::ZERO };
        let fraction = Fraction { fraction: 0.0 };
        let records: [&dyn Record; 6] = [
            &trace,
            &ray,
            &Interval::AHEAD,
            &scattered,
            &color,
            &fraction,
        ];
        let fields = records.into_iter().flat_map(|record| {
            let named = record.names().iter().zip(record.values());
            named.filter_map(|(name, value)| {
                Some(Threshold::Field(name, types::of(&value).tolerance()?))
            })
        });
        let mut all: Vec<Threshold> = Vec::new();
        for threshold in fields.chain(OTHER) {
            if !all.contains(&threshold) {
                all.push(threshold);
            }
        }
        all
    }

    /// Returns a human-readable title.
    pub fn title(self) -> &'static str {
        match self {
            Threshold::Field(name, _) => name,
            Threshold::UnitLength => "length of a unit vector",
            Threshold::PictureDepth => "depth in a picture",
            Threshold::PictureNormal => "normal in a picture",
            Threshold::PictureUv => "uv in a picture",
            Threshold::PicturePositions => "wrong positions in a picture",
            Threshold::Radiance => "radiance of a pixel",
            Threshold::RadiancePixels => "wrong pixels in a rendered picture",
            Threshold::Spread => "unevenness of directions (χ²)",
            Threshold::SahCost => "SAH cost of a tree",
            Threshold::BoxTooLarge => "how far a box extends beyond its contents",
            Threshold::BoxTooSmall => "how far a primitive extends beyond its box",
        }
    }

    /// Returns the threshold's value, which corresponds to a deviation of 1.
    pub fn limit(self) -> String {
        match self {
            Threshold::Field(_, Tolerance::Length) => {
                format!("{:e} of the scale", length::TOLERANCE)
            }
            Threshold::Field(_, Tolerance::Direction) | Threshold::UnitLength => {
                format!("{:e}", direction::TOLERANCE)
            }
            Threshold::Field(_, Tolerance::Uv) | Threshold::PictureUv => {
                format!("{:e}", uv::TOLERANCE)
            }
            Threshold::PictureDepth => format!("{DEPTH:e} of the scale"),
            Threshold::PictureNormal => format!("{NORMAL:e}"),
            Threshold::PicturePositions => {
                format!("{TOLERATED_POSITIONS}, or 1e-4 of all positions")
            }
            Threshold::Radiance => format!("{RELATIVE_TOLERANCE}, relative"),
            Threshold::Field(_, Tolerance::Relative) => {
                format!("{:e}, relative", portion::TOLERANCE)
            }
            Threshold::RadiancePixels | Threshold::Spread => "set by the key".to_owned(),
            Threshold::SahCost => format!("{FULL_MARKS_RATIO} times the exact sweep's"),
            Threshold::BoxTooLarge => format!("{TIGHT_TOLERANCE:e} diagonals"),
            Threshold::BoxTooSmall => format!("{CONTAIN_TOLERANCE:e} diagonals"),
        }
    }

    /// Returns the location where the threshold is defined: a constant and its file (relative to
    /// `grader/judging/src`), or a field in an exam's key.
    pub fn location(self) -> &'static str {
        match self {
            Threshold::Field(_, Tolerance::Length) => "types/length.rs: TOLERANCE",
            Threshold::Field(_, Tolerance::Direction) | Threshold::UnitLength => {
                "types/direction.rs: TOLERANCE"
            }
            Threshold::Field(_, Tolerance::Uv) | Threshold::PictureUv => "types/uv.rs: TOLERANCE",
            Threshold::PictureDepth => "judge/first_hits/mod.rs: DEPTH",
            Threshold::PictureNormal => "judge/first_hits/mod.rs: NORMAL",
            Threshold::PicturePositions => "judge/credit.rs: TOLERATED_POSITIONS",
            Threshold::Radiance => "judge/radiance.rs: RELATIVE_TOLERANCE",
            Threshold::Field(_, Tolerance::Relative) => "types/portion.rs: TOLERANCE",
            Threshold::RadiancePixels => "the exam's key: max_wrong_pixels",
            Threshold::Spread => "the exam's key: max_chi_squared",
            Threshold::SahCost => "judge/tree/mod.rs: FULL_MARKS_RATIO",
            Threshold::BoxTooLarge => "judge/tree/mod.rs: TIGHT_TOLERANCE",
            Threshold::BoxTooSmall => "judge/tree/mod.rs: CONTAIN_TOLERANCE",
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
        let titles: BTreeSet<&str> = Threshold::all().into_iter().map(Threshold::title).collect();
        assert_eq!(titles.len(), Threshold::all().len());
        for threshold in Threshold::all() {
            let limit = threshold.limit();
            let is_number = limit.starts_with(|first: char| first.is_ascii_digit());
            assert!(is_number || limit == "set by the key", "{limit}");
        }
    }

    #[test]
    fn each_threshold_is_where_it_says() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        for threshold in Threshold::all() {
            let (place, name) = threshold.location().split_once(": ").unwrap();
            if place == "the exam's key" {
                continue;
            }
            let text = fs::read_to_string(folder.join(place)).unwrap();
            assert!(text.contains(&format!("const {name}: ")), "{place}: {name}");
        }
    }
}
