//! Aspects of the tree that an exact sweep builds.

use glam::DVec3;

use super::BuildCall;
use crate::domains::Aspect;
use crate::domains::fields::class_up_to;
use crate::oracle::bbox::Bounds;
use crate::oracle::{scan, sweep};

/// How far the centres extend along the axis of the best split.
pub const BEST_AXIS: Aspect<BuildCall> = Aspect {
    name: "extent along the axis of the best split",
    classes: &[
        "the longest",
        "more than a tenth of the longest",
        "more than a hundredth",
        "less than a hundredth",
        "more than a tenth, with 8 or fewer primitives",
        "less than a tenth, with 8 or fewer primitives",
        "not the longest, with over 1,100 primitives",
        "less than a thousandth",
    ],
    class: |call| {
        let (extents, axis) = extents_and_best_axis(call)?;
        let part = extents[axis] / extents.max_element();
        Some(match (call.shapes.len(), part) {
            (_, 1.0..) => 0,
            (_, ..1e-3) => 7,
            (..=8, 0.1..) => 4,
            (..=8, _) => 5,
            (1100.., _) => 6,
            (_, 0.1..) => 1,
            (_, 0.01..) => 2,
            (_, _) => 3,
        })
    },
};

/// The rank of the axis of the best split, by how far the centres extend along it.
pub const RANK: Aspect<BuildCall> = Aspect {
    name: "axis of the best split",
    classes: &[
        "the longest",
        "the second longest",
        "the shortest",
        "the shortest, with over 100 primitives",
    ],
    class: |call| {
        let (extents, axis) = extents_and_best_axis(call)?;
        let all = extents.to_array();
        let rank = all.iter().filter(|&&other| other > extents[axis]).count();
        Some(rank + usize::from(rank == 2 && call.shapes.len() > 100))
    },
};

/// Returns how far the centres extend along each axis, and the axis of the best split. Returns
/// `None` if all primitives fit into one leaf.
fn extents_and_best_axis(call: &BuildCall) -> Option<(DVec3, usize)> {
    let boxes: Vec<Bounds> = call.shapes.iter().map(scan::bounds).collect();
    if boxes.len() <= call.max_leaf_size as usize {
        return None;
    }
    let centers = Bounds::around(boxes.iter().map(Bounds::center));
    Some((centers.max - centers.min, sweep::best_axis(&boxes)?))
}

/// The number of levels of the tree.
pub const LEVELS: Aspect<BuildCall> = Aspect {
    name: "levels",
    classes: &["1", "2 to 8", "9 to 20", "21 or more"],
    class: |call| {
        let boxes: Vec<Bounds> = call.shapes.iter().map(scan::bounds).collect();
        let levels = sweep::levels(&boxes, call.max_leaf_size as usize);
        (!boxes.is_empty()).then(|| class_up_to(&[1, 8, 20], levels))
    },
};

/// The number of primitives on the smaller side of the best split.
pub const SMALLER_SIDE: Aspect<BuildCall> = Aspect {
    name: "smaller side of the best split",
    classes: &["less than a sixteenth", "more"],
    class: |call| {
        /// The aspect applies only if there are at least this many primitives.
        const LEAST: usize = 17;
        let boxes: Vec<Bounds> = call.shapes.iter().map(scan::bounds).collect();
        if boxes.len() < LEAST || boxes.len() <= call.max_leaf_size as usize {
            return None;
        }
        let side = sweep::smaller_side(&boxes)?;
        Some(usize::from(16 * side >= boxes.len()))
    },
};
