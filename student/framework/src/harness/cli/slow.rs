//! Notes that say why a picture will take a long time or show nothing.

use glam::Vec3;
use protocol::{Ray, Shape, Tree, TreeNode};

use crate::harness::attempt::attempt;
use crate::scene::Scene;
use crate::submission::Submission;

/// The number of primitives above which testing all of them takes a long time.
const MANY_PRIMITIVES: usize = 200;
/// A leaf is slow if it exceeds the maximum size by more than this factor.
const LARGE_LEAF_FACTOR: usize = 10;

/// Returns a note if a ray may be tested against many primitives or finds nothing, because part of
/// task 3 isn't written or doesn't work yet.
pub(super) fn note(submission: &dyn Submission, scene: &Scene, tree: &Tree) -> Option<String> {
    let count = scene.shapes.len();
    let shape = scene.shapes.first()?;
    let leaves = tree.nodes.iter().filter(|node| node.is_leaf());
    let largest = leaves.map(|leaf| leaf.size as usize).max().unwrap_or(0);
    let (why, tested) = if tree.nodes.is_empty() {
        let why = "`Bvh::build` doesn't return a tree yet";
        // The starter's `Bvh::hit` finds hits without a tree, but a correct traversal doesn't. If
        // this panics, rendering does too, and its message says why.
        if !finds(submission, shape, &[])? {
            return Some(format!("note: {why}, so `Bvh::hit` finds nothing"));
        }
        (why, format!("all {count}"))
    } else if !skips_missed_boxes(submission, shape) {
        let why = "`Bvh::hit` doesn't use the tree's boxes yet";
        (why, format!("all {count}"))
    } else if largest > LARGE_LEAF_FACTOR * scene.max_leaf_size {
        (
            "`Bvh::build` makes a leaf that is too large",
            largest.to_string(),
        )
    } else {
        return None;
    };
    let quick = if count > MANY_PRIMITIVES {
        "; to see a picture sooner, use `--samples 4`"
    } else {
        ""
    };
    Some(format!(
        "note: {why}, so each ray may be tested against {tested} primitives{quick}"
    ))
}

/// Returns whether the submission's traversal skips a primitive if the ray misses its leaf's box.
/// In a tree built by `Bvh::build`, the ray would then miss the primitive too, but in the tree that
/// this function makes, the primitive is in the ray's path.
fn skips_missed_boxes(submission: &dyn Submission, shape: &Shape) -> bool {
    let (target, toward) = target_and_vector(shape);
    // The box isn't flat, since a ray that only touches a box may hit or miss it.
    let behind = target - 3.0 * toward;
    let half = Vec3::splat(0.5 * toward.length());
    let leaf = TreeNode::new(behind - half, behind + half, 0, 1, 0, 0);
    finds(submission, shape, &[leaf]) != Some(true)
}

/// Returns whether a ray toward a primitive hits it in a tree with these nodes, or `None` if the
/// submission panics.
fn finds(submission: &dyn Submission, shape: &Shape, nodes: &[TreeNode]) -> Option<bool> {
    let (target, toward) = target_and_vector(shape);
    let ray = Ray::new(target - toward, toward.normalize_or_zero());
    let bvh = || submission.prebuilt_tree(&[*shape], nodes, 0);
    let hit = attempt(|| bvh().closest_hit(&ray)).ok()?;
    Some(hit.is_some())
}

/// Returns the centre of a primitive and a vector that leads from outside to the centre.
fn target_and_vector(shape: &Shape) -> (Vec3, Vec3) {
    match *shape {
        Shape::Triangle { vertices, .. } => aim(vertices.map(|vertex| vertex.position)),
        Shape::FlatTriangle { corners, .. } => aim(corners),
        Shape::Sphere { center, radius, .. } => (center, 2.0 * radius * Vec3::NEG_Z),
    }
}

/// Returns the centre of a triangle, and a vector perpendicular to its plane that is as long as an
/// edge.
fn aim([p0, p1, p2]: [Vec3; 3]) -> (Vec3, Vec3) {
    let (e1, e2) = (p1 - p0, p2 - p0);
    let normal = e1.cross(e2).normalize_or_zero();
    ((p0 + p1 + p2) / 3.0, e1.length() * normal)
}

#[cfg(test)]
mod tests {
    use protocol::{Interval, PinholeCamera};

    use super::*;
    use crate::submission::{Aggregate, CameraRays, Hierarchy};
    use crate::tests::{CORRECT, SphereSubmission, scene};

    /// A submission whose traversal finds nothing in a tree without nodes.
    struct Traversal;

    impl Submission for Traversal {
        fn camera(&self, pinhole: &PinholeCamera) -> Box<dyn CameraRays> {
            CORRECT.camera(pinhole)
        }

        fn build(&self, shapes: &[Shape], max_leaf_size: usize) -> Box<dyn Hierarchy> {
            CORRECT.build(shapes, max_leaf_size)
        }

        fn primitive_list(&self, shapes: &[Shape]) -> Box<dyn Aggregate> {
            CORRECT.primitive_list(shapes)
        }

        fn prebuilt_tree(
            &self,
            shapes: &[Shape],
            nodes: &[TreeNode],
            root: usize,
        ) -> Box<dyn Hierarchy> {
            let shapes = if nodes.is_empty() { &[] } else { shapes };
            CORRECT.prebuilt_tree(shapes, nodes, root)
        }

        fn intersect_box(
            &self,
            min: Vec3,
            max: Vec3,
            ray: &Ray,
            times: Interval,
        ) -> Option<Interval> {
            CORRECT.intersect_box(min, max, ray, times)
        }
    }

    #[test]
    fn says_which_part_makes_a_picture_slow() {
        let sphere = r#"{ "sphere": { "center": [0, 0, -3], "radius": 1, "material": "m" } }"#;
        let material = r#""m": { "lambertian": { "albedo": [0.5, 0.5, 0.5] } }"#;
        let scene = &scene(1.0, material, sphere);
        let leaf = |size| Tree {
            nodes: vec![TreeNode::new(Vec3::ZERO, Vec3::ONE, 0, size, 0, 0)],
            ..Tree::default()
        };
        let starts = |submission: &dyn Submission, tree: &Tree, start: &str| {
            let note = note(submission, scene, tree).unwrap_or_default();
            assert!(note.starts_with(start), "{note}");
        };
        starts(
            &CORRECT,
            &Tree::default(),
            "note: `Bvh::build` doesn't return a tree yet, so each ray",
        );
        // This submission tests every primitive, regardless of the tree.
        starts(&CORRECT, &leaf(1), "note: `Bvh::hit` doesn't use");
        // If a primitive can't be tested at all, another message says so.
        let panicking = SphereSubmission {
            alter: |_| panic!("the sphere is hit"),
            ..CORRECT
        };
        starts(
            &panicking,
            &leaf(99),
            "note: `Bvh::build` makes a leaf that is too large",
        );
        assert_eq!(note(&panicking, scene, &leaf(4)), None);
        assert_eq!(note(&panicking, scene, &Tree::default()), None);
        let nothing = "note: `Bvh::build` doesn't return a tree yet, so `Bvh::hit` finds nothing";
        assert_eq!(
            note(&Traversal, scene, &Tree::default()).as_deref(),
            Some(nothing)
        );
    }
}
