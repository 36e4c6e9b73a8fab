//! Notes that say why a picture will take a long time.

use glam::Vec3;
use protocol::{Ray, Shape, Tree, TreeNode};

use crate::harness::attempt::attempt;
use crate::scene::Scene;
use crate::submission::Submission;

/// The number of primitives above which testing all of them takes a long time.
const MANY_PRIMITIVES: usize = 200;
/// A leaf is slow if it exceeds the maximum size by more than this factor.
const LARGE_LEAF_FACTOR: usize = 10;

/// Returns a note if a ray may be tested against many primitives, because part of task 3 isn't
/// written or doesn't work yet.
pub(super) fn note(submission: &dyn Submission, scene: &Scene, tree: &Tree) -> Option<String> {
    let count = scene.shapes.len();
    let shape = scene.shapes.first()?;
    let leaves = tree.nodes.iter().filter(|node| node.is_leaf());
    let largest = leaves.map(|leaf| leaf.size as usize).max().unwrap_or(0);
    let (why, tested) = if tree.nodes.is_empty() {
        ("build: no tree yet", format!("all {count}"))
    } else if !skips_missed_boxes(submission, shape) {
        let why = "traverse: `Bvh::hit` doesn't use the boxes of the tree yet";
        (why, format!("all {count}"))
    } else if largest > LARGE_LEAF_FACTOR * scene.max_leaf_size {
        ("build: a leaf is too large", largest.to_string())
    } else {
        return None;
    };
    let quick = if count > MANY_PRIMITIVES {
        "; `--samples 4` is enough for a first look"
    } else {
        ""
    };
    Some(format!(
        "note: task 3, {why}, so each ray may test {tested} primitives{quick}"
    ))
}

/// Returns whether the submission's traversal skips a primitive if the ray misses its leaf's box.
/// In a tree built by `Bvh::build`, the ray would then miss the primitive too, but in the tree that
/// this function makes, the primitive is in the ray's path.
fn skips_missed_boxes(submission: &dyn Submission, shape: &Shape) -> bool {
    let (target, toward) = match *shape {
        Shape::Triangle { vertices, .. } => aim(vertices.map(|vertex| vertex.position)),
        Shape::FlatTriangle { corners, .. } => aim(corners),
        Shape::Sphere { center, radius, .. } => (center, 2.0 * radius * Vec3::NEG_Z),
    };
    let ray = Ray::new(target - toward, toward.normalize_or_zero());
    // The box isn't flat, since a ray that only touches a box may hit or miss it.
    let behind = target - 3.0 * toward;
    let half = Vec3::splat(0.5 * toward.length());
    let leaf = TreeNode::new(behind - half, behind + half, 0, 1, 0, 0);
    let bvh = || submission.prebuilt_tree(&[*shape], &[leaf], 0);
    !attempt(|| bvh().closest_hit(&ray)).is_ok_and(|hit| hit.is_some())
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
    use super::*;
    use crate::tests::{CORRECT, SphereSubmission, scene};

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
        starts(&CORRECT, &Tree::default(), "note: task 3, build: no tree");
        // This submission tests every primitive, regardless of the tree.
        starts(&CORRECT, &leaf(1), "note: task 3, traverse: `Bvh::hit`");
        // If a primitive can't be tested at all, another message says so.
        let panicking = SphereSubmission {
            alter: |_| panic!("the sphere is hit"),
            ..CORRECT
        };
        starts(
            &panicking,
            &leaf(99),
            "note: task 3, build: a leaf is too large",
        );
        assert_eq!(note(&panicking, scene, &leaf(4)), None);
    }
}
