//! Meshes in OBJ files.

#[cfg(test)]
mod tests;
mod triangulate;

use std::path::Path;

use glam::{DVec3, Vec2, Vec3};

use super::error::{SceneError, SceneErrorKind, TextPosition, read_bytes};
use super::mesh::{Face, Mesh};
use triangulate::triangulate;

/// Loads a mesh from an OBJ file.
pub(super) fn load(path: &Path) -> Result<Mesh, SceneErrorKind> {
    let bytes = read_bytes(path).map_err(in_mesh)?;
    // Names of groups and materials may have another encoding.
    parse(&String::from_utf8_lossy(&bytes)).map_err(|error| in_mesh(error.in_file(path)))
}

fn in_mesh(error: SceneError) -> SceneErrorKind {
    SceneErrorKind::Mesh(Box::new(error))
}

/// Parses the faces of an OBJ text, and splits them into triangles. The scene defines the materials,
/// so everything else is ignored.
fn parse(text: &str) -> Result<Mesh, SceneError> {
    let text = &text.replace("\r\n", "\n").replace('\r', "\n");
    let statements = statements(text);
    mesh(&statements).map_err(|(line, message)| {
        let position = line.map(|line| TextPosition::new(text, line, 0));
        SceneError::new(position, SceneErrorKind::Obj(message))
    })
}

/// The kinds of lines that faces refer to by index, in the order of the indices in a face corner.
const INDEXED: [(&str, &str); 3] = [("v", "position"), ("vt", "uv"), ("vn", "normal")];

/// One statement of an OBJ file.
struct Statement<'a> {
    /// The number of its first line, starting at 1.
    line: usize,
    words: Vec<&'a str>,
}

/// Splits a text into statements: removes comments, which may follow a statement on its line, and
/// joins lines that end in a backslash.
fn statements(text: &str) -> Vec<Statement<'_>> {
    let mut statements: Vec<Statement> = Vec::new();
    let mut continues = false;
    for (line, text) in (1..).zip(text.lines()) {
        let words = text.split_whitespace();
        let mut words: Vec<&str> = words.take_while(|word| !word.starts_with('#')).collect();
        let last = words.last().and_then(|last| last.strip_suffix('\\'));
        if let Some(last) = last {
            words.pop();
            words.extend((!last.is_empty()).then_some(last));
        }
        match statements.last_mut().filter(|_| continues) {
            Some(before) => before.words.extend(words),
            None => statements.push(Statement { line, words }),
        }
        continues = last.is_some();
    }
    statements
}

/// Returns the mesh, or the message of an error and its line.
fn mesh(statements: &[Statement]) -> Result<Mesh, (Option<usize>, String)> {
    let mut elements: [Vec<Vec3>; 3] = Default::default();
    let mut faces = Vec::new();
    for Statement { line, words } in statements {
        let Some((kind, words)) = words.split_first() else {
            continue;
        };
        if *kind == "f" {
            faces.push((*line, words, elements.each_ref().map(Vec::len)));
        } else if let Some(i) = INDEXED.iter().position(|(known, _)| known == kind) {
            let element = element(INDEXED[i], words).map_err(|message| (Some(*line), message))?;
            elements[i].push(element);
        }
    }
    let mut mesh = Mesh::default();
    for (line, words, so_far) in faces {
        let triangles = triangles(words, &elements, so_far);
        mesh.faces
            .extend(triangles.map_err(|message| (Some(line), message))?);
    }
    if mesh.faces.is_empty() {
        let message = "the file has no faces (lines that begin with `f`); is it a mesh?";
        return Err((None, message.to_owned()));
    }
    // Keeps the positions that faces use, in this order.
    let mut indices = vec![None; elements[0].len()];
    for corner in mesh.faces.iter_mut().flat_map(|face| &mut face.corners) {
        let position = elements[0][*corner];
        *corner = *indices[*corner].get_or_insert_with(|| {
            mesh.positions.push(position);
            mesh.positions.len() - 1
        });
    }
    Ok(mesh)
}

/// Returns the first three numbers of a statement. `v` may be followed by a weight or a colour, and
/// `vt` may have fewer numbers.
fn element((kind, name): (&str, &str), words: &[&str]) -> Result<Vec3, String> {
    let numbers: Vec<f32> = words
        .iter()
        .map(|word| number(word))
        .collect::<Result<_, _>>()?;
    let (at_least, noun) = match kind {
        "vt" => (1, "number"),
        _ => (3, "numbers"),
    };
    let given = numbers.len();
    if given < at_least {
        return Err(format!(
            "a {name} needs {at_least} {noun}, and this has {given}"
        ));
    }
    let at = |i: usize| numbers.get(i).copied().unwrap_or(0.0);
    Ok(Vec3::new(at(0), at(1), at(2)))
}

fn number(word: &str) -> Result<f32, String> {
    let number = word.parse().ok();
    number
        .filter(|number: &f32| number.is_finite())
        .ok_or_else(|| format!("`{word}` is not a finite number"))
}

/// Returns the triangles of a face. `so_far` is the number of elements before its line.
fn triangles(
    words: &[&str],
    elements: &[Vec<Vec3>; 3],
    so_far: [usize; 3],
) -> Result<Vec<Face>, String> {
    if words.len() < 3 {
        let given = words.len();
        return Err(format!(
            "a face needs 3 corners or more, and this has {given}"
        ));
    }
    let totals = elements.each_ref().map(Vec::len);
    let corners = words.iter().map(|word| corner(word, totals, so_far));
    let corners: Vec<Corner> = corners.collect::<Result<_, _>>()?;
    let form = |corner: &Corner| (corner.uv.is_some(), corner.normal.is_some());
    if let Some(other) = corners.iter().position(|c| form(c) != form(&corners[0])) {
        return Err(format!(
            "the corners `{}` and `{}` differ: give either all corners of a face a uv, and all a \
             normal, or none",
            words[0], words[other]
        ));
    }
    let [positions, uvs, normals] = elements;
    let points = corners.iter().map(|corner| positions[corner.position]);
    let points: Vec<DVec3> = points.map(|point| point.as_dvec3()).collect();
    let triangles = triangulate(&points).ok_or(
        "the outline of this face crosses itself: list the corners in order, all around, or export \
         the mesh as triangles",
    )?;
    let face = |triangle: [usize; 3]| {
        let corners = triangle.map(|i| corners[i]);
        Face {
            corners: corners.map(|corner| corner.position),
            uv: match corners.map(|corner| corner.uv) {
                [Some(a), Some(b), Some(c)] => [a, b, c].map(|i| uvs[i].truncate()),
                _ => [Vec2::ZERO, Vec2::X, Vec2::Y],
            },
            normals: match corners.map(|corner| corner.normal) {
                [Some(a), Some(b), Some(c)] => Some([a, b, c].map(|i| normals[i])),
                _ => None,
            },
        }
    };
    Ok(triangles.into_iter().map(face).collect())
}

/// The indices of a face corner, starting at 0.
#[derive(Clone, Copy)]
struct Corner {
    position: usize,
    uv: Option<usize>,
    normal: Option<usize>,
}

/// Parses a face corner such as `7`, `7/1`, `7//3` or `7/1/3`. A negative index counts backward from
/// the last element before the current line. Like other programs, ignores the indices of uvs in a
/// file that has none, and those of normals.
fn corner(word: &str, totals: [usize; 3], so_far: [usize; 3]) -> Result<Corner, String> {
    let mut indices = [None; 3];
    let invalid =
        || format!("`{word}` is not a face corner; expected the form 7, 7/1, 7//3 or 7/1/3");
    for (i, text) in word.split('/').enumerate() {
        if i > 0 && text.is_empty() {
            continue;
        }
        let (Some((_, name)), Ok(index)) = (INDEXED.get(i), text.parse::<isize>()) else {
            return Err(invalid());
        };
        let total = totals[i];
        if i > 0 && total == 0 {
            continue;
        }
        let found = match index {
            1.. => index
                .checked_sub(1)
                .and_then(|index| usize::try_from(index).ok()),
            _ => so_far[i].checked_sub(index.unsigned_abs()),
        };
        indices[i] = found.filter(|found| index != 0 && *found < total);
        if indices[i].is_none() {
            return Err(format!(
                "there is no {name} {index}: the indices are 1 to {total}"
            ));
        }
    }
    let [position, uv, normal] = indices;
    Ok(Corner {
        position: position.ok_or_else(invalid)?,
        uv,
        normal,
    })
}
