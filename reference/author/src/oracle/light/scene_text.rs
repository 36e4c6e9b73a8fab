//! Rooms as the text of scene files.

use std::collections::BTreeMap;

use glam::DVec3;
use protocol::light::transport;
use serde::Deserialize;

use super::environment::Map64;
use super::light_sources::Environment64;
use super::quad::{Material64, Quad};
use super::room::Room;

impl Room {
    /// Returns the room as the text of a scene file. The framework reads exactly the numbers of this
    /// room. The camera, which scene files must have, is at the origin and looks along −z.
    ///
    /// An environment map isn't part of the text, since scene files only refer to it.
    pub fn text(&self) -> String {
        let quads = || self.quads().iter().enumerate();
        let materials = quads().map(|(index, quad)| {
            let material = material_text(quad.material());
            format!(r#"    "{index}": {material}"#)
        });
        let materials = materials.collect::<Vec<String>>().join(",\n");
        let shapes = quads().map(|(index, quad)| {
            let points = quad.corners().map(numbers).join(", ");
            let polygon = format!(r#"{{ "material": "{index}", "points": [{points}] }}"#);
            format!(r#"    {{ "polygon": {polygon} }}"#)
        });
        let shapes = shapes.collect::<Vec<String>>().join(",\n");
        let environment = match self.sources().environment {
            Environment64::Constant(radiance) => radiance,
            Environment64::Map(_) => DVec3::ZERO,
        };
        let environment = numbers(environment);
        format!(
            r#"{{
  "camera": {{
    "vertical_fov": 90,
    "film": [64, 64],
    "position": [0, 0, 0],
    "look_at": [0, 0, -1],
    "up": [0, 1, 0]
  }},
  "environment": {environment},
  "materials": {{
{materials}
  }},
  "shapes": [
{shapes}
  ]
}}
"#
        )
    }

    /// Returns the room of a question.
    pub fn in_question(subject: &transport::Room) -> Room {
        let map = subject.map.as_ref();
        let map = map.map(|map| Map64::new(map.size, &map.pixels));
        let room = Room::from_text(&subject.scene, map);
        room.expect("rooms in questions are written by `Room::text`")
    }

    /// Reads a room from the text that [`Room::text`] returns. `map` is its environment map, if it
    /// has one.
    fn from_text(text: &str, map: Option<Map64>) -> serde_json::Result<Room> {
        let scene: SceneText = serde_json::from_str(text)?;
        let quads = scene.shapes.iter().map(|shape| {
            let PolygonText { material, points } = &shape.polygon;
            let [p, q, _, s] = *points;
            Quad::new(p, [q - p, s - p], scene.materials[material])
        });
        let constant = Environment64::Constant(scene.environment);
        Ok(Room::new(
            quads.collect(),
            map.map_or(constant, Environment64::Map),
        ))
    }
}

/// The parts of a scene file that a room's text contains, apart from the camera.
#[derive(Deserialize)]
struct SceneText {
    environment: DVec3,
    materials: BTreeMap<String, Material64>,
    shapes: Vec<ShapeText>,
}

/// A shape in a scene file.
#[derive(Deserialize)]
struct ShapeText {
    polygon: PolygonText,
}

/// A parallelogram in a scene file.
#[derive(Deserialize)]
struct PolygonText {
    material: String,
    points: [DVec3; 4],
}

/// Returns a material's entry in a scene file.
fn material_text(material: &Material64) -> String {
    let (kind, key, value) = match *material {
        Material64::Lambertian { albedo } => ("lambertian", "albedo", numbers(albedo)),
        Material64::Mirror { reflectance } => ("mirror", "reflectance", numbers(reflectance)),
        Material64::Glass { ior } => ("glass", "ior", ior.to_string()),
        Material64::Emitter { radiance } => ("emitter", "radiance", numbers(radiance)),
    };
    format!(r#"{{ "{kind}": {{ "{key}": {value} }} }}"#)
}

/// Returns a list of three numbers in JSON.
fn numbers(DVec3 { x, y, z }: DVec3) -> String {
    format!("[{x}, {y}, {z}]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_room_is_read_from_its_text() {
        let materials = [
            Material64::Lambertian {
                albedo: DVec3::new(0.1, 0.2, 0.3),
            },
            Material64::Mirror {
                reflectance: DVec3::new(0.9, 0.7, 1.0 / 3.0),
            },
            Material64::Glass { ior: 1.7 },
            Material64::Emitter {
                radiance: DVec3::new(1e-3, 40.0, 0.0),
            },
        ];
        let quads = (0..).zip(materials).map(|(index, material)| {
            let corner = DVec3::new(f64::from(index), -0.7, 300.0);
            Quad::new(corner, [DVec3::new(0.1, 2.3, 0.0), DVec3::Z], material)
        });
        let environment = Environment64::Constant(DVec3::new(0.0, 0.3, 7.7));
        let room = Room::new(quads.collect(), environment);
        let read = Room::from_text(&room.text(), None).expect("the text is a scene");
        assert_eq!(read.quads(), room.quads());
        assert_eq!(read.text(), room.text());
        // The framework reads numbers in single precision.
        let corners = room.quads().iter().flat_map(Quad::corners);
        for corner in corners {
            assert_eq!(corner.as_vec3().as_dvec3(), corner);
        }
    }
}
