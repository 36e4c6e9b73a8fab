//! The tokens of source code. Comparing tokens ignores changes in formatting and comments.

use ra_ap_rustc_lexer::{FrontmatterAllowed, TokenKind, tokenize};

/// Returns the tokens of Rust source code as text, without white space or comments. Works on any
/// text: anything that isn't a Rust token is kept unchanged.
pub(super) fn tokens(text: &str) -> Vec<&str> {
    let mut rest = text;
    let mut found = Vec::new();
    for token in tokenize(text, FrontmatterAllowed::No) {
        let (this, after) = rest.split_at(token.len as usize);
        rest = after;
        let is_code = !matches!(
            token.kind,
            TokenKind::Whitespace | TokenKind::LineComment { .. } | TokenKind::BlockComment { .. }
        );
        if is_code {
            found.push(this);
        }
    }
    found
}

/// Returns the text without comments. Line breaks in comments are kept, so that nothing moves to a
/// different line.
pub fn without_comments(text: &str) -> String {
    let mut rest = text;
    let mut code = String::new();
    for token in tokenize(text, FrontmatterAllowed::No) {
        let (this, after) = rest.split_at(token.len as usize);
        rest = after;
        if matches!(token.kind, TokenKind::BlockComment { .. }) {
            code.push(' ');
            code.extend(this.chars().filter(|c| *c == '\n'));
        } else if !matches!(token.kind, TokenKind::LineComment { .. }) {
            code.push_str(this);
        }
    }
    code
}

/// Returns whether `all` contains the tokens of `part` as a contiguous sequence.
pub(super) fn contains(all: &[&str], part: &[&str]) -> bool {
    part.is_empty() || all.windows(part.len()).any(|window| window == part)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn formatting_and_comments_are_no_tokens_but_the_text_of_a_string_is() {
        let plain = tokens("fn f(){let x=\"a  // b\";}");
        let formatted = "/// Text.\nfn f() {\r\n    let x = \"a  // b\"; // why\n    /* or */\n}\n";
        assert_eq!(tokens(formatted), plain);
        assert_ne!(tokens(&formatted.replace("a  //", "a //")), plain);
        assert_ne!(tokens(&formatted.replace("let x", "letx")), plain);
    }

    proptest! {
        #[test]
        fn any_text_has_tokens_and_contains_each_run_of_them(text: String, from: usize, to: usize) {
            let all = tokens(&text);
            let from = from % (all.len() + 1);
            let to = from + to % (all.len() - from + 1);
            prop_assert!(contains(&all, &all[from..to]));
        }
    }
}
