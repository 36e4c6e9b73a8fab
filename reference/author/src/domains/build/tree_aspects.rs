//! Aspects of the tree that an exact sweep builds.

use glam::DVec3;

use super::BuildCall;
use super::arrangement::ARRANGEMENT_ALONG_ANY_AXIS;
use crate::domains::fields::class_up_to;
use crate::domains::{Aspect, Placed};
use crate::oracle::bbox::Bounds;
use crate::oracle::sweep;

/// The aspects of the trees that calls ask for.
pub(super) const TREE_ASPECTS: &[Aspect<BuildCall>] = &[
    ARRANGEMENT_ALONG_ANY_AXIS,
    // How far the centres extend along the axis of the best split.
    Aspect::new(
        "extent along the axis of the best split",
        &[
            "the longest",
            "more than a tenth of the longest",
            "more than a hundredth",
            "less than a hundredth",
            "more than a tenth, with 8 or fewer primitives",
            "less than a tenth, with 8 or fewer primitives",
            "not the longest, with over 1,100 primitives",
            "less than a thousandth",
        ],
        |call| {
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
    ),
    // The rank of the axis of the best split, by how far the centres extend along it.
    Aspect::new(
        "axis of the best split",
        &[
            "the longest",
            "the second longest",
            "the shortest",
            "the shortest, with over 100 primitives",
        ],
        |call| {
            let (extents, axis) = extents_and_best_axis(call)?;
            let all = extents.to_array();
            let rank = all.iter().filter(|&&other| other > extents[axis]).count();
            Some(rank + usize::from(rank == 2 && call.shapes.len() > 100))
        },
    ),
    // The number of levels of the tree.
    Aspect::new(
        "levels",
        &["1", "2 to 8", "9 to 20", "21 or more"],
        |call| {
            let boxes = call.boxes();
            let levels = sweep::levels(&boxes, call.max_leaf_size as usize);
            (!boxes.is_empty()).then(|| class_up_to(&[1, 8, 20], levels))
        },
    ),
    // Many primitives in small leaves.
    Aspect::new("over 1,024 primitives", &["in leaves of up to 3"], |call| {
        (call.shapes.len() > 1024 && call.max_leaf_size < 4).then_some(0)
    }),
    // The number of primitives on the smaller side of the best split.
    Aspect::new(
        "smaller side of the best split",
        &["less than a sixteenth", "more"],
        |call| {
            /// The aspect applies only if there are at least this many primitives.
            const LEAST: usize = 17;
            let boxes = call.boxes();
            if boxes.len() < LEAST || boxes.len() <= call.max_leaf_size as usize {
                return None;
            }
            let side = sweep::smaller_side(&boxes)?;
            Some(usize::from(16 * side >= boxes.len()))
        },
    ),
    // The numbers of primitives in the tree and in its leaves.
    Aspect::new(
        "form of the tree",
        &[
            "one split of over 1,024",
            "9 to 100 primitives in leaves of one",
            "five or more leaves of 16 to 32",
            "five or more leaves of 33 or more",
        ],
        |call| match (call.shapes.len(), call.max_leaf_size as usize) {
            (1025.., leaf) if call.shapes.len() < 2 * leaf => Some(0),
            (9..=100, 1) => Some(1),
            (count, leaf @ 16..) if count > 4 * leaf => Some(2 + usize::from(leaf > 32)),
            _ => None,
        },
    ),
    // The area of the root's box times the number of primitives. Costs are proportional to this
    // product.
    Aspect::new("area times primitives", &["above 1e10"], |call| {
        let work = call.bounds()?.area() * call.shapes.len() as f64;
        (work > 1e10).then_some(0)
    }),
];

/// Returns how far the centres extend along each axis, and the axis of the best split. Returns
/// `None` if all primitives fit into one leaf.
fn extents_and_best_axis(call: &BuildCall) -> Option<(DVec3, usize)> {
    let boxes = call.boxes();
    if boxes.len() <= call.max_leaf_size as usize {
        return None;
    }
    let centers = Bounds::around(boxes.iter().map(Bounds::center));
    Some((centers.max - centers.min, sweep::best_axis(&boxes)?))
}
