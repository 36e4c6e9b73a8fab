//! The one seam between what is given and what students write.

use glam::{UVec2, Vec2};
use protocol::{Answer, Question, Ray, Trace, Tree};

use crate::scene::Scene;

/// The five files of a submission, behind what is given in `world.rs`.
pub trait Submission: Sync {
    /// The scene, made of the submission's own types, ready for rays.
    fn world(&self, scene: &Scene) -> Box<dyn World>;

    /// The answer to one question of the grader.
    fn answer(&self, question: &Question) -> Answer;
}

/// A scene made of a submission's own types: all that the integrator sees of it.
pub trait World: Sync {
    /// `Camera::sample_ray`, in camera space.
    fn camera_ray(&self, pixel: UVec2, offset: Vec2) -> Ray;

    /// `Bvh::hit`, in world space.
    fn hit(&self, ray: &Ray) -> Option<Trace>;

    /// The tree that `Bvh::build` made.
    fn tree(&self) -> Tree;
}
