//! The aspects of calls to `Bvh::hit`.

use std::collections::BTreeSet;

use protocol::Shape;

use super::call::{SecondLeaf, TraverseCall};
use crate::domains::Aspect;
use crate::domains::build::kind;
use crate::domains::fields::{class_up_to, history_class, powers_of_two};
use crate::oracle::bbox::Bounds;
use crate::oracle::{Ray64, scan};
use crate::tree::Tree;

/// The aspects of trees, rays and hits.
pub(super) const ASPECTS: &[Aspect<TraverseCall>] = &[
    // Where the tree comes from: the exam or the submission.
    Aspect::new("tree", &["the exam's", "the student's own"], |call| {
        Some(usize::from(call.subject.is_built))
    }),
    // The number of nodes in the exam's tree.
    Aspect::new(
        "nodes",
        &[
            "none",
            "one, an empty leaf",
            "one, a leaf of one",
            "one, a leaf of several",
            "3",
            "5 to 19",
            "20 or more",
        ],
        |call| {
            let subject = &call.subject;
            let first = subject.leaves.first();
            let in_first = first.map(|&leaf| subject.tree.primitives(leaf).len());
            (!subject.is_built).then(|| match (subject.nodes(), in_first) {
                (0, _) => 0,
                (1, Some(0)) => 1,
                (1, Some(1)) => 2,
                (1, _) => 3,
                (..=3, _) => 4,
                (..20, _) => 5,
                _ => 6,
            })
        },
    ),
    // The number of levels in the exam's tree.
    Aspect::new(
        "levels",
        &["1", "2 to 5", "6 to 12", "13 to 59", "60"],
        |call| {
            let levels = call.subject.levels;
            (levels > 0).then(|| class_up_to(&[1, 5, 12, 59], levels))
        },
    ),
    // The largest leaf of the exam's tree.
    Aspect::new(
        "largest leaf",
        &["1", "2", "3 to 8", "9 to 32", "33 to 255", "256 to 1,000"],
        |call| {
            let leaves = call.subject.leaves.iter();
            let sizes = leaves.map(|&leaf| call.subject.tree.primitives(leaf).len());
            let largest = sizes.max().filter(|&size| size > 0)?;
            Some(class_up_to(&[1, 2, 8, 32, 255], largest))
        },
    ),
    // The position of the root among the nodes of the exam's tree.
    Aspect::new("root", &["first", "in the middle", "last"], |call| {
        let Tree { nodes, root, .. } = &call.subject.tree;
        (nodes.len() > 1).then_some(match *root {
            0 => 0,
            root if root + 1 == nodes.len() => 2,
            _ => 1,
        })
    }),
    // The number of primitives in the tree.
    Aspect::new(
        "primitives",
        &[
            "0",
            "1",
            "2",
            "3",
            "4 to 5",
            "6 to 11",
            "12 to 22",
            "23 to 45",
            "46 to 90",
            "91 to 181",
            "182 to 362",
            "363 to 724",
            "725 to 1,448",
            "more",
        ],
        |call| {
            Some(match call.subject.shapes().len() {
                count @ ..=3 => count,
                count => 2 + powers_of_two(count).clamp(2, 11),
            })
        },
    ),
    Aspect::SIZE,
    Aspect::PLACE,
    Aspect::OCTANT_OF_ALL,
    // The kinds of the primitives.
    Aspect::new(
        "kind",
        &["triangles", "flat triangles", "spheres", "mixed"],
        |call| {
            let shapes = call.subject.shapes().into_iter();
            let kinds: BTreeSet<usize> = shapes.map(kind).collect();
            let first = kinds.first().copied()?;
            Some(if kinds.len() > 1 { 3 } else { first })
        },
    ),
    // The start of the ray.
    Aspect::new(
        "start",
        &[
            "outside the root's box",
            "more than 3 diagonals away",
            "inside the root's box",
            "inside a leaf's box",
        ],
        |call| {
            let subject = &call.subject;
            let start = call.ray.origin.as_dvec3();
            if subject.bounds.half_side() <= 0.0 {
                return None;
            }
            let holds =
                |bounds: &Bounds| bounds.min.cmple(start).all() && start.cmple(bounds.max).all();
            let mut leaves = subject.leaves.iter();
            let away = start.distance(subject.bounds.center()) - 0.5 * subject.bounds.diagonal();
            Some(match holds(&subject.bounds) {
                true if leaves.any(|&leaf| holds(&subject.tree.bounds(leaf))) => 3,
                true => 2,
                false if away > 3.0 * subject.bounds.diagonal() => 1,
                false => 0,
            })
        },
    ),
    Aspect::DIRECTION,
    Aspect::RANGE,
    // The previous call on the same tree.
    Aspect::new(
        "history",
        &[
            "first call on a tree",
            "after another ray",
            "after the same ray with another range",
            "after almost the same ray, with another hit",
            "after a ray in the opposite or a mirrored direction, with another hit",
        ],
        |call| {
            if call.is_after_almost_the_same_ray() {
                return Some(3);
            }
            if call.is_after_a_mirrored_ray() {
                return Some(4);
            }
            Some(history_class(call.previous.as_ref(), &call.ray))
        },
    ),
    // The distance to the hit as a fraction of the largest coordinate of the ray's start.
    Aspect::new(
        "distance relative to the coordinates of the start",
        &["below 1e-5", "1e-5", "1e-3 or more"],
        |call| {
            let largest = f64::from(call.ray.origin.abs().max_element());
            Some(match call.hit?.distance / largest {
                ..1e-5 if call.ray.range.min == 0.0 => 0,
                ..1e-3 => 1,
                _ => 2,
            })
        },
    ),
    // The start of the ray relative to the boxes around the hit.
    Aspect::new(
        "start relative to the boxes around the hit",
        &[
            "before all boxes around the hit",
            "before the middle of a box",
            "beyond the middle of a box",
            "more than half a side beyond the middle",
        ],
        |call| {
            let tree = &call.subject.tree;
            let ray64 = Ray64::from(&call.ray);
            let path = tree
                .path(call.leaf_of_hit()?)
                .into_iter()
                .map(|node| tree.bounds(node));
            let holds = |bounds: &Bounds| bounds.contains(&Bounds::around([ray64.origin]));
            let around = path.filter(holds).map(|bounds| {
                let beyond = (ray64.origin - bounds.center()).dot(ray64.dir);
                match beyond / (bounds.max - bounds.min).max_element() {
                    ..0.0 => 1,
                    ..0.5 => 2,
                    _ => 3,
                }
            });
            Some(around.max().unwrap_or(0))
        },
    ),
    // Whether the ray starts on the sphere that it hits.
    Aspect::new(
        "start on the shape that is hit",
        &["elsewhere", "on the sphere that is hit again"],
        |call| {
            let hit = call.hit?;
            let mut shapes = call.subject.tree.shapes.iter();
            let shape = shapes.find(|shape| shape.number() == hit.shape)?;
            let Shape::Sphere { center, radius, .. } = *shape else {
                return Some(0);
            };
            let from_center = call.ray.origin.distance(center);
            Some(usize::from((from_center / radius - 1.0).abs() < 0.01))
        },
    ),
    // The number of primitives whose boxes the ray enters before it hits something or ends.
    Aspect::new(
        "primitives' boxes on the way",
        &["up to 2,048", "2,049 to 5,000"],
        |call| {
            let ray64 = Ray64::from(&call.ray);
            let on_the_way = Ray64 {
                max: call.hit.map_or(ray64.max, |hit| hit.distance),
                ..ray64
            };
            let shapes = call.subject.shapes().into_iter();
            let boxes = shapes.filter(|shape| scan::bounds(shape).span(&on_the_way).is_some());
            Some(class_up_to(&[2048], boxes.count()))
        },
    ),
    // The index of the hit primitive in its leaf.
    Aspect::new(
        "position of the hit primitive in its leaf",
        &[
            "up to the 16th",
            "up to the 512th",
            "later",
            "the last of a thousand",
        ],
        |call| Some(class_up_to(&[15, 511, 998], call.place_in_leaf()?)),
    ),
    // The number of nodes that a traversal enters only after the leaf with the hit.
    Aspect::new("nodes waiting", &["up to 47", "48 or more"], |call| {
        Some(class_up_to(&[47], call.nodes_waiting()?))
    }),
    // A second hit close behind the closest hit.
    Aspect::new(
        "another hit close behind",
        &[
            "within a thousandth of the distance, earlier in the same leaf",
            "in a leaf around the start, with both hits within 1e-3 diagonals of the start",
            "within a thousandth of the distance, in a leaf that is entered earlier",
        ],
        |call| {
            Some(match call.layer()? {
                SecondLeaf::Same => 0,
                SecondLeaf::Other => 1,
                SecondLeaf::Earlier => 2,
            })
        },
    ),
    // An unreferenced primitive in front of the answer.
    Aspect::new(
        "primitive in front that is in no leaf",
        &["small", "as large as the tree"],
        |call| call.unreferenced_in_front().map(usize::from),
    ),
];
