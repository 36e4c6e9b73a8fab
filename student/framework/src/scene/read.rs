//! From the text of a scene file to the scene.

use protocol::Shape;

use super::error::{SceneError, SceneErrorKind, TextPosition};
use super::file::{MeshEntry, SceneFile, ShapeEntry};
use super::mesh::Mesh;
use super::subdivide::subdivide;
use super::{MAX_LEAF_SIZE, Scene};

/// The most triangles that one mesh may come to: about 2 GB of them.
const MAX_TRIANGLES: u64 = 1 << 24;

/// The scene in `text`. `load` finds the mesh in a file that the scene names.
pub(super) fn scene(
    text: &str,
    load: &mut dyn FnMut(&str) -> Result<Mesh, SceneErrorKind>,
) -> Result<Scene, SceneError> {
    if text.trim().is_empty() {
        return Err(SceneError::new(None, SceneErrorKind::Empty));
    }
    let file: SceneFile = serde_json::from_str(text).map_err(|error| syntax_error(text, &error))?;
    let (names, materials): (Vec<String>, Vec<_>) = file.materials.0.into_iter().unzip();
    let number_of = |name: &str| {
        let place = names.iter().position(|known| known == name);
        place.map(|place| place as u32).ok_or_else(|| {
            let known = names.join(", ");
            let name = name.to_owned();
            let place = TextPosition::of_value(text, "material", &name);
            SceneError::new(place, SceneErrorKind::UnknownMaterial { name, known })
        })
    };

    let mut shapes = Vec::new();
    for shape in &file.shapes {
        match shape {
            ShapeEntry::Sphere {
                center,
                radius,
                material,
            } => shapes.push(Shape::Sphere {
                center: *center,
                radius: *radius,
                material: number_of(material)?,
            }),
            ShapeEntry::Polygon(polygon) => {
                shapes.extend(polygon.shapes(number_of(&polygon.material)?));
            }
            ShapeEntry::Mesh(put) => {
                let material = number_of(&put.material)?;
                let failed = |problem| {
                    SceneError::new(TextPosition::of_value(text, "file", &put.file), problem)
                };
                let mesh = load(&put.file).and_then(|mesh| subdivide_mesh(mesh, put));
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

fn subdivide_mesh(mut mesh: Mesh, put: &MeshEntry) -> Result<Mesh, SceneErrorKind> {
    let faces = (mesh.faces.len() as u64).saturating_mul(4_u64.saturating_pow(put.subdivide));
    if faces > MAX_TRIANGLES {
        return Err(SceneErrorKind::TooManyTriangles {
            levels: put.subdivide,
            triangles: faces,
            limit: MAX_TRIANGLES,
        });
    }
    if put.subdivide == 0 {
        return Ok(mesh);
    }
    for _ in 0..put.subdivide {
        mesh = subdivide(&mesh);
    }
    Ok(mesh.with_smooth_normals())
}

/// The parser's error, with its place told apart from its words.
fn syntax_error(text: &str, error: &serde_json::Error) -> SceneError {
    let (line, column) = (error.line(), error.column());
    let words = error.to_string();
    let place = format!(" at line {line} column {column}");
    let words = words.strip_suffix(&place).unwrap_or(&words).to_owned();
    // Line 0 means that the parser does not know.
    let place = (line > 0).then(|| TextPosition::new(text, line, column));
    SceneError::new(place, SceneErrorKind::Syntax(words))
}
