//! Meshes as OBJ text, small and the same on every machine.

use std::collections::HashMap;
use std::fmt::Write;

/// An OBJ text in the making.
pub(super) struct Obj {
    header: String,
    kinds: [Lines; 3],
    faces: String,
}

/// The lines of one kind. Equal lines are one, so that neighbours share their corners.
struct Lines {
    kind: &'static str,
    text: String,
    numbers: HashMap<String, usize>,
}

impl Obj {
    /// A text that begins by saying where the mesh is from.
    pub(super) fn new(about: &str) -> Self {
        let lines = |kind| Lines {
            kind,
            text: String::new(),
            numbers: HashMap::new(),
        };
        Obj {
            header: about.lines().map(|line| format!("# {line}\n")).collect(),
            kinds: [lines("v"), lines("vt"), lines("vn")],
            faces: String::new(),
        }
    }

    /// The number of a position.
    pub(super) fn position(&mut self, position: [f64; 3]) -> usize {
        self.kinds[0].index_of(&position)
    }

    /// The number of texture coordinates.
    pub(super) fn uv(&mut self, uv: [f64; 2]) -> usize {
        self.kinds[1].index_of(&uv)
    }

    /// The number of a normal.
    pub(super) fn normal(&mut self, normal: [f64; 3]) -> usize {
        self.kinds[2].index_of(&normal)
    }

    /// A triangle of positions alone; none if two of them are the same.
    pub(super) fn triangle(&mut self, [a, b, c]: [usize; 3]) {
        if a != b && b != c && c != a {
            writeln!(self.faces, "f {a} {b} {c}").expect("a String takes it");
        }
    }

    /// A triangle of (position, texture coordinates, normal); none if two positions are the same.
    pub(super) fn full_triangle(&mut self, corners: [(usize, usize, usize); 3]) {
        let [a, b, c] = corners.map(|(position, _, _)| position);
        if a != b && b != c && c != a {
            let [a, b, c] = corners.map(|(v, vt, vn)| format!("{v}/{vt}/{vn}"));
            writeln!(self.faces, "f {a} {b} {c}").expect("a String takes it");
        }
    }

    /// The whole text.
    pub(super) fn finish(self) -> String {
        let [v, vt, vn] = self.kinds.map(|lines| lines.text);
        [self.header, v, vt, vn, self.faces].concat()
    }
}

impl Lines {
    fn index_of(&mut self, numbers: &[f64]) -> usize {
        let words: Vec<String> = numbers.iter().copied().map(format_number).collect();
        let words = words.join(" ");
        let next = self.numbers.len() + 1;
        *self.numbers.entry(words).or_insert_with_key(|words| {
            writeln!(self.text, "{} {words}", self.kind).expect("a String takes it");
            next
        })
    }
}

/// Four digits behind the point, less those that say nothing.
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
        let shown = [1.0, -0.000_01, 0.12345, 20.0, -1.5].map(format_number);
        assert_eq!(shown, ["1", "0", "0.1235", "20", "-1.5"]);
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
