//! The subjects that can be viewed: scenes and questions from the practice exam.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use framework::render::renderer::PathSettings;
use framework::scene::{Camera, Scene};
use glam::{DVec3, Vec3};
use grader::nearest_name::suggestion;
use grader::workspace::Workspace;
use judging::judge::tree::TreeCriteria;
use judging::judge::tree::bounds::Bounds;
use protocol::{Question, Ray, Shape};
use serde::{Serialize, Serializer};
use view_probe::messages::TreeSize;
use view_probe::scene_data::{Aim, SceneData, TreeSource};

use crate::error::ViewError;
use crate::model::tree::CHECKS;
use crate::model::viewpoint::Viewpoint;
use crate::sweep_costs;

/// The folder of scenes.
const SCENES: &str = "scenes";

/// A scene or a question from the exam, ready to be sent to a program.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The name on the page.
    pub name: String,
    /// The scene.
    pub data: Arc<SceneData>,
    /// The box around all shapes.
    pub bounds: Bounds,
    /// The largest coordinate, as in [`Scene::extent`].
    pub extent: f32,
    /// The viewpoint of the scene's own camera.
    pub viewpoint: Viewpoint,
    /// The question from the exam, if the subject is one.
    pub question: Option<ExamRay>,
    /// The SAH cost of the tree with the best split at every node, if it is known.
    pub sweep_cost: Option<f64>,
}

/// A ray from the exam and the texts of its question.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExamRay {
    /// The ray, if the question is about a ray. The page is only told whether there is one.
    #[serde(rename = "has_ray", serialize_with = "is_some")]
    pub ray: Option<Ray>,
    /// The corners of the boxes to draw, for questions about boxes.
    pub boxes: Vec<[Vec3; 2]>,
    /// The question.
    pub asked: String,
    /// The accepted answers.
    pub wanted: Vec<String>,
}

fn is_some<S: Serializer>(ray: &Option<Ray>, out: S) -> Result<S::Ok, S::Error> {
    out.serialize_bool(ray.is_some())
}

impl Subject {
    /// Creates a subject from a scene.
    pub fn of_scene(name: &str, scene: Scene, settings: PathSettings) -> Self {
        let bounds = bounds(scene.shapes.iter().map(Bounds::of_shape));
        let camera = scene.camera;
        Subject {
            name: name.to_owned(),
            bounds,
            extent: scene.extent(),
            viewpoint: Viewpoint::of_scene(&camera, &bounds),
            question: None,
            sweep_cost: sweep_costs::find(&scene.shapes, scene.max_leaf_size),
            data: Arc::new(SceneData {
                scene,
                tree: TreeSource::Build,
                aim: Aim { camera, settings },
                is_recorded: false,
            }),
        }
    }

    /// Returns the scene's own camera.
    pub fn camera(&self) -> &Camera {
        &self.data.scene.camera
    }

    /// Returns the criteria for a tree over these shapes. A tree from the exam isn't checked,
    /// because its decoys would count as defects.
    pub fn tree_criteria<'a>(&self, shapes: &'a [Shape]) -> TreeCriteria<'a> {
        let is_complete = shapes.len() == self.data.scene.shapes.len();
        TreeCriteria {
            checks: match self.data.tree {
                TreeSource::Build => &CHECKS,
                TreeSource::Prebuilt(_) | TreeSource::List => &[],
            },
            sweep_cost: self.sweep_cost.filter(|_| is_complete),
            shapes,
            max_leaf_size: u32::try_from(self.data.scene.max_leaf_size).unwrap_or(u32::MAX),
        }
    }

    /// Returns the reason for not reading a tree of this size, or `None` if the tree isn't much
    /// larger than a correct tree can be.
    pub fn oversize(&self, size: TreeSize) -> Option<String> {
        let shapes = self.data.scene.shapes.len();
        let own = match &self.data.tree {
            TreeSource::Prebuilt(tree) => tree.nodes.len(),
            TreeSource::Build | TreeSource::List => 0,
        };
        let limit = Question::max_nodes(shapes).max(own);
        let TreeSize { nodes, primitives } = size;
        if nodes as usize > limit {
            let most = (2 * shapes).saturating_sub(1);
            Some(format!(
                "it has {nodes} nodes, but a binary tree over {shapes} primitives has at most {most}. \
                 Does `Bvh::build` add nodes that the tree does not use?"
            ))
        } else if primitives as usize > limit {
            Some(format!(
                "it has {primitives} primitives, but the scene only contains {shapes}. Does `Bvh::build` \
                 add primitives more than once?"
            ))
        } else {
            None
        }
    }
}

/// Returns the box around all finite boxes. If there are none, returns a unit cube centred at the
/// origin.
pub fn bounds(boxes: impl Iterator<Item = Bounds>) -> Bounds {
    let finite = boxes.filter(|bounds| bounds.min.is_finite() && bounds.max.is_finite());
    let all = finite.reduce(|mut all, bounds| {
        all.enclose(bounds);
        all
    });
    let half = DVec3::splat(0.5);
    all.unwrap_or(Bounds {
        min: -half,
        max: half,
    })
}

/// The scenes that the page may open: those in the workspace's folder and the one on the command
/// line.
#[derive(Clone, Debug)]
pub struct SceneList {
    scenes: Vec<(String, PathBuf)>,
}

impl SceneList {
    /// Lists the scenes.
    pub fn find(workspace: &Workspace) -> Self {
        let folder = workspace.root().join(SCENES);
        let entries = folder.read_dir().into_iter().flatten().flatten();
        let mut scenes: Vec<(String, PathBuf)> = entries
            .map(|entry| entry.path())
            .filter(|path| {
                path.extension()
                    .is_some_and(|extension| extension == "json")
            })
            .filter_map(|path| Some((path.file_stem()?.to_str()?.to_owned(), path)))
            .collect();
        scenes.sort();
        SceneList { scenes }
    }

    /// Returns the name of the scene that the command line specifies, either by name or by path. A
    /// file from elsewhere is added to the list.
    pub fn name_of(&mut self, scene: &str) -> Result<String, ViewError> {
        let stem = Path::new(scene)
            .file_stem()
            .and_then(|stem| stem.to_str())
            .unwrap_or(scene);
        let known = self.scenes.iter().find(|(name, _)| name == scene);
        if let Some((name, _)) = known {
            return Ok(name.clone());
        }
        let path = PathBuf::from(scene);
        if path.is_file() {
            self.scenes.retain(|(name, _)| name != stem);
            self.scenes.push((stem.to_owned(), path));
            return Ok(stem.to_owned());
        }
        // In a subfolder of the workspace, `scenes/flat.json` isn't an existing path.
        if self.scenes.iter().any(|(name, _)| name == stem) {
            Ok(stem.to_owned())
        } else {
            Err(self.unknown(scene))
        }
    }

    /// Returns all names.
    pub fn names(&self) -> Vec<String> {
        self.scenes.iter().map(|(name, _)| name.clone()).collect()
    }

    /// Loads the scene with this name.
    pub fn load(&self, name: &str) -> Result<Scene, ViewError> {
        let known = self.scenes.iter().find(|(known, _)| known == name);
        let (_, path) = known.ok_or_else(|| self.unknown(name))?;
        Scene::load(path).map_err(ViewError::usage)
    }

    fn unknown(&self, name: &str) -> ViewError {
        let known = self.names();
        let nearest = suggestion(name, known.iter().map(String::as_str));
        let known = known.join(", ");
        ViewError::Usage(format!(
            "unknown scene `{name}`{nearest}; the `scenes` folder contains: {known}"
        ))
    }
}
