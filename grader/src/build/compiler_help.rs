//! The sections of the handout that explain compiler errors.

use judging::section::Section;

/// The beginning of the line that follows the compiler's text and names the section.
pub const SECTION_LABEL: &str = "read: ";

/// The section about variables, semicolons and the value of a block.
const BLOCKS: &str = "cpp.md#variables-and-semicolons";
const NUMBERS: &str = "cpp.md#numbers-do-not-convert-by-themselves";
const VECTORS: &str = "cpp.md#vectors";
const OPTION: &str = "cpp.md#a-value-that-may-be-missing";
const ORDER: &str = "cpp.md#floats-have-no-total-order";
const MOVES: &str = "cpp.md#slices-and-partitions";
const LOOPS: &str = "cpp.md#loops";
const CRATES: &str = "cpp.md#crates";
const BORROWS: &str = "cpp.md#recursion-that-fills-a-vector";

/// Triples of an error code, words in the compiler's text, and the section that explains errors
/// that match both. For syntax errors, the code is empty. The first match is used.
const SECTIONS: [(&str, &str, &str); 79] = [
    ("", "expected `;`", BLOCKS),
    ("", "expected one of `.`, `;`", BLOCKS),
    ("", "expected one of `!`", BLOCKS),
    ("", "expected one of `:`, `;`", BLOCKS),
    ("", "invalid variable declaration", BLOCKS),
    ("", "ternary operator", BLOCKS),
    ("", "expected one of `)`, `,`, `@`", LOOPS),
    ("", "expected pattern, found `let`", LOOPS),
    ("", "increment operator", LOOPS),
    ("", "decrement operator", LOOPS),
    ("", "invalid suffix `f`", NUMBERS),
    ("E0308", "found `()`", BLOCKS),
    ("E0308", "`Option<", OPTION),
    ("E0308", "`()`", BLOCKS),
    ("E0308", "expected `Vec3`, found `f32`", VECTORS),
    (
        "E0308",
        "expected `Vec3`, found floating-point number",
        VECTORS,
    ),
    ("E0308", "`f32`", NUMBERS),
    ("E0308", "`f64`", NUMBERS),
    ("E0308", "`usize`", NUMBERS),
    ("E0308", "`u32`", NUMBERS),
    ("E0308", "integer", NUMBERS),
    ("E0317", "", BLOCKS),
    ("E0384", "", BLOCKS),
    ("E0594", "as mutable", BLOCKS),
    ("E0594", "not declared as mutable", BLOCKS),
    ("E0596", "not declared as mutable", BLOCKS),
    ("E0381", "", BLOCKS),
    ("E0277", "the `?` operator", OPTION),
    ("E0277", "`Option<", OPTION),
    ("E0277", ": Ord`", ORDER),
    ("E0277", ": Eq`", ORDER),
    ("E0277", "cannot be indexed by", NUMBERS),
    ("E0277", "cannot add", NUMBERS),
    ("E0277", "cannot subtract", NUMBERS),
    ("E0277", "cannot multiply", NUMBERS),
    ("E0277", "cannot divide", NUMBERS),
    ("E0277", "can't compare", NUMBERS),
    ("E0600", "", NUMBERS),
    ("E0604", "", NUMBERS),
    ("E0606", "", NUMBERS),
    ("E0689", "", NUMBERS),
    ("E0369", "`Option<", OPTION),
    ("E0599", "`Option<", OPTION),
    ("E0599", "`Vec3`", VECTORS),
    ("E0609", "`Option<", OPTION),
    ("E0004", "`None`", OPTION),
    ("E0425", "function `max`", ORDER),
    ("E0425", "function `min`", ORDER),
    ("E0425", "function `float`", NUMBERS),
    ("E0425", "function `int`", NUMBERS),
    ("E0425", "function `fmax`", ORDER),
    ("E0425", "function `fmin`", ORDER),
    ("E0425", "function `cross`", VECTORS),
    ("E0425", "function `dot`", VECTORS),
    ("E0425", "function `norm`", VECTORS),
    ("E0425", "function `unit`", VECTORS),
    ("E0425", "function `normalize`", VECTORS),
    ("E0425", "function `length`", VECTORS),
    ("E0425", "function `hmin`", VECTORS),
    ("E0425", "function `hmax`", VECTORS),
    ("E0425", "function `sqrt`", VECTORS),
    ("E0425", "function `abs`", VECTORS),
    ("E0425", "function `fabs`", VECTORS),
    ("E0425", "function `pow`", VECTORS),
    ("E0425", "function `tan`", VECTORS),
    ("E0412", "cannot find type", CRATES),
    ("E0425", "cannot find type", CRATES),
    ("E0425", "`vec2`", CRATES),
    ("E0425", "`vec3`", CRATES),
    ("E0432", "missing a crate named", CRATES),
    ("E0433", "unlinked crate", CRATES),
    ("E0433", "undeclared type", CRATES),
    ("E0433", "cannot find type", CRATES),
    ("E0382", "", MOVES),
    ("E0499", "", BORROWS),
    ("E0502", "", BORROWS),
    ("E0506", "", BORROWS),
    ("E0507", "", BORROWS),
    ("E0515", "", BORROWS),
];

/// Returns the section that explains an error with this code and text, if any.
pub(super) fn section(code: Option<&str>, text: &str) -> Option<Section> {
    let code = code.unwrap_or_default();
    let mut sections = SECTIONS.iter();
    let (_, _, section) = sections.find(|(of, words, _)| *of == code && text.contains(words))?;
    // A module of the standard library may only lack its `use`, as the compiler says.
    let is_importable = *section == CRATES && text.contains("consider importing");
    (!is_importable).then(|| Section::new(*section))
}

/// Returns all sections that explain errors, so that a test can look for them in the handout.
pub fn sections() -> impl Iterator<Item = Section> {
    SECTIONS
        .iter()
        .map(|(_, _, section)| Section::new(*section))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_leads_to_its_section() {
        for (code, text, expected) in [
            (
                None,
                "error: expected `;`, found keyword `let`",
                Some(BLOCKS),
            ),
            (
                None,
                "error: expected one of `!`, `.`, `::`, `;`, `?`, `{`, `}`, or an operator, found \
                 `det`",
                Some(BLOCKS),
            ),
            (None, "error: Rust has no ternary operator", Some(BLOCKS)),
            (
                None,
                "error: Rust has no postfix increment operator",
                Some(LOOPS),
            ),
            (
                None,
                "error: expected one of `)`, `,`, `@`, `if`, or `|`, found `i`",
                Some(LOOPS),
            ),
            (
                Some("E0425"),
                "cannot find function `cross` in this scope",
                Some(VECTORS),
            ),
            (
                Some("E0425"),
                "cannot find function `sqrt` in this scope",
                Some(VECTORS),
            ),
            (
                None,
                "error: this file contains an unclosed delimiter",
                None,
            ),
            (
                Some("E0308"),
                "expected `Option<Trace>`, found `()`",
                Some(BLOCKS),
            ),
            (
                Some("E0308"),
                "expected `Option<Trace>`, found `Trace`",
                Some(OPTION),
            ),
            (Some("E0308"), "expected `f32`, found `f64`", Some(NUMBERS)),
            (Some("E0308"), "expected `Vec3`, found `Vec2`", None),
            (Some("E0308"), "expected `Vec3`, found `f32`", Some(VECTORS)),
            (
                Some("E0277"),
                "the trait bound `f32: Ord` is not satisfied",
                Some(ORDER),
            ),
            (
                Some("E0425"),
                "cannot find function `max` in this scope; consider importing this function",
                Some(ORDER),
            ),
            (
                Some("E0433"),
                "failed to resolve: use of undeclared type `Vec3`",
                Some(CRATES),
            ),
            (
                Some("E0384"),
                "cannot assign twice to immutable variable",
                Some(BLOCKS),
            ),
            (
                Some("E0382"),
                "use of moved value: `primitives`",
                Some(MOVES),
            ),
            (
                Some("E0499"),
                "cannot borrow `*nodes` as mutable",
                Some(BORROWS),
            ),
        ] {
            let section = section(code, text);
            assert_eq!(section, expected.map(Section::new), "{text}");
        }
    }
}
