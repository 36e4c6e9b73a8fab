//! Parses scene files.

use protocol::Shape;

use super::error::{SceneError, SceneErrorKind, TextPosition};
use super::file::{MeshEntry, SceneFile, ShapeEntry};
use super::json_error::scene_error;
use super::mesh::Mesh;
use super::subdivide::subdivide;
use super::{MAX_LEAF_SIZE, Scene};

/// The maximum number of triangles in one mesh. A mesh of this size takes about 2 GB of memory.
const MAX_TRIANGLES: u64 = 1 << 24;

/// Parses the scene in `text`, and returns it with the names of its materials. `load` loads a mesh
/// from the path in the scene file.
pub(super) fn scene(
    text: &str,
    load: &mut dyn FnMut(&str) -> Result<Mesh, SceneErrorKind>,
) -> Result<(Scene, Vec<String>), SceneError> {
    if text.trim().is_empty() {
        return Err(SceneError::new(None, SceneErrorKind::Empty));
    }
    let first = text.len() - text.trim_start().len();
    if !text[first..].starts_with('{') {
        let position = TextPosition::at_offset(text, first);
        return Err(SceneError::new(Some(position), SceneErrorKind::NotAScene));
    }
    let file = parse(text)?;
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
    let mut shape_materials = Vec::new();
    for entry in &file.shapes {
        let material = index_of(entry.material())?;
        let first = shapes.len() as u32;
        match entry {
            ShapeEntry::Sphere { center, radius, .. } => shapes.push(Shape::Sphere {
                center: *center,
                radius: *radius,
                material: first,
            }),
            ShapeEntry::Polygon(polygon) => shapes.extend(polygon.shapes(first)),
            ShapeEntry::Mesh(entry) => {
                let failed =
                    |kind| SceneError::new(TextPosition::of_value(text, "file", &entry.file), kind);
                let mesh = load(&entry.file).and_then(|mesh| subdivide_mesh(mesh, entry));
                let mesh = mesh.and_then(|mesh| mesh.shapes(entry, first));
                shapes.extend(mesh.map_err(failed)?);
            }
        }
        shape_materials.resize(shapes.len(), material);
    }
    let scene = Scene {
        about: file.about,
        camera: file.camera,
        environment: file.environment,
        materials,
        shapes,
        shape_materials,
        max_leaf_size: MAX_LEAF_SIZE,
    };
    Ok((scene, names))
}

fn parse(text: &str) -> Result<SceneFile, SceneError> {
    let mut parser = serde_json::Deserializer::from_str(text);
    let file = serde_path_to_error::deserialize(&mut parser)
        .map_err(|error| scene_error(text, error.path(), error.inner()))?;
    let whole_text = serde_path_to_error::Track::new().path();
    parser
        .end()
        .map_err(|error| scene_error(text, &whole_text, &error))?;
    Ok(file)
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
