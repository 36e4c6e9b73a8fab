//! Meshes as OBJ text, which is short and the same on every machine.

use std::collections::HashMap;
use std::fmt::Write;

/// An OBJ file that is being written.
pub(super) struct Obj {
    header: String,
    sections: [Lines; 3],
    faces: String,
}

/// The lines with one keyword. Equal lines are written once, so that neighbouring triangles share
/// their corners.
struct Lines {
    keyword: &'static str,
    text: String,
    indices: HashMap<String, usize>,
}

impl Obj {
    /// Starts an OBJ file that has no geometry yet, with `about` as a comment at the top.
    pub(super) fn new(about: &str) -> Self {
        let lines = |keyword| Lines {
            keyword,
            text: String::new(),
            indices: HashMap::new(),
        };
        Obj {
            header: about.lines().map(|line| format!("# {line}\n")).collect(),
            sections: [lines("v"), lines("vt"), lines("vn")],
            faces: String::new(),
        }
    }

    /// Returns the index of a position, adding the position if it is new.
    pub(super) fn position(&mut self, position: [f64; 3]) -> usize {
        self.sections[0].index_of(&position)
    }

    /// Returns the index of a pair of texture coordinates, adding the pair if it is new.
    pub(super) fn uv(&mut self, uv: [f64; 2]) -> usize {
        self.sections[1].index_of(&uv)
    }

    /// Returns the index of a normal, adding the normal if it is new.
    pub(super) fn normal(&mut self, normal: [f64; 3]) -> usize {
        self.sections[2].index_of(&normal)
    }

    /// Adds a triangle that has positions only. Does nothing if two of them are the same.
    pub(super) fn triangle(&mut self, [a, b, c]: [usize; 3]) {
        if a != b && b != c && c != a {
            writeln!(self.faces, "f {a} {b} {c}").expect("writing to a String succeeds");
        }
    }

    /// Adds a triangle whose corners are (position, texture coordinates, normal). Does nothing if
    /// two positions are the same.
    pub(super) fn full_triangle(&mut self, corners: [(usize, usize, usize); 3]) {
        let [a, b, c] = corners.map(|(position, _, _)| position);
        if a != b && b != c && c != a {
            let [a, b, c] = corners.map(|(v, vt, vn)| format!("{v}/{vt}/{vn}"));
            writeln!(self.faces, "f {a} {b} {c}").expect("writing to a String succeeds");
        }
    }

    /// Returns the text of the file.
    pub(super) fn finish(self) -> String {
        let [v, vt, vn] = self.sections.map(|lines| lines.text);
        [self.header, v, vt, vn, self.faces].concat()
    }
}

impl Lines {
    fn index_of(&mut self, numbers: &[f64]) -> usize {
        let words: Vec<String> = numbers.iter().copied().map(format_number).collect();
        let line = words.join(" ");
        let next = self.indices.len() + 1;
        *self.indices.entry(line).or_insert_with_key(|line| {
            writeln!(self.text, "{} {line}", self.keyword).expect("writing to a String succeeds");
            next
        })
    }
}

/// Formats a number with at most four decimal places, without trailing zeros.
fn format_number(number: f64) -> String {
    let text = format!("{number:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_zero_has_no_sign() {
        let formatted = [1.0, -0.000_01, 0.12345, 20.0, -1.5].map(format_number);
        assert_eq!(formatted, ["1", "0", "0.1235", "20", "-1.5"]);
    }

    #[test]
    fn merges_equal_positions_and_drops_degenerate_triangles() {
        let mut obj = Obj::new("a test");
        let (a, b) = (obj.position([0.0; 3]), obj.position([1.0, 0.0, 0.0]));
        let c = obj.position([0.0, 1.0, 0.0]);
        assert_eq!(obj.position([-0.0; 3]), a);
        obj.triangle([a, b, c]);
        obj.triangle([a, b, b]);
        assert_eq!(
            obj.finish(),
            "# a test\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
        );
    }
}
