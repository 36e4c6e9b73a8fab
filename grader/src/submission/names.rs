//! Determines from a file's name what the file could be: a task file, a copy of one, or an archive.
//! People, browsers, file managers and editors add to the names of files, so names are compared
//! without such additions.

use unicode_normalization::UnicodeNormalization;
use unicode_normalization::char::is_combining_mark;

use crate::handed_out::HandedOut;

/// Words for a copy that browsers, file managers and web storage put before or after the name of a
/// file, in the languages of common systems. A number is also treated as such a word.
const COPY_WORDS: [&str; 15] = [
    "copy",
    "kopie",
    "copie",
    "copia",
    "kopi",
    "kopia",
    "kopio",
    "kopya",
    "cópia",
    "másolat",
    "копия",
    "副本",
    "拷贝",
    "コピー",
    "のコピー",
];
/// Words that are put next to these words or next to a number.
const WORDS_NEAR_COPY: [&str; 12] = [
    "of", "another", "von", "de", "di", "af", "av", "van", "st", "nd", "rd", "th",
];
/// The maximum length of a number that is added to the name of a copy. Longer numbers identify
/// students.
const MAX_DIGITS: usize = 2;
/// Extensions, other than `rs`, of text files that could contain source code.
const TEXT_EXTENSIONS: [&str; 14] = [
    "txt", "text", "rust", "bak", "old", "orig", "save", "tmp", "swp", "rtf", "doc", "docx", "odt",
    "pages",
];
/// Extensions of archives, most of which cannot be read.
const ARCHIVE_EXTENSIONS: [&str; 30] = [
    "zip", "tar", "gz", "tgz", "rar", "7z", "xz", "txz", "bz2", "tbz", "tbz2", "zst", "tzst", "lz",
    "lz4", "lzma", "lzh", "z", "z01", "zipx", "arj", "ace", "cab", "iso", "dmg", "sit", "sitx",
    "cpio", "wim", "xar",
];
/// macOS stores metadata about a file in a second file, whose name has this prefix.
const MACOS_METADATA: &str = "._";

/// How a name resembles a task file's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Resemblance {
    /// The name is exactly the task file's.
    Exact,
    /// The name is the task file's, plus whatever a browser or a file manager adds to the name of a
    /// copy: `bvh (1).rs`, `Copy of bvh.rs`. If there is no task file with the exact name, the copy
    /// is used as that file.
    Copy,
    /// The name contains the task file's name, as in `bvh_final.rs`, `Bvh.rs` or `bvh.rs.bak`.
    Similar,
}

/// Returns how a file's name resembles a task file's name, or `None` if it doesn't.
pub(super) fn resemblance(name: &str, task_file: &str) -> Option<Resemblance> {
    if name == task_file {
        return Some(Resemblance::Exact);
    }
    if name.starts_with(MACOS_METADATA) {
        return None;
    }
    let name: String = name.nfc().collect();
    let (stem, extension) = task_file.rsplit_once('.')?;
    if let Some(stem_of_name) = name.strip_suffix(&format!(".{extension}")) {
        let is_added = |word: &&str| {
            let word = word.to_lowercase();
            let mut known = COPY_WORDS.iter().chain(&WORDS_NEAR_COPY);
            known.any(|known| *known == word) || word.bytes().all(|byte| byte.is_ascii_digit())
        };
        let mut others = words(stem_of_name)
            .into_iter()
            .filter(|word| !is_added(word));
        // The names of hidden files begin with a dot, and the names of editors' own files begin
        // with other special characters.
        let is_plain = name.starts_with(char::is_alphanumeric);
        if is_plain && others.next() == Some(stem) && others.next().is_none() {
            return Some(Resemblance::Copy);
        }
    }
    let name = name.to_lowercase();
    let is_text = match name.rsplit_once('.') {
        Some((_, last)) => TEXT_EXTENSIONS.contains(&words(last).first().copied().unwrap_or("")),
        None => true,
    };
    let words = words(&name);
    let is_similar =
        words.contains(&extension) && name.contains(stem) || is_text && words.contains(&stem);
    is_similar.then_some(Resemblance::Similar)
}

/// Returns whether a file with this name may be a task file or a copy of one.
pub fn may_be_task_file(name: &str, handed_out: &HandedOut) -> bool {
    let mut files = handed_out.file_names();
    files.any(|file| resemblance(name, file).is_some())
}

/// Returns whether this is the name of an archive or a copy of one, even if its kind isn't
/// supported.
pub fn is_archive_name(name: &str) -> bool {
    let lower = name.to_lowercase();
    let mut extensions = lower.split('.').skip(1);
    let is_archives = |extension: &str| {
        // Ignore suffixes of the whole name, such as ` (1)` or `~`.
        let end = extension.find(|c: char| !c.is_alphanumeric());
        ARCHIVE_EXTENSIONS.contains(&&extension[..end.unwrap_or(extension.len())])
    };
    !name.starts_with(MACOS_METADATA) && extensions.any(is_archives)
}

/// Returns the name without the extension of an archive, such as `.zip` or `.tar.gz`.
pub fn strip_archive_extension(name: &str) -> &str {
    let is_archives = |end: &str| ARCHIVE_EXTENSIONS.contains(&&*end.to_lowercase());
    let Some((stem, end)) = name.rsplit_once('.').filter(|(stem, _)| !stem.is_empty()) else {
        return name;
    };
    if !is_archives(end) {
        return name;
    }
    let is_tar = stem.to_lowercase().ends_with(".tar");
    &stem[..stem.len() - if is_tar { ".tar".len() } else { 0 }]
}

/// Returns the names that a name without an extension could be a copy or a second download of, the
/// longest first: `Ann_Lee` for `Ann_Lee-2`, `Ann_Lee (1)`, `Ann_Lee - Copy` and `Copy of Ann_Lee`.
/// Accounts such as `ann2` have a number of their own.
pub fn copied_names(name: &str) -> Vec<&str> {
    let is_separator = |c: char| !c.is_alphanumeric() && !is_combining_mark(c);
    let is_copy_word = |word: &str| {
        let word: String = word.nfc().collect::<String>().to_lowercase();
        let is_number = word.len() <= MAX_DIGITS && word.bytes().all(|byte| byte.is_ascii_digit());
        !word.is_empty() && (is_number || COPY_WORDS.contains(&word.as_str()))
    };
    let is_near_copy = |word: &str| {
        let mut words = words(word).into_iter();
        words.all(|word| is_copy_word(word) || WORDS_NEAR_COPY.contains(&word))
    };
    let mut names = Vec::new();
    let mut rest = name.trim_end_matches(is_separator);
    while let Some((before, last)) = rest.rsplit_once(is_separator) {
        let is_copy = is_copy_word(last);
        if !is_copy && (names.is_empty() || !is_near_copy(last)) {
            break;
        }
        rest = before.trim_end_matches(is_separator);
        names.extend(Some(rest).filter(|rest| !rest.is_empty()));
    }
    if let Some((_, after)) = rest
        .split_once(is_separator)
        .filter(|(word, _)| is_copy_word(word))
    {
        let after = after.trim_start_matches(is_separator);
        let shorter = after
            .split_once(is_separator)
            .filter(|(word, _)| is_near_copy(word));
        names.push(shorter.map_or(after, |(_, name)| name));
    }
    names
}

/// Splits a name into runs of letters and runs of digits.
fn words(name: &str) -> Vec<&str> {
    let parts = name.split(|c: char| !c.is_alphanumeric());
    let mut words = Vec::new();
    for mut part in parts.filter(|part| !part.is_empty()) {
        let is_digit = |c: char| c.is_ascii_digit();
        while let Some(first) = part.chars().next() {
            let end = part.find(|c: char| is_digit(c) != is_digit(first));
            let (word, rest) = part.split_at(end.unwrap_or(part.len()));
            words.push(word);
            part = rest;
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::handed_out::RAYS;

    /// Checks all of these names, which are separated by bars.
    fn all(names: &str, expected: Option<Resemblance>) {
        for name in names.split('|').map(str::trim) {
            assert_eq!(resemblance(name, "camera.rs"), expected, "{name}");
        }
    }

    #[test]
    fn copies_are_recognised_as_systems_name_them() {
        let copies = "camera (1).rs | camera(1).rs | camera 2.rs | camera-1.rs | camera_2.rs
            | camera2.rs | camera - Copy.rs | camera - Copy (2).rs | camera copy.rs
            | camera copy 2.rs | Copy of camera.rs | Kopie von camera.rs | camera - Kopie (2).rs
            | camera (3rd copy).rs | camera (another copy).rs | Copie de camera.rs
            | camera - cópia.rs | camera - co\u{301}pia.rs | camera - 副本.rs | camera のコピー.rs";
        all(copies, Some(Resemblance::Copy));
        all("camera.rs", Some(Resemblance::Exact));
    }

    #[test]
    fn the_names_of_copies_lead_to_the_name_of_the_original() {
        let copies =
            "Ann_Lee-2 | Ann_Lee (1) | Ann_Lee(12) | Ann_Lee 2 | Ann_Lee_3 | Ann_Lee - Copy
            | Ann_Lee copy 2 | Ann_Lee - Kopie (2) | Copy of Ann_Lee | Kopie von Ann_Lee (1)
            | Ann_Lee (3rd copy) | Ann_Lee - co\u{301}pia | Ann_Lee のコピー";
        for name in copies.split('|').map(str::trim) {
            assert_eq!(copied_names(name).last(), Some(&"Ann_Lee"), "{name}");
        }
        assert_eq!(copied_names("Team 1 (2)"), ["Team 1", "Team"]);
        for name in "Ann_Lee | ann2 | Lee_302 | van Lee | Lee de | 12 | Copy | (1) |".split('|') {
            assert_eq!(copied_names(name.trim()), [""; 0], "{name}");
        }
    }

    #[test]
    fn names_that_people_and_editors_give_are_similar() {
        let similar = "Camera.rs | CAMERA.RS | camera.RS | Camera (1).rs | camera_final.rs
            | camera_v2.rs | mycamera.rs | old_camera.rs | cameraNew.rs | camera.rs.txt
            | camera.rs.rs | camera.txt | camera (1).txt | camera | camera.rs.bak | camera.rs~
            | camera.rs.orig | #camera.rs# | .#camera.rs | .camera.rs.swp | camera.rs.1
            | camera.rs.crdownload | camera.rust | camera (conflicted copy 2026-11-20).rs
            | camera.sync-conflict-20261120.rs | ａcamera.rs";
        all(similar, Some(Resemblance::Similar));
        let others =
            "sphere.rs | cam.rs | camera.png | camera.obj | camera.md | camera.zip | lib.rs
            | notes.txt | ._camera.rs | cameraman.txt |";
        all(others, None);
    }

    #[test]
    fn a_name_is_without_the_extension_of_an_archive() {
        let names = "alice.tar.gz alice.b.ZIP alice.tgz alice.TAR.bz2 alice.txt .zip";
        let stems: Vec<&str> = names.split(' ').map(strip_archive_extension).collect();
        let expected = ["alice", "alice.b", "alice", "alice", "alice.txt", ".zip"];
        assert_eq!(stems, expected);
    }

    #[test]
    fn archives_are_recognised_by_their_names_in_any_case() {
        let archives = "a.zip|a.TAR.GZ|a.rar|a.7z|a.zip.txt|a.zip (1)|a.zip~|a (1).tar.zst";
        for name in archives.split('|') {
            assert!(is_archive_name(name), "{name}");
        }
        for name in ["a.rs", "zip", "a.zipped", "._a.zip", "a.b"] {
            assert!(!is_archive_name(name), "{name}");
        }
    }

    fn copy_mark() -> impl Strategy<Value = (String, String)> {
        let number = "[0-9]{1,4}";
        let word = prop::sample::select([&COPY_WORDS[..], &WORDS_NEAR_COPY[..]].concat());
        prop_oneof![
            number.prop_map(|n| (String::new(), format!("({n})"))),
            number.prop_map(|n| (String::new(), format!("-{n}"))),
            (word.clone()).prop_map(|word| (format!("{word} "), String::new())),
            word.prop_map(|word| (String::new(), format!(" - {word}"))),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// No matter what is added around a task file's name, the file is still recognised. If only
        /// copy marks are added, it is recognised as a copy.
        #[test]
        fn no_addition_hides_a_task_file(
            marks in prop::collection::vec(copy_mark(), 1..4),
            (before, after) in ("[a-z#_ -]{0,6}", "(|~|#|[._ -][a-z]{1,5}|\\.(txt|bak|orig))"),
            file in prop::sample::select(RAYS.file_names().collect::<Vec<_>>()),
        ) {
            let stem = file.trim_end_matches(".rs");
            let name = marks.iter().fold(stem.to_owned(), |name, (before, after)| format!("{before}{name}{after}"));
            let copy = format!("{name}.rs");
            prop_assert_eq!(resemblance(&copy, file), Some(Resemblance::Copy), "{}", copy);
            let other = format!("{before}{name}.rs{after}");
            prop_assert!(resemblance(&other, file).is_some(), "{}", other);
            let shouted = other.to_uppercase();
            prop_assert!(resemblance(&shouted, file).is_some(), "{}", shouted);
        }

        #[test]
        fn any_name_can_be_compared(name: String) {
            for file in RAYS.file_names() {
                let is_exact = resemblance(&name, file) == Some(Resemblance::Exact);
                prop_assert_eq!(is_exact, name == file);
            }
            let _ = is_archive_name(&name);
        }
    }
}
