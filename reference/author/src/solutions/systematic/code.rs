//! The code of a solution, as tokens with their places in the file.

use std::ops::Range;

use ra_ap_rustc_lexer::{FrontmatterAllowed, TokenKind, tokenize};

/// The line before the code that students write.
const BEGIN: &str = "// solution";
/// The line after it.
const END: &str = "// end solution";

/// A part of a file that students write: a method's body, or helpers of their own.
#[derive(Clone, Debug)]
pub(super) struct Code<'a> {
    /// The whole file.
    pub file: &'a str,
    /// The part's bytes.
    pub bytes: Range<usize>,
    /// The signature of the method whose body it is, or `None` for helpers.
    pub signature: Option<Signature>,
    /// Its tokens, without white space and comments.
    pub tokens: Vec<Token<'a>>,
}

/// A method that students write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Signature {
    /// The name, such as `hit`.
    pub name: String,
    /// The parameters after `self`: names and types.
    pub parameters: Vec<(String, String)>,
    /// The type that is returned.
    pub returns: String,
}

/// A token of code.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    /// The text. Operators of several characters, such as `<=`, are one token.
    pub text: &'a str,
    /// The index of its first byte in the file.
    pub start: usize,
    /// Whether it is a number.
    pub is_number: bool,
    /// Whether there is white space before and after it.
    pub is_apart: bool,
    /// The name of the function, constant or type that it is in, or an empty text.
    pub function: &'a str,
}

impl Token<'_> {
    /// Returns the token's bytes in the file.
    pub(super) fn bytes(&self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }

    /// Returns whether it is a name or a keyword.
    pub(super) fn is_name(&self) -> bool {
        self.text
            .starts_with(|c: char| c.is_alphabetic() || c == '_')
    }
}

/// Returns the parts of a file of the reference that students write.
pub(super) fn parts(file: &str) -> Vec<Code<'_>> {
    let all = tokens(file);
    let mut parts = Vec::new();
    let mut from = 0;
    while let Some(begin) = find_line(file, from, BEGIN) {
        let end = find_line(file, begin, END).unwrap_or(file.len());
        let inside = |token: &&Token| (begin..end).contains(&token.start);
        parts.push(Code {
            file,
            bytes: begin..end,
            signature: signature(&all, begin),
            tokens: all.iter().filter(inside).copied().collect(),
        });
        from = end;
    }
    parts
}

/// Returns the start of the line after the next line that consists of `line`.
fn find_line(file: &str, from: usize, line: &str) -> Option<usize> {
    let mut start = from;
    for text in file[from..].split_inclusive('\n') {
        let is_end = line == END;
        if text.trim() == line {
            return Some(if is_end { start } else { start + text.len() });
        }
        start += text.len();
    }
    None
}

/// Returns the method whose body begins at the byte `begin`: the last brace before it must be open,
/// and belong to a function.
fn signature(all: &[Token], begin: usize) -> Option<Signature> {
    let before = all.iter().take_while(|token| token.start < begin);
    let before: Vec<&str> = before.map(|token| token.text).collect();
    // Everything since the last closed block or item.
    let head = before.strip_suffix(&["{"])?;
    let from = head.iter().rposition(|text| *text == "fn")?;
    let head = &head[from + 1..];
    if head.contains(&"{") {
        return None;
    }
    let open = head.iter().position(|text| *text == "(")?;
    let close = head.iter().rposition(|text| *text == ")")?;
    let returns = head[close + 1..].strip_prefix(&["->"])?.concat();
    let mut parameters = Vec::new();
    let mut depth = 0_i32;
    let mut parts: Vec<Vec<&str>> = vec![Vec::new()];
    for text in &head[open + 1..close] {
        match *text {
            "<" | "(" | "[" => depth += 1,
            ">" | ")" | "]" => depth -= 1,
            _ => {}
        }
        if *text == "," && depth == 0 {
            parts.push(Vec::new());
        } else if let Some(last) = parts.last_mut() {
            last.push(text);
        }
    }
    for part in parts {
        if let [name, ":", of_type @ ..] = &part[..] {
            parameters.push(((*name).to_owned(), of_type.concat()));
        }
    }
    Some(Signature {
        name: head.first()?.to_string(),
        parameters,
        returns,
    })
}

fn tokens(file: &str) -> Vec<Token<'_>> {
    let mut found: Vec<Token> = Vec::new();
    let mut start = 0;
    let (mut function, mut after_fn) = ("", false);
    let mut after_space = true;
    for token in tokenize(file, FrontmatterAllowed::No) {
        let bytes = start..start + token.len as usize;
        start = bytes.end;
        let is_blank = matches!(
            token.kind,
            TokenKind::Whitespace | TokenKind::LineComment { .. } | TokenKind::BlockComment { .. }
        );
        if is_blank {
            after_space = true;
            continue;
        }
        let text = &file[bytes.clone()];
        if after_fn {
            function = text;
        }
        // A constant or a type between functions is named like one.
        after_fn = matches!(text, "fn" | "const" | "impl" | "struct");
        // The compiler's lexer gives operators character by character.
        if let Some(last) = found.last_mut().filter(|_| !after_space)
            && is_operator(&file[last.start..bytes.end])
        {
            last.text = &file[last.start..bytes.end];
            last.is_apart = last.is_apart && file[bytes.end..].starts_with(char::is_whitespace);
            continue;
        }
        found.push(Token {
            text,
            start: bytes.start,
            is_number: matches!(token.kind, TokenKind::Literal { .. })
                && text.starts_with(|c: char| c.is_ascii_digit()),
            is_apart: after_space,
            function,
        });
        after_space = false;
    }
    for token in &mut found {
        let end = token.bytes().end;
        token.is_apart &= file[end..].starts_with(char::is_whitespace);
    }
    found
}

fn is_operator(text: &str) -> bool {
    const OPERATORS: [&str; 17] = [
        "->", "=>", "::", "==", "!=", "<=", ">=", "&&", "||", "+=", "-=", "*=", "/=", "%=", "..",
        "..=", "<<",
    ];
    OPERATORS.contains(&text)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "\
impl Sphere {
    pub fn hit(&self, ray: &Ray, t: f32) -> Option<Trace> {
        // solution
        // starter: todo!()
        (t <= 1.5).then_some(a::b)
        // end solution
    }

    // solution
    fn helper() {}
    // end solution
}
";

    #[test]
    fn finds_the_parts_that_students_write_with_their_methods() {
        let parts = parts(FILE);
        let signatures: Vec<_> = parts.iter().map(|part| part.signature.clone()).collect();
        let hit = Signature {
            name: "hit".to_owned(),
            parameters: vec![
                ("ray".to_owned(), "&Ray".to_owned()),
                ("t".to_owned(), "f32".to_owned()),
            ],
            returns: "Option<Trace>".to_owned(),
        };
        assert_eq!(signatures, [Some(hit), None]);
        let texts = |part: &Code| -> Vec<String> {
            part.tokens
                .iter()
                .map(|token| token.text.to_owned())
                .collect()
        };
        let expected = "( t <= 1.5 ) . then_some ( a :: b )";
        assert_eq!(texts(&parts[0]).join(" "), expected);
        assert_eq!(texts(&parts[1]).join(" "), "fn helper ( ) { }");
        let compared = parts[0].tokens.iter().find(|token| token.text == "<=");
        assert!(compared.is_some_and(|token| token.is_apart && token.function == "hit"));
    }
}
