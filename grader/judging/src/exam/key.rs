//! What counts as right: data, compared by `judge`.

use glam::Vec3;
use protocol::{Interval, packed};
use serde::{Deserialize, Serialize};

/// What counts as right for one question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Key {
    /// To `Camera`: a ray for each sample.
    Rays {
        /// What is compared.
        #[serde(alias = "judged")]
        checks: Vec<RayCheck>,
        /// The direction of each; every ray starts at the origin, with range `[0, ∞)`.
        #[serde(with = "packed")]
        directions: Vec<Vec3>,
    },
    /// To `Shapes`, `Traverse`, `BuildAndTraverse` with a list of rays: all must be right.
    Hits {
        /// What is compared, beside whether there is a hit at all.
        #[serde(alias = "judged")]
        checks: Vec<HitCheck>,
        /// For each ray.
        #[serde(with = "packed")]
        hits: Vec<Option<ExpectedHit>>,
    },
    /// To `BBox`: the times inside, for each shot.
    Spans {
        /// For each shot.
        #[serde(with = "packed")]
        spans: Vec<Option<Interval>>,
    },
    /// To `Build`: the tree's structure, and its cost if one is given.
    Tree {
        /// What is compared, beside that the nodes form a tree at all.
        #[serde(alias = "judged")]
        checks: Vec<TreeCheck>,
        /// Of the best partition at every node, by an exact sweep that stops at the same leaf
        /// size: C_trav = C_isect = 1, areas divided by the root's.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        sweep_cost: Option<f64>,
    },
    /// To `Shapes`, `Traverse`, `BuildAndTraverse` with a view: partial credit by counting.
    FirstHits {
        /// What is right for each position.
        #[serde(with = "packed")]
        hits: Vec<Option<Surface>>,
        /// What is right as well, at positions where a neighbour less than 1/1000 of a pixel away
        /// sees something else.
        #[serde(with = "packed")]
        #[serde(alias = "also")]
        alternatives: Vec<(u32, Option<Surface>)>,
    },
    /// To `Radiance`.
    Radiance {
        /// Linear red, green and blue, row by row from the bottom.
        #[serde(with = "packed")]
        pixels: Vec<Vec3>,
        /// The most pixels that may be off by more than 1 %.
        #[serde(alias = "allowed")]
        max_wrong_pixels: u32,
    },
}

/// What can be compared of a camera's ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RayCheck {
    /// It starts at (0, 0, 0).
    Origin,
    /// It goes the right way, whatever its length.
    Direction,
    /// Its direction has length one.
    UnitLength,
    /// It counts from 0 to ∞.
    Range,
}

/// What can be compared of a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HitCheck {
    /// `Trace::distance`
    Distance,
    /// `Trace::position`
    Position,
    /// `Trace::normal`, after normalising.
    Normal,
    /// That `Trace::normal` has length one.
    UnitNormal,
    /// `Trace::uv`, u modulo 1.
    Uv,
    /// `Trace::origin`
    Origin,
    /// `Trace::material`
    Material,
}

/// What can be asked of a tree. Each part is judged by itself, on boxes that the judge computes
/// where it needs right ones, so that one mistake costs once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TreeCheck {
    /// Every primitive is in exactly one leaf.
    Partition,
    /// Every box holds all primitives below its node.
    Contains,
    /// No box exceeds the union of the primitives below by more than 1e-4 of its diagonal.
    Tight,
    /// The primitives were split at all: no leaf holds half of them or more.
    Split,
    /// No leaf holds more than `max_leaf_size` primitives.
    LeafSize,
    /// No node with at most `max_leaf_size` primitives was split.
    Stops,
}

/// The true answer to one ray of a table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedHit {
    /// Along the ray.
    pub distance: f32,
    /// The point there.
    pub position: Vec3,
    /// The surface normal there, of length one.
    pub normal: Vec3,
    /// The texture coordinates there.
    pub uv: glam::Vec2,
    /// The material of what was hit.
    pub material: u32,
}

/// The true answer at one position of a picture: depth, normal, texture coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Along the ray.
    pub depth: f32,
    /// The surface normal there, of length one.
    pub normal: Vec3,
    /// The texture coordinates there.
    pub uv: glam::Vec2,
}
