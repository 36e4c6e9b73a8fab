//! Parts of code, found by its tokens: operands, statements, fields and blocks.

use std::ops::Range;

use super::code::{Code, Token};

/// Texts of a few tokens, for matching.
pub(super) trait Texts<const N: usize> {
    /// Returns the texts of the first tokens.
    fn map_texts(&self) -> [&str; N];
}

impl<const N: usize> Texts<N> for [Token<'_>] {
    fn map_texts(&self) -> [&str; N] {
        std::array::from_fn(|index| self[index].text)
    }
}

/// Returns the bytes of the path before a token, such as `ray.origin`.
pub(super) fn operand_before(code: &Code, index: usize) -> Range<usize> {
    let is_part = |token: &Token| token.is_name() || token.is_number || token.text == ".";
    let mut first = index;
    while first > 0 && is_part(&code.tokens[first - 1]) {
        first -= 1;
    }
    if first < index {
        code.tokens[first].start..code.tokens[index - 1].bytes().end
    } else {
        0..0
    }
}

/// Returns the bytes of the path from a token on, unless it is called.
pub(super) fn operand_after(code: &Code, index: usize) -> Range<usize> {
    let is_part = |token: &Token| token.is_name() || token.is_number || token.text == ".";
    let mut end = index;
    while code.tokens.get(end).is_some_and(is_part) {
        end += 1;
    }
    let is_called = code.tokens.get(end).is_some_and(|token| token.text == "(");
    if index < end && !is_called {
        code.tokens[index].start..code.tokens[end - 1].bytes().end
    } else {
        0..0
    }
}

/// Returns the end of the bytes before the semicolon that ends a statement.
pub(super) fn end_of_statement(code: &Code, from: usize) -> usize {
    end_before(code, from, &[";"])
}

/// Returns the end of the bytes before the comma or brace that ends a field's value.
pub(super) fn end_of_field(code: &Code, from: usize) -> usize {
    end_before(code, from, &[",", "}"])
}

fn end_before(code: &Code, from: usize, ends: &[&str]) -> usize {
    let mut depth = 0;
    for index in from..code.tokens.len() {
        let text = code.tokens[index].text;
        if depth == 0 && ends.contains(&text) {
            return code.tokens[index - 1].bytes().end;
        }
        match text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
    }
    code.bytes.end
}

/// Returns the index of the brace that begins the block of an `if` or a loop.
pub(super) fn brace_after(code: &Code, from: usize) -> Option<usize> {
    let mut depth = 0;
    (from..code.tokens.len()).find(|index| {
        match code.tokens[*index].text {
            "(" | "[" => depth += 1,
            ")" | "]" => depth -= 1,
            _ => {}
        }
        depth == 0 && code.tokens[*index].text == "{"
    })
}

/// Returns the index of the brace that closes a block.
pub(super) fn closing(code: &Code, open: usize) -> Option<usize> {
    let mut depth = 0;
    (open..code.tokens.len()).find(|index| {
        match code.tokens[*index].text {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        depth == 0
    })
}

/// Returns whether a brace or comma is inside the braces of a value, such as `Trace { … }`.
pub(super) fn in_literal(code: &Code, index: usize) -> bool {
    let mut depth = 0;
    for before in (0..=index).rev() {
        match code.tokens[before].text {
            "}" | ")" | "]" => depth += 1,
            "(" | "[" => depth -= 1,
            "{" if depth == 0 => {
                let name = before.checked_sub(1).map(|name| &code.tokens[name]);
                let is_type = |name: &Token| name.text.starts_with(char::is_uppercase);
                let declares =
                    |name: usize| matches!(code.tokens[name].text, "struct" | "impl" | "->");
                return name.is_some_and(is_type) && !before.checked_sub(2).is_some_and(declares);
            }
            "{" => depth -= 1,
            _ => {}
        }
        if depth < 0 {
            return false;
        }
    }
    false
}
