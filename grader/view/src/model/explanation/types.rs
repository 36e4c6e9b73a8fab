//! An explanation as sent to the page.

use framework::render::path_steps::Bounce;
use glam::{UVec2, Vec3};
use serde::Serialize;
use view_probe::rules::Rule;

use crate::model::history::SampleRow;

/// An explained pixel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    /// The pixel, counted from the bottom left, or `None` for a ray from the exam.
    pub pixel: Option<UVec2>,
    /// The number of the path, or `None` for the ray through the centre.
    pub sample: Option<u32>,
    /// The rays, in the order they were traced.
    pub rays: Vec<ExplainedRay>,
    /// The radiance of the path.
    pub radiance: Option<Vec3>,
    /// The steps of the path, as logged by the path tracer.
    pub steps: Vec<String>,
    /// The bounces of the path, each with the index of its first step.
    pub bounces: Vec<BounceRow>,
    /// The first samples of the pixel. There are none for a ray from the exam, or if part two isn't
    /// written yet.
    pub history: Vec<SampleRow>,
    /// The reason the samples cannot be listed.
    pub history_problem: Option<String>,
    /// The panic that ended the recording: its message and its location.
    pub panic: Option<[String; 2]>,
}

/// A bounce of a path, with its bad values as text.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BounceRow {
    #[serde(flatten)]
    bounce: Bounce,
    /// Whether the scattered direction has a density. In JSON, NaN looks like no density.
    has_pdf: bool,
    problems: Vec<String>,
}

impl From<&Bounce> for BounceRow {
    fn from(bounce: &Bounce) -> Self {
        let problems = bounce.bad_values.iter().map(ToString::to_string).collect();
        BounceRow {
            bounce: bounce.clone(),
            has_pdf: bounce.pdf.is_some(),
            problems,
        }
    }
}

/// An explained ray.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExplainedRay {
    /// The purpose of the ray, such as "camera ray".
    pub kind: String,
    /// Whether the ray leads to a light, which is visible if the ray hits nothing.
    pub is_shadow_ray: bool,
    /// The origin.
    pub origin: Vec3,
    /// The direction.
    pub dir: Vec3,
    /// The range. An infinite end is `None`.
    pub range: [Option<f32>; 2],
    /// The result of `Bvh::hit`.
    pub hit: Option<ExplainedHit>,
    /// The tests, in order.
    pub rows: Vec<ExplainedTest>,
    /// The number of box tests, including those that aren't listed.
    pub boxes: u32,
    /// The number of primitive tests, including those that aren't listed.
    pub primitives: u32,
    /// Remarks about all tests, taken together.
    pub notes: Vec<String>,
}

/// The result of `Bvh::hit`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ExplainedHit {
    /// The distance.
    pub distance: f32,
    /// The position.
    pub position: Vec3,
    /// The index of the shape.
    pub shape: u32,
}

/// A test.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExplainedTest {
    /// Whether a box was tested, rather than a primitive.
    pub is_box: bool,
    /// The nodes with this box, or the leaf that contains the primitive.
    pub nodes: Vec<u32>,
    /// The level of the first of these nodes.
    pub level: Option<u32>,
    /// The index of the shape.
    pub shape: Option<u32>,
    /// The lower and the upper corner of the box.
    pub corners: Option<[Vec3; 2]>,
    /// The corners of the triangle.
    pub triangle: Option<[Vec3; 3]>,
    /// The outcome.
    pub outcome: TestOutcome,
    /// The part of the ray inside the box, or the distance to the hit.
    pub at: Vec<f32>,
    /// The closest hit after this test.
    pub closest: Option<f32>,
    /// The rules that this test breaks, each with the node that shouldn't have been entered.
    pub marks: Vec<(Rule, u32)>,
    /// Whether the primitive had already been tested for this ray.
    pub again: bool,
}

/// The outcome of a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TestOutcome {
    /// The ray hits the box, and the node was entered.
    Entered,
    /// The ray hits the box, but the node was not entered.
    NotEntered,
    /// The ray hits the box, but the box begins beyond the closest hit, so the node was not
    /// entered.
    SkippedBeyond,
    /// The ray hits the box, but outside the `times` argument.
    OutsideTimes,
    /// The ray misses the box.
    Missed,
    /// The primitive is the closest hit so far.
    Closest,
    /// The primitive is hit, but isn't the closest.
    Farther,
    /// The primitive isn't hit.
    NoHit,
}
