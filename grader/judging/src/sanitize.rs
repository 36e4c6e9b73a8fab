//! Makes text from untrusted sources safe for terminals, files and web pages.

/// Escapes control characters except line breaks, and truncates the text after `longest`
/// characters.
pub fn sanitize(text: &str, longest: usize) -> String {
    let mut sanitized = String::new();
    for (count, character) in text.chars().enumerate() {
        if count == longest {
            sanitized.push('…');
            break;
        }
        match character {
            '\n' => sanitized.push('\n'),
            '\t' => sanitized.push_str("    "),
            // Direction marks are escaped too: they reorder the text around them on screen.
            c if c.is_control() || is_direction_mark(c) => sanitized.extend(c.escape_default()),
            c => sanitized.push(c),
        }
    }
    sanitized
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
