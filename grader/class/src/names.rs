//! Compares names and identifiers that platforms, file systems and people write differently.

use std::collections::BTreeSet;
use std::iter;

use judging::sanitize::without_invisible;
use unicode_normalization::UnicodeNormalization;
use unicode_normalization::char::is_combining_mark;

/// Normalises text for comparisons: converts it to lower case, composes accents (macOS decomposes
/// them), and removes invisible characters and surrounding white space.
pub fn fold(text: &str) -> String {
    let visible = without_invisible(text);
    let lower = visible.trim().nfc().collect::<String>().to_lowercase();
    lower.nfc().collect()
}

/// Returns whether two strings stand for the same name or identifier.
pub fn are_equal(one: &str, other: &str) -> bool {
    if one.is_ascii() && other.is_ascii() {
        one.trim().eq_ignore_ascii_case(other.trim())
    } else {
        fold(one) == fold(other)
    }
}

/// Normalises a name for comparisons: [folds](fold) it and keeps only its letters and digits,
/// because platforms remove or replace other characters in the names of files. A name without
/// letters and digits is only folded.
pub fn fold_name(name: &str) -> String {
    let folded = fold(name);
    let is_kept = |c: &char| c.is_alphanumeric() || is_combining_mark(*c);
    let kept: String = folded.chars().filter(is_kept).collect();
    if kept.is_empty() { folded } else { kept }
}

/// Returns whether two names can belong to the same person or group, although a platform may have
/// changed one of them. Identifiers are compared with [`are_equal`] instead.
pub fn are_same_name(one: &str, other: &str) -> bool {
    fn kept(name: &str) -> impl Iterator<Item = u8> {
        let kept = name.bytes().filter(u8::is_ascii_alphanumeric);
        kept.map(|byte| byte.to_ascii_lowercase())
    }
    if !one.is_ascii() || !other.is_ascii() {
        return fold_name(one) == fold_name(other);
    }
    are_equal(one, other) || (kept(one).next().is_some() && kept(one).eq(kept(other)))
}

/// Returns whether a platform could have derived the name of a file or folder from a listed name by
/// removing characters or replacing them with spaces.
pub fn can_become(listed: &str, file: &str) -> bool {
    let (listed, file) = (fold(listed), fold(file));
    let mut rest = listed.chars();
    let mut wanted = file.chars().filter(|c| !c.is_whitespace());
    are_same_name(&listed, &file) && wanted.all(|c| rest.any(|other| other == c))
}

/// Returns whether two names with the same number can belong to the same person. The letters must
/// be the same, in any order, since platforms write `doejane`, `Doe, Jane` and `Jane Doe`. A file
/// name may begin with the group, for example `Team A-Jane Doe` in older versions of Moodle.
pub fn are_alike(file: &str, listed: &str) -> bool {
    let wanted = letters(listed);
    let mut names = iter::successors(Some(file), |name| Some(name.split_once('-')?.1));
    names.any(|name| letters(name) == wanted)
}

/// Joins the texts with a separator.
pub fn joined<T: AsRef<str>>(texts: impl IntoIterator<Item = T>, separator: &str) -> String {
    let texts = texts.into_iter().map(|text| text.as_ref().to_owned());
    Vec::from_iter(texts).join(separator)
}

/// Returns a text followed by a detail, if there is one.
pub fn with_detail(text: &str, detail: &str) -> String {
    let colon = if detail.is_empty() { "" } else { ": " };
    format!("{text}{colon}{detail}")
}

/// Returns `Jane Doe` for `Doe, Jane`, and `Jane Doe, Jr.` for `Doe, Jane, Jr.`
pub fn given_name_first(name: &str) -> String {
    let Some((last, first)) = name.split_once(',') else {
        return name.to_owned();
    };
    let (first, suffix) = first.split_at(first.find(',').unwrap_or(first.len()));
    format!("{} {}{suffix}", first.trim(), last.trim())
}

/// Returns whether a string consists of digits.
pub fn is_number(text: &str) -> bool {
    !text.is_empty() && number_at_end(text) == text
}

/// Returns the digits at the end of a string.
pub fn number_at_end(text: &str) -> &str {
    let rest = text.trim_end_matches(|c: char| c.is_ascii_digit());
    &text[rest.len()..]
}

/// Returns the name of a file with this stem and ending. If it is taken, a number is appended to the
/// stem. Adds the result to `used`, in lower case.
pub fn unique_name(stem: &str, end: &str, used: &mut BTreeSet<String>) -> String {
    let numbered = (2..).map(|number| format!("{stem}-{number}{end}"));
    let mut names = iter::once(format!("{stem}{end}")).chain(numbered);
    let free = names.find(|name| used.insert(name.to_lowercase()));
    free.expect("there are enough numbers")
}

/// Returns a name's letters and digits, sorted. Accents are removed, because some platforms drop
/// them.
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
    fn names_are_compared_by_letters_and_digits() {
        for (listed, file) in [
            ("Bob O'Hara", "Bob OHara"),
            ("M\u{fc}ller & Co", "Mu\u{308}ller  Co"),
            ("Lab 1: Team 8", "Lab 1 Team 8"),
            ("Team_7", "Team 7"),
            ("Project Group 1", "projectgroup1"),
            ("\u{2605}", "\u{2605}"),
        ] {
            assert!(are_same_name(listed, file), "{listed} {file}");
            assert!(can_become(listed, file), "{listed} {file}");
        }
        // A platform doesn't add characters.
        for (listed, file) in [("Team C", "Team C++"), ("Lab 11-2", "Lab 1-12")] {
            assert!(are_same_name(listed, file), "{listed} {file}");
            assert!(!can_become(listed, file), "{listed} {file}");
        }
        for (one, other) in [
            ("Team 7", "Team 8"),
            ("\u{2605}", "\u{2606}"),
            ("\u{d6}zil", "Ozil"),
        ] {
            assert!(!are_same_name(one, other), "{one} {other}");
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
