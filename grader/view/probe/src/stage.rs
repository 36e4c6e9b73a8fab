//! An open scene: the submission's camera and tree, and the parts that haven't been written yet.

use std::borrow::Cow;

use framework::harness::attempt::attempt;
use framework::math::sin_cos;
use framework::scene::Scene;
use framework::submission::{Aggregate, CameraRays, Hierarchy, Submission, World};
use glam::{UVec2, Vec2, Vec3};
use protocol::{
    ElementOutcome, ExamCamera, Interval, Panic, PinholeCamera, Ray, Sample, Shape, Trace, TreeNode,
};

use crate::messages::{Opened, Part, TreeSize};
use crate::record::Recorded;
use crate::scene_data::{Aim, SceneData, TreeSource};

/// An open scene.
pub(crate) struct Stage<'a> {
    submission: &'a dyn Submission,
    pub(crate) scene: Scene,
    pub(crate) world: World,
    pub(crate) aim: Aim,
    has_camera: bool,
}

impl<'a> Stage<'a> {
    /// Opens a scene. Shapes whose `hit` hasn't been written yet are left out, so that the others
    /// can be seen. Returns no stage if the tree cannot be built.
    pub(crate) fn open(submission: &'a dyn Submission, data: SceneData) -> (Opened, Option<Self>) {
        let (aim, is_recorded, source) = (data.aim, data.is_recorded, data.tree.clone());
        let scene = data.into_scene();
        let missing = missing_parts(submission, &scene);
        let has = |part| missing.iter().all(|(known, _)| *known != part);
        let is_written = |shape: &&Shape| match shape {
            Shape::Triangle { .. } | Shape::FlatTriangle { .. } => has(Part::Triangle),
            Shape::Sphere { .. } => has(Part::Sphere),
        };
        let shapes: Cow<[Shape]> = if has(Part::Triangle) && has(Part::Sphere) {
            Cow::Borrowed(&scene.shapes)
        } else {
            Cow::Owned(scene.shapes.iter().filter(is_written).copied().collect())
        };
        let build = || match &source {
            TreeSource::Build => submission.build(&shapes, scene.max_leaf_size),
            // A tree from the exam refers to all shapes.
            TreeSource::Prebuilt(tree) => {
                submission.prebuilt_tree(&scene.shapes, &tree.nodes, tree.root as usize)
            }
            TreeSource::List => Box::new(List(submission.primitive_list(&shapes))),
        };
        let has_camera = has(Part::Camera);
        let opened = attempt(|| {
            let tree = build();
            let camera = camera(submission, &aim, has_camera);
            let size = TreeSize {
                nodes: TreeNode::saturating_index(tree.node_count()),
                primitives: TreeNode::saturating_index(tree.primitive_count()),
            };
            let tree: Box<dyn Hierarchy> = if is_recorded {
                Box::new(Recorded(tree))
            } else {
                tree
            };
            (size, World { camera, bvh: tree })
        });
        let (tree, stage) = match opened {
            Err(panic) => (ElementOutcome::Panicked(panic), None),
            Ok((size, world)) => {
                let stage = Stage {
                    submission,
                    scene,
                    world,
                    aim,
                    has_camera,
                };
                (ElementOutcome::Value(size), Some(stage))
            }
        };
        (Opened { missing, tree }, stage)
    }

    /// Replaces the camera.
    pub(crate) fn aim(&mut self, aim: Aim) {
        if let Ok(camera) = attempt(|| camera(self.submission, &aim, self.has_camera)) {
            self.world.camera = camera;
        }
        self.scene.camera = aim.camera;
        self.aim = aim;
    }

    /// Calls `BBox::hit` for the ray's entire range.
    pub(crate) fn intersect_box(&self, corners: (Vec3, Vec3), ray: &Ray) -> Option<Interval> {
        let (min, max) = corners;
        let test = || self.submission.intersect_box(min, max, ray, ray.range);
        attempt(test).ok().flatten()
    }
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

/// Finds the parts that haven't been written yet by calling each one once.
fn missing_parts(submission: &dyn Submission, scene: &Scene) -> Vec<(Part, Panic)> {
    let ray = Ray::new(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0));
    let hit = |is_sphere: bool| {
        let is_such = |shape: &&Shape| matches!(shape, Shape::Sphere { .. }) == is_sphere;
        if let Some(shape) = scene.shapes.iter().find(is_such) {
            submission.primitive_list(&[*shape]).closest_hit(&ray);
        }
    };
    let camera = || {
        let camera = submission.camera(&scene.camera.pinhole);
        camera.ray(UVec2::ZERO, Vec2::splat(0.5));
    };
    let bbox = || {
        submission.intersect_box(Vec3::NEG_ONE, Vec3::ONE, &ray, Interval::AHEAD);
    };
    let outcomes = [
        (Part::Camera, attempt(camera)),
        (Part::Triangle, attempt(|| hit(false))),
        (Part::Sphere, attempt(|| hit(true))),
        (Part::BBox, attempt(bbox)),
    ];
    let panics = outcomes.into_iter();
    let panics = panics.filter_map(|(part, outcome)| Some((part, outcome.err()?)));
    panics
        .filter(|(_, panic)| panic.is_unimplemented())
        .collect()
}

/// A list of primitives as a tree without nodes.
struct List(Box<dyn Aggregate>);

impl Aggregate for List {
    fn closest_hit(&self, ray: &Ray) -> Option<Trace> {
        self.0.closest_hit(ray)
    }
}

impl Hierarchy for List {
    fn root(&self) -> usize {
        0
    }

    fn node_count(&self) -> usize {
        0
    }

    fn node(&self, index: usize) -> TreeNode {
        unreachable!("a list has no node {index}")
    }

    fn primitive_count(&self) -> usize {
        0
    }

    fn shape(&self, index: usize) -> u32 {
        unreachable!("the primitives of a list are not read, so not {index}")
    }
}
