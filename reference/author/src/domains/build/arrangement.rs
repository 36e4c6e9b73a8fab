//! The arrangement of the primitives in a tree.

use glam::DVec3;
use protocol::Shape;

use super::BuildCall;
use crate::domains::fields::without_repetition;
use crate::domains::{Aspect, Placed};
use crate::oracle::bbox::Bounds;
use crate::oracle::scan;

/// The arrangement of two or more primitives.
pub const ARRANGEMENT: Aspect<BuildCall> = Aspect::new(
    "arrangement",
    &[
        "scattered",
        "boxes flat along x",
        "boxes flat along y",
        "boxes flat along z",
        "centres in a plane perpendicular to x",
        "centres in a plane perpendicular to y",
        "centres in a plane perpendicular to z",
        "centres in a row along x",
        "centres in a row along y",
        "centres in a row along z",
        "all centres coincide",
        "equal primitives",
        "one primitive far from the others",
        "of very different sizes",
        "all on a line parallel to an axis",
        "some without area",
        "over 128 centres coincide",
        "equal boxes, max_leaf_size 1",
    ],
    arrangement,
);

/// The arrangement, regardless of its axis. Each property of a tree is tested with each
/// arrangement.
pub const ARRANGEMENT_ALONG_ANY_AXIS: Aspect<BuildCall> = Aspect::new(
    "arrangement along any axis",
    &[
        "scattered",
        "flat boxes",
        "centres in a plane",
        "centres in a row",
        "all centres coincide",
        "equal primitives",
        "one primitive far from the others",
        "of very different sizes",
        "all on a line parallel to an axis",
        "some without area",
        "over 128 centres coincide",
        "equal boxes, max_leaf_size 1",
    ],
    |call| {
        Some(match arrangement(call)? {
            0 => 0,
            along @ 1..=9 => 1 + (along - 1) / 3,
            other => other - 6,
        })
    },
);

fn arrangement(call: &BuildCall) -> Option<usize> {
    /// The farthest primitive is an outlier if the box without it is smaller by more than this
    /// factor.
    const OUTLIER: f64 = 5.0;
    /// Sizes count as very different if the ratio of the largest to the smallest is above this
    /// limit.
    const SIZE_RATIO: f64 = 50.0;
    /// Arrangements with more coinciding centres than this are a separate class.
    const MANY: usize = 128;

    let boxes = call.boxes();
    let centers: Vec<DVec3> = boxes.iter().map(Bounds::center).collect();
    if centers.len() < 2 {
        return None;
    }
    let around = Bounds::around(centers.iter().copied());
    let extent = around.max - around.min;
    let flat: Vec<usize> = (0..3).filter(|&axis| extent[axis] == 0.0).collect();
    let around_all = call.bounds()?;
    let is_flat = |axis: usize| around_all.max[axis] == around_all.min[axis];
    let sizes = boxes.iter().map(Bounds::half_side);
    let (least, most) = sizes.fold((f64::INFINITY, 0.0), |(least, most), size: f64| {
        (size.min(least), size.max(most))
    });
    Some(match flat[..] {
        [_, _, _] if centers.len() > MANY => 16,
        _ if has_equal(&call.shapes) => 11,
        _ if call.max_leaf_size == 1 && has_equal_boxes(&boxes) => 17,
        [_, _, _] => 10,
        [x, y] if is_flat(x) && is_flat(y) => 14,
        [x, y] => 7 + (3 - x - y),
        [axis] if is_flat(axis) => 1 + axis,
        [axis] => 4 + axis,
        _ if call.shapes.iter().any(is_without_area) => 15,
        _ if most > SIZE_RATIO * least => 13,
        _ if centers.len() > 2
            && extent_without_farthest(&centers) * OUTLIER < around.half_side() =>
        {
            12
        }
        _ => 0,
    })
}

/// Returns whether two corners of a triangle coincide.
fn is_without_area(shape: &Shape) -> bool {
    scan::corners(shape).is_some_and(|[a, b, c]| a == b || b == c || c == a)
}

/// Returns whether any two of the shapes are equal apart from their numbers.
fn has_equal(shapes: &[Shape]) -> bool {
    let text = |shape: &Shape| match shape {
        Shape::Triangle { vertices, .. } => format!("{vertices:?}"),
        Shape::FlatTriangle { corners, .. } => format!("{corners:?}"),
        Shape::Sphere { center, radius, .. } => format!("{center:?} {radius:?}"),
    };
    !without_repetition(shapes.iter().map(text))
}

/// Returns whether any two of the boxes are equal.
fn has_equal_boxes(boxes: &[Bounds]) -> bool {
    !without_repetition(boxes.iter().map(|bounds| format!("{bounds:?}")))
}

/// Returns half of the longest side of the box around all points except the farthest.
fn extent_without_farthest(points: &[DVec3]) -> f64 {
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
    sorted.pop();
    Bounds::around(sorted).half_side()
}
