//! Answer keys: the data that [`judge`](mod@crate::judge) compares answers with.

use glam::Vec3;
use protocol::{Interval, Ray, Trace, packed};
use serde::{Deserialize, Serialize};

/// The correct answers to one question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Key {
    /// Key of a `Camera` question: one ray per sample.
    Rays {
        /// Parts of each ray that are compared.
        checks: Vec<RayCheck>,
        /// The expected directions. Every ray starts at the origin, with range `[0, ∞)`.
        #[serde(with = "packed")]
        directions: Vec<Vec3>,
    },
    /// Key of a `Shapes`, `Traverse` or `BuildAndTraverse` question with a list of rays. Every
    /// answer must be correct.
    Hits {
        /// Parts of each hit that are compared, in addition to whether there is a hit.
        checks: Vec<HitCheck>,
        /// The expected hit of each ray.
        #[serde(with = "packed")]
        hits: Vec<Option<ExpectedHit>>,
    },
    /// Key of a `BBox` question: for each query, the interval in which the ray is inside the box.
    Spans {
        /// The expected interval of each query.
        #[serde(with = "packed")]
        spans: Vec<Option<Interval>>,
    },
    /// Key of a `Build` question: properties of the tree, and optionally its cost.
    Tree {
        /// Properties to check. That the nodes form a tree is always checked.
        checks: Vec<TreeCheck>,
        /// SAH cost of the tree that an exact sweep builds by choosing the best split at every node
        /// and stopping at the same leaf size. C_trav = C_isect = 1, and areas are divided by the
        /// root's area. `None` if the cost is not checked.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        sweep_cost: Option<f64>,
    },
    /// Key of a `Shapes`, `Traverse` or `BuildAndTraverse` question with a view. Partial credit
    /// depends on the number of correct positions.
    FirstHits {
        /// The expected first hit at each position.
        #[serde(with = "packed")]
        hits: Vec<Option<Surface>>,
        /// Additional correct answers, each with the index of its position. They exist where a ray
        /// up to 1/2000 of a pixel away, along each axis, hits a different surface or none.
        #[serde(with = "packed")]
        alternatives: Vec<(u32, Option<Surface>)>,
    },
    /// Key of a `Radiance` question.
    Radiance {
        /// The expected colour of each pixel in linear RGB, row by row from the bottom.
        #[serde(with = "packed")]
        pixels: Vec<Vec3>,
        /// Maximum number of pixels that may differ by more than 1 %.
        max_wrong_pixels: u32,
    },
}

/// A check on a camera ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RayCheck {
    /// The ray starts at (0, 0, 0).
    Origin,
    /// The direction is correct, regardless of its length.
    Direction,
    /// The direction has length one.
    UnitLength,
    /// The range is `[0, ∞)`.
    Range,
}

/// A check on a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HitCheck {
    /// `Trace::distance` is correct.
    Distance,
    /// `Trace::position` is correct.
    Position,
    /// `Trace::normal` is correct after normalisation.
    Normal,
    /// `Trace::normal` has length one.
    UnitNormal,
    /// `Trace::uv` is correct, with u modulo 1.
    Uv,
    /// `Trace::origin` is correct.
    Origin,
    /// `Trace::material` is correct.
    Material,
}

/// A check on a tree. The checks are independent of each other: where a check needs correct boxes,
/// the judge computes them itself, so that a mistake costs points only once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TreeCheck {
    /// Every primitive is in exactly one leaf.
    Partition,
    /// Every box contains all primitives below its node.
    Contains,
    /// No box exceeds the union of the primitives below it by more than 1e-4 of its diagonal.
    Tight,
    /// The primitives were split: no leaf holds half of them or more.
    Split,
    /// No leaf holds more than `max_leaf_size` primitives.
    LeafSize,
    /// No node with at most `max_leaf_size` primitives was split.
    Stops,
}

impl TreeCheck {
    /// Returns the requirement as part of a sentence about the tree.
    pub fn requirement(self) -> &'static str {
        match self {
            TreeCheck::Partition => "every primitive is in exactly one leaf",
            TreeCheck::Contains => "every box contains the primitives below it",
            TreeCheck::Tight => "no box is larger than these primitives need",
            TreeCheck::Split => "no leaf holds half of the primitives",
            TreeCheck::LeafSize => "no leaf holds more than `max_leaf_size` primitives",
            TreeCheck::Stops => "nodes with at most `max_leaf_size` primitives are leaves",
        }
    }
}

/// The correct hit of one ray of a `Hits` key.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedHit {
    /// Distance along the ray.
    pub distance: f32,
    /// Position of the hit.
    pub position: Vec3,
    /// Unit surface normal at the hit.
    pub normal: Vec3,
    /// Texture coordinates at the hit.
    pub uv: glam::Vec2,
    /// Material of the primitive that was hit.
    pub material: u32,
}

impl ExpectedHit {
    /// Returns the trace with which a correct submission answers to this ray.
    pub fn to_trace(&self, ray: &Ray) -> Trace {
        Trace {
            distance: self.distance,
            position: self.position,
            normal: self.normal,
            uv: self.uv,
            origin: ray.origin,
            material: self.material,
        }
    }
}

/// The correct hit at one position of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Distance along the ray.
    pub depth: f32,
    /// Unit surface normal at the hit.
    pub normal: Vec3,
    /// Texture coordinates at the hit.
    pub uv: glam::Vec2,
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::TreeCheck;

    #[test]
    fn each_check_of_a_tree_has_a_requirement_of_its_own() {
        let checks = [
            TreeCheck::Partition,
            TreeCheck::Contains,
            TreeCheck::Tight,
            TreeCheck::Split,
            TreeCheck::LeafSize,
            TreeCheck::Stops,
        ];
        let requirements: BTreeSet<&str> = checks.map(TreeCheck::requirement).into();
        assert_eq!(requirements.len(), checks.len());
    }
}
