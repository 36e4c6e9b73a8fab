//! Text that others wrote, made harmless: it is going to terminals, files and pages.

/// The text without control characters but line ends, cut at `longest` characters.
pub fn sanitize(text: &str, longest: usize) -> String {
    let mut tamed = String::new();
    for (count, character) in text.chars().enumerate() {
        if count == longest {
            tamed.push('…');
            break;
        }
        match character {
            '\n' => tamed.push('\n'),
            '\t' => tamed.push_str("    "),
            // Also what reorders the characters around it on screen.
            c if c.is_control() || is_direction_mark(c) => tamed.extend(c.escape_default()),
            c => tamed.push(c),
        }
    }
    tamed
}

fn is_direction_mark(c: char) -> bool {
    matches!(c, '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::sanitize;

    #[test]
    fn escapes_control_and_direction_characters() {
        assert_eq!(
            sanitize("\x1b[2Jscore\u{202e}", 99),
            "\\u{1b}[2Jscore\\u{202e}"
        );
        assert_eq!(sanitize("two\nlines", 99), "two\nlines");
    }

    #[test]
    fn truncates_long_text() {
        assert_eq!(sanitize("ééé", 2), "éé…");
    }
}
