//! The domain of `Bvh::hit`, both on the exam's trees and on trees that the submission builds.

mod aspects;
mod call;
mod decoy;
mod decoy_aspects;
mod draw;

use self::aspects::ASPECTS;
use self::call::calls;
use self::decoy_aspects::DECOY_ASPECTS;
use super::{FunctionDomain, not_asked};

pub use call::TraverseCall;
pub use draw::{
    ray, ray_from_a_surface, ray_in_a_corner, ray_through_the_sphere_that_it_starts_on,
};

/// The domain of `Bvh::hit`.
pub static TRAVERSE: FunctionDomain<TraverseCall> = FunctionDomain {
    aspects: &[ASPECTS, DECOY_ASPECTS],
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
    not_asked: &[
        not_asked(&["nodes", "primitives"])
            .classes(&["none", "one, an empty leaf", "0"])
            .columns(OF_A_HIT)
            .because("In an empty tree, there is nothing to hit."),
        not_asked(&[
            "distance relative to the coordinates of the start",
            "start relative to the boxes around the hit",
            "start on the shape that is hit",
            "position of the hit primitive in its leaf",
            "another hit close behind",
            "nodes waiting",
        ])
        .columns(&["`None`"])
        .because("A ray that hits nothing has no hit to describe."),
        not_asked(&["start before a decoy"])
            .classes(&["in the sibling's box, which contains the hit"])
            .columns(&["`None`"])
            .because("If a ray hits nothing, no box contains a hit."),
        not_asked(&[
            "decoy in a child of the root",
            "decoy after a farther hit",
            "decoy's tree",
            "decoy's large leaf",
        ])
        .columns(&["`None`"])
        .because("A decoy that is tested is returned, whether or not there is another hit."),
        not_asked(&["decoy's box"])
            .classes(&["a line or a point"])
            .columns(&["pairs"])
            .because(
                "Whether a ray hits a line or a point depends on rounding, so a box like this \
                 is tested only where it is missed.",
            ),
        not_asked(&["decoy"])
            .classes(&[
                "its box begins beyond the hit",
                "the hit comes before its box, and its sibling's box is farther still",
                "the hit comes before its sibling's box, and its own box is farther still",
            ])
            .columns(&["`None`"])
            .because(
                "If a ray hits nothing, there is no closest hit, so no box can begin beyond it.",
            ),
        not_asked(&["decoy's history"])
            .classes(&["after a parallel ray that enters the decoy's box before the sibling's box"])
            .columns(&["`None`", "pairs"])
            .because(
                "The order of two boxes matters only if the second box begins beyond a hit in \
                 the first box.",
            ),
        not_asked(&["history"])
            .columns(&["`None`", "normal", "origin", "position", "shape", "uv"])
            .because(
                "If an exam repeats a ray, it tests only the distance. This is enough, since a \
                 trace left over from an earlier call has the wrong distance as well.",
            ),
        not_asked(&[])
            .columns(&["normal", "origin", "position", "shape", "uv"])
            .because(
                "Whatever the tree's shape, size and position, traversing it returns the \
                 primitive's trace unchanged. So these quantities are tested for only a few \
                 trees, but the distance is tested for all trees.",
            ),
        not_asked(&["size"]).classes(&["500"]).because(
            "The size of a tree in this class is at least half of the largest coordinate. \
             An exam tests such a tree only if its seed leaves room for one.",
        ),
    ],
    ..FunctionDomain::new("Bvh::hit", calls)
};

/// The columns for rays that hit.
const OF_A_HIT: &[&str] = &[
    "some", "distance", "normal", "origin", "position", "shape", "uv",
];

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};
    use protocol::{Question, Ray, Shape};

    use super::*;
    use crate::domains::Domain;
    use crate::tree::{Tree, construction};

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
