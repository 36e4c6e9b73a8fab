//! The things that can be viewed: scenes, and questions of the practice exam.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use framework::scene::{Camera, Scene};
use grader::workspace::Workspace;
use protocol::{Question, Ray};
use view_probe::messages::{Aim, TreeSize};
use view_probe::scene_data::{SceneData, TreeSource};

use crate::error::ViewError;
use crate::model::bounds::Bounds;
use crate::model::viewpoint::Viewpoint;

/// The folder of scenes.
const SCENES: &str = "scenes";

/// A scene, or a question of the exam, ready to be sent to a program.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The name on the page.
    pub name: String,
    /// A description.
    pub about: String,
    /// The scene.
    pub data: Arc<SceneData>,
    /// The box around all shapes.
    pub bounds: Bounds,
    /// The largest coordinate, as in [`Scene::extent`].
    pub extent: f32,
    /// The scene's own camera.
    pub camera: Camera,
    /// The viewpoint of the scene's own camera.
    pub viewpoint: Viewpoint,
    /// The question of the exam, if the subject is one.
    pub question: Option<ExamRay>,
}

/// A ray of the exam, and the texts of its question.
#[derive(Clone, Debug, PartialEq)]
pub struct ExamRay {
    /// The ray, if the question is about one.
    pub ray: Option<Ray>,
    /// Boxes to draw, as corners: for questions about boxes.
    pub boxes: Vec<[[f32; 3]; 2]>,
    /// The question.
    pub asked: String,
    /// The accepted answers.
    pub wanted: Vec<String>,
}

/// The settings of paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathSettings {
    /// The maximum number of times that a path is scattered.
    pub bounces: u32,
    /// The seed of all random numbers.
    pub seed: u64,
}

impl Subject {
    /// Creates the subject of a scene.
    pub fn of_scene(name: &str, scene: &Scene, settings: PathSettings) -> Self {
        let bounds = Bounds::of_shapes(&scene.shapes);
        let viewpoint = Viewpoint::of_scene(&scene.camera, &bounds);
        Subject {
            name: name.to_owned(),
            about: scene.about.clone(),
            data: Arc::new(SceneData::new(scene, aim(&scene.camera, settings))),
            bounds,
            extent: scene.extent(),
            camera: scene.camera,
            viewpoint,
            question: None,
        }
    }
}

impl Subject {
    /// Returns why a tree is not read, if it is much larger than a correct one can be.
    pub fn oversize(&self, size: TreeSize) -> Option<String> {
        let shapes = self.data.shapes.len();
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
                "it has {primitives} primitives, but the scene only {shapes}. Does `Bvh::build` add \
                 primitives more than once?"
            ))
        } else {
            None
        }
    }
}

/// Returns the aim of a camera.
pub fn aim(camera: &Camera, settings: PathSettings) -> Aim {
    Aim {
        pinhole: camera.pinhole,
        position: camera.placement.position,
        axes: camera.placement.axes,
        bounces: settings.bounces,
        seed: settings.seed,
    }
}

/// The scenes that the page may name: those in the workspace's folder, and the one on the command
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

    /// Returns the name of a scene that the command line gives by its name or as a path. A file from
    /// elsewhere is added to the list.
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
        // From another folder of the workspace, `scenes/flat.json` is not a path.
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
        Ok(Scene::load(path)?)
    }

    fn unknown(&self, name: &str) -> ViewError {
        ViewError::UnknownScene {
            name: name.to_owned(),
            known: self.names(),
        }
    }
}
