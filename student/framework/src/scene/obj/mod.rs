//! Meshes in OBJ files.
//!
//! The crate `tobj` reports errors without their lines, accepts NaN, and splits concave faces wrongly.
//! A scene needs only positions, uvs, normals and faces, so this module reads them itself.

#[cfg(test)]
mod tests;

use std::path::Path;

use glam::{DVec3, Vec2, Vec3, vec3};

use super::error::{SceneError, TextPosition};
use super::mesh::Face;
use super::text_file::read_bytes;
use super::triangulate::triangulate;

/// The maximum number of corners of a face. Splitting a face takes up to the third power of this.
const MAX_CORNERS: usize = 1000;

/// The line of an error, if known, and its message.
type ObjError = (Option<usize>, String);

/// Loads a mesh from an OBJ file.
pub(super) fn load(path: &Path) -> Result<Vec<Face>, SceneError> {
    // Names of groups and materials may have another encoding.
    let text = String::from_utf8_lossy(&read_bytes(path)?).into_owned();
    parse(&text).map_err(|error| error.in_file(path))
}

/// Parses the faces of an OBJ text, and splits them into triangles. The scene defines the materials,
/// so everything else is ignored.
fn parse(text: &str) -> Result<Vec<Face>, SceneError> {
    let text = &text.replace("\r\n", "\n").replace('\r', "\n");
    let read = read(&statements(text));
    let mesh = read.and_then(|(elements, faces)| triangles(&elements, &faces));
    mesh.map_err(|(line, message)| {
        let position = line.map(|line| TextPosition::new(text, line, 0));
        SceneError::new(position, message)
    })
}

/// The kinds of lines that faces refer to by index, in the order of the indices in a face corner.
const INDEXED: [(&str, &str); 3] = [("v", "position"), ("vt", "uv"), ("vn", "normal")];

/// Splits a text into statements, each with the number of its first line: removes comments, which
/// may follow a statement on its line, and joins lines that end in a backslash.
fn statements(text: &str) -> Vec<(usize, Vec<&str>)> {
    let mut statements: Vec<(usize, Vec<&str>)> = Vec::new();
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
            Some((_, before)) => before.extend(words),
            None => statements.push((line, words)),
        }
        continues = last.is_some();
    }
    statements
}

/// The elements that faces refer to: the positions, the uvs and the normals. The third number of a uv
/// is not used.
type Elements = [Vec<Vec3>; 3];

/// A face that is known to be valid.
struct ObjFace {
    line: usize,
    /// The indices of each corner's position, uv and normal.
    corners: Vec<[usize; 3]>,
    has_uv: bool,
    has_normal: bool,
}

/// Reads the elements and the faces, and leaves out everything else.
fn read(statements: &[(usize, Vec<&str>)]) -> Result<(Elements, Vec<ObjFace>), ObjError> {
    let kinds = || statements.iter().filter_map(|(_, words)| words.first());
    let totals = INDEXED.map(|(kind, _)| kinds().filter(|other| **other == kind).count());
    let mut elements = Elements::default();
    let mut faces = Vec::new();
    for (line, words) in statements {
        let failed = |message| (Some(*line), message);
        let Some((kind, words)) = words.split_first() else {
            continue;
        };
        if *kind == "f" {
            let so_far = elements.each_ref().map(Vec::len);
            faces.push(read_face(*line, words, totals, so_far).map_err(failed)?);
        } else if let Some(i) = INDEXED.iter().position(|(known, _)| known == kind) {
            elements[i].push(read_numbers(INDEXED[i], words).map_err(failed)?);
        }
    }
    Ok((elements, faces))
}

/// Reads the numbers of a statement, which must be finite. `v` may be followed by a weight or a
/// colour, and the second number of `vt` may be missing.
fn read_numbers((kind, name): (&str, &str), words: &[&str]) -> Result<Vec3, String> {
    let number = |word: &&str| {
        let number = word.parse().ok().filter(|number: &f32| number.is_finite());
        number.ok_or_else(|| format!("`{word}` is not a finite number"))
    };
    let numbers: Vec<f32> = words.iter().map(number).collect::<Result<_, _>>()?;
    let (needed, noun) = match kind {
        "vt" => (1, "number"),
        _ => (3, "numbers"),
    };
    let given = numbers.len();
    if given < needed {
        return Err(format!(
            "a {name} needs {needed} {noun}, and this has {given}"
        ));
    }
    let number = |axis: usize| numbers.get(axis).copied().unwrap_or_default();
    Ok(vec3(number(0), number(1), number(2)))
}

/// Reads the corners of a face. `so_far` is the number of elements before its line.
fn read_face(
    line: usize,
    words: &[&str],
    totals: [usize; 3],
    so_far: [usize; 3],
) -> Result<ObjFace, String> {
    let corners = words.len();
    if corners < 3 {
        return Err(format!(
            "a face needs 3 corners or more, and this has {corners}"
        ));
    }
    if corners > MAX_CORNERS {
        return Err(format!(
            "a face can have up to {MAX_CORNERS} corners, and this has {corners}: export the mesh as \
             triangles"
        ));
    }
    let corners = words.iter().map(|word| read_corner(word, totals, so_far));
    let corners: Vec<[Option<usize>; 3]> = corners.collect::<Result<_, _>>()?;
    let form = |corner: &[Option<usize>; 3]| corner.map(|index| index.is_some());
    let [_, has_uv, has_normal] = form(&corners[0]);
    if let Some(other) = corners
        .iter()
        .position(|corner| form(corner) != form(&corners[0]))
    {
        return Err(format!(
            "the corners `{}` and `{}` differ: give either all corners of a face a uv, and all a \
             normal, or none",
            words[0], words[other]
        ));
    }
    let corners = corners.into_iter();
    let corners = corners.map(|corner| corner.map(Option::unwrap_or_default));
    Ok(ObjFace {
        line,
        corners: corners.collect(),
        has_uv,
        has_normal,
    })
}

/// Reads a face corner such as `7`, `7/1`, `7//3` or `7/1/3`. A negative index counts backward from the
/// last element before the current line. Like other programs, ignores the indices of uvs in a file that
/// has none, and those of normals.
fn read_corner(
    word: &str,
    totals: [usize; 3],
    so_far: [usize; 3],
) -> Result<[Option<usize>; 3], String> {
    let mut corner = [None; 3];
    for (i, text) in word.split('/').enumerate() {
        if i > 0 && text.is_empty() {
            continue;
        }
        let (Some((_, name)), Ok(index)) = (INDEXED.get(i), text.parse::<isize>()) else {
            return Err(format!(
                "`{word}` is not a face corner; expected the form 7, 7/1, 7//3 or 7/1/3"
            ));
        };
        let total = totals[i];
        if i > 0 && total == 0 {
            continue;
        }
        let distance = index.unsigned_abs();
        corner[i] = if index > 0 {
            (distance <= total).then(|| distance - 1)
        } else {
            so_far[i].checked_sub(distance).filter(|_| index != 0)
        };
        if corner[i].is_none() {
            return Err(format!(
                "there is no {name} {index}: the indices are 1 to {total}"
            ));
        }
    }
    Ok(corner)
}

/// Splits the faces into triangles.
fn triangles(elements: &Elements, faces: &[ObjFace]) -> Result<Vec<Face>, ObjError> {
    let [positions, uvs, normals] = elements;
    let mut mesh = Vec::new();
    for face in faces {
        let points = face
            .corners
            .iter()
            .map(|[i, _, _]| positions[*i].as_dvec3());
        let triangles = triangulate(&points.collect::<Vec<DVec3>>()).ok_or_else(|| {
            let message = "the outline of this face crosses itself: list the corners in order, all \
                           around, or export the mesh as triangles";
            (Some(face.line), message.to_owned())
        })?;
        for triangle in triangles {
            let at = |list: &[Vec3], i: usize| triangle.map(|corner| list[face.corners[corner][i]]);
            let uv = || at(uvs, 1).map(Vec3::truncate);
            let whole_texture = [Vec2::ZERO, Vec2::X, Vec2::Y];
            mesh.push(Face {
                corners: at(positions, 0),
                uv: face.has_uv.then(uv).unwrap_or(whole_texture),
                normals: face.has_normal.then(|| at(normals, 2)),
            });
        }
    }
    if mesh.is_empty() {
        let message = "the file has no faces (lines that begin with `f`); is it a mesh?";
        return Err((None, message.to_owned()));
    }
    Ok(mesh)
}
