//! The domain of `Bvh::hit`, of the exam's trees and of trees that the submission builds.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;
use protocol::{Geometry, Question, Ray, Shape};

use super::build::kind;
use super::fields::{
    DIRECTIONS, OCTANTS, PLACES, RANGES, SIZES, class_up_to, direction, direction_class,
    history_class, octant, place_class, powers_of_two, range_class, size_class,
};
use super::{Aspect, FunctionDomain, not_asked};
use crate::oracle::bbox::Bounds;
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;
use crate::tree::Tree;

/// A call of `Bvh::hit`.
#[derive(Clone, Debug)]
pub struct TraverseCall {
    subject: Arc<Subject>,
    ray: Ray,
    previous: Option<Ray>,
}

/// A tree that rays are asked of.
#[derive(Debug)]
struct Subject {
    /// The exam's tree. A tree that the submission builds has no nodes yet.
    tree: Tree,
    is_built: bool,
    /// The box around all primitives in leaves.
    bounds: Bounds,
    leaves: Vec<usize>,
    levels: usize,
}

impl Subject {
    fn of(geometry: &Geometry) -> Option<Subject> {
        let (tree, is_built) = match geometry {
            Geometry::List { .. } => return None,
            Geometry::Tree {
                shapes,
                nodes,
                root,
            } => (
                Tree {
                    shapes: shapes.clone(),
                    nodes: nodes.clone(),
                    root: *root as usize,
                },
                false,
            ),
            Geometry::BuiltTree { shapes, .. } => (
                Tree {
                    shapes: shapes.clone(),
                    ..Tree::default()
                },
                true,
            ),
        };
        let leaves = tree.leaves();
        let bounds = if tree.nodes.is_empty() {
            Bounds::enclosing(tree.shapes.iter().map(scan::bounds))
        } else {
            tree.bounds(tree.root)
        };
        let levels = leaves.iter().map(|&leaf| tree.path(leaf).len()).max();
        Some(Subject {
            levels: levels.unwrap_or(0),
            is_built,
            bounds,
            leaves,
            tree,
        })
    }

    fn size(&self) -> f64 {
        0.5 * (self.bounds.max - self.bounds.min).max_element()
    }

    /// Returns the number of nodes that can be reached.
    fn nodes(&self) -> usize {
        (2 * self.leaves.len()).saturating_sub(1)
    }

    /// Returns the primitives in leaves, or all that a tree is built over.
    fn shapes(&self) -> Vec<&Shape> {
        if self.is_built {
            return self.tree.shapes.iter().collect();
        }
        let in_leaves = self
            .leaves
            .iter()
            .flat_map(|&leaf| self.tree.primitives(leaf));
        in_leaves.map(|index| &self.tree.shapes[index]).collect()
    }
}

/// The domain of `Bvh::hit`.
pub static TRAVERSE: FunctionDomain<TraverseCall> = FunctionDomain {
    function: "Bvh::hit",
    subject_aspects: &[],
    aspects: &[
        WAY, NODES, LEVELS, LEAF_SIZE, ROOT, COUNT, SIZE, PLACE, OCTANT, KIND, START, DIRECTION,
        RANGE, HISTORY,
    ],
    pairs: &[],
    calls,
    not_asked: &[
        not_asked(
            "nodes",
            &["none", "one, an empty leaf"],
            &[
                "some", "distance", "normal", "origin", "position", "shape", "uv",
            ],
            "Nothing is hit in an empty tree.",
        ),
        not_asked(
            "primitives",
            &["0"],
            &[
                "some", "distance", "normal", "origin", "position", "shape", "uv",
            ],
            "Nothing is hit in an empty tree.",
        ),
        not_asked(
            "history",
            &[],
            &["`None`", "normal", "origin", "position", "shape", "uv"],
            "An exam asks the same ray again for the distance, as a trace that is kept has a wrong distance, too.",
        ),
        not_asked(
            "",
            &[],
            &["normal", "origin", "position", "shape", "uv"],
            "A tree returns the trace of a primitive unchanged, whatever the form, size and place of the tree. So these quantities are asked of a few trees, and the distance of all.",
        ),
        not_asked(
            "size",
            &["500"],
            &[],
            "A tree that is half as large as the largest coordinate allows is asked of where the seed has room for one.",
        ),
    ],
};

fn calls(question: &Question) -> Vec<TraverseCall> {
    let Question::Hit(table) = question else {
        return Vec::new();
    };
    let Some(subject) = Subject::of(&table.subject).map(Arc::new) else {
        return Vec::new();
    };
    let mut previous = None;
    let rays = table.rows.to_vec();
    let calls = rays.iter().map(|&ray| TraverseCall {
        subject: Arc::clone(&subject),
        previous: previous.replace(ray),
        ray,
    });
    calls.collect()
}

/// Where the tree comes from.
const WAY: Aspect<TraverseCall> = Aspect {
    name: "tree",
    classes: &["the exam's", "the student's own"],
    class: |call| Some(usize::from(call.subject.is_built)),
};

/// The number of nodes of the exam's tree.
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

/// The number of levels of the exam's tree.
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
        "more",
    ],
    class: |call| {
        Some(match call.subject.shapes().len() {
            count @ ..=3 => count,
            count => 2 + powers_of_two(count).clamp(2, 9),
        })
    },
};

/// The size of the tree.
const SIZE: Aspect<TraverseCall> = Aspect {
    name: "size",
    classes: SIZES,
    class: |call| {
        let size = call.subject.size();
        (size > 0.0).then(|| size_class(size))
    },
};

/// The position of the tree.
const PLACE: Aspect<TraverseCall> = Aspect {
    name: "place",
    classes: PLACES,
    class: |call| {
        let size = call.subject.size();
        (size > 0.0).then(|| place_class(call.subject.bounds.center(), size))
    },
};

/// The octant of the tree, if it is in one.
const OCTANT: Aspect<TraverseCall> = Aspect {
    name: "octant",
    classes: OCTANTS,
    class: |call| {
        let Bounds { min, max } = call.subject.bounds;
        let is_in_one = call.subject.size() > 0.0 && (min * max).min_element() > 0.0;
        is_in_one.then(|| octant(min)).flatten()
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
        if subject.size() <= 0.0 {
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

/// The direction of the ray.
const DIRECTION: Aspect<TraverseCall> = Aspect {
    name: "direction",
    classes: DIRECTIONS,
    class: |call| direction_class(call.ray.dir),
};

/// The range of the ray.
const RANGE: Aspect<TraverseCall> = Aspect {
    name: "range",
    classes: RANGES,
    class: |call| range_class(call.ray.range),
};

/// The call of the same tree before this one.
const HISTORY: Aspect<TraverseCall> = Aspect {
    name: "history",
    classes: &[
        "first call of a tree",
        "after another ray",
        "after the same ray with another range",
    ],
    class: |call| Some(history_class(call.previous.as_ref(), &call.ray)),
};

/// Draws a ray toward a point in a tree. It starts outside, far away or inside. No shape is farther away
/// than 30 of its sizes.
pub fn ray(rng: &mut Rng, tree: &Tree) -> Ray {
    /// The farthest start, in sizes of the smallest shape.
    const FARTHEST: f64 = 27.0;
    let bounds = tree.bounds(tree.root);
    let target = bounds.center() + rng.point(0.45) * (bounds.max - bounds.min);
    let sizes = tree.shapes.iter().map(|shape| {
        let bounds = scan::bounds(shape);
        0.5 * (bounds.max - bounds.min).max_element()
    });
    let smallest = sizes.fold(f64::INFINITY, f64::min);
    let farthest = FARTHEST * smallest - bounds.diagonal();
    let dir = direction(rng);
    let near = rng.uniform(0.6, 1.0) * bounds.diagonal();
    let distance = match rng.index(6) {
        0 => rng.uniform(0.0, 0.2) * bounds.diagonal(),
        1 => near.max(farthest.min(6.0 * bounds.diagonal())),
        _ => near,
    };
    let start: DVec3 = target - distance * dir;
    Ray::new(start.as_vec3(), dir.as_vec3())
}

/// Draws a ray that starts at the hit of another one. Its range begins later. Returns `None` if that one
/// hits nothing.
pub fn ray_from_a_surface(rng: &mut Rng, tree: &Tree) -> Option<Ray> {
    let hit = tree.expected_hit(&Ray64::from(&ray(rng, tree)))?;
    let later = 0.02 * tree.bounds(tree.root).diagonal();
    let ray = Ray::new(hit.position.as_vec3(), direction(rng).as_vec3());
    Some(ray.within(later as f32, f32::INFINITY))
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};

    use super::*;
    use crate::domains::Domain;
    use crate::seed::Seed;
    use crate::tree::construction;

    fn row_of_spheres() -> Tree {
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
        let calls = TRAVERSE.classes(&question);
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
            Some("first call of a tree"),
        ];
        assert_eq!(names[0], expected);
        let history = "after the same ray with another range";
        assert_eq!(
            names[1][12..],
            [Some("from later to an end"), Some(history)]
        );
    }

    #[test]
    fn rays_lead_toward_the_tree_from_not_too_far_away() {
        let tree = row_of_spheres();
        let mut rng = Seed(1).rng("domains.traverse");
        for _ in 0..100 {
            let ray = ray(&mut rng, &tree);
            let span = tree.bounds(tree.root).span(&Ray64::from(&ray));
            assert!(span.is_some(), "{ray:?}");
            assert!(ray.origin.length() < 30.0 + 8.0, "{ray:?}");
        }
    }

    #[test]
    fn a_ray_from_a_surface_starts_where_another_one_hits() {
        let tree = row_of_spheres();
        let mut rng = Seed(2).rng("domains.traverse");
        let ray = rng.retry(|rng| ray_from_a_surface(rng, &tree));
        let start = ray.origin.as_dvec3();
        let mut centers = (0..3).map(|index| 4.0 * f64::from(index) * DVec3::X);
        assert!(centers.any(|center| (start.distance(center) - 1.0).abs() < 1e-5));
        assert!(ray.range.min > 0.0);
    }
}
