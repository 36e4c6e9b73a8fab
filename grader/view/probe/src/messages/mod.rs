//! The viewer's requests and the probe's responses. They are framed like the grader's questions.
//! See [`protocol::wire`].

mod limits;
mod recorded;

use framework::render::path_steps::FirstBadValues;
use framework::render::renderer::{InvalidSample, RenderStats};
use glam::{UVec2, Vec3};
use protocol::{ElementOutcome, Interval, Panic, Ray, Trace, Tree, TreeNode};
use serde::{Deserialize, Serialize};

use crate::rules::RULES;
use crate::scene_data::{Aim, SceneData};

use limits::{at_most, fixed_width};

pub(crate) use limits::MAX_STEP_BYTES;
pub use limits::{MAX_PANICS, MAX_SAMPLES, MAX_VALUES};
pub use recorded::{RecordedRay, RecordedRays, Test};

/// A request from the viewer.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Request {
    /// Replaces the scene. All other requests need a scene. Runs none of the submission's code.
    Scene(Box<SceneData>),
    /// Calls a method to find out whether it has been written and whether it returns. As with the
    /// grader's questions, each call is a separate request, so the viewer knows which method
    /// doesn't return.
    Try {
        /// The method.
        part: SubmissionPart,
        /// The ray to test. Unused for the camera. The ray is tested against a single shape before
        /// the tree is built, and against all shapes afterwards.
        ray: Ray,
    },
    /// Builds the tree, leaving out shapes whose `hit` hasn't been written yet. All requests listed
    /// below need the tree.
    Build,
    /// Replaces the camera and keeps the tree.
    Aim(Aim),
    /// Draws some pixels.
    Draw(Draw),
    /// Returns the tree of this size.
    Tree(TreeSize),
    /// Records the tests made for a ray or a path.
    Follow(Follow),
    /// Computes the first samples of a pixel in the shaded view, one by one.
    Samples {
        /// The pixel.
        pixel: UVec2,
        /// The number of samples.
        count: u32,
    },
    /// Calls `BBox::hit` on boxes.
    Boxes {
        /// The ray.
        ray: Ray,
        /// The corners of each box.
        boxes: Vec<(Vec3, Vec3)>,
    },
}

/// A rectangle on the film in which some pixels should be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Draw {
    /// The lower left pixel.
    pub origin: UVec2,
    /// The width and height of the rectangle, in pixels.
    pub size: UVec2,
    /// Draws only pixels whose coordinates are multiples of this number.
    pub stride: u32,
    /// Leaves out pixels whose coordinates are multiples of this number, because they have already
    /// been drawn. If the number is 0, no pixels are left out.
    pub drawn_stride: u32,
    /// The number of samples to draw for each of these pixels, one after the other. Rays through
    /// the same pixel need the same nodes, which are then in the cache.
    pub passes: u32,
    /// The number of samples drawn so far.
    pub first: u32,
    /// The quantity to compute for each pixel.
    pub quantity: Quantity,
    /// The index of the path in the first pass.
    pub sample: u32,
    /// The time in milliseconds after which the probe returns the pixels it has drawn. The probe
    /// always draws at least one pixel.
    pub milliseconds: u32,
}

/// The quantity to compute for a pixel. Some views share the same quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    /// The hit of the ray through the centre of the pixel.
    Hit,
    /// The radiance of one path per pass.
    Light,
    /// The radiance of one path per pass, with the scene in clay.
    Clay,
    /// The tests made for the ray through the centre of the pixel. Needs the recording program.
    Tests,
}

impl Draw {
    /// Returns the pixels to draw, in order, excluding those that have already been drawn. Each
    /// pixel is paired with the index of its pass.
    pub fn pixels(self) -> impl Iterator<Item = (u32, UVec2)> {
        self.pixels_of_pass()
            .flat_map(move |pixel| (0..self.passes).map(move |pass| (pass, pixel)))
            .skip(self.first as usize)
    }

    /// Returns the pixels that are drawn in each pass.
    pub fn pixels_of_pass(self) -> impl Iterator<Item = UVec2> {
        let Draw {
            origin,
            size,
            stride,
            drawn_stride,
            ..
        } = self;
        let multiples = move |from: u32, length: u32| {
            (from.next_multiple_of(stride)..from + length).step_by(stride as usize)
        };
        let is_drawn = move |x: u32, y: u32| {
            drawn_stride > 0 && x.is_multiple_of(drawn_stride) && y.is_multiple_of(drawn_stride)
        };
        multiples(origin.y, size.y)
            .flat_map(move |y| multiples(origin.x, size.x).map(move |x| (x, y)))
            .filter(move |&(x, y)| !is_drawn(x, y))
            .map(UVec2::from)
    }
}

/// A ray or a path to record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Follow {
    /// The ray or path.
    pub target: Target,
    /// The maximum number of tests to list. All tests are counted.
    pub max_tests: u32,
    /// The maximum number of rays to trace. One more ray is listed without being traced, as if it
    /// hit nothing.
    pub max_rays: u32,
}

/// A ray or a path to record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Target {
    /// The ray or the path through a pixel that a quantity is computed from.
    Pixel {
        /// The quantity.
        quantity: Quantity,
        /// The pixel.
        pixel: UVec2,
        /// The index of the path.
        sample: u32,
    },
    /// This ray, in world space.
    Ray(Ray),
}

/// A response to a request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Response {
    /// The response to `Scene`.
    Received,
    /// The response to `Try`.
    Tried,
    /// The response to `Build`.
    Opened(OpenOutcome),
    /// The response to `Aim`.
    Aimed,
    /// The response to `Draw`.
    Drawn(DrawnPixels),
    /// The response to `Tree`.
    Tree(ElementOutcome<TreeData>),
    /// The response to `Follow`.
    Followed(RecordedRays),
    /// The response to `Samples`. There are none if part two isn't written yet.
    Samples(#[serde(deserialize_with = "at_most::<_, _, MAX_SAMPLES>")] Vec<PathSample>),
    /// The response to `Boxes`: the part of the ray's range inside each box, or `None`.
    Spans(Vec<Option<Interval>>),
    /// There is no scene, or its tree could not be built.
    NotOpen,
}

/// The result of building a scene's tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OpenOutcome {
    /// The parts of the submission that haven't been written yet, each with its panic.
    #[serde(deserialize_with = "at_most::<_, _, MAX_PANICS>")]
    pub missing: Vec<(SubmissionPart, Panic)>,
    /// The size of the tree, or the panic in `Bvh::build`.
    pub tree: ElementOutcome<TreeSize>,
}

/// A part of a submission: a method that students write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SubmissionPart {
    /// `Camera::sample_ray`. The viewer's camera is used instead.
    Camera,
    /// `Triangle::hit`. Triangles are left out.
    Triangle,
    /// `Sphere::hit`. Spheres are left out.
    Sphere,
    /// `BBox::hit`.
    BBox,
    /// `Bvh::build`.
    Build,
    /// `Bvh::hit`.
    Traversal,
    /// `radiance`, with everything else in part two. It isn't called separately.
    Light,
}

impl SubmissionPart {
    /// The methods that can be called before the tree is built.
    pub const BEFORE_BUILD: [SubmissionPart; 4] = [
        SubmissionPart::Camera,
        SubmissionPart::Triangle,
        SubmissionPart::Sphere,
        SubmissionPart::BBox,
    ];
    /// The methods that are called with a ray, ordered so that each method comes after the methods
    /// that it calls.
    pub const WITH_RAY: [SubmissionPart; 4] = [
        SubmissionPart::Triangle,
        SubmissionPart::Sphere,
        SubmissionPart::BBox,
        SubmissionPart::Traversal,
    ];
}

/// A tree that can be sent to the viewer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TreeData(#[serde(with = "TreeDef")] pub Tree);

/// The fields of [`Tree`], for `serde`. In memory, they take only slightly more bytes than on the
/// wire.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Tree")]
struct TreeDef {
    nodes: Vec<TreeNode>,
    root: u32,
    #[serde(with = "fixed_width")]
    order: Vec<u32>,
}

/// The size of a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct TreeSize {
    /// The number of nodes.
    pub nodes: u32,
    /// The number of primitives.
    pub primitives: u32,
}

/// Some pixels of a picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DrawnPixels {
    /// One value per pixel, in the order of [`Draw::pixels`].
    pub values: Values,
    /// Each panic, with the indices of the pixels where it occurred.
    #[serde(deserialize_with = "at_most::<_, _, MAX_PANICS>")]
    pub panics: Vec<(Panic, Vec<u32>)>,
    /// The number of traced rays, and the problems with the paths.
    pub stats: RenderStats,
    /// Why the shaded view is drawn in clay: part two isn't written yet.
    pub no_light: Option<Panic>,
}

/// One sample of a pixel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathSample {
    /// The radiance, why the sample is black, or the panic of the code.
    pub outcome: Result<Result<Vec3, InvalidSample>, Panic>,
    /// The values on its path that no correct code returns.
    pub bad_values: FirstBadValues,
}

/// The values of pixels. The value of a pixel with a panic is meaningless.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Values {
    /// First hits.
    Hits(#[serde(deserialize_with = "at_most::<_, _, MAX_VALUES>")] Vec<Option<Trace>>),
    /// The radiance of one path per pixel.
    Light(#[serde(deserialize_with = "at_most::<_, _, MAX_VALUES>")] Vec<Vec3>),
    /// The tests of rays.
    Tests(#[serde(deserialize_with = "at_most::<_, _, MAX_VALUES>")] Vec<MarkedTests>),
}

impl Values {
    /// Returns the number of pixels.
    pub fn count(&self) -> usize {
        match self {
            Values::Hits(list) => list.len(),
            Values::Light(list) => list.len(),
            Values::Tests(list) => list.len(),
        }
    }
}

/// Test counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct TestCounts {
    /// The number of calls to `BBox::hit`.
    pub boxes: u32,
    /// The number of calls to `Primitive::hit`.
    pub primitives: u32,
}

impl TestCounts {
    /// Returns the total number of tests.
    pub fn total(self) -> u32 {
        self.boxes.saturating_add(self.primitives)
    }
}

/// The tests of a ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MarkedTests {
    /// The test counts.
    pub counts: TestCounts,
    /// For each [rule](crate::rules::Rule), the number of steps that break it.
    pub marks: [u32; RULES],
}
