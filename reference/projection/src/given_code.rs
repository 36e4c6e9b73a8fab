//! The given code of a variant: everything in the reference's file except the solutions and the
//! items that the variant defines itself.

use std::collections::HashSet;

use crate::item::{Item, items};
use crate::marks::{Line, MarkError, lines_without_solutions};

/// The indentation of the items in an `impl` block.
const IN_IMPL: &str = "    ";

/// The reason that a variant cannot be completed with given code.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GivenCodeError {
    /// The marks in the reference are wrong.
    #[error("the reference's line {0}")]
    Mark(#[from] MarkError),
    /// The variant lacks a method or function that students write.
    #[error(
        "`{0}` is missing: define it with the reference's signature, and run rustfmt on the file"
    )]
    Missing(String),
}

/// Returns the code that completes a variant, so that it can replace the reference's task file.
/// `reference` is the marked text of that file. An item defined by the variant replaces the item of
/// the same name. That item can be a method that students write, a given method, or a given struct
/// that the variant adds private fields to.
///
/// The given code comes after the variant's own code, so that the compiler's errors refer to lines
/// of the variant's file.
pub fn given_code(reference: &str, variant: &str) -> Result<String, GivenCodeError> {
    let lines: Vec<&str> = lines_without_solutions(reference)?
        .into_iter()
        .filter_map(|line| match line {
            Line::Given(line) => Some(line),
            Line::Starter(..) => None,
        })
        // Comments for the whole file are only allowed at its top.
        .filter(|line| !line.starts_with("//!"))
        .collect();
    let variant: Vec<&str> = variant.lines().collect();
    let defined: HashSet<(&str, &str)> = blocks(&variant)
        .into_iter()
        .flat_map(|(block, items)| items.into_iter().map(move |item| (block, item.name)))
        .filter(|(_, name)| !name.starts_with("use "))
        .collect();

    let mut is_given = vec![true; lines.len()];
    for (block, items) in blocks(&lines) {
        for item in items {
            if defined.contains(&(block, item.name)) {
                is_given[item.lines].fill(false);
            } else if item.is_function() && item.body.is_some_and(|body| body.is_empty()) {
                // Its entire body is a solution.
                return Err(GivenCodeError::Missing(match block {
                    "" => item.name.to_owned(),
                    block => format!("{block} {{ {} }}", item.name),
                }));
            }
        }
    }
    let given = lines.into_iter().zip(is_given);
    Ok(join(
        given
            .filter(|(_, is_given)| *is_given)
            .map(|(line, _)| line),
    ))
}

/// Returns the name and the items of each `impl` block. All other items are returned together,
/// under the name "".
fn blocks<'a>(lines: &[&'a str]) -> Vec<(&'a str, Vec<Item<'a>>)> {
    let mut blocks = Vec::new();
    let mut others = Vec::new();
    for item in items(lines, 0..lines.len(), "") {
        match item.body.clone() {
            Some(body) if item.is_impl() => blocks.push((item.name, items(lines, body, IN_IMPL))),
            _ => others.push(item),
        }
    }
    blocks.push(("", others));
    blocks
}

/// Joins lines, and drops the blank lines that removed items left behind.
fn join<'a>(lines: impl Iterator<Item = &'a str>) -> String {
    let mut text = String::new();
    for line in lines {
        let is_first = text.is_empty() || text.ends_with("{\n") || text.ends_with("\n\n");
        if !(line.is_empty() && is_first) {
            text.extend([line, "\n"]);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const REFERENCE: &str = "\
//! The task.

use a::A;

/// A shape.
pub struct Shape {
    /// Given.
    pub a: A,
}

impl Shape {
    /// Creates a shape.
    pub fn new(a: A) -> Self {
        Shape { a }
    }

    /// Returns the hit.
    pub fn hit(&self) -> u8 {
        // solution
        // starter: todo!()
        helper()
        // end solution
    }
}

// solution
// starter: // Add your own functions here.
fn helper() -> u8 {
    1
}
// end solution

#[cfg(test)]
mod tests {
    // starter: #[ignore]
    #[test]
    fn hits() {}
}
";

    #[test]
    fn leaves_out_solutions_and_the_methods_to_write() {
        let variant =
            "// Two.\n\nimpl Shape {\n    pub fn hit(&self) -> u8 {\n        2\n    }\n}\n";
        let expected = "\
use a::A;

/// A shape.
pub struct Shape {
    /// Given.
    pub a: A,
}

impl Shape {
    /// Creates a shape.
    pub fn new(a: A) -> Self {
        Shape { a }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn hits() {}
}
";
        assert_eq!(given_code(REFERENCE, variant).unwrap(), expected);
    }

    #[test]
    fn a_struct_and_a_given_method_can_be_replaced() {
        let variant = "pub struct Shape {\n    pub a: A,\n    b: u8,\n}\n\nimpl Shape {\n    pub fn \
                       new(a: A) -> Self {\n        Shape { a, b: 1 }\n    }\n\n    pub fn \
                       hit(&self) -> u8 {\n        self.b\n    }\n}\n";
        let given = given_code(REFERENCE, variant).unwrap();
        assert!(
            !given.contains("A shape.") && !given.contains("fn new"),
            "{given}"
        );
        assert!(
            given.starts_with("use a::A;\n\nimpl Shape {\n}\n\n#[cfg(test)]"),
            "{given}"
        );
    }

    #[test]
    fn reports_a_method_that_is_not_written() {
        let elsewhere = "impl Other {\n    pub fn hit(&self) -> u8 {\n        2\n    }\n}\n";
        for variant in ["", "fn hit() {}\n", elsewhere] {
            let expected = GivenCodeError::Missing("impl Shape { fn hit }".to_owned());
            assert_eq!(given_code(REFERENCE, variant), Err(expected), "{variant:?}");
        }
    }

    #[test]
    fn reports_wrong_marks() {
        let error = given_code("// solution\n// starter:\n", "").unwrap_err();
        let expected = "the reference's line 1: this `// solution` has no `// end solution`";
        assert_eq!(error.to_string(), expected);
    }
}
