//! Parts of the state.

use clap::ValueEnum;
use glam::UVec2;
use serde::{Deserialize, Serialize};
use view_probe::messages::Quantity;
use view_probe::scene_data::Aim;

use super::PanicNote;
use crate::source_links::SourceLinks;

/// The cores and the memory that the programs may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resources {
    /// The number of programs that draw at the same time.
    pub cores: usize,
    /// The memory that all programs together may use, in bytes.
    pub memory: u64,
}

/// The quantity shown in the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum View {
    /// The scene with its lighting.
    #[default]
    Shaded,
    /// The scene in clay, without its materials or lights.
    Clay,
    /// Normals.
    Normals,
    /// Distances.
    Depth,
    /// Texture coordinates.
    Uv,
    /// Boxes around the hit.
    Bvh,
    /// Test counts.
    Tests,
    /// Steps that no correct traversal takes.
    Mistakes,
}

impl View {
    /// Returns the layer shown by the view.
    pub(crate) fn layer(self) -> Quantity {
        match self {
            View::Shaded => Quantity::Light,
            View::Clay => Quantity::Clay,
            View::Normals | View::Depth | View::Uv | View::Bvh => Quantity::Hit,
            View::Tests | View::Mistakes => Quantity::Tests,
        }
    }
}

/// Identifies the program, scene and camera of a job. A result with an outdated key is dropped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Key {
    /// Changes with the program.
    pub program: u64,
    /// Changes with the scene.
    pub scene: u64,
    /// Changes with the camera.
    pub aim: u64,
}

impl Key {
    /// Returns whether both keys belong to the same program and scene, and therefore to the same
    /// tree.
    pub fn has_tree_of(&self, other: &Key) -> bool {
        (self.program, self.scene) == (other.program, other.scene)
    }
}

/// The pixel or ray to explain. It stays the same when the camera moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PinnedTarget {
    /// The camera at the time of the click.
    #[serde(skip)]
    pub aim: Aim,
    /// The pixel, or `None` for the exam's ray.
    pub pixel: Option<UVec2>,
    /// The number of the path, or `None` for the ray through the centre of the pixel.
    pub sample: Option<u32>,
}

/// The part of the state that is sent to the page unchanged.
#[derive(Debug, Default, Serialize)]
pub struct PageFields {
    /// Changes whenever anything that the page shows changes.
    pub version: u64,
    /// The folders of the files of both parts, for links.
    pub(crate) sources: Vec<SourceLinks>,
    /// The names of the scenes that the page may choose.
    pub(super) scenes: Vec<String>,
    /// The scene that is being loaded.
    pub(super) loading: Option<String>,
    pub(crate) view: View,
    pub(crate) exposure: f32,
    pub(super) film: UVec2,
    pub(super) samples: u32,
    pub(super) panics: Vec<PanicNote>,
    /// The number of the picture on the page.
    pub(super) picture: u64,
    /// Whether the picture on the page was made by an earlier version of the code.
    pub(super) is_stale: bool,
    /// Whether the picture on the page contains all samples for the current camera and program.
    pub(super) is_picture_complete: bool,
}
