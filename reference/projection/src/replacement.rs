//! The files that make up a variant. Its own files, the *parts*, are `STEM/…/NAME.rs` in the folder
//! of variants. Helpers used by several variants are in `STEM/shared/NAME.rs`. A shared file
//! belongs to each variant whose code contains the word `NAME` but doesn't define a function with
//! that name.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::given_code::{GivenCodeError, given_code};

/// The code of a variant that replaces one task file of the reference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replacement {
    /// The stem of the task file, such as `bvh`.
    pub stem: String,
    /// The variant's parts, then the shared files, each with its path (relative to the folder of
    /// variants) and its text.
    pub files: Vec<(PathBuf, String)>,
}

/// The error returned if a file or folder of a variant cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("cannot read {}: {source}", path.display())]
pub struct ReadError {
    /// The path of the file or folder.
    pub path: PathBuf,
    /// The system's error.
    pub source: io::Error,
}

/// Reads a variant's files from `folder`, which contains all variants. `parts` are the paths of its
/// parts without `.rs`. If `parts` is empty, the variant has a single part, whose path is the
/// variant's id with a slash instead of the dot.
pub fn replacements(
    folder: &Path,
    id: &str,
    parts: &[String],
) -> Result<Vec<Replacement>, ReadError> {
    let one_part = [id.replace('.', "/")];
    let mut replacements: Vec<Replacement> = Vec::new();
    for part in if parts.is_empty() { &one_part } else { parts } {
        let stem = part.split('/').next().unwrap_or_default();
        let file = read(folder, format!("{part}.rs").into())?;
        match replacements.iter_mut().find(|other| other.stem == stem) {
            Some(replacement) => replacement.files.push(file),
            None => replacements.push(Replacement {
                stem: stem.to_owned(),
                files: vec![file],
            }),
        }
    }
    for replacement in &mut replacements {
        replacement.add_shared_files(folder)?;
    }
    Ok(replacements)
}

impl Replacement {
    /// Returns the part of the reference's given code that completes the variant's files.
    /// `reference` is the text of the reference's task file, including its marks.
    pub fn given_code(&self, reference: &str) -> Result<String, GivenCodeError> {
        given_code(reference, &self.own_code())
    }

    /// Returns the complete task file.
    pub fn complete(&self, reference: &str) -> Result<String, GivenCodeError> {
        let given = self.given_code(reference)?;
        Ok(format!("{}{given}", self.own_code()))
    }

    /// Returns the text of all files, each followed by a blank line.
    fn own_code(&self) -> String {
        let texts = self.files.iter().map(|(_, text)| format!("{text}\n"));
        texts.collect()
    }

    /// Adds the shared files used by the code, including those that are only used by other shared
    /// files.
    fn add_shared_files(&mut self, folder: &Path) -> Result<(), ReadError> {
        let mut unused = names(folder, &Path::new(&self.stem).join("shared"));
        let is_used = |code: &str, path: &Path| {
            let name = path.file_stem().and_then(|name| name.to_str());
            name.is_some_and(|name| uses(code, name))
        };
        loop {
            let code = self.own_code();
            let Some(index) = unused.iter().position(|path| is_used(&code, path)) else {
                return Ok(());
            };
            self.files.push(read(folder, unused.remove(index))?);
        }
    }
}

/// Returns whether code contains a word, such as the name of a function, without defining a
/// function with that name.
fn uses(code: &str, name: &str) -> bool {
    let words = code.split(|c: char| !c.is_alphanumeric() && c != '_');
    let words: Vec<&str> = words.collect();
    words.contains(&name) && !words.windows(2).any(|pair| pair == ["fn", name])
}

/// Returns the sorted paths of the files in a subfolder, or an empty list if the subfolder doesn't
/// exist.
fn names(folder: &Path, subfolder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder.join(subfolder)).into_iter().flatten();
    let names = entries.flatten().map(|entry| entry.file_name());
    let mut paths: Vec<PathBuf> = names.map(|name| subfolder.join(name)).collect();
    paths.sort();
    paths
}

fn read(folder: &Path, path: PathBuf) -> Result<(PathBuf, String), ReadError> {
    let full_path = folder.join(&path);
    let text = fs::read_to_string(&full_path);
    let path_of_error = |source| ReadError {
        path: full_path,
        source,
    };
    Ok((path, text.map_err(path_of_error)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Writes files with these paths and texts to a new folder.
    fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (path, text) in files {
            let path = folder.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        folder
    }

    #[test]
    fn shared_files_are_added_if_the_code_uses_them() {
        let folder = folder(&[
            (
                "bvh/build/new.rs",
                "fn new() { sort(split) }\nfn split() {}\n",
            ),
            ("bvh/hit/old.rs", "fn old() { resort() }\n"),
            ("bvh/shared/bounds.rs", "fn bounds() {}\n"),
            ("bvh/shared/resorted.rs", "fn resorted() {}\n"),
            ("bvh/shared/sort.rs", "fn sort() { bounds() }\n"),
            ("bvh/shared/split.rs", "fn split() {}\n"),
        ]);
        let parts = ["bvh/build/new", "bvh/hit/old"].map(str::to_owned);
        let [replacement] = &replacements(folder.path(), "bvh.new", &parts).unwrap()[..] else {
            panic!("one task file is replaced");
        };
        let expected = "fn new() { sort(split) }\nfn split() {}\n\nfn old() { resort() }\n\nfn sort() { bounds() }\n\n\
                        fn bounds() {}\n\nstruct Bvh;\n";
        assert_eq!(replacement.complete("struct Bvh;\n").unwrap(), expected);
    }

    #[test]
    fn parts_of_several_task_files_replace_each_of_them() {
        let folder = folder(&[("bbox/a.rs", "// A\n"), ("bvh/b.rs", "// B\n")]);
        let parts = ["bbox/a", "bvh/b"].map(str::to_owned);
        let replacements = replacements(folder.path(), "bvh.b", &parts).unwrap();
        let stems: Vec<&str> = replacements.iter().map(|r| &*r.stem).collect();
        assert_eq!(stems, ["bbox", "bvh"]);
    }

    #[test]
    fn without_parts_the_id_is_the_path() {
        let folder = folder(&[("bvh/median.rs", "")]);
        let files = |id| replacements(folder.path(), id, &[]);
        assert!(files("bvh.median").is_ok());
        let error = files("bvh.mean").unwrap_err().to_string();
        assert!(
            error.contains("cannot read") && error.contains("bvh/mean.rs"),
            "{error}"
        );
    }
}
