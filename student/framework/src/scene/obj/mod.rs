//! Meshes in OBJ files, parsed by `tobj`.
//!
//! `tobj` reports errors without line numbers, accepts NaN and splits concave faces incorrectly. So
//! this module checks each line first and splits the faces into triangles itself.

#[cfg(test)]
mod tests;

use std::path::Path;

use glam::{DVec3, Vec2, Vec3};

use super::error::{SceneError, TextPosition};
use super::mesh::Face;
use super::text_file::read_bytes;
use super::triangulate::triangulate;

/// The maximum number of corners in a face. Splitting a face takes cubic time in the worst case.
const MAX_CORNERS: usize = 1000;

/// The line number of an error, if known, and the error's message.
type ObjError = (Option<usize>, String);

/// Loads a mesh from an OBJ file.
pub(super) fn load(path: &Path) -> Result<Vec<Face>, SceneError> {
    // Names of groups and materials may use a different encoding.
    let text = String::from_utf8_lossy(&read_bytes(path)?).into_owned();
    parse(&text).map_err(|error| error.in_file(path))
}

/// Parses the faces in the text of an OBJ file and splits them into triangles. The scene defines
/// the materials, so everything else is ignored.
fn parse(text: &str) -> Result<Vec<Face>, SceneError> {
    let text = &text.replace("\r\n", "\n").replace('\r', "\n");
    let checked = check(&statements(text));
    let mesh = checked.and_then(|(text, faces)| triangles(&text, &faces));
    mesh.map_err(|(line, message)| {
        let position = line.map(|line| TextPosition::new(text, line, 0));
        SceneError::new(position, message)
    })
}

/// The kinds of lines that faces refer to by index, in the order of the indices in a face corner.
const INDEXED: [(&str, &str); 3] = [("v", "position"), ("vt", "uv"), ("vn", "normal")];

/// Splits the text into statements, each with the number of its first line: removes comments, which
/// may follow a statement on the same line, and joins lines that end in a backslash.
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

/// A face that is known to be valid.
struct CheckedFace {
    line: usize,
    corners: usize,
    has_uv: bool,
    has_normal: bool,
}

/// Checks the numbers and the faces. Returns the statements that contain them, in the form that
/// `tobj` parses, and the checked faces.
fn check(statements: &[(usize, Vec<&str>)]) -> Result<(String, Vec<CheckedFace>), ObjError> {
    let kinds = || statements.iter().filter_map(|(_, words)| words.first());
    let totals = INDEXED.map(|(kind, _)| kinds().filter(|other| **other == kind).count());
    let mut so_far = [0; 3];
    let mut faces = Vec::new();
    let mut text = String::new();
    for (line, words) in statements {
        let failed = |message| (Some(*line), message);
        let Some((kind, words)) = words.split_first() else {
            continue;
        };
        let words = if *kind == "f" {
            faces.push(check_face(*line, words, totals, so_far).map_err(failed)?);
            words.to_vec()
        } else if let Some(i) = INDEXED.iter().position(|(known, _)| known == kind) {
            so_far[i] += 1;
            check_numbers(INDEXED[i], words).map_err(failed)?
        } else {
            continue;
        };
        text.push_str(&format!("{kind} {}\n", words.join(" ")));
    }
    Ok((text, faces))
}

/// Returns the numbers that the mesh uses from a statement, provided that all of the statement's
/// numbers are finite. `v` may be followed by a weight or a colour, and the second number of `vt`
/// may be missing.
fn check_numbers<'a>(
    (kind, name): (&str, &str),
    words: &[&'a str],
) -> Result<Vec<&'a str>, String> {
    let is_finite = |word: &&str| word.parse().is_ok_and(f32::is_finite);
    if let Some(word) = words.iter().find(|word| !is_finite(word)) {
        return Err(format!("`{word}` is not a finite number"));
    }
    let (needed, noun, used) = match kind {
        "vt" => (1, "number", 2),
        _ => (3, "numbers", 3),
    };
    let given = words.len();
    if given < needed {
        return Err(format!(
            "a {name} needs {needed} {noun}, but this one has {given}"
        ));
    }
    Ok(words.iter().copied().chain(["0"]).take(used).collect())
}

/// Checks the corners of a face. `so_far` contains the number of elements of each kind before the
/// face's line.
fn check_face(
    line: usize,
    words: &[&str],
    totals: [usize; 3],
    so_far: [usize; 3],
) -> Result<CheckedFace, String> {
    let corners = words.len();
    if corners < 3 {
        return Err(format!(
            "a face needs at least 3 corners, but this one has {corners}"
        ));
    }
    if corners > MAX_CORNERS {
        return Err(format!(
            "a face can have up to {MAX_CORNERS} corners, but this one has {corners}: export the mesh as \
             triangles"
        ));
    }
    let forms = words.iter().map(|word| corner_form(word, totals, so_far));
    let forms: Vec<[bool; 3]> = forms.collect::<Result<_, _>>()?;
    if let Some(other) = forms.iter().position(|form| *form != forms[0]) {
        return Err(format!(
            "the corners `{}` and `{}` differ: in each face, either all corners or none must have a uv, and \
             the same goes for normals",
            words[0], words[other]
        ));
    }
    let [_, has_uv, has_normal] = forms[0];
    Ok(CheckedFace {
        line,
        corners,
        has_uv,
        has_normal,
    })
}

/// Checks a face corner such as `7`, `7/1`, `7//3` or `7/1/3`. Returns which indices it contains. A
/// negative index counts backward from the last element before the current line. Like other
/// programs, this function ignores the indices of uvs and normals if the file has none.
fn corner_form(word: &str, totals: [usize; 3], so_far: [usize; 3]) -> Result<[bool; 3], String> {
    let mut form = [false; 3];
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
        let limit = if index > 0 { total } else { so_far[i] };
        if index == 0 || index.unsigned_abs() > limit {
            return Err(format!(
                "there is no {name} {index}: the indices go from 1 to {total}"
            ));
        }
        form[i] = true;
    }
    Ok(form)
}

/// Parses text that has been checked and splits its faces into triangles.
fn triangles(text: &str, faces: &[CheckedFace]) -> Result<Vec<Face>, ObjError> {
    let no_materials = |_: &Path| Ok(Default::default());
    let options = tobj::LoadOptions::default();
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_materials)
        .map_err(|error| (None, error.to_string()))?;
    // Without groups and objects, there is one model.
    let parsed = &models[0].mesh;
    let positions = triples(&parsed.positions);
    let normals = triples(&parsed.normals);
    let (uvs, _) = parsed.texcoords.as_chunks::<2>();
    let mut mesh = Vec::new();
    let mut first = 0;
    for face in faces {
        let corners = parsed.indices[first..][..face.corners].iter();
        let points = corners.map(|&i| positions[i as usize].as_dvec3());
        let triangles = triangulate(&points.collect::<Vec<DVec3>>()).ok_or_else(|| {
            let message = "the outline of this face crosses itself: list the corners in order \
                           around the face, or export the mesh as triangles";
            (Some(face.line), message.to_owned())
        })?;
        for triangle in triangles {
            let indices = |list: &[u32]| triangle.map(|corner| list[first + corner] as usize);
            let uv = || indices(&parsed.texcoord_indices).map(|i| Vec2::from(uvs[i]));
            let normals = || indices(&parsed.normal_indices).map(|i| normals[i]);
            let whole_texture = [Vec2::ZERO, Vec2::X, Vec2::Y];
            mesh.push(Face {
                corners: indices(&parsed.indices).map(|i| positions[i]),
                // `tobj` makes up indices for corners without a uv or a normal.
                uv: face.has_uv.then(uv).unwrap_or(whole_texture),
                normals: face.has_normal.then(normals),
            });
        }
        first += face.corners;
    }
    if mesh.is_empty() {
        let message = "the file has no faces (lines that begin with `f`); is it a mesh?";
        return Err((None, message.to_owned()));
    }
    Ok(mesh)
}

fn triples(numbers: &[f32]) -> Vec<Vec3> {
    let (triples, _) = numbers.as_chunks::<3>();
    triples.iter().copied().map(Vec3::from).collect()
}
