//! Reads scene files.

use glam::Vec3;
use protocol::{Shape, Vertex};

use super::camera::Camera;
use super::environment::{Environment, EnvironmentMap};
use super::error::{SceneError, TextPosition};
use super::material::Material;
use super::mesh::{Face, Transform};
use super::value::{Object, Value};
use super::{MAX_LEAF_SIZE, Scene, polygon};

/// Loads the files that a scene refers to, given their paths.
pub(super) struct LoadFiles<'a> {
    /// Loads a mesh, or returns the reason it can't be loaded.
    pub(super) mesh: &'a dyn Fn(&str) -> Result<Vec<Face>, String>,
    /// Loads an environment map whose pixels are multiplied by a factor, or returns the reason
    /// it can't be loaded.
    pub(super) map: &'a dyn Fn(&str, f32) -> Result<EnvironmentMap, String>,
}

/// Reads the scene in `text` and returns it with the names of its materials.
pub(super) fn scene(text: &str, load: &LoadFiles) -> Result<(Scene, Vec<String>), SceneError> {
    let start = text.trim_start();
    if start.is_empty() {
        let message = "the scene is empty: it needs at least a camera, materials and shapes";
        return Err(SceneError::new(None, message));
    }
    if !start.starts_with('{') {
        let position = TextPosition::at_offset(text, text.len() - start.len());
        let message = "this is not a scene: a scene begins with `{`. scenes/README.md describes \
                       the format";
        return Err(SceneError::new(Some(position), message));
    }
    let file = Value::parse(text)?;
    let keys = file.object(&["about", "camera", "environment", "materials", "shapes"])?;
    let about = keys.optional("about", Value::string)?;
    let camera = keys.required("camera", Camera::read)?;
    let environment = keys.optional("environment", |value| read_environment(value, load))?;
    let (mut names, mut materials) = (Vec::new(), Vec::new());
    for (name, material) in keys.required("materials", Value::members)? {
        names.push(name.key);
        materials.push(Material::read(&material)?);
    }
    let mut shapes = Vec::new();
    let mut shape_materials = Vec::new();
    keys.required("shapes", |list| {
        list.list(|entry| {
            let (keys, new) = read_shape(entry, shapes.len() as u32, load)?;
            shapes.extend(new);
            let material = material_index(&keys.value("material")?, &names)?;
            shape_materials.resize(shapes.len(), material);
            Ok(())
        })
    })?;
    let scene = Scene {
        about: about.unwrap_or_default(),
        camera,
        environment: environment.unwrap_or(Environment::Constant(Vec3::ZERO)),
        materials,
        shapes,
        shape_materials,
        max_leaf_size: MAX_LEAF_SIZE,
    };
    Ok((scene, names))
}

/// Reads the environment: a radiance, or an object with the path of a map.
fn read_environment(value: &Value, load: &LoadFiles) -> Result<Environment, SceneError> {
    if value.members().is_err() {
        return value.radiance().map(Environment::Constant);
    }
    let keys = value.object(&["map", "scale"])?;
    let scale = keys.optional("scale", Value::positive)?.unwrap_or(1.0);
    let file = keys.value("map")?;
    let map = (load.map)(&file.string()?, scale);
    map.map(Environment::Map)
        .map_err(|message| file.error(message))
}

/// Returns the index of the material named in `value`.
fn material_index(value: &Value, names: &[String]) -> Result<u32, SceneError> {
    let name = value.string()?;
    let index = names.iter().position(|known| *known == name);
    index.map(|index| index as u32).ok_or_else(|| {
        let problem = "there is no material";
        value.unknown(problem, &name, ("the scene defines", names))
    })
}

/// Reads an entry of `shapes`. Returns its keys and its shapes, numbered from `first`.
fn read_shape<'a>(
    entry: &Value<'a>,
    first: u32,
    load: &LoadFiles,
) -> Result<(Object<'a>, Vec<Shape>), SceneError> {
    let numbered = |triangles: Vec<[Vertex; 3]>| {
        let numbered = triangles.into_iter().zip(first..);
        let shapes = numbered.map(|(vertices, shape)| Shape::Triangle { vertices, shape });
        shapes.collect::<Vec<Shape>>()
    };
    let (kind, value) = entry.kind()?;
    match kind.key.as_str() {
        "sphere" => {
            let keys = value.object(&["center", "radius", "material"])?;
            let sphere = Shape::Sphere {
                center: keys.required("center", Value::point)?,
                radius: keys.required("radius", Value::positive)?,
                shape: first,
            };
            Ok((keys, vec![sphere]))
        }
        "polygon" => {
            let keys = value.object(&["points", "uv", "material"])?;
            let triangles = polygon::read(&keys)?;
            Ok((keys, numbered(triangles)))
        }
        "mesh" => {
            let known = ["file", "material", "scale", "rotate", "translate"];
            let keys = value.object(&known)?;
            let triangles = read_mesh(&keys, load)?;
            Ok((keys, numbered(triangles)))
        }
        name => {
            let known = ["sphere", "polygon", "mesh"];
            let problem = "unknown kind of shape";
            Err(kind.unknown(problem, name, ("the kinds are", &known)))
        }
    }
}

/// Reads the entry for a mesh. The mesh itself is in an OBJ file in the scene file's folder or
/// below it.
fn read_mesh(keys: &Object, load: &LoadFiles) -> Result<Vec<[Vertex; 3]>, SceneError> {
    let transform = Transform {
        scale: keys.optional("scale", Value::positive)?.unwrap_or(1.0),
        rotate: keys.optional("rotate", Value::point)?.unwrap_or_default(),
        translate: keys
            .optional("translate", Value::point)?
            .unwrap_or_default(),
    };
    let file = keys.value("file")?;
    (load.mesh)(&file.string()?)
        .and_then(|mesh| transform.apply(&mesh))
        .map_err(|message| file.error(message))
}
