//! From the text of a scene file to the scene.

use protocol::Shape;

use super::error::{Place, Problem, SceneError};
use super::file::{MeshInFile, SceneInFile, ShapeInFile};
use super::mesh::Mesh;
use super::subdivide::subdivided;
use super::{MAX_LEAF_SIZE, Scene};

/// The most triangles that one mesh may come to: about 2 GB of them.
const MOST_FACES: u64 = 1 << 24;

/// The scene in `text`. `load` finds the mesh in a file that the scene names.
pub(super) fn scene(
    text: &str,
    load: &mut dyn FnMut(&str) -> Result<Mesh, Problem>,
) -> Result<Scene, SceneError> {
    if text.trim().is_empty() {
        return Err(SceneError::at(None, Problem::Empty));
    }
    let file: SceneInFile = serde_json::from_str(text).map_err(|error| syntax(text, &error))?;
    let (names, materials): (Vec<String>, Vec<_>) = file.materials.0.into_iter().unzip();
    let number_of = |name: &str| {
        let place = names.iter().position(|known| known == name);
        place.map(|place| place as u32).ok_or_else(|| {
            let known = names.join(", ");
            let name = name.to_owned();
            let place = Place::of(text, "material", &name);
            SceneError::at(place, Problem::UnknownMaterial { name, known })
        })
    };

    let mut shapes = Vec::new();
    for shape in &file.shapes {
        match shape {
            ShapeInFile::Sphere {
                center,
                radius,
                material,
            } => shapes.push(Shape::Sphere {
                center: *center,
                radius: *radius,
                material: number_of(material)?,
            }),
            ShapeInFile::Polygon(polygon) => {
                shapes.extend(polygon.shapes(number_of(&polygon.material)?));
            }
            ShapeInFile::Mesh(put) => {
                let material = number_of(&put.material)?;
                let failed = |problem| SceneError::at(Place::of(text, "file", &put.file), problem);
                let mesh = load(&put.file).and_then(|mesh| refined(mesh, put));
                shapes.extend(mesh.map_err(failed)?.shapes(put, material));
            }
        }
    }
    Ok(Scene {
        about: file.about,
        camera: file.camera,
        environment: file.environment,
        materials,
        shapes,
        max_leaf_size: MAX_LEAF_SIZE,
    })
}

fn refined(mut mesh: Mesh, put: &MeshInFile) -> Result<Mesh, Problem> {
    let faces = (mesh.faces.len() as u64).saturating_mul(4_u64.saturating_pow(put.subdivide));
    if faces > MOST_FACES {
        return Err(Problem::TooFine {
            levels: put.subdivide,
            faces,
            most: MOST_FACES,
        });
    }
    if put.subdivide == 0 {
        return Ok(mesh);
    }
    for _ in 0..put.subdivide {
        mesh = subdivided(&mesh);
    }
    Ok(mesh.smooth())
}

/// The parser's error, with its place told apart from its words.
fn syntax(text: &str, error: &serde_json::Error) -> SceneError {
    let (line, column) = (error.line(), error.column());
    let words = error.to_string();
    let place = format!(" at line {line} column {column}");
    let words = words.strip_suffix(&place).unwrap_or(&words).to_owned();
    // Line 0 means that the parser does not know.
    let place = (line > 0).then(|| Place::new(text, line, column));
    SceneError::at(place, Problem::Syntax(words))
}
