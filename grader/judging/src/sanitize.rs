//! Makes text from untrusted sources safe for terminals, tables and web pages. All text from a
//! submission, its name or a roster goes through [`sanitize`] or [`sanitize_line`] before people
//! read it.

/// Escapes all characters that could affect the text around them, except line breaks. Replaces tabs
/// with spaces, and truncates the text after `longest` characters.
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
            c if affects_surroundings(c) => sanitized.extend(c.escape_default()),
            c if is_joiner(c) && !sanitized.chars().next_back().is_some_and(can_be_joined) => {
                sanitized.extend(c.escape_default());
            }
            c => sanitized.push(c),
        }
    }
    sanitized
}

/// Sanitizes text like [`sanitize`], and also escapes line breaks.
pub fn sanitize_line(text: &str, longest: usize) -> String {
    sanitize(text, longest).replace('\n', "\\n")
}

/// Returns whether a character could affect the text around it: a control character, a mark that
/// changes the text direction, a line separator, or an invisible character that programs interpret,
/// such as a tag.
pub fn affects_surroundings(c: char) -> bool {
    let is_direction_mark = matches!(
        c,
        '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    let is_separator = matches!(c, '\u{2028}' | '\u{2029}');
    c.is_control() || is_direction_mark || is_separator || is_invisible(c)
}

/// Returns whether a character is invisible and doesn't affect the text around it: soft hyphens,
/// zero width spaces, fillers, tags and variation selectors. Two names that look the same can
/// differ in these characters.
fn is_invisible(c: char) -> bool {
    matches!(
        c,
        '\u{ad}' | '\u{34f}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}'
            | '\u{180b}'..='\u{180f}' | '\u{200b}' | '\u{2060}'..='\u{2065}'
            | '\u{206a}'..='\u{206f}' | '\u{3164}' | '\u{feff}' | '\u{ffa0}'
            | '\u{fff0}'..='\u{fffb}' | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}'
            | '\u{e0000}'..='\u{e0fff}'
    )
}

/// Returns whether the character is the zero width joiner or non-joiner. These are needed in
/// Persian, in Indic and other scripts, and in emoji.
fn is_joiner(c: char) -> bool {
    matches!(c, '\u{200c}' | '\u{200d}')
}

/// Returns whether a joiner may follow this character. After Latin, Greek or Cyrillic letters it
/// has no effect, so it isn't allowed there.
fn can_be_joined(c: char) -> bool {
    c >= '\u{590}' && !matches!(c, '\u{1e00}'..='\u{200f}')
}

/// Returns the text without invisible characters, for comparing names.
pub fn without_invisible(text: &str) -> String {
    let is_hidden = |c: char| is_joiner(c) || (affects_surroundings(c) && !c.is_whitespace());
    text.chars().filter(|c| !is_hidden(*c)).collect()
}

/// Maximum length of a folder name, in characters.
const MAX_FOLDER_NAME_CHARS: usize = 80;
/// Device names that Windows reserves, even if they are followed by digits or an extension.
const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "com", "lpt"];

/// Converts any text to a folder name that is valid on every system and in links. The name consists
/// of letters and digits of any language, `-`, `_` and `.`. It never refers to another folder. It
/// doesn't begin with a dot, which would hide the folder, or with a dash, which programs would
/// mistake for an option.
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn characters_of_each_kind_affect_their_surroundings() {
        for c in [
            '\u{1b}',
            '\n',
            '\u{202e}',
            '\u{2028}',
            '\u{feff}',
            '\u{ad}',
            '\u{200b}',
            '\u{e0041}',
        ] {
            assert!(affects_surroundings(c), "{c:?}");
        }
        for c in ['a', ' ', 'é', '漢', '🎈'] {
            assert!(!affects_surroundings(c), "{c:?}");
        }
    }

    #[test]
    fn escapes_control_and_direction_characters() {
        assert_eq!(
            sanitize("\x1b[2Jscore\u{202e}", 99),
            "\\u{1b}[2Jscore\\u{202e}"
        );
        assert_eq!(sanitize("two\nlines", 99), "two\nlines");
        assert_eq!(sanitize_line("two\r\nlines", 99), "two\\r\\nlines");
        // Names and formulas stay unchanged.
        let harmless = "Zoë Müller, مريم, 张伟, नेहा, θ ≤ 2π, 👩\u{200d}🔬";
        assert_eq!(sanitize_line(harmless, 99), harmless);
        assert_eq!(sanitize_line("Zoë\u{200d}", 99), "Zoë\\u{200d}");
    }

    #[test]
    fn invisible_characters_are_left_out_of_comparisons() {
        let hidden = "A\u{ad}n\u{200d}n\u{200b} L\u{e0041}ee\u{202e}";
        assert_eq!(without_invisible(hidden), "Ann Lee");
    }

    proptest! {
        #[test]
        fn nothing_that_affects_its_surroundings_is_left(text in any::<String>(), longest in 0..50_usize) {
            let sanitized = sanitize(&text, longest);
            prop_assert!(!sanitized.chars().any(|c| c != '\n' && affects_surroundings(c)));
            prop_assert_eq!(sanitize(&sanitized, usize::MAX), sanitized);
            let line = sanitize_line(&text, longest);
            prop_assert!(!line.chars().any(affects_surroundings));
            prop_assert_eq!(sanitize_line(&line, usize::MAX), line);
        }
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
        let longest = "é".repeat(MAX_FOLDER_NAME_CHARS);
        assert_eq!(safe_folder_name(&format!("{longest}é")), longest);
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
