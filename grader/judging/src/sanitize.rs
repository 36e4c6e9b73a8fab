//! Makes text from untrusted sources safe for terminals, files and web pages.

/// Escapes direction marks, and control characters except line breaks and tabs. Replaces tabs with
/// spaces, and truncates the text after `longest` characters.
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
            // Direction marks are escaped, because they reorder the text around them on screen.
            c if c.is_control() || is_direction_mark(c) => sanitized.extend(c.escape_default()),
            c => sanitized.push(c),
        }
    }
    sanitized
}

/// Maximum length of a folder name, in characters.
const MAX_FOLDER_NAME_CHARS: usize = 80;
/// Device names that Windows reserves, even if they are followed by digits or an extension.
const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "com", "lpt"];

/// Converts any text to a folder name that is valid on every system and in links. The name consists
/// of letters and digits of any language, `-`, `_` and `.`. It never refers to another folder. It
/// begins neither with a dot, which would hide the folder, nor with a dash, which programs would
/// take for an option.
pub fn safe_folder_name(text: &str) -> String {
    let safe = |c: char| match c {
        c if c.is_alphanumeric() || "-_.".contains(c) => c,
        _ => '_',
    };
    let name: String = text.chars().map(safe).collect();
    let name = name.trim_start_matches('.');
    let stem = name.split('.').next().unwrap_or(name).to_lowercase();
    let stem = stem.trim_end_matches(|c: char| c.is_ascii_digit());
    let needs_prefix = name.is_empty() || name.starts_with('-') || DEVICES.contains(&stem);
    let prefix = if needs_prefix { "_" } else { "" };
    let name: String = prefix
        .chars()
        .chain(name.chars())
        .take(MAX_FOLDER_NAME_CHARS)
        .collect();
    name.trim_end_matches('.').to_owned()
}

fn is_direction_mark(c: char) -> bool {
    matches!(c, '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::{safe_folder_name, sanitize};

    #[test]
    fn escapes_control_and_direction_characters() {
        assert_eq!(
            sanitize("\x1b[2Jscore\u{202e}", 99),
            "\\u{1b}[2Jscore\\u{202e}"
        );
        assert_eq!(sanitize("two\nlines", 99), "two\nlines");
    }

    #[test]
    fn folder_names_are_safe() {
        assert_eq!(safe_folder_name("../é ü/x:y"), "_é_ü_x_y");
        assert_eq!(safe_folder_name(".."), "_");
        assert_eq!(safe_folder_name("=cmd|' /C calc'!A0"), "_cmd____C_calc__A0");
        assert_eq!(safe_folder_name("-rf"), "_-rf");
        assert_eq!(safe_folder_name("Con.txt"), "_Con.txt");
        assert_eq!(safe_folder_name("LPT1"), "_LPT1");
        assert_eq!(safe_folder_name("Connor"), "Connor");
    }

    proptest! {
        #[test]
        fn a_folder_name_is_a_single_visible_name(text in ".{0,200}") {
            let name = safe_folder_name(&text);
            prop_assert!(!name.is_empty() && !name.starts_with(['.', '-']) && !name.ends_with('.'));
            prop_assert!(!name.contains(['/', '\\', ':', '\0', ' ']));
            prop_assert_eq!(std::path::Path::new(&name).components().count(), 1);
            prop_assert_eq!(safe_folder_name(&name), name);
        }
    }

    #[test]
    fn truncates_long_text() {
        assert_eq!(sanitize("ééé", 2), "éé…");
    }
}
