//! Tests of the parser of OBJ files.

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
    let error = problem(&format!("{POSITIONS}vn 0 0 1\nf 1//1 2//1 3//2\n"));
    assert!(error.contains("there is no normal 2"), "{error}");
    assert!(problem(&format!("{POSITIONS}f 0 1 2\n")).contains("no position 0"));
    assert!(problem(&format!("{POSITIONS}f 1 2 -5\n")).contains("no position -5"));
}

#[test]
fn indices_of_normals_and_uvs_in_a_file_without_any_are_ignored() {
    let mesh = parse(&format!("{POSITIONS}f 1/1/1 2/0/2 3\n")).expect("the text is valid");
    assert_eq!(mesh.faces[0].normals, None);
}

#[test]
fn reports_the_line_of_an_invalid_number_or_corner() {
    for word in [
        "nan",
        "inf",
        "1e99",
        "0x1",
        "0,5",
        "1d5",
        "1.#QNAN0",
        "-1.#IND00",
        "1\u{fffd}",
    ] {
        let error = problem(&format!("v 0 {word} 0\n"));
        assert!(
            error.contains(&format!(":1: `{word}` is not a finite number")),
            "{error}"
        );
    }
    for word in ["a", "//1", "1/1/1/1", "1.5", "1,2", "99999999999999999999"] {
        let error = problem(&format!("{POSITIONS}vn 0 0 1\nf {word} {word} {word}\n"));
        assert!(
            error.contains(&format!(":6: `{word}` is not a face corner")),
            "{error}"
        );
    }
}

#[test]
fn lines_can_end_in_any_way_and_words_are_separated_by_any_space() {
    let plain = parse("v 0 0 0\nv 10 0 0\nv 0.5 1 0\nf 1 2 3\n").expect("the text is valid");
    let text = "# c\rv\t0 0 0\r\u{c}v +1e1 -0. .0E-3#\rv .5 1 0 # f 1 1 1 \\\rf 1 2\\\r 3/";
    let text = text.replace("3#", "3 #");
    for text in [text.clone(), text.replace('\r', "\r\n")] {
        let mesh = parse(&text).expect("the text is valid");
        assert_eq!(mesh.positions, plain.positions, "{text:?}");
    }
    assert!(problem("v 0 0 0\rv 1\r").contains(":2: a position needs"));
}

#[test]
fn a_concave_face_is_filled_and_one_that_crosses_itself_has_a_line() {
    let arrow = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\n";
    let mesh = parse(&format!("{arrow}f 1 2 3 4 5\n")).expect("the text is valid");
    let corners: Vec<[usize; 3]> = mesh.faces.iter().map(|face| face.corners).collect();
    let notch = mesh.positions.iter().position(|p| p.x == 2.0);
    assert!(
        corners
            .iter()
            .all(|corners| corners.contains(&notch.unwrap()))
    );
    let error = problem(&format!("{POSITIONS}f 1 3 2 4\n"));
    assert!(
        error.contains(":5: the outline of this face crosses itself"),
        "{error}"
    );
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
fn reports_the_line_with_too_few_numbers_and_too_few_or_many_corners() {
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
    let error = problem(&format!("{POSITIONS}f{}\n", " 1".repeat(1001)));
    assert!(
        error.contains(":5: a face can have up to 1000 corners, and this has 1001"),
        "{error}"
    );
}

#[test]
fn rejects_a_mesh_without_faces() {
    assert!(problem("").contains("has no faces"));
    assert!(problem(POSITIONS).contains("has no faces"));
}
