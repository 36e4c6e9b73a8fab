//! Compares names and identifiers that platforms, file systems and people write differently.

use judging::sanitize::without_invisible;
use unicode_normalization::UnicodeNormalization;
use unicode_normalization::char::is_combining_mark;

/// Normalises a text for comparisons: converts it to lower case, composes accents (macOS decomposes
/// them), and removes invisible characters and surrounding white space.
pub fn fold(text: &str) -> String {
    let visible = without_invisible(text);
    let lower = visible.trim().nfc().collect::<String>().to_lowercase();
    lower.nfc().collect()
}

/// Returns whether two texts are the same name or identifier.
pub fn are_equal(one: &str, other: &str) -> bool {
    if one.is_ascii() && other.is_ascii() {
        one.trim().eq_ignore_ascii_case(other.trim())
    } else {
        fold(one) == fold(other)
    }
}

/// Returns whether two names with the same number can belong to the same person. The letters must
/// be the same, in any order, since platforms write `doejane`, `Doe, Jane` and `Jane Doe`. A file
/// name may begin with the group, as in older versions of Moodle: `Team A-Jane Doe`.
pub fn are_alike(file: &str, listed: &str) -> bool {
    let wanted = letters(listed);
    let mut rest = Some(file);
    std::iter::from_fn(|| {
        let name = rest?;
        rest = name.split_once('-').map(|(_, rest)| rest);
        Some(name)
    })
    .any(|name| letters(name) == wanted)
}

/// Returns whether a text consists of digits.
pub fn is_number(text: &str) -> bool {
    !text.is_empty() && number_at_end(text) == text
}

/// Returns the digits at the end of a text.
pub fn number_at_end(text: &str) -> &str {
    let rest = text.trim_end_matches(|c: char| c.is_ascii_digit());
    &text[rest.len()..]
}

/// Returns the sorted letters and digits. Accents are removed, because some platforms drop them.
fn letters(name: &str) -> Vec<char> {
    let name = without_invisible(name).to_lowercase();
    let plain = name.nfkd().filter(|c| !is_combining_mark(*c));
    let mut letters: Vec<char> = plain.filter(|c| c.is_alphanumeric()).collect();
    letters.sort_unstable();
    letters
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn case_accents_and_invisible_characters_are_compared_as_people_see_them() {
        let same = [
            ("Ann", "aNN"),
            ("ÖZIL", "özil"),
            ("\u{212a}im", "kim"),
            ("Jose\u{301}", "José"),
            ("Ann\u{200b} L\u{ad}ee", "ann lee"),
        ];
        for (one, other) in same {
            assert_eq!(fold(one), fold(other));
            let equal = [are_equal(one, other), are_equal(other, one)];
            assert_eq!(equal, [true; 2], "{one} {other}");
        }
        for (one, other) in [("ann", "anne"), ("özil", "ozil"), ("annlee", "ann lee")] {
            assert!(!are_equal(one, other), "{one} {other}");
            assert_ne!(fold(one), fold(other));
        }
    }

    #[test]
    fn names_are_alike_in_whatever_order_and_with_a_group_in_front() {
        for (file, listed) in [
            ("doejane", "Doe, Jane"),
            ("doejane", "Jane Doe"),
            ("nunezjose", "Núñez, José"),
            ("Bob OHara", "Bob O'Hara"),
            ("Team A-Ann Lee", "Ann Lee"),
            ("Team A-Ann Lee-Ray", "Ann Lee-Ray"),
        ] {
            assert!(are_alike(file, listed), "{file} {listed}");
        }
        for (file, listed) in [("Team A", "Ann Lee"), ("Ann", "Ann Lee"), ("", "Ann")] {
            assert!(!are_alike(file, listed), "{file} {listed}");
        }
    }
}
