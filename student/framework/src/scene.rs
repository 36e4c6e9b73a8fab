//! What is to be drawn: a camera, materials, shapes, and the light from around.
//!
//! A scene is data. It is read from a JSON file (the keys are those of the types in `file`), and
//! a submission makes its own types of it.

mod camera;
mod error;
mod file;
mod material;
mod mesh;
mod number;
#[cfg(feature = "cli")]
mod obj;
mod ordered_map;
mod polygon;
mod read;
mod subdivide;

#[cfg(feature = "cli")]
use std::path::Path;

use glam::{UVec2, Vec3};
use protocol::Shape;

pub use camera::{Camera, Placement};
pub use error::{SceneError, SceneErrorKind, TextPosition};
pub use material::Material;

// Former names, so that submissions written before they changed still compile.
#[doc(hidden)]
pub use self::MAX_FILM_SIDE as LONGEST_SIDE;
#[doc(hidden)]
pub use error::{SceneErrorKind as Problem, TextPosition as Place};
pub(crate) use material::checker;

/// The most primitives in a leaf of the tree that is built for a picture.
const MAX_LEAF_SIZE: usize = 4;

/// The most pixels along one side of the film.
pub const MAX_FILM_SIDE: u32 = 16_384;

/// All that is to be drawn.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What the scene shows, in its author's words; may be empty.
    pub about: String,
    /// Who looks, from where.
    pub camera: Camera,
    /// The radiance of all that no shape hides.
    pub environment: Vec3,
    /// What `Shape::material` counts.
    pub materials: Vec<Material>,
    /// All shapes, in world space; meshes are triangles here.
    pub shapes: Vec<Shape>,
    /// What to ask of `Bvh::build`.
    pub max_leaf_size: usize,
}

impl Scene {
    /// The scene in a text that needs no other file.
    ///
    /// # Errors
    /// If the text is no scene, or asks for a mesh's file.
    pub fn from_text(text: &str) -> Result<Scene, SceneError> {
        read::scene(text, &mut |_| Err(SceneErrorKind::MeshWithoutFolder))
    }

    /// The scene in a file; meshes are looked for beside it.
    ///
    /// # Errors
    /// If a file can not be read or is no scene or mesh. The error begins with the file's name.
    #[cfg(feature = "cli")]
    pub fn load(path: &Path) -> Result<Scene, SceneError> {
        let text = error::read_text(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        read::scene(&text, &mut |file| obj::load(&folder.join(file)))
            .map_err(|error| error.in_file(path))
    }

    /// The same scene on a film of another size. The sensor keeps the shape that the scene's
    /// author gave it, or else takes the film's.
    pub fn on_film(&self, film: UVec2) -> Scene {
        Scene {
            camera: self.camera.on_film(film),
            ..self.clone()
        }
    }

    /// The largest coordinate, without its sign, of anything in the scene.
    pub fn extent(&self) -> f32 {
        let of_shape = |shape: &Shape| match shape {
            Shape::Triangle { vertices, .. } => vertices
                .iter()
                .map(|vertex| vertex.position.abs().max_element())
                .fold(0.0, f32::max),
            Shape::FlatTriangle { corners, .. } => corners
                .iter()
                .map(|corner| corner.abs().max_element())
                .fold(0.0, f32::max),
            Shape::Sphere { center, radius, .. } => center.abs().max_element() + radius,
        };
        let of_camera = self.camera.placement.position.abs().max_element();
        self.shapes.iter().map(of_shape).fold(of_camera, f32::max)
    }
}

#[cfg(all(test, feature = "cli"))]
mod file_tests;
#[cfg(test)]
mod tests;
