//! The items of a file, or of an `impl` block. They are found by indentation, without parsing Rust,
//! so the file must be formatted by rustfmt.

use std::ops::Range;

/// An item, such as a function or a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Item<'a> {
    /// The kind and the name, such as `struct Camera`, `fn hit` or `impl Camera`.
    pub name: &'a str,
    /// The indices of its lines, including the blank lines, comments and attributes above it.
    pub lines: Range<usize>,
    /// The indices of the lines between its braces. `None` if it has no braces or if everything is
    /// on one line.
    pub body: Option<Range<usize>>,
}

impl Item<'_> {
    /// Returns whether the item is an `impl` block.
    pub fn is_impl(&self) -> bool {
        self.name.starts_with("impl")
    }

    /// Returns whether the item is a function or a method.
    pub fn is_function(&self) -> bool {
        self.name.starts_with("fn ")
    }
}

/// Returns the items with this indentation in a range of a file's lines.
///
/// An item begins after the end of the previous one. Its last line is the first one with this
/// indentation that ends with a brace or a semicolon.
pub(crate) fn items<'a>(
    lines: &[&'a str],
    range: Range<usize>,
    indentation: &str,
) -> Vec<Item<'a>> {
    let mut items = Vec::new();
    let mut start = range.start;
    let mut name = None;
    let mut body_start = None;
    for index in range {
        let code = lines[index].strip_prefix(indentation).unwrap_or(" ");
        if code.is_empty() || code.starts_with([' ', '#']) || code.starts_with("//") {
            continue;
        }
        let name_of_item = *name.get_or_insert_with(|| item_name(code));
        if code.ends_with('{') {
            body_start = Some(index + 1);
        }
        if code.ends_with(['}', ';']) {
            items.push(Item {
                name: name_of_item,
                lines: start..index + 1,
                body: body_start.map(|start| start..index),
            });
            (start, name, body_start) = (index + 1, None, None);
        }
    }
    items
}

/// Returns the kind and the name of an item, given the first line of its declaration.
fn item_name(declaration: &str) -> &str {
    let declaration = declaration.strip_prefix("pub ").unwrap_or(declaration);
    if declaration.starts_with("impl") {
        return declaration.trim_end_matches(" {");
    }
    let is_part_of_name = |c: char| c.is_alphanumeric() || c == '_' || c == ' ';
    let end = declaration.find(|c| !is_part_of_name(c));
    declaration[..end.unwrap_or(declaration.len())].trim_end()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_items_of_a_file_and_of_an_impl_block() {
        let source = "use a::{\n    b, c,\n};\n\n/// Doc.\n#[derive(Debug)]\npub struct S<T> {\n    \
                      x: T,\n}\n\nimpl<T> S<T> {\n    const N: [u8; 1] = [\n        0,\n    ];\n\n    \
                      // Why.\n    pub fn f(\n        &self,\n    ) -> u8 {\n        1\n    }\n}\n\n\
                      fn g() {}\n";
        let lines: Vec<&str> = source.lines().collect();
        let all = items(&lines, 0..lines.len(), "");
        let names: Vec<&str> = all.iter().map(|item| item.name).collect();
        assert_eq!(names, ["use a", "struct S", "impl<T> S<T>", "fn g"]);
        assert_eq!(lines[all[1].lines.clone()][..2], ["", "/// Doc."]);

        let inner = items(&lines, all[2].body.clone().unwrap(), "    ");
        let names: Vec<&str> = inner.iter().map(|item| item.name).collect();
        assert_eq!(names, ["const N", "fn f"]);
        assert_eq!(lines[inner[1].body.clone().unwrap()], ["        1"]);
        assert_eq!(all[3].body, None);
    }
}
