//! Tests of the parser for OBJ files.

use super::*;

const POSITIONS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn mesh(text: &str) -> Vec<Face> {
    parse(text).expect("the text is valid")
}

fn corners(mesh: &[Face]) -> Vec<[Vec3; 3]> {
    mesh.iter().map(|face| face.corners).collect()
}

/// Checks the error for an OBJ file that begins with four positions.
fn check(rest: &str, expected: &str) {
    let error = parse(&format!("{POSITIONS}{rest}")).expect_err("the text is invalid");
    let message = error.to_string();
    assert!(
        message.contains(expected),
        "expected {expected}\ngot {message}"
    );
}

#[test]
fn a_face_without_normals_is_flat_and_a_square_is_two_triangles() {
    let square = mesh(&format!("{POSITIONS}f 1 2 3 4\n"));
    assert_eq!(square.len(), 2);
    assert!(square.iter().all(|face| face.normals.is_none()));
}

#[test]
fn reads_normals_and_texture_coordinates_per_corner() {
    let attributes = "vt 0.5 0.25\nvn 0 0 1\nvn 1 0 0\n";
    let face = mesh(&format!("{POSITIONS}{attributes}f 1/1/1 2/1/2 -2/-1/-2\n"))[0];
    assert_eq!(face.normals, Some([Vec3::Z, Vec3::X, Vec3::Z]));
    assert_eq!(face.uv, [Vec2::new(0.5, 0.25); 3]);
}

#[test]
fn indices_of_normals_and_uvs_in_a_file_without_any_are_ignored() {
    assert_eq!(
        mesh(&format!("{POSITIONS}f 1/1/1 2/0/2 3\n"))[0].normals,
        None
    );
}

#[test]
fn lines_can_end_in_any_way_and_words_are_separated_by_any_space() {
    let plain = mesh("v 0 0 0\nv 10 0 0\nv 0.5 1 0\nf 1 2 3\n");
    let text = "# c\rv\t0 0 0\r\u{c}v +1e1 -0. .0E-3#\rv .5 1 0 # f 1 1 1 \\\rf 1 2\\\r 3/";
    let text = text.replace("3#", "3 #");
    for text in [text.clone(), text.replace('\r', "\r\n")] {
        assert_eq!(corners(&mesh(&text)), corners(&plain), "{text:?}");
    }
    check("v 0 0 0\rv 1\r", ":6: a position needs");
}

#[test]
fn a_concave_face_is_filled() {
    let arrow = mesh("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n");
    let has_notch = |corners: &[Vec3; 3]| corners.iter().any(|p| p.x == 2.0);
    assert!(corners(&arrow).iter().all(has_notch));
}

#[test]
fn reads_comments_continued_lines_weights_and_short_texture_coordinates() {
    let text = "v 0 0 0 1 # origin\nv 1 0 0 0.5 0.5 0.5\nv 1 \\\n  1 0\nvt 0.5\nvt 0.5 0.25 0\n\
                f 1/1 2/2 \\\n  3/1 # the only face\n";
    let face = mesh(text)[0];
    assert_eq!(
        face.corners,
        [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0)]
    );
    let uv = [[0.5, 0.0], [0.5, 0.25], [0.5, 0.0]].map(Vec2::from);
    assert_eq!(face.uv, uv);
}

#[test]
fn faces_with_and_without_normals_can_be_mixed() {
    let faces = "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//1 2//1 4//1\n";
    let mesh = mesh(&format!("{POSITIONS}{faces}"));
    let has_normals: Vec<bool> = mesh.iter().map(|f| f.normals.is_some()).collect();
    assert_eq!(has_normals, [true, false, true]);
}

#[test]
fn reports_the_line_and_the_reason() {
    check(
        "f 1 2 5\n",
        ":5: there is no position 5: the indices go from 1 to 4",
    );
    check("vn 0 0 1\nf 1//1 2//1 3//2\n", ":6: there is no normal 2");
    check("f 0 1 2\n", ":5: there is no position 0");
    check("f 1 2 -5\n", ":5: there is no position -5");
    check("f 1 3 2 4\n", ":5: the outline of this face crosses itself");
    check(
        "vn 0 0 1\nf 1//1 2 \\\n3//1\n",
        ":6: the corners `1//1` and `2` differ",
    );
    check(
        "v 0 1\n",
        ":5: a position needs 3 numbers, but this one has 2",
    );
    check("vt\n", ":5: a uv needs 1 number, but this one has 0");
    check(
        "f 1 2\n",
        ":5: a face needs at least 3 corners, but this one has 2",
    );
    let many = format!("f{}\n", " 1".repeat(1001));
    check(
        &many,
        ":5: a face can have up to 1000 corners, but this one has 1001",
    );
    check("", "has no faces");
    for word in "nan inf 1e99 0x1 0,5 1d5 1.#QNAN0 -1.#IND00 1\u{fffd}".split(' ') {
        check(
            &format!("v 0 {word} 0\n"),
            &format!(":5: `{word}` is not a finite number"),
        );
    }
    for word in "a //1 1/1/1/1 1.5 1,2 99999999999999999999".split(' ') {
        let face = format!("vn 0 0 1\nf {word} {word} {word}\n");
        check(&face, &format!(":6: `{word}` is not a face corner"));
    }
}
