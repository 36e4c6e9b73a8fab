//! An open scene: the submission's camera and tree, and the parts that haven't been written yet.

use std::cell::OnceCell;

use framework::harness::attempt::attempt;
use framework::math::sin_cos;
use framework::scene::Scene;
use framework::submission::{CameraRays, Hierarchy, List, Submission, World};
use glam::{UVec2, Vec2, Vec3};
use protocol::{
    ElementOutcome, ExamCamera, Interval, Panic, PinholeCamera, Ray, Sample, Shape, TreeNode,
};

use crate::indexed_tree::IndexedTree;
use crate::messages::{OpenOutcome, SubmissionPart, TreeSize};
use crate::record::RecordingTree;
use crate::scene_data::{Aim, SceneData, TreeSource, written_shapes};

/// An open scene.
pub(crate) struct OpenScene<'a> {
    submission: &'a dyn Submission,
    pub(crate) scene: Scene,
    pub(crate) world: World,
    pub(crate) aim: Aim,
    has_camera: bool,
    /// The indexed tree, which is created when steps are first judged.
    tree: OnceCell<IndexedTree>,
}

/// A scene whose tree hasn't been built yet.
pub(crate) struct Opening {
    data: SceneData,
    /// The parts that haven't been written yet.
    missing: Vec<(SubmissionPart, Panic)>,
}

impl Opening {
    pub(crate) fn new(data: SceneData) -> Self {
        Opening {
            data,
            missing: Vec::new(),
        }
    }

    /// Calls a part once to find out whether it has been written yet.
    pub(crate) fn try_part(
        &mut self,
        submission: &dyn Submission,
        part: SubmissionPart,
        ray: &Ray,
    ) {
        let shapes = &self.data.scene.shapes;
        let outcome = attempt(|| match part {
            SubmissionPart::Camera => {
                let camera = submission.camera(&self.data.aim.camera.pinhole);
                camera.ray(UVec2::ZERO, Vec2::splat(0.5));
            }
            SubmissionPart::Triangle => hit_shapes(submission, shapes, false, 1, ray),
            SubmissionPart::Sphere => hit_shapes(submission, shapes, true, 1, ray),
            SubmissionPart::BBox => {
                submission.intersect_box(Vec3::NEG_ONE, Vec3::ONE, ray, Interval::AHEAD);
            }
            SubmissionPart::Build | SubmissionPart::Traversal | SubmissionPart::Light => {}
        });
        if let Err(panic) = outcome
            && panic.is_unimplemented()
        {
            self.missing.push((part, panic));
        }
    }

    /// Builds the tree. Shapes whose `hit` hasn't been written yet are left out, so that the others
    /// can be seen. Returns no open scene if the tree cannot be built.
    pub(crate) fn build(self, submission: &dyn Submission) -> (OpenOutcome, Option<OpenScene<'_>>) {
        let Opening { data, missing } = self;
        let SceneData {
            mut scene,
            tree: source,
            aim,
            is_recorded,
        } = data;
        scene.camera = aim.camera;
        let shapes = written_shapes(&scene.shapes, &missing);
        let mut missing_parts = missing.iter().map(|(part, _)| *part);
        let has_camera = missing_parts.all(|part| part != SubmissionPart::Camera);
        let opened = attempt(|| {
            let tree = match &source {
                TreeSource::Build => submission.build(&shapes, scene.max_leaf_size),
                // A tree from the exam refers to all shapes.
                TreeSource::Prebuilt(tree) => {
                    submission.prebuilt_tree(&scene.shapes, &tree.nodes, tree.root as usize)
                }
                TreeSource::List => Box::new(List(submission.primitive_list(&shapes))),
            };
            let camera = camera(submission, &aim, has_camera);
            let size = TreeSize {
                nodes: TreeNode::saturating_index(tree.node_count()),
                primitives: TreeNode::saturating_index(tree.primitive_count()),
            };
            let tree: Box<dyn Hierarchy> = if is_recorded {
                Box::new(RecordingTree(tree))
            } else {
                tree
            };
            (size, World { camera, bvh: tree })
        });
        let (tree, stage) = match opened {
            Err(panic) => (ElementOutcome::Panicked(panic), None),
            Ok((size, world)) => {
                let stage = OpenScene {
                    submission,
                    scene,
                    world,
                    aim,
                    has_camera,
                    tree: OnceCell::new(),
                };
                (ElementOutcome::Value(size), Some(stage))
            }
        };
        (OpenOutcome { missing, tree }, stage)
    }
}

/// The number of shapes to test at a time. These shapes are copied into a list.
const SHAPES_AT_ONCE: usize = 1024;
/// The maximum number of boxes to test, because a tree can have far too many nodes.
const MAX_BOXES: usize = 1 << 20;

impl OpenScene<'_> {
    /// Calls a method with a ray: `hit` on all shapes of one kind, `hit` on all boxes in the tree,
    /// or the traversal. The results don't matter, only whether the calls return.
    pub(crate) fn try_part(&self, part: SubmissionPart, ray: &Ray) {
        let hit = |is_sphere: bool| {
            for shapes in self.scene.shapes.chunks(SHAPES_AT_ONCE) {
                // If this panics, the pixels where the panic occurs report it.
                let _ =
                    attempt(|| hit_shapes(self.submission, shapes, is_sphere, SHAPES_AT_ONCE, ray));
            }
        };
        match part {
            SubmissionPart::Triangle => hit(false),
            SubmissionPart::Sphere => hit(true),
            SubmissionPart::BBox => {
                for index in 0..self.world.bvh.node_count().min(MAX_BOXES) {
                    let node = self.world.bvh.node(index);
                    self.intersect_box((node.min, node.max), ray);
                }
            }
            SubmissionPart::Traversal => {
                let _ = attempt(|| self.world.bvh.closest_hit(ray));
            }
            SubmissionPart::Camera | SubmissionPart::Build | SubmissionPart::Light => {}
        }
    }

    /// Replaces the camera.
    pub(crate) fn aim(&mut self, aim: Aim) {
        if let Ok(camera) = attempt(|| camera(self.submission, &aim, self.has_camera)) {
            self.world.camera = camera;
        }
        self.scene.camera = aim.camera;
        self.aim = aim;
    }

    /// Returns the indexed tree.
    pub(crate) fn indexed_tree(&self) -> &IndexedTree {
        self.tree
            .get_or_init(|| IndexedTree::new(self.world.bvh.tree()))
    }

    /// Calls `BBox::hit` for the ray's entire range.
    pub(crate) fn intersect_box(&self, corners: (Vec3, Vec3), ray: &Ray) -> Option<Interval> {
        let (min, max) = corners;
        let test = || self.submission.intersect_box(min, max, ray, ray.range);
        attempt(test).ok().flatten()
    }
}

/// Calls `hit` on the first `most` shapes of one kind.
fn hit_shapes(
    submission: &dyn Submission,
    shapes: &[Shape],
    is_sphere: bool,
    most: usize,
    ray: &Ray,
) {
    let is_such = |shape: &&Shape| matches!(shape, Shape::Sphere { .. }) == is_sphere;
    let shapes: Vec<Shape> = shapes.iter().filter(is_such).take(most).copied().collect();
    submission.primitive_list(&shapes).closest_hit(ray);
}

fn camera(submission: &dyn Submission, aim: &Aim, has_camera: bool) -> Box<dyn CameraRays> {
    if has_camera {
        submission.camera(&aim.camera.pinhole)
    } else {
        Box::new(ViewerCamera::new(&aim.camera.pinhole))
    }
}

/// The viewer's own camera, used as long as the submission's camera hasn't been written. It is an
/// exam camera, whose rays are computed by `protocol`.
struct ViewerCamera(ExamCamera);

impl ViewerCamera {
    fn new(pinhole: &PinholeCamera) -> Self {
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
