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
    let statements = statements(text);
    let plain = validate(&statements).map_err(|(line, message)| {
        let position = Some(TextPosition::new(text, line, 0));
        SceneError::new(position, SceneErrorKind::Obj(message))
    })?;
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..tobj::LoadOptions::default()
    };
    // The scene defines the materials, so material libraries are ignored.
    let no_library = |_: &Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut plain.text.as_bytes(), &options, no_library)
        .map_err(|error| SceneError::new(None, SceneErrorKind::Obj(error.to_string())))?;

    let mut mesh = Mesh::default();
    // Groups and objects are not part of the plain text, so there is at most one model. It has made
    // up indices for corners without uv or normal.
    for tobj::Model { mesh: model, .. } in models {
        mesh.positions = triples(&model.positions).collect();
        let normals: Vec<Vec3> = triples(&model.normals).collect();
        let (uvs, _) = model.texcoords.as_chunks::<2>();
        let face = |(i, form): (usize, &CornerForm)| Face {
            corners: three(&model.indices, i),
            uv: if form.has_uv {
                three(&model.texcoord_indices, i).map(|k| Vec2::from(uvs[k]))
            } else {
                [Vec2::ZERO, Vec2::X, Vec2::Y]
            },
            normals: (form.has_normal).then(|| three(&model.normal_indices, i).map(|k| normals[k])),
        };
        mesh.faces = plain.triangles.iter().enumerate().map(face).collect();
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

/// One statement of an OBJ file.
struct Statement<'a> {
    /// The number of its first line, starting at 1.
    line: usize,
    words: Vec<&'a str>,
}

impl Statement<'_> {
    fn kind(&self) -> &str {
        self.words.first().copied().unwrap_or("")
    }

    fn arguments(&self) -> &[&str] {
        self.words.get(1..).unwrap_or_default()
    }
}

/// Splits a text into statements: removes comments, which may follow a statement on its line, and
/// joins lines that end in a backslash.
fn statements(text: &str) -> Vec<Statement<'_>> {
    let mut statements: Vec<Statement> = Vec::new();
    let mut continues = false;
    for (number, line) in (1..).zip(text.lines()) {
        let statement = line.split('#').next().unwrap_or("").trim_end();
        let (statement, ends_in_backslash) = match statement.strip_suffix('\\') {
            Some(statement) => (statement, true),
            None => (statement, false),
        };
        let words = statement.split_whitespace();
        match statements.last_mut().filter(|_| continues) {
            Some(last) => last.words.extend(words),
            None => statements.push(Statement {
                line: number,
                words: words.collect(),
            }),
        }
        continues = ends_in_backslash;
    }
    statements
}

/// A valid mesh in the form that `tobj` reads.
struct PlainObj {
    text: String,
    /// The form of the corners of each triangle, in the order in which `tobj` returns them.
    triangles: Vec<CornerForm>,
}

/// Checks the numbers of positions, texture coordinates and normals, and the indices of faces.
/// Returns the statements about them, or the line and the message of an error.
fn validate(statements: &[Statement]) -> Result<PlainObj, (usize, String)> {
    let count = |kind: &str| statements.iter().filter(|s| s.kind() == kind).count();
    let totals = INDEXED.map(|(kind, _)| count(kind));
    let mut so_far = [0; 3];
    let mut triangles = Vec::new();
    let mut text = String::new();
    for statement in statements {
        let (kind, words) = (statement.kind(), statement.arguments());
        let failed = |message| (statement.line, message);
        let mut words: Vec<&str> = if kind == "f" {
            let form = face_form(words, totals, so_far).map_err(failed)?;
            triangles.extend(std::iter::repeat_n(form, words.len() - 2));
            words.to_vec()
        } else if let Some(i) = INDEXED.iter().position(|(known, _)| *known == kind) {
            so_far[i] += 1;
            numbers(INDEXED[i], words).map_err(failed)?
        } else {
            continue;
        };
        words.insert(0, kind);
        text.push_str(&words.join(" "));
        text.push('\n');
    }
    Ok(PlainObj { text, triangles })
}

/// Returns the numbers of a statement that `tobj` needs, if they are finite. `v` may be followed by
/// a weight or a colour, and the second number of `vt` may be missing.
fn numbers<'a>((kind, name): (&str, &str), words: &[&'a str]) -> Result<Vec<&'a str>, String> {
    words.iter().try_for_each(|word| number_is_finite(word))?;
    let (at_least, used) = match kind {
        "vt" => (1, 2),
        _ => (3, 3),
    };
    if words.len() < at_least {
        let (given, numbers) = (
            words.len(),
            if at_least == 1 { "number" } else { "numbers" },
        );
        return Err(format!(
            "a {name} needs {at_least} {numbers}, and this has {given}"
        ));
    }
    let missing = std::iter::repeat("0");
    Ok(words.iter().copied().chain(missing).take(used).collect())
}

/// Flags for the data that the corners of a face have: uv, a normal, or both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct CornerForm {
    has_uv: bool,
    has_normal: bool,
}

/// Checks the corners of a face, and returns their form, which must be the same for all.
fn face_form(
    corners: &[&str],
    totals: [usize; 3],
    so_far: [usize; 3],
) -> Result<CornerForm, String> {
    if corners.len() < 3 {
        let given = corners.len();
        return Err(format!(
            "a face needs 3 corners or more, and this has {given}"
        ));
    }
    let mut forms = Vec::new();
    for corner in corners {
        corner_exists(corner, totals, so_far)?;
        let mut indices = corner.split('/').skip(1);
        let mut has_next = || indices.next().is_some_and(|index| !index.is_empty());
        forms.push(CornerForm {
            has_uv: has_next(),
            has_normal: has_next(),
        });
    }
    match forms.iter().position(|form| *form != forms[0]) {
        Some(other) => Err(format!(
            "the corners `{}` and `{}` differ: give either all corners of a face a uv, and all a \
             normal, or none",
            corners[0], corners[other]
        )),
        None => Ok(forms[0]),
    }
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
    fn reads_comments_continued_lines_weights_and_short_texture_coordinates() {
        let text = "v 0 0 0 1 # origin\nv 1 0 0 0.5 0.5 0.5\nv 1 \\\n  1 0\nvt 0.5\nvt 0.5 0.25 0\n\
                    f 1/1 2/2 \\\n  3/1 # the only face\n";
        let mesh = parse(text).expect("the text is valid");
        assert_eq!(
            mesh.positions,
            [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0)]
        );
        let uv = [
            Vec2::new(0.5, 0.0),
            Vec2::new(0.5, 0.25),
            Vec2::new(0.5, 0.0),
        ];
        assert_eq!(mesh.faces[0].uv, uv);
    }

    #[test]
    fn faces_with_and_without_normals_can_be_mixed() {
        let faces = "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//1 2//1 4//1\n";
        let mesh = parse(&format!("{POSITIONS}{faces}")).expect("the text is valid");
        let has_normals: Vec<bool> = mesh.faces.iter().map(|f| f.normals.is_some()).collect();
        assert_eq!(has_normals, [true, false, true]);
        let error = problem(&format!("{POSITIONS}vn 0 0 1\nf 1//1 2 \\\n3//1\n"));
        assert!(
            error.contains(":6: the corners `1//1` and `2` differ"),
            "{error}"
        );
    }

    #[test]
    fn reports_the_line_with_too_few_numbers_or_corners() {
        assert!(problem("v 0 1\n").contains(":1: a position needs 3 numbers, and this has 2"));
        let error = problem(&format!("{POSITIONS}vt\n"));
        assert!(
            error.contains(":5: a uv needs 1 number, and this has 0"),
            "{error}"
        );
        let error = problem(&format!("{POSITIONS}f 1 2\n"));
        assert!(
            error.contains(":5: a face needs 3 corners or more, and this has 2"),
            "{error}"
        );
    }

    #[test]
    fn rejects_a_mesh_without_faces() {
        assert!(problem("").contains("has no faces"));
        assert!(problem(POSITIONS).contains("has no faces"));
    }
}
