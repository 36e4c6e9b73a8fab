//! Recorded tests.

use framework::render::path_log::MAX_STEPS;
use framework::render::path_steps::Bounce;
use glam::Vec3;
use protocol::{Interval, Panic, Ray, Trace};
use serde::{Deserialize, Serialize};

use super::TestCounts;
use super::limits::{MAX_RAYS, at_most};

/// The tests recorded for a ray, or for all rays in a path.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RecordedRays {
    /// The rays, in the order they were traced.
    #[serde(deserialize_with = "at_most::<_, _, MAX_RAYS>")]
    pub rays: Vec<RecordedRay>,
    /// The radiance of the path.
    pub radiance: Option<Vec3>,
    /// The steps of the path, as logged by the path tracer.
    #[serde(deserialize_with = "at_most::<_, _, MAX_STEPS>")]
    pub steps: Vec<String>,
    /// The bounces of the path.
    #[serde(deserialize_with = "at_most::<_, _, MAX_STEPS>")]
    pub bounces: Vec<Bounce>,
    /// The panic that ended the recording.
    pub panic: Option<Panic>,
}

/// The tests recorded for one ray.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordedRay {
    /// The ray that was passed to `Bvh::hit`.
    pub ray: Ray,
    /// The result of `Bvh::hit`. `Trace::shape` is the index of the shape. `None` if the ray missed
    /// or the method panicked.
    pub hit: Option<Trace>,
    /// The tests, in order. Tests beyond the maximum number are left out.
    pub tests: Vec<Test>,
    /// The counts of all tests, including those that aren't listed.
    pub counts: TestCounts,
    /// The number of steps that the path tracer logged before it traced the ray.
    pub steps_before: usize,
}

impl RecordedRay {
    /// Returns a ray without tests.
    pub(crate) fn new(ray: Ray, steps_before: usize) -> Self {
        RecordedRay {
            ray,
            steps_before,
            hit: None,
            tests: Vec::new(),
            counts: TestCounts::default(),
        }
    }
}

/// A call to `BBox::hit` or `Primitive::hit`, with its result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Test {
    /// A call to `BBox::hit`.
    Box {
        /// The lower corner of the box.
        min: Vec3,
        /// The upper corner of the box.
        max: Vec3,
        /// The `times` argument.
        times: Interval,
        /// The result.
        inside: Option<Interval>,
        /// The address of the box. Nodes with equal boxes have different addresses unless the
        /// traversal copies them.
        address: u64,
    },
    /// A call to `Primitive::hit`.
    Primitive {
        /// The index of the shape in the scene.
        shape: u32,
        /// The range of the ray argument.
        range: Interval,
        /// The distance of the hit.
        distance: Option<f32>,
    },
}
