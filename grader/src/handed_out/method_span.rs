//! Finds a method in source code by its tokens, so that it can be replaced without touching
//! anything else in the file.

use std::mem;
use std::ops::Range;

use ra_ap_rustc_lexer::{FrontmatterAllowed, Token, TokenKind, tokenize};

use super::tokens::tokens;

/// The reason reported if a method cannot be found because a brace, bracket or parenthesis is
/// missing or superfluous.
const UNMATCHED_BRACES: &str = "the file's braces do not match";

/// A method in an `impl` block at the top level of a file, or a free function at the top level.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MethodSpan<'a> {
    /// The tokens between `impl` and the block's opening brace, separated by spaces, such as
    /// `Sphere`. Empty for a free function.
    pub implemented: String,
    /// The method's name.
    pub name: &'a str,
    /// The index of the name's first byte in the text.
    pub name_start: usize,
    /// The range of the method's bytes in the text, from its documentation to its closing brace.
    pub bytes: Range<usize>,
}

impl MethodSpan<'_> {
    /// Returns the method's full name, such as `Sphere::hit`.
    pub fn path(&self) -> String {
        if self.implemented.is_empty() {
            self.name.to_owned()
        } else {
            format!("{}::{}", self.implemented, self.name)
        }
    }
}

/// Returns the method with this full name, such as `Sphere::hit`, or the reason why it cannot be
/// found.
pub fn find_method<'a>(text: &'a str, path: &str) -> Result<MethodSpan<'a>, &'static str> {
    let mut found = methods(text)?;
    found.retain(|span| span.path() == path);
    match found.len() {
        0 => Err("it was renamed or removed"),
        1 => Ok(found.remove(0)),
        _ => Err("several methods have this name"),
    }
}

/// Returns all free functions at the top level of a file and all methods in its `impl` blocks.
pub fn methods(text: &str) -> Result<Vec<MethodSpan<'_>>, &'static str> {
    let mut scan = Scan {
        text,
        open: Vec::new(),
        header: None,
        block: None,
        item: None,
        name: None,
        after_fn: false,
        found: Vec::new(),
    };
    let mut start = 0;
    for token in tokenize(text, FrontmatterAllowed::No) {
        let bytes = start..start + token.len as usize;
        start = bytes.end;
        scan.add(&token, bytes)?;
    }
    match scan.open[..] {
        [] => Ok(scan.found),
        _ => Err(UNMATCHED_BRACES),
    }
}

/// The state while reading a file's tokens in order.
struct Scan<'a> {
    text: &'a str,
    /// The expected closing delimiters, from the outermost to the innermost.
    open: Vec<&'static str>,
    /// The end of the keyword `impl`, while the block's header is being read.
    header: Option<usize>,
    /// The tokens in the header of the current `impl` block.
    block: Option<String>,
    /// The start of the current item in the block or at the top level, including its documentation.
    item: Option<usize>,
    /// The name of this item, if it is a method or a function.
    name: Option<Range<usize>>,
    /// Whether the last token was `fn`.
    after_fn: bool,
    found: Vec<MethodSpan<'a>>,
}

impl Scan<'_> {
    fn add(&mut self, token: &Token, bytes: Range<usize>) -> Result<(), &'static str> {
        // An ordinary comment above an item isn't part of it.
        if let TokenKind::Whitespace
        | TokenKind::LineComment { doc_style: None }
        | TokenKind::BlockComment {
            doc_style: None, ..
        } = token.kind
        {
            return Ok(());
        }
        // The depth of the items to find: inside an `impl` block, or at the top level.
        let depth = usize::from(self.block.is_some());
        let in_block = self.open.len() == depth;
        let word = &self.text[bytes.clone()];
        if in_block && word != "}" {
            self.item.get_or_insert(bytes.start);
        }
        let is_after_fn = mem::take(&mut self.after_fn);
        // A token's text is enough to recognise it: a brace in a string or a character literal is
        // part of a token that includes the quotation marks.
        match word {
            "impl" if self.open.is_empty() => {
                self.item = None;
                self.header = Some(bytes.end);
            }
            "{" => {
                if self.open.is_empty()
                    && let Some(header) = self.header.take()
                {
                    self.block = Some(tokens(&self.text[header..bytes.start]).join(" "));
                }
                self.open.push("}");
            }
            "(" => self.open.push(")"),
            "[" => self.open.push("]"),
            "}" | ")" | "]" => {
                if self.open.pop() != Some(word) {
                    return Err(UNMATCHED_BRACES);
                }
                // The other delimiters don't end an item: an attribute ends with a bracket, and a
                // signature's arguments end with a parenthesis.
                if self.open.len() <= depth && word == "}" {
                    self.end_item(bytes.end);
                }
                if self.open.is_empty() && word == "}" {
                    self.block = None;
                }
            }
            ";" if in_block => self.end_item(bytes.end),
            word if in_block => {
                if is_after_fn {
                    self.name = Some(bytes);
                }
                self.after_fn = word == "fn";
            }
            _ => {}
        }
        Ok(())
    }

    /// Ends the current item. Records it if it is a method.
    fn end_item(&mut self, end: usize) {
        let (start, name) = (self.item.take(), self.name.take());
        if let (Some(start), Some(name)) = (start, name) {
            self.found.push(MethodSpan {
                implemented: self.block.clone().unwrap_or_default(),
                name_start: name.start,
                name: &self.text[name],
                bytes: start..end,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Result<&str, &'static str> {
        find_method(text, "Ball::hit").map(|span| &text[span.bytes])
    }

    #[test]
    fn finds_a_method_with_its_documentation_whatever_is_in_its_body() {
        let method = "/// Text with a }.\n    #[inline]\n    pub fn hit(&self, a: [f32; 2]) -> bool {\n        let s = \"}\"; // }\n        if s == r#\"{\"# { '{' == '}' } else { true }\n    }";
        let text = format!(
            "impl Node {{ fn hit() {{}} }}\nimpl Clone for Ball {{ fn hit() {{}} }}\n\
             impl Ball {{\n    const A: [u8; 1] = [1];\n    fn first() {{}}\n    // Mine.\n    \
             {method}\n    fn hits() {{ fn hit() {{}} }}\n}}\nmod tests {{ impl Ball {{ fn hit() {{}} }} }}\n"
        );
        assert_eq!(found(&text), Ok(method));
    }

    #[test]
    fn finds_a_free_function_between_other_items() {
        let function =
            "/// Says }.\n#[inline]\npub fn hit(f: fn(u8) -> u8) {\n    fn inner() {}\n}";
        let text = format!(
            "//! A file.\nuse a::b;\nstruct A {{ x: u8 }}\nstruct B(u8);\nimpl A {{ fn hit() {{}} }}\n\
             type F = fn(u8);\n{function}\nconst C: [u8; 1] = [1];\nmod tests {{ fn hit() {{}} }}\n"
        );
        let span = find_method(&text, "hit").expect("the function is found");
        assert_eq!(&text[span.bytes], function);
        let names: Vec<String> = methods(&text)
            .unwrap()
            .iter()
            .map(MethodSpan::path)
            .collect();
        assert_eq!(names, ["A::hit", "hit"]);
    }

    #[test]
    fn says_why_a_method_is_not_found() {
        let [none, several, braces] = ["it was renamed", "several methods", "the file's braces"];
        for (text, error) in [
            ("impl Ball { fn hit_it() {} }", none),
            ("fn hit() {}", none),
            ("mod ball { impl Ball { fn hit() {} } }", none),
            ("", none),
            ("impl Ball { fn hit() {} fn hit() {} }", several),
            ("impl Ball { fn hit() { }", braces),
            ("impl Ball { fn hit() } }", braces),
            ("impl Ball { fn hit() { ( } ) }", braces),
            ("impl Ball { fn hit() { \"} }", braces),
        ] {
            assert!(found(text).unwrap_err().starts_with(error), "{text}");
        }
    }
}
