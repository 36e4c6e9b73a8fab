//! Errors of files have one type, `grader::files::PathError`, so that all of them name the path in
//! the same way.

use std::fs;
use std::path::Path;

use crate::harness::workspace;

/// The folders with the sources of the crates that use the type.
const FOLDERS: [&str; 4] = [
    "grader/src",
    "grader/class/src",
    "grader/view/src",
    "reference/author/src",
];
/// The file of the type itself.
const OWN_FILE: &str = "files.rs";

/// Returns the numbers of the lines that declare a field for the system's error, or a variant with
/// fields for a path and the system's message, counted from 1.
fn declarations(source: &str) -> Vec<usize> {
    let is_declaration = |line: &str| {
        let field = line.trim().trim_start_matches("pub ");
        matches!(
            field.trim_end_matches(','),
            "Io {" | "source: io::Error" | "source: std::io::Error"
        )
    };
    let lines = (1..).zip(source.lines());
    let found = lines.filter(|(_, line)| is_declaration(line));
    found.map(|(number, _)| number).collect()
}

fn collect(path: &Path, found: &mut Vec<String>) {
    if path.is_dir() {
        for entry in fs::read_dir(path).unwrap() {
            collect(&entry.unwrap().path(), found);
        }
    } else if path.extension().is_some_and(|ending| ending == "rs") && !path.ends_with(OWN_FILE) {
        let source = fs::read_to_string(path).unwrap();
        let lines = declarations(&source).into_iter();
        found.extend(lines.map(|line| format!("{}:{line}", path.display())));
    }
}

#[test]
fn no_other_type_adds_a_path_to_the_error_of_the_system() {
    let mut found = Vec::new();
    for folder in FOLDERS {
        collect(&workspace().join(folder), &mut found);
    }
    assert_eq!(found, [""; 0], "use grader::files::PathError instead");
}

#[test]
fn finds_a_field_for_the_error_of_the_system() {
    let variant = "Io {\n    path: PathBuf,\n    source: io::Error,\n},";
    assert_eq!(declarations(variant), [1, 3]);
    let message = "Io {\n    path: PathBuf,\n    why: String,\n},";
    assert_eq!(declarations(message), [1]);
    let own = fs::read_to_string(workspace().join("grader/src").join(OWN_FILE)).unwrap();
    assert_eq!(declarations(&own).len(), 1);
}
