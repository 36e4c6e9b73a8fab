//! Parses scene files.

use protocol::Shape;

use super::error::{SceneError, SceneErrorKind, TextPosition};
use super::file::{MeshEntry, SceneFile, ShapeEntry};
use super::mesh::Mesh;
use super::subdivide::subdivide;
use super::{MAX_LEAF_SIZE, Scene};

/// The maximum number of triangles in one mesh. A mesh of this size takes about 2 GB of memory.
const MAX_TRIANGLES: u64 = 1 << 24;

/// Parses the scene in `text`. `load` loads a mesh from the path in the scene file.
pub(super) fn scene(
    text: &str,
    load: &mut dyn FnMut(&str) -> Result<Mesh, SceneErrorKind>,
) -> Result<Scene, SceneError> {
    if text.trim().is_empty() {
        return Err(SceneError::new(None, SceneErrorKind::Empty));
    }
    let file: SceneFile = serde_json::from_str(text).map_err(|error| syntax_error(text, &error))?;
    let (names, materials): (Vec<String>, Vec<_>) = file.materials.0.into_iter().unzip();
    let index_of = |name: &str| {
        let index = names.iter().position(|known| known == name);
        index.map(|index| index as u32).ok_or_else(|| {
            let known = names.clone();
            let name = name.to_owned();
            let position = TextPosition::of_value(text, "material", &name);
            SceneError::new(position, SceneErrorKind::UnknownMaterial { name, known })
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
                material: index_of(material)?,
            }),
            ShapeEntry::Polygon(polygon) => {
                shapes.extend(polygon.shapes(index_of(&polygon.material)?));
            }
            ShapeEntry::Mesh(entry) => {
                let material = index_of(&entry.material)?;
                let failed =
                    |kind| SceneError::new(TextPosition::of_value(text, "file", &entry.file), kind);
                let mesh = load(&entry.file).and_then(|mesh| subdivide_mesh(mesh, entry));
                shapes.extend(mesh.map_err(failed)?.shapes(entry, material));
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

/// Subdivides a mesh as many times as `entry` specifies.
fn subdivide_mesh(mut mesh: Mesh, entry: &MeshEntry) -> Result<Mesh, SceneErrorKind> {
    let triangles = (mesh.faces.len() as u64).saturating_mul(4_u64.saturating_pow(entry.subdivide));
    if triangles > MAX_TRIANGLES {
        return Err(SceneErrorKind::TooManyTriangles {
            levels: entry.subdivide,
            triangles,
            limit: MAX_TRIANGLES,
        });
    }
    if entry.subdivide == 0 {
        return Ok(mesh);
    }
    for _ in 0..entry.subdivide {
        mesh = subdivide(&mesh);
    }
    Ok(mesh.with_smooth_normals())
}

/// Converts an error of the parser, separating the position from the message.
fn syntax_error(text: &str, error: &serde_json::Error) -> SceneError {
    let (line, column) = (error.line(), error.column());
    let message = error.to_string();
    let suffix = format!(" at line {line} column {column}");
    let message = message.strip_suffix(&suffix).unwrap_or(&message);
    // Line 0 means that the parser does not know the position.
    let position = (line > 0).then(|| TextPosition::new(text, line, column));
    SceneError::new(position, SceneErrorKind::Syntax(in_scene_terms(message)))
}

/// Replaces serde's terms in a message: the fields of a struct are the keys of a scene file, and
/// the variants of an enum are kinds of shapes or materials.
fn in_scene_terms(message: &str) -> String {
    const TERMS: [(&str, &str); 4] = [
        ("unknown field ", "unknown key "),
        ("missing field ", "missing key "),
        ("duplicate field ", "duplicate key "),
        ("unknown variant ", "unknown kind "),
    ];
    for (term, replacement) in TERMS {
        if let Some(rest) = message.strip_prefix(term) {
            return format!("{replacement}{rest}");
        }
    }
    message.to_owned()
}
