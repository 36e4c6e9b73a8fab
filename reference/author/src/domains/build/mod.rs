//! The domain of `Bvh::build`.

mod arrangement;
mod tree_aspects;

use std::collections::BTreeSet;

use protocol::{Question, Shape};

use self::arrangement::ARRANGEMENT;
use self::tree_aspects::TREE_ASPECTS;
use super::fields::{class_up_to, powers_of_two};
use super::{Aspect, FunctionDomain, Placed, not_asked};
use crate::oracle::bbox::Bounds;
use crate::oracle::scan;

/// A call to `Bvh::build`.
#[derive(Clone, Debug)]
pub struct BuildCall {
    /// The primitives.
    pub shapes: Vec<Shape>,
    /// The maximum number of primitives in a leaf.
    pub max_leaf_size: u32,
}

impl BuildCall {
    /// Returns the call in a question, or `None` if the question is about something else.
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

    /// Returns the boxes around the primitives.
    fn boxes(&self) -> Vec<Bounds> {
        self.shapes.iter().map(scan::bounds).collect()
    }
}

impl Placed for BuildCall {
    fn bounds(&self) -> Option<Bounds> {
        (!self.shapes.is_empty()).then(|| Bounds::enclosing(self.boxes()))
    }
}

/// The domain of `Bvh::build`.
pub static BUILD: FunctionDomain<BuildCall> = FunctionDomain {
    aspects: &[DRAWN, TREE_ASPECTS],
    not_asked: &[
        not_asked(&["primitives"])
            .classes(&["about 2,048", "about 4,096"])
            .because(
                "An exam tests only one tree for each of these sizes, since a tree this large \
                 takes up as much of the exam as a hundred small trees.",
            ),
        not_asked(&[
            "primitives",
            "max_leaf_size",
            "primitives in leaves",
            "size",
            "place",
            "octant",
            "kind",
            "arrangement",
        ])
        .columns(EVERY_PROPERTY)
        .because(
            "Each property of a tree is judged for every arrangement of primitives (along \
             any axis) and for many trees that differ in this respect. So the property need \
             not be judged for every class.",
        ),
        not_asked(&[
            "extent along the axis of the best split",
            "axis of the best split",
            "smaller side of the best split",
            "form of the tree",
            "area times primitives",
        ])
        .columns(ALL_BUT_COST)
        .because("Only the cost depends on areas and on how nodes are split."),
        not_asked(&["over 1,024 primitives"])
            .columns(&["split", "cost"])
            .because(
                "The leaf size is judged instead, because this is a stricter test. The cost is \
                 judged for trees with larger leaves.",
            ),
        not_asked(&["levels"])
            .columns(&[
                "partition",
                "contents",
                "tightness",
                "split",
                "stops",
                "cost",
            ])
            .because(
                "A builder that always stops at a certain level makes leaves that are too \
                 large. So it is enough to judge the leaf size.",
            ),
        not_asked(&["levels"])
            .classes(&["1"])
            .columns(&["leaf size"])
            .because(
                "Trees of one level are tested by the questions about when a node must be a leaf.",
            ),
        not_asked(&["arrangement along any axis"])
            .classes(&["all centres coincide", "over 128 centres coincide"])
            .columns(&["split", "cost"])
            .because(
                "If all primitives have the same centre, all partitions cost the same, so the \
                 leaf size is judged instead.",
            ),
        not_asked(&["arrangement along any axis"])
            .classes(&["all on a line parallel to an axis"])
            .columns(&["split", "cost"])
            .because("Every box has an area of 0, so no partition is better than any other."),
        not_asked(&["arrangement along any axis"])
            .classes(&["equal boxes, max_leaf_size 1"])
            .columns(&["split", "cost"])
            .because(
                "If the boxes are equal, some partitions cost the same, so the leaf size is \
                 judged instead.",
            ),
        not_asked(&["arrangement along any axis"])
            .classes(&["equal primitives"])
            .columns(&["cost"])
            .because(
                "If the primitives are equal, some partitions cost the same, so correct \
                 builders may choose different partitions.",
            ),
        not_asked(&["arrangement along any axis"])
            .classes(&[
                "some without area",
                "equal primitives",
                "of very different sizes",
            ])
            .columns(&["split"])
            .because("The leaf size is judged instead, because this is a stricter test."),
    ],
    ..FunctionDomain::new("Bvh::build", |question| {
        BuildCall::of(question).into_iter().collect()
    })
};

/// All judged properties of a tree.
const EVERY_PROPERTY: &[&str] = &[
    "partition",
    "contents",
    "tightness",
    "split",
    "leaf size",
    "stops",
    "cost",
];

/// All judged properties of a tree except its cost.
const ALL_BUT_COST: &[&str] = EVERY_PROPERTY.split_last().unwrap().1;

/// The aspects that are balanced when calls are picked at random: those that can be computed
/// without a tree.
pub const DRAWN: &[Aspect<BuildCall>] = &[
    // The number of primitives: every number from 0 to 10, then powers of two and numbers close to
    // them.
    Aspect::new(
        "primitives",
        &[
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
        |call| {
            Some(match call.shapes.len() {
                count @ ..=10 => count,
                count => 7 + powers_of_two(count).clamp(4, 12),
            })
        },
    ),
    // The maximum number of primitives in a leaf.
    Aspect::new(
        "max_leaf_size",
        &[
            "1",
            "2",
            "3 or 4",
            "5 to 8",
            "9 to 32",
            "33 to 255",
            "256 to 1,000",
        ],
        |call| {
            let limits = [1, 2, 4, 8, 32, 255];
            Some(class_up_to(&limits, call.max_leaf_size as usize))
        },
    ),
    // The number of primitives relative to the leaf size.
    Aspect::new(
        "primitives in leaves",
        &[
            "fewer than fit into one leaf",
            "as many as fit into one leaf",
            "one more than fits into one leaf",
            "up to 2 leaves",
            "up to 8 leaves",
            "more",
        ],
        |call| {
            let (count, leaf) = (call.shapes.len(), call.max_leaf_size as usize);
            Some(match count {
                _ if count < leaf => 0,
                _ if count == leaf => 1,
                _ if count == leaf + 1 => 2,
                _ => 3 + class_up_to(&[2, 8], count.div_ceil(leaf)),
            })
        },
    ),
    Aspect::SIZE,
    Aspect::PLACE,
    Aspect::OCTANT_OF_ALL,
    // The kind of the primitives.
    Aspect::new(
        "kind",
        &["triangles", "flat triangles", "spheres", "mixed"],
        |call| {
            let kinds: BTreeSet<usize> = call.shapes.iter().map(kind).collect();
            let first = kinds.first().copied()?;
            Some(if kinds.len() > 1 { 3 } else { first })
        },
    ),
    ARRANGEMENT,
];

/// Returns the kind of a shape: triangle, flat triangle or sphere.
pub(super) fn kind(shape: &Shape) -> usize {
    match shape {
        Shape::Triangle { .. } => 0,
        Shape::FlatTriangle { .. } => 1,
        Shape::Sphere { .. } => 2,
    }
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
        let classes = BUILD.classes(&question, None).remove(0);
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
            "one more than fits into one leaf",
            "10",
            "1 size away",
            "+++",
            "spheres",
            "centres in a row along x",
            "centres in a row",
            "the longest",
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
        assert_eq!(none[3..], [None; 14]);
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
        assert_eq!(plane, Some("centres in a plane perpendicular to z"));
        let far = of([1.0; 3], [a, [3.0, 1.0, 2.0], [90.0, 80.0, 70.0]]);
        assert_eq!(far, Some("one primitive far from the others"));
        let sizes = of([0.01, 2.0, 1.0], [a, b, [1.0, 2.0, 3.0]]);
        assert_eq!(sizes, Some("of very different sizes"));
    }
}
