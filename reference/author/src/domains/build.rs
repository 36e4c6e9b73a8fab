//! The domain of `Bvh::build`.

use std::collections::BTreeSet;

use glam::DVec3;
use protocol::{Question, Shape};

use super::fields::{class_up_to, powers_of_two, without_repetition};
use super::{Aspect, FunctionDomain, Placed, not_asked};
use crate::oracle::bbox::Bounds;
use crate::oracle::{scan, sweep};

/// A call of `Bvh::build`.
#[derive(Clone, Debug)]
pub struct BuildCall {
    /// The primitives.
    pub shapes: Vec<Shape>,
    /// The maximum number of primitives in a leaf.
    pub max_leaf_size: u32,
}

impl BuildCall {
    /// Returns the call of a question, or `None` if the question is about something else.
    pub fn of(question: &Question) -> Option<BuildCall> {
        let Question::Build {
            shapes,
            max_leaf_size,
        } = question
        else {
            return None;
        };
        Some(BuildCall {
            shapes: shapes.clone(),
            max_leaf_size: *max_leaf_size,
        })
    }

    fn centers(&self) -> Vec<DVec3> {
        let boxes = self.shapes.iter().map(scan::bounds);
        boxes.map(|bounds| bounds.center()).collect()
    }
}

impl Placed for BuildCall {
    fn bounds(&self) -> Option<Bounds> {
        let boxes = self.shapes.iter().map(scan::bounds);
        (!self.shapes.is_empty()).then(|| Bounds::enclosing(boxes))
    }
}

/// The domain of `Bvh::build`.
pub static BUILD: FunctionDomain<BuildCall> = FunctionDomain {
    function: "Bvh::build",
    subject_aspects: &[],
    aspects: &[
        COUNT,
        LEAF_SIZE,
        LEAVES,
        Aspect::SIZE,
        Aspect::PLACE,
        Aspect::OCTANT_OF_ALL,
        KIND,
        ARRANGEMENT,
        ARRANGEMENT_ALONG_ANY_AXIS,
        BEST_AXIS,
        LEVELS,
        LARGE,
        SMALLER_SIDE,
        SHAPE_OF_TREE,
        WORK,
    ],
    pairs: &[],
    calls: |question| BuildCall::of(question).into_iter().collect(),
    not_asked: &[
        not_asked(
            "primitives",
            &["about 2,048", "about 4,096"],
            &[],
            "An exam asks one tree of each of these sizes, since each is as long in the exam as a hundred small ones.",
        ),
        not_asked(
            "primitives",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
                "cost",
            ],
            "Each property of a tree is judged for each arrangement of primitives, and by many trees that differ in this.",
        ),
        not_asked(
            "max_leaf_size",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
                "cost",
            ],
            "Each property of a tree is judged for each arrangement of primitives, and by many trees that differ in this.",
        ),
        not_asked(
            "primitives in leaves",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
                "cost",
            ],
            "Each property of a tree is judged for each arrangement of primitives, and by many trees that differ in this.",
        ),
        not_asked(
            "size",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
                "cost",
            ],
            "Each property of a tree is judged for each arrangement of primitives, and by many trees that differ in this.",
        ),
        not_asked(
            "place",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
                "cost",
            ],
            "Each property of a tree is judged for each arrangement of primitives, and by many trees that differ in this.",
        ),
        not_asked(
            "octant",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
                "cost",
            ],
            "Each property of a tree is judged for each arrangement of primitives, and by many trees that differ in this.",
        ),
        not_asked(
            "kind",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
                "cost",
            ],
            "Each property of a tree is judged for each arrangement of primitives, and by many trees that differ in this.",
        ),
        not_asked(
            "arrangement",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
                "cost",
            ],
            "Each property of a tree is judged for each arrangement of primitives, and by many trees that differ in this.",
        ),
        not_asked(
            "extent along the axis of the best split",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
            ],
            "Only the cost depends on the axis of a split.",
        ),
        not_asked(
            "smaller side of the best split",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
            ],
            "Only the cost depends on how a node is split.",
        ),
        not_asked(
            "form of the tree",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
            ],
            "Only the cost depends on how nodes are split.",
        ),
        not_asked(
            "area times primitives",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "leaf size",
                "stops",
            ],
            "Only the cost depends on areas.",
        ),
        not_asked(
            "over 1,024 primitives",
            &[],
            &["split", "cost"],
            "The leaf size is judged, which is stricter, and the cost of trees with larger leaves.",
        ),
        not_asked(
            "levels",
            &[],
            &[
                "partition",
                "contents",
                "tightness",
                "split",
                "stops",
                "cost",
            ],
            "A builder that stops at a level makes a leaf there, which is too large.",
        ),
        not_asked(
            "levels",
            &["1"],
            &["leaf size"],
            "A tree of one level is asked of where a node must be a leaf.",
        ),
        not_asked(
            "arrangement along any axis",
            &["all centres coincide", "over 128 centres coincide"],
            &["split", "cost"],
            "All partitions of primitives with one centre cost the same, and the leaf size is judged instead.",
        ),
        not_asked(
            "arrangement along any axis",
            &["on a line along an axis"],
            &["split", "cost"],
            "Every box has the area 0, so no partition is better than another.",
        ),
        not_asked(
            "arrangement along any axis",
            &["equal boxes, max_leaf_size 1"],
            &["split", "cost"],
            "Some of the partitions of equal boxes cost the same, and the leaf size is judged.",
        ),
        not_asked(
            "arrangement along any axis",
            &["equal primitives"],
            &["cost"],
            "Some of the partitions of equal primitives cost the same, so builders differ.",
        ),
        not_asked(
            "arrangement along any axis",
            &[
                "some without area",
                "equal primitives",
                "of very different sizes",
            ],
            &["split"],
            "The leaf size is judged, which is stricter.",
        ),
    ],
};

/// The aspects that are balanced when calls are drawn: those that can be computed without a tree.
pub const DRAWN: &[Aspect<BuildCall>] = &[
    COUNT,
    LEAF_SIZE,
    LEAVES,
    Aspect::SIZE,
    Aspect::PLACE,
    Aspect::OCTANT_OF_ALL,
    KIND,
    ARRANGEMENT,
];

/// The number of primitives: each from 0 to 10, then powers of two and numbers close to them.
const COUNT: Aspect<BuildCall> = Aspect {
    name: "primitives",
    classes: &[
        "0",
        "1",
        "2",
        "3",
        "4",
        "5",
        "6",
        "7",
        "8",
        "9",
        "10",
        "about 16",
        "about 32",
        "about 64",
        "about 128",
        "about 256",
        "about 512",
        "about 1,024",
        "about 2,048",
        "about 4,096",
    ],
    class: |call| {
        Some(match call.shapes.len() {
            count @ ..=10 => count,
            count => 7 + powers_of_two(count).clamp(4, 12),
        })
    },
};

/// The maximum number of primitives in a leaf.
const LEAF_SIZE: Aspect<BuildCall> = Aspect {
    name: "max_leaf_size",
    classes: &[
        "1",
        "2",
        "3 or 4",
        "5 to 8",
        "9 to 32",
        "33 to 255",
        "256 to 1,000",
    ],
    class: |call| {
        let limits = [1, 2, 4, 8, 32, 255];
        Some(class_up_to(&limits, call.max_leaf_size as usize))
    },
};

/// The number of primitives relative to the leaf size.
const LEAVES: Aspect<BuildCall> = Aspect {
    name: "primitives in leaves",
    classes: &[
        "fewer than fit into one",
        "as many as fit into one",
        "one more",
        "up to 2 leaves",
        "up to 8 leaves",
        "more",
    ],
    class: |call| {
        let (count, leaf) = (call.shapes.len(), call.max_leaf_size as usize);
        Some(match count {
            _ if count < leaf => 0,
            _ if count == leaf => 1,
            _ if count == leaf + 1 => 2,
            _ => 3 + class_up_to(&[2, 8], count.div_ceil(leaf)),
        })
    },
};

/// The kind of the primitives.
const KIND: Aspect<BuildCall> = Aspect {
    name: "kind",
    classes: &["triangles", "flat triangles", "spheres", "mixed"],
    class: |call| {
        let kinds: BTreeSet<usize> = call.shapes.iter().map(kind).collect();
        let first = kinds.first().copied()?;
        Some(if kinds.len() > 1 { 3 } else { first })
    },
};

/// Returns the kind of a shape: triangle, flat triangle or sphere.
pub(super) fn kind(shape: &Shape) -> usize {
    match shape {
        Shape::Triangle { .. } => 0,
        Shape::FlatTriangle { .. } => 1,
        Shape::Sphere { .. } => 2,
    }
}

/// The arrangement of two or more primitives.
const ARRANGEMENT: Aspect<BuildCall> = Aspect {
    name: "arrangement",
    classes: &[
        "scattered",
        "boxes flat along x",
        "boxes flat along y",
        "boxes flat along z",
        "centres in a plane across x",
        "centres in a plane across y",
        "centres in a plane across z",
        "centres in a row along x",
        "centres in a row along y",
        "centres in a row along z",
        "all centres coincide",
        "equal primitives",
        "one far from the others",
        "of very different sizes",
        "on a line along an axis",
        "some without area",
        "over 128 centres coincide",
        "equal boxes, max_leaf_size 1",
    ],
    class: arrangement,
};

/// The arrangement again, but regardless of its axis. Each property of a tree is tested with each
/// arrangement.
const ARRANGEMENT_ALONG_ANY_AXIS: Aspect<BuildCall> = Aspect {
    name: "arrangement along any axis",
    classes: &[
        "scattered",
        "flat boxes",
        "centres in a plane",
        "centres in a row",
        "all centres coincide",
        "equal primitives",
        "one far from the others",
        "of very different sizes",
        "on a line along an axis",
        "some without area",
        "over 128 centres coincide",
        "equal boxes, max_leaf_size 1",
    ],
    class: |call| {
        Some(match arrangement(call)? {
            0 => 0,
            along @ 1..=9 => 1 + (along - 1) / 3,
            other => other - 6,
        })
    },
};

/// How far the centres extend along the axis of the best split.
const BEST_AXIS: Aspect<BuildCall> = Aspect {
    name: "extent along the axis of the best split",
    classes: &[
        "the longest",
        "above a tenth of the longest",
        "above a hundredth",
        "less",
        "above a tenth, 8 or fewer primitives",
        "less, 8 or fewer primitives",
        "not the longest, over 1,100 primitives",
    ],
    class: |call| {
        let boxes: Vec<Bounds> = call.shapes.iter().map(scan::bounds).collect();
        if boxes.len() <= call.max_leaf_size as usize {
            return None;
        }
        let centers = Bounds::around(boxes.iter().map(Bounds::center));
        let extent = centers.max - centers.min;
        let part = extent[sweep::best_axis(&boxes)?] / extent.max_element();
        Some(match (boxes.len(), part) {
            (_, 1.0..) => 0,
            (..=8, 0.1..) => 4,
            (..=8, _) => 5,
            (1100.., _) => 6,
            (_, 0.1..) => 1,
            (_, 0.01..) => 2,
            (_, _) => 3,
        })
    },
};

/// The number of levels of the tree.
const LEVELS: Aspect<BuildCall> = Aspect {
    name: "levels",
    classes: &["1", "2 to 8", "9 to 20", "21 or more"],
    class: |call| {
        let boxes: Vec<Bounds> = call.shapes.iter().map(scan::bounds).collect();
        let levels = sweep::levels(&boxes, call.max_leaf_size as usize);
        (!boxes.is_empty()).then(|| class_up_to(&[1, 8, 20], levels))
    },
};

/// Many primitives in small leaves.
const LARGE: Aspect<BuildCall> = Aspect {
    name: "over 1,024 primitives",
    classes: &["in leaves of up to 3"],
    class: |call| (call.shapes.len() > 1024 && call.max_leaf_size < 4).then_some(0),
};

/// The number of primitives on the smaller side of the best split.
const SMALLER_SIDE: Aspect<BuildCall> = Aspect {
    name: "smaller side of the best split",
    classes: &["less than a sixteenth", "more"],
    class: |call| {
        /// With fewer primitives than this, the sides aren't distinguished.
        const LEAST: usize = 17;
        let boxes: Vec<Bounds> = call.shapes.iter().map(scan::bounds).collect();
        if boxes.len() < LEAST || boxes.len() <= call.max_leaf_size as usize {
            return None;
        }
        let side = sweep::smaller_side(&boxes)?;
        Some(usize::from(16 * side >= boxes.len()))
    },
};

/// The numbers of primitives in the tree and in its leaves.
const SHAPE_OF_TREE: Aspect<BuildCall> = Aspect {
    name: "form of the tree",
    classes: &[
        "one split of over 1,024",
        "9 to 100 primitives in leaves of one",
        "five or more leaves of 16 or more",
    ],
    class: |call| match (call.shapes.len(), call.max_leaf_size as usize) {
        (1025.., leaf) if call.shapes.len() < 2 * leaf => Some(0),
        (9..=100, 1) => Some(1),
        (count, leaf @ 16..) if count > 4 * leaf => Some(2),
        _ => None,
    },
};

/// The area of the root's box times the number of primitives. Costs are proportional to it.
const WORK: Aspect<BuildCall> = Aspect {
    name: "area times primitives",
    classes: &["above 1e10"],
    class: |call| {
        let work = call.bounds()?.area() * call.shapes.len() as f64;
        (work > 1e10).then_some(0)
    },
};

fn arrangement(call: &BuildCall) -> Option<usize> {
    /// The factor by which the box must shrink without the farthest primitive for that to be an
    /// outlier.
    const OUTLIER: f64 = 5.0;
    /// The minimum ratio between the largest and the smallest of very different sizes.
    const SIZE_RATIO: f64 = 50.0;
    /// Arrangements with more coinciding centres than this are a separate class.
    const MANY: usize = 128;

    let centers = call.centers();
    if centers.len() < 2 {
        return None;
    }
    let around = Bounds::around(centers.iter().copied());
    let extent = around.max - around.min;
    let flat: Vec<usize> = (0..3).filter(|&axis| extent[axis] == 0.0).collect();
    let boxes = call.bounds()?;
    let is_flat = |axis: usize| boxes.max[axis] == boxes.min[axis];
    let sizes = call
        .shapes
        .iter()
        .map(|shape| scan::bounds(shape).half_side());
    let (least, most) = sizes.fold((f64::INFINITY, 0.0), |(least, most), size: f64| {
        (size.min(least), size.max(most))
    });
    Some(match flat[..] {
        [_, _, _] if centers.len() > MANY => 16,
        _ if has_equal(&call.shapes) => 11,
        _ if call.max_leaf_size == 1 && has_equal_boxes(&call.shapes) => 17,
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

/// Returns whether two corners of a triangle are the same.
fn is_without_area(shape: &Shape) -> bool {
    let [a, b, c] = match shape {
        Shape::Triangle { vertices, .. } => vertices.map(|vertex| vertex.position),
        Shape::FlatTriangle { corners, .. } => *corners,
        Shape::Sphere { .. } => return false,
    };
    a == b || b == c || c == a
}

/// Returns whether two shapes are equal except for their numbers.
fn has_equal(shapes: &[Shape]) -> bool {
    let text = |shape: &Shape| match shape {
        Shape::Triangle { vertices, .. } => format!("{vertices:?}"),
        Shape::FlatTriangle { corners, .. } => format!("{corners:?}"),
        Shape::Sphere { center, radius, .. } => format!("{center:?} {radius:?}"),
    };
    !without_repetition(shapes.iter().map(text))
}

/// Returns whether two shapes have the same box.
fn has_equal_boxes(shapes: &[Shape]) -> bool {
    let text = |shape: &Shape| format!("{:?}", scan::bounds(shape));
    !without_repetition(shapes.iter().map(text))
}

/// Returns half of the longest side of the box around all points except the farthest.
fn extent_without_farthest(points: &[DVec3]) -> f64 {
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
    sorted.pop();
    Bounds::around(sorted).half_side()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::domains::Domain;

    fn sphere(center: [f32; 3], radius: f32) -> Shape {
        Shape::Sphere {
            center: Vec3::from_array(center),
            radius,
            shape: 0,
        }
    }

    fn classes(shapes: Vec<Shape>, max_leaf_size: u32) -> Vec<Option<&'static str>> {
        let question = Question::Build {
            shapes,
            max_leaf_size,
        };
        let classes = BUILD.classes(&question).remove(0);
        let aspects = BUILD.aspects().into_iter().zip(classes);
        aspects
            .map(|((_, names), class)| Some(names[class?]))
            .collect()
    }

    #[test]
    fn every_aspect_has_the_class_of_a_call() {
        let row = (0..17).map(|index| sphere([2.0 * index as f32 + 5.0, 3.0, 4.0], 1.0));
        let expected = [
            "about 16",
            "9 to 32",
            "one more",
            "10",
            "1 size away",
            "+++",
            "spheres",
            "centres in a row along x",
            "centres in a row",
            "the longest",
            "2 to 8",
        ];
        let classes = classes(row.collect(), 16);
        assert_eq!(classes[..expected.len()], expected.map(Some));
    }

    #[test]
    fn nothing_has_a_number_and_no_place() {
        let none = classes(Vec::new(), 1000);
        assert_eq!(none[0], Some("0"));
        assert_eq!(none[1], Some("256 to 1,000"));
        assert_eq!(none[3..], [None; 12]);
    }

    #[test]
    fn arrangements_are_told_apart() {
        let arrangement = |shapes: Vec<Shape>| classes(shapes, 1)[7];
        let [a, b, c] = [[0.0, 0.0, 0.0], [3.0, 1.0, 0.0], [1.0, 4.0, 0.0]];
        let of = |radii: [f32; 3], centers: [[f32; 3]; 3]| {
            let spheres = centers.into_iter().zip(radii);
            arrangement(
                spheres
                    .map(|(center, radius)| sphere(center, radius))
                    .collect(),
            )
        };
        assert_eq!(of([1.0, 2.0, 1.0], [a, a, a]), Some("equal primitives"));
        assert_eq!(of([1.0, 2.0, 3.0], [a, a, a]), Some("all centres coincide"));
        let plane = of([1.0; 3], [a, b, c]);
        assert_eq!(plane, Some("centres in a plane across z"));
        let far = of([1.0; 3], [a, [3.0, 1.0, 2.0], [90.0, 80.0, 70.0]]);
        assert_eq!(far, Some("one far from the others"));
        let sizes = of([0.01, 2.0, 1.0], [a, b, [1.0, 2.0, 3.0]]);
        assert_eq!(sizes, Some("of very different sizes"));
    }
}
