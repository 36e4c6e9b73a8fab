//! Submissions graded by several tests: the reference, the starter, and the reference with small
//! changes. A run used by several tests is kept in a static, so that its submission is only graded
//! once.

use std::sync::LazyLock;

use crate::harness::{GradeRun, Submission};

pub static REFERENCE: LazyLock<GradeRun> = LazyLock::new(|| Submission::reference("full").grade());
pub static STARTER: LazyLock<GradeRun> = LazyLock::new(|| Submission::starter("starter").grade());
pub static NOT_COMPILING: LazyLock<GradeRun> =
    LazyLock::new(|| Submission::not_compiling().grade());
pub static PANICKING: LazyLock<GradeRun> = LazyLock::new(|| Submission::panicking().grade());
pub static EXITING: LazyLock<GradeRun> = LazyLock::new(|| Submission::exiting().grade());

/// Compiles the dependencies, unless an earlier run has already done so, so that later runs start
/// working on the submission immediately.
pub fn compile_dependencies() {
    LazyLock::force(&REFERENCE);
}

impl Submission {
    /// Uses a field of `Ray` that doesn't exist, so `sphere.rs` doesn't compile.
    pub fn not_compiling() -> Self {
        Submission::reference("not_compiling").with_replaced(
            "sphere.rs",
            "let a = ray.dir.length_squared();",
            "let a = ray.direction.length_squared();",
        )
    }

    /// Panics in `Sphere::hit` if the sphere's centre has a negative x.
    pub fn panicking() -> Self {
        Submission::reference("panicking").with_replaced(
            "sphere.rs",
            "let root = discriminant.sqrt();",
            "let roots = [discriminant.sqrt()];
        let root = roots[usize::from(self.center.x < 0.0)];",
        )
    }

    /// Loops forever if a ray misses the sphere.
    pub fn looping() -> Self {
        Submission::reference("looping").with_replaced(
            "sphere.rs",
            "if discriminant < 0.0 {
            return None;
        }",
            "while discriminant < 0.0 {}",
        )
    }

    /// Ends the process when `Camera::sample_ray` reaches the fifth column of pixels.
    pub fn exiting() -> Self {
        Submission::reference("exiting").with_replaced(
            "camera.rs",
            "let height =",
            "if pixel.x > 3 {
            std::process::exit(0);
        }
        let height =",
        )
    }

    /// Uses a sphere's far root first, which is a known mistake.
    pub fn far_first(name: &str) -> Self {
        let submission = Submission::reference(name);
        submission.with_replaced("sphere.rs", "[near, far]", "[far, near]")
    }

    /// Returns NaN as the distance to a hit on a sphere.
    pub fn not_a_number() -> Self {
        Submission::reference("not_a_number").with_replaced(
            "sphere.rs",
            "distance: t,",
            "distance: t / 0.0 * 0.0,",
        )
    }

    /// Calls a helper in `bbox.rs` from `bvh.rs`.
    pub fn with_helper_in_another_file() -> Self {
        Submission::reference("helper")
            .with_replaced(
                "bbox.rs",
                "    /// Grows the box to contain `point` as well.",
                "    /// Returns the box around two boxes.
    pub fn union(a: BBox, b: BBox) -> BBox {
        BBox::new(a.min.min(b.min), a.max.max(b.max))
    }

    /// Grows the box to contain `point` as well.",
            )
            .with_replaced(
                "bvh.rs",
                "            bbox.enclose(item.bbox);
        }

        let index",
                "            bbox = BBox::union(bbox, item.bbox);
        }

        let index",
            )
    }
}
