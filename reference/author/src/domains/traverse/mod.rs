//! The domain of `Bvh::hit`, both on the exam's trees and on trees that the submission builds.

mod call;
mod decoy;
mod decoy_aspects;
mod draw;

use std::collections::BTreeSet;

use protocol::Shape;

use self::call::{SecondLeaf, calls};
use super::build::kind;
use super::fields::{class_up_to, history_class, powers_of_two};
use super::{Aspect, FunctionDomain, not_asked};
use crate::oracle::bbox::Bounds;
use crate::oracle::{Ray64, scan};
use crate::tree::Tree;

pub use call::TraverseCall;
pub use draw::{
    ray, ray_from_a_surface, ray_in_a_corner, ray_through_the_sphere_that_it_starts_on,
};

/// The domain of `Bvh::hit`.
pub static TRAVERSE: FunctionDomain<TraverseCall> = FunctionDomain {
    function: "Bvh::hit",
    subject_aspects: &[],
    aspects: &[
        WAY,
        NODES,
        LEVELS,
        LEAF_SIZE,
        ROOT,
        COUNT,
        Aspect::SIZE,
        Aspect::PLACE,
        Aspect::OCTANT_OF_ALL,
        KIND,
        START,
        Aspect::DIRECTION,
        Aspect::RANGE,
        HISTORY,
        NEARNESS,
        IN_BOX,
        ON_SPHERE,
        ON_THE_WAY,
        PLACE_OF_HIT,
        WAITING,
        LAYERS,
        UNREFERENCED,
        decoy_aspects::REASON,
        decoy_aspects::KIND,
        decoy_aspects::LEAF_SIZE,
        decoy_aspects::LARGE_LEAF,
        decoy_aspects::PLACE,
        decoy_aspects::LEVEL,
        decoy_aspects::CHILD_OF_ROOT,
        decoy_aspects::TREE,
        decoy_aspects::FARTHER_HIT,
        decoy_aspects::BOX,
        decoy_aspects::SIBLING,
        decoy_aspects::START,
        decoy_aspects::HISTORY,
    ],
    pairs: &[
        ["decoy", "decoy's kind"],
        ["decoy", "decoy's leaf"],
        ["decoy", "decoy's place"],
        ["decoy", "decoy's level"],
        ["decoy", "decoy's box"],
        ["decoy", "decoy's sibling"],
        ["decoy", "decoy's history"],
        ["decoy", "range"],
    ],
    fields: &[],
    calls,
    not_asked: &[
        not_asked(
            &["nodes"],
            &["none", "one, an empty leaf"],
            OF_A_HIT,
            "In an empty tree, there is nothing to hit.",
        ),
        not_asked(
            &["primitives"],
            &["0"],
            OF_A_HIT,
            "In an empty tree, there is nothing to hit.",
        ),
        not_asked(
            &[
                "distance relative to the coordinates of the start",
                "start relative to the boxes around the hit",
                "start on the shape that is hit",
                "position of the hit primitive in its leaf",
                "another hit close behind",
                "nodes waiting",
            ],
            &[],
            &["`None`"],
            "A ray that hits nothing has no hit to describe.",
        ),
        not_asked(
            &["start before a decoy"],
            &["in the sibling's box, which contains the hit"],
            &["`None`"],
            "If a ray hits nothing, no box contains a hit.",
        ),
        not_asked(
            &[
                "decoy in a child of the root",
                "decoy after a farther hit",
                "decoy's tree",
                "decoy's large leaf",
            ],
            &[],
            &["`None`"],
            "A decoy that is tested is returned, whether or not there is another hit.",
        ),
        not_asked(
            &["decoy's box"],
            &["a line or a point"],
            &["pairs"],
            "Whether a ray hits a line or a point depends on rounding, so a box like this is \
             tested only where it is missed.",
        ),
        not_asked(
            &["decoy"],
            &[
                "its box begins beyond the hit",
                "the hit comes before its box, and its sibling's box is farther still",
                "the hit comes before its sibling's box, and its own box is farther still",
            ],
            &["`None`"],
            "If a ray hits nothing, there is no closest hit, so no box can begin beyond it.",
        ),
        not_asked(
            &["decoy's history"],
            &["after a parallel ray that enters the decoy's box before the sibling's box"],
            &["`None`", "pairs"],
            "The order of two boxes matters only if the second box begins beyond a hit in the \
             first box.",
        ),
        not_asked(
            &["history"],
            &[],
            &["`None`", "normal", "origin", "position", "shape", "uv"],
            "If an exam repeats a ray, it tests only the distance. This is enough, since a trace \
             left over from an earlier call has the wrong distance as well.",
        ),
        not_asked(
            &[],
            &[],
            &["normal", "origin", "position", "shape", "uv"],
            "Whatever the tree's shape, size and position, traversing it returns the primitive's \
             trace unchanged. So these quantities are tested for only a few trees, but the \
             distance is tested for all trees.",
        ),
        not_asked(
            &["size"],
            &["500"],
            &[],
            "The size of a tree in this class is at least half of the largest coordinate. An exam \
             tests such a tree only if its seed leaves room for one.",
        ),
    ],
};

/// The columns for rays that hit.
const OF_A_HIT: &[&str] = &[
    "some", "distance", "normal", "origin", "position", "shape", "uv",
];

/// Where the tree comes from: the exam or the submission.
const WAY: Aspect<TraverseCall> = Aspect {
    name: "tree",
    classes: &["the exam's", "the student's own"],
    class: |call| Some(usize::from(call.subject.is_built)),
};

/// The number of nodes in the exam's tree.
const NODES: Aspect<TraverseCall> = Aspect {
    name: "nodes",
    classes: &[
        "none",
        "one, an empty leaf",
        "one, a leaf of one",
        "one, a leaf of several",
        "3",
        "5 to 19",
        "20 or more",
    ],
    class: |call| {
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
};

/// The number of levels in the exam's tree.
const LEVELS: Aspect<TraverseCall> = Aspect {
    name: "levels",
    classes: &["1", "2 to 5", "6 to 12", "13 to 59", "60"],
    class: |call| {
        let levels = call.subject.levels;
        (levels > 0).then(|| class_up_to(&[1, 5, 12, 59], levels))
    },
};

/// The largest leaf of the exam's tree.
const LEAF_SIZE: Aspect<TraverseCall> = Aspect {
    name: "largest leaf",
    classes: &["1", "2", "3 to 8", "9 to 32", "33 to 255", "256 to 1,000"],
    class: |call| {
        let leaves = call.subject.leaves.iter();
        let sizes = leaves.map(|&leaf| call.subject.tree.primitives(leaf).len());
        let largest = sizes.max().filter(|&size| size > 0)?;
        Some(class_up_to(&[1, 2, 8, 32, 255], largest))
    },
};

/// The position of the root among the nodes of the exam's tree.
const ROOT: Aspect<TraverseCall> = Aspect {
    name: "root",
    classes: &["first", "in the middle", "last"],
    class: |call| {
        let Tree { nodes, root, .. } = &call.subject.tree;
        (nodes.len() > 1).then_some(match *root {
            0 => 0,
            root if root + 1 == nodes.len() => 2,
            _ => 1,
        })
    },
};

/// The number of primitives in the tree.
const COUNT: Aspect<TraverseCall> = Aspect {
    name: "primitives",
    classes: &[
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
    class: |call| {
        Some(match call.subject.shapes().len() {
            count @ ..=3 => count,
            count => 2 + powers_of_two(count).clamp(2, 11),
        })
    },
};

/// The kinds of the primitives.
const KIND: Aspect<TraverseCall> = Aspect {
    name: "kind",
    classes: &["triangles", "flat triangles", "spheres", "mixed"],
    class: |call| {
        let shapes = call.subject.shapes().into_iter();
        let kinds: BTreeSet<usize> = shapes.map(kind).collect();
        let first = kinds.first().copied()?;
        Some(if kinds.len() > 1 { 3 } else { first })
    },
};

/// The start of the ray.
const START: Aspect<TraverseCall> = Aspect {
    name: "start",
    classes: &[
        "outside the root's box",
        "more than 3 diagonals away",
        "inside the root's box",
        "inside a leaf's box",
    ],
    class: |call| {
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
};

/// The previous call on the same tree.
const HISTORY: Aspect<TraverseCall> = Aspect {
    name: "history",
    classes: &[
        "first call on a tree",
        "after another ray",
        "after the same ray with another range",
        "after almost the same ray, with another hit",
        "after a ray in the opposite or a mirrored direction, with another hit",
    ],
    class: |call| {
        if call.is_after_almost_the_same_ray() {
            return Some(3);
        }
        if call.is_after_a_mirrored_ray() {
            return Some(4);
        }
        Some(history_class(call.previous.as_ref(), &call.ray))
    },
};

/// The distance to the hit as a fraction of the largest coordinate of the ray's start.
const NEARNESS: Aspect<TraverseCall> = Aspect {
    name: "distance relative to the coordinates of the start",
    classes: &["below 1e-5", "1e-5", "1e-3 or more"],
    class: |call| {
        let largest = f64::from(call.ray.origin.abs().max_element());
        Some(match call.hit?.distance / largest {
            ..1e-5 if call.ray.range.min == 0.0 => 0,
            ..1e-3 => 1,
            _ => 2,
        })
    },
};

/// The start of the ray relative to the boxes around the hit.
const IN_BOX: Aspect<TraverseCall> = Aspect {
    name: "start relative to the boxes around the hit",
    classes: &[
        "before all boxes around the hit",
        "before the middle of a box",
        "beyond the middle of a box",
        "more than half a side beyond the middle",
    ],
    class: |call| {
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
};

/// Whether the ray starts on the sphere that it hits.
const ON_SPHERE: Aspect<TraverseCall> = Aspect {
    name: "start on the shape that is hit",
    classes: &["elsewhere", "on the sphere that is hit again"],
    class: |call| {
        let hit = call.hit?;
        let mut shapes = call.subject.tree.shapes.iter();
        let shape = shapes.find(|shape| shape.number() == hit.shape)?;
        let Shape::Sphere { center, radius, .. } = *shape else {
            return Some(0);
        };
        let from_center = call.ray.origin.distance(center);
        Some(usize::from((from_center / radius - 1.0).abs() < 0.01))
    },
};

/// The number of primitives whose boxes the ray enters before it hits something or ends.
const ON_THE_WAY: Aspect<TraverseCall> = Aspect {
    name: "primitives' boxes on the way",
    classes: &["up to 2,048", "2,049 to 5,000"],
    class: |call| {
        let ray64 = Ray64::from(&call.ray);
        let on_the_way = Ray64 {
            max: call.hit.map_or(ray64.max, |hit| hit.distance),
            ..ray64
        };
        let shapes = call.subject.shapes().into_iter();
        let boxes = shapes.filter(|shape| scan::bounds(shape).span(&on_the_way).is_some());
        Some(class_up_to(&[2048], boxes.count()))
    },
};

/// The index of the hit primitive in its leaf.
const PLACE_OF_HIT: Aspect<TraverseCall> = Aspect {
    name: "position of the hit primitive in its leaf",
    classes: &[
        "up to the 16th",
        "up to the 512th",
        "later",
        "the last of a thousand",
    ],
    class: |call| Some(class_up_to(&[15, 511, 998], call.place_in_leaf()?)),
};

/// The number of nodes that a traversal enters only after the leaf with the hit.
const WAITING: Aspect<TraverseCall> = Aspect {
    name: "nodes waiting",
    classes: &["up to 47", "48 or more"],
    class: |call| Some(class_up_to(&[47], call.nodes_waiting()?)),
};

/// A second hit close behind the closest hit.
const LAYERS: Aspect<TraverseCall> = Aspect {
    name: "another hit close behind",
    classes: &[
        "within a thousandth of the distance, earlier in the same leaf",
        "in a leaf around the start, with both hits within 1e-3 diagonals of the start",
        "within a thousandth of the distance, in a leaf that is entered earlier",
    ],
    class: |call| {
        Some(match call.layer()? {
            SecondLeaf::Same => 0,
            SecondLeaf::Other => 1,
            SecondLeaf::Earlier => 2,
        })
    },
};

/// An unreferenced primitive in front of the answer.
const UNREFERENCED: Aspect<TraverseCall> = Aspect {
    name: "primitive in front that is in no leaf",
    classes: &["small", "as large as the tree"],
    class: |call| call.unreferenced_in_front().map(usize::from),
};

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};
    use protocol::{Question, Ray};

    use super::*;
    use crate::domains::Domain;
    use crate::tree::construction;

    pub(super) fn row_of_spheres() -> Tree {
        let spheres = (0..3).map(|index| Shape::Sphere {
            center: 4.0 * index as f32 * Vec3::X,
            radius: 1.0,
            shape: index,
        });
        construction::median_split(spheres.collect(), 1)
    }

    #[test]
    fn every_aspect_has_the_class_of_a_call() {
        let ray = Ray::new(vec3(-5.0, 0.0, 0.0), Vec3::X);
        let rays = vec![ray, ray.within(1.0, 9.0)];
        let question = Question::hits(row_of_spheres().geometry(), rays);
        let calls = TRAVERSE.classes(&question, None);
        let names = calls.into_iter().map(|classes| {
            let aspects = TRAVERSE.aspects().into_iter().zip(classes);
            let names = aspects.map(|((_, names), class)| Some(names[class?]));
            names.collect::<Vec<_>>()
        });
        let names: Vec<_> = names.collect();
        let expected = [
            Some("the exam's"),
            Some("5 to 19"),
            Some("2 to 5"),
            Some("1"),
            Some("last"),
            Some("3"),
            Some("1"),
            Some("around the origin"),
            None,
            Some("spheres"),
            Some("outside the root's box"),
            Some("along +x"),
            Some("from 0 to ∞"),
            Some("first call on a tree"),
            Some("1e-3 or more"),
            Some("before all boxes around the hit"),
            Some("elsewhere"),
            Some("up to 2,048"),
        ];
        assert_eq!(names[0][..expected.len()], expected);
        let history = "after the same ray with another range";
        assert_eq!(
            names[1][12..14],
            [Some("from a later start to a nearby end"), Some(history)]
        );
    }

    #[test]
    fn the_first_call_of_a_subject_can_follow_another_subject() {
        let rays = vec![Ray::new(vec3(-5.0, 0.0, 0.0), Vec3::X); 2];
        let question = Question::hits(row_of_spheres().geometry(), rays);
        let first_calls = |before| {
            let calls = TRAVERSE.classes(&question, before).into_iter();
            calls.map(|mut call| call.pop()).collect::<Vec<_>>()
        };
        assert_eq!(first_calls(None), [Some(None); 2]);
        assert_eq!(first_calls(Some(&question)), [Some(Some(0)), Some(None)]);
    }
}
