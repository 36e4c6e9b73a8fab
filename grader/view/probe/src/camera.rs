//! The viewer's own camera, which is used while a submission's camera is not written yet.

use framework::math::sin_cos;
use framework::submission::CameraRays;
use glam::{UVec2, Vec2, Vec3};
use protocol::{ExamCamera, PinholeCamera, Ray, Sample};

/// A camera of the exam, whose rays `protocol` computes.
pub(crate) struct ViewerCamera(ExamCamera);

impl ViewerCamera {
    pub(crate) fn new(pinhole: &PinholeCamera) -> Self {
        let (sin, cos) = sin_cos(0.5 * pinhole.vertical_fov.to_radians());
        ViewerCamera(ExamCamera {
            eye: Vec3::ZERO,
            forward: Vec3::NEG_Z * cos,
            right: Vec3::X * sin * pinhole.aspect_ratio,
            up: Vec3::Y * sin,
            film: pinhole.film,
        })
    }
}

impl CameraRays for ViewerCamera {
    fn ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let ViewerCamera(camera) = self;
        camera.ray(Sample { pixel, offset })
    }
}
