//! The domain of `Bvh::build`.

use std::collections::BTreeSet;

use glam::DVec3;
use protocol::{Question, Shape};

use super::fields::{
    OCTANTS, PLACES, SIZES, class_up_to, octant, place_class, powers_of_two, size_class,
    without_repetition,
};
use super::{Aspect, FunctionDomain, not_asked};
use crate::oracle::bbox::Bounds;
use crate::oracle::scan;

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

    fn bounds(&self) -> Bounds {
        Bounds::enclosing(self.shapes.iter().map(scan::bounds))
    }

    fn centers(&self) -> Vec<DVec3> {
        let boxes = self.shapes.iter().map(scan::bounds);
        boxes.map(|bounds| bounds.center()).collect()
    }

    /// Returns half of the largest side of the box around everything.
    fn size(&self) -> f64 {
        half_side(&self.bounds())
    }
}

fn half_side(bounds: &Bounds) -> f64 {
    0.5 * (bounds.max - bounds.min).max_element()
}

/// The domain of `Bvh::build`.
pub static BUILD: FunctionDomain<BuildCall> = FunctionDomain {
    function: "Bvh::build",
    subject_aspects: &[],
    aspects: &[
        COUNT,
        LEAF_SIZE,
        LEAVES,
        SIZE,
        PLACE,
        OCTANT,
        KIND,
        ARRANGEMENT,
    ],
    pairs: &[],
    calls: |question| BuildCall::of(question).into_iter().collect(),
    not_asked: &[not_asked(
        "primitives",
        &["about 2,048", "about 4,096"],
        &[],
        "An exam asks one tree of each of these sizes, since each is as long in the exam as a hundred small ones.",
    )],
};

/// The number of primitives: each from 0 to 10, and then powers of two and what is near them.
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

/// The number of primitives, in leaves.
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

/// The size of the whole.
const SIZE: Aspect<BuildCall> = Aspect {
    name: "size",
    classes: SIZES,
    class: |call| (!call.shapes.is_empty()).then(|| size_class(call.size())),
};

/// The position of the whole.
const PLACE: Aspect<BuildCall> = Aspect {
    name: "place",
    classes: PLACES,
    class: |call| {
        let middle = call.bounds().center();
        (!call.shapes.is_empty()).then(|| place_class(middle, call.size()))
    },
};

/// The octant of everything, if it is in one.
const OCTANT: Aspect<BuildCall> = Aspect {
    name: "octant",
    classes: OCTANTS,
    class: |call| {
        let Bounds { min, max } = call.bounds();
        let is_in_one = !call.shapes.is_empty() && (min * max).min_element() > 0.0;
        is_in_one.then(|| octant(min)).flatten()
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
    ],
    class: arrangement,
};

fn arrangement(call: &BuildCall) -> Option<usize> {
    /// How much smaller the box around all but the farthest primitive is if that one is far away.
    const OUTLIER: f64 = 5.0;
    /// The ratio between the largest and the smallest of primitives of very different sizes.
    const SIZE_RATIO: f64 = 50.0;

    let centers = call.centers();
    if centers.len() < 2 {
        return None;
    }
    let around = Bounds::around(centers.iter().copied());
    let extent = around.max - around.min;
    let flat: Vec<usize> = (0..3).filter(|&axis| extent[axis] == 0.0).collect();
    let boxes = call.bounds();
    let is_flat = |axis: usize| boxes.max[axis] == boxes.min[axis];
    let sizes = call
        .shapes
        .iter()
        .map(|shape| half_side(&scan::bounds(shape)));
    let (least, most) = sizes.fold((f64::INFINITY, 0.0), |(least, most), size: f64| {
        (size.min(least), size.max(most))
    });
    Some(match flat[..] {
        _ if has_equal(&call.shapes) => 11,
        [_, _, _] => 10,
        [x, y] => 7 + (3 - x - y),
        [axis] if is_flat(axis) => 1 + axis,
        [axis] => 4 + axis,
        _ if most > SIZE_RATIO * least => 13,
        _ if centers.len() > 2
            && extent_without_farthest(&centers) * OUTLIER < half_side(&around) =>
        {
            12
        }
        _ => 0,
    })
}

/// Returns whether two shapes are equal but for their numbers.
fn has_equal(shapes: &[Shape]) -> bool {
    let text = |shape: &Shape| match shape {
        Shape::Triangle { vertices, .. } => format!("{vertices:?}"),
        Shape::FlatTriangle { corners, .. } => format!("{corners:?}"),
        Shape::Sphere { center, radius, .. } => format!("{center:?} {radius:?}"),
    };
    !without_repetition(shapes.iter().map(text))
}

/// Returns half of the largest side of the box around all but the farthest of some points.
fn extent_without_farthest(points: &[DVec3]) -> f64 {
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
    sorted.pop();
    half_side(&Bounds::around(sorted))
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
        ];
        assert_eq!(classes(row.collect(), 16), expected.map(Some));
    }

    #[test]
    fn nothing_has_a_number_and_no_place() {
        let none = classes(Vec::new(), 1000);
        assert_eq!(none[0], Some("0"));
        assert_eq!(none[1], Some("256 to 1,000"));
        assert_eq!(none[3..], [None; 5]);
    }

    #[test]
    fn arrangements_are_told_apart() {
        let arrangement = |shapes: Vec<Shape>| *classes(shapes, 1).last().unwrap();
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
