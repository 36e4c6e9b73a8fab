//! Meshes in OBJ files, read with `tobj`.
//!
//! `tobj` reports no line numbers in its errors and accepts NaN, so this module validates the text
//! first.

use std::path::Path;

use glam::{Vec2, Vec3};

use super::error::{SceneError, SceneErrorKind, TextPosition, read_text};
use super::mesh::{Face, Mesh};

/// Loads a mesh from an OBJ file.
pub(super) fn load(path: &Path) -> Result<Mesh, SceneErrorKind> {
    let text = read_text(path).map_err(in_mesh)?;
    parse(&text).map_err(|error| in_mesh(error.in_file(path)))
}

fn in_mesh(error: SceneError) -> SceneErrorKind {
    SceneErrorKind::Mesh(Box::new(error))
}

/// Parses the triangles of an OBJ text. Faces with more than three corners become triangle fans.
fn parse(text: &str) -> Result<Mesh, SceneError> {
    validate(text)?;
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..tobj::LoadOptions::default()
    };
    // The scene defines the materials, so material libraries are ignored.
    let no_library = |_: &Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_library)
        .map_err(|error| SceneError::new(None, SceneErrorKind::Obj(error.to_string())))?;

    let mut mesh = Mesh::default();
    for model in models {
        let first = mesh.positions.len();
        mesh.positions.extend(triples(&model.mesh.positions));
        let normals: Vec<Vec3> = triples(&model.mesh.normals).collect();
        let (uvs, _) = model.mesh.texcoords.as_chunks::<2>();
        let face = |i: usize| Face {
            corners: three(&model.mesh.indices, i).map(|corner| first + corner),
            uv: if model.mesh.texcoord_indices.is_empty() {
                [Vec2::ZERO, Vec2::X, Vec2::Y]
            } else {
                three(&model.mesh.texcoord_indices, i).map(|k| Vec2::from(uvs[k]))
            },
            normals: (!model.mesh.normal_indices.is_empty())
                .then(|| three(&model.mesh.normal_indices, i).map(|k| normals[k])),
        };
        mesh.faces
            .extend((0..model.mesh.indices.len() / 3).map(face));
    }
    if mesh.faces.is_empty() {
        Err(SceneError::new(None, no_faces()))
    } else {
        Ok(mesh)
    }
}

fn no_faces() -> SceneErrorKind {
    let message = "the file has no faces (lines that begin with `f`); is it a mesh?";
    SceneErrorKind::Obj(message.to_owned())
}

fn triples(numbers: &[f32]) -> impl Iterator<Item = Vec3> {
    numbers.as_chunks::<3>().0.iter().copied().map(Vec3::from)
}

fn three(indices: &[u32], face: usize) -> [usize; 3] {
    [0, 1, 2].map(|corner| indices[3 * face + corner] as usize)
}

/// The kinds of lines that faces refer to by index, in the order of the indices in a face corner.
const INDEXED: [(&str, &str); 3] = [("v", "position"), ("vt", "uv"), ("vn", "normal")];

/// Checks the numbers of positions, texture coordinates and normals, and the indices of faces.
fn validate(text: &str) -> Result<(), SceneError> {
    let count = |kind: &str| text.lines().filter(|line| first_word(line) == kind).count();
    let totals = INDEXED.map(|(kind, _)| count(kind));
    let mut so_far = [0; 3];
    for (number, line) in (1..).zip(text.lines()) {
        let kind = first_word(line);
        let words = || line.split_whitespace().skip(1);
        let checked = if let Some(i) = INDEXED.iter().position(|(known, _)| *known == kind) {
            so_far[i] += 1;
            words().try_for_each(number_is_finite)
        } else if kind == "f" {
            words().try_for_each(|corner| corner_exists(corner, totals, so_far))
        } else {
            Ok(())
        };
        let failed = |message| {
            let position = Some(TextPosition::new(text, number, 0));
            SceneError::new(position, SceneErrorKind::Obj(message))
        };
        checked.map_err(failed)?;
    }
    Ok(())
}

fn first_word(line: &str) -> &str {
    line.split_whitespace().next().unwrap_or("")
}

fn number_is_finite(word: &str) -> Result<(), String> {
    match word.parse::<f32>() {
        Ok(number) if number.is_finite() => Ok(()),
        Ok(_) | Err(_) => Err(format!("`{word}` is not a finite number")),
    }
}

/// Checks the indices of a face corner such as `7`, `7/1`, `7//3` or `7/1/3`. A negative index
/// counts backward from the last element before the current line.
fn corner_exists(corner: &str, totals: [usize; 3], so_far: [usize; 3]) -> Result<(), String> {
    for (i, index) in corner.split('/').enumerate() {
        if index.is_empty() {
            continue;
        }
        let (Some((_, name)), Ok(index)) = (INDEXED.get(i), index.parse::<i64>()) else {
            return Err(format!(
                "`{corner}` is not a face corner; expected the form 7, 7/1, 7//3 or 7/1/3"
            ));
        };
        let exists = match index {
            1.. => index.unsigned_abs() <= totals[i] as u64,
            0 => false,
            ..0 => index.unsigned_abs() <= so_far[i] as u64,
        };
        if !exists {
            let total = totals[i];
            return Err(format!(
                "there is no {name} {index}: the indices are 1 to {total}"
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(text: &str) -> String {
        parse(text).expect_err("the text is invalid").to_string()
    }

    const POSITIONS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    #[test]
    fn a_face_without_normals_is_flat_and_a_square_is_two_triangles() {
        let mesh = parse(&format!("{POSITIONS}f 1 2 3 4\n")).expect("the text is valid");
        assert_eq!(mesh.faces.len(), 2);
        assert!(mesh.faces.iter().all(|face| face.normals.is_none()));
    }

    #[test]
    fn reads_normals_and_texture_coordinates_per_corner() {
        let attributes = "vt 0.5 0.25\nvn 0 0 1\nvn 1 0 0\n";
        let mesh = parse(&format!("{POSITIONS}{attributes}f 1/1/1 2/1/2 -2/-1/-2\n"));
        let mesh = mesh.expect("the text is valid");
        let face = mesh.faces[0];
        assert_eq!(face.normals, Some([Vec3::Z, Vec3::X, Vec3::Z]));
        assert_eq!(face.uv, [Vec2::new(0.5, 0.25); 3]);
    }

    #[test]
    fn reports_the_line_of_an_index_out_of_range() {
        let error = problem(&format!("{POSITIONS}f 1 2 5\n"));
        assert!(
            error.contains(":5: there is no position 5: the indices are 1 to 4"),
            "{error}"
        );
        let error = problem(&format!("{POSITIONS}f 1//1 2//1 3//1\n"));
        assert!(error.contains("there is no normal 1"), "{error}");
        assert!(problem(&format!("{POSITIONS}f 0 1 2\n")).contains("no position 0"));
        assert!(problem(&format!("{POSITIONS}f 1 2 -5\n")).contains("no position -5"));
    }

    #[test]
    fn reports_the_line_of_an_invalid_number() {
        assert!(problem("v 0 nan 0\n").contains(":1: `nan` is not a finite number"));
        assert!(problem("v 0 1e99 0\n").contains("`1e99` is not"));
        assert!(problem(&format!("{POSITIONS}f a b c\n")).contains("`a` is not a face corner"));
    }

    #[test]
    fn rejects_a_mesh_without_faces() {
        assert!(problem("").contains("has no faces"));
        assert!(problem(POSITIONS).contains("has no faces"));
    }
}
