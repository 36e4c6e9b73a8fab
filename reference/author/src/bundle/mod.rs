//! The bundle that students get: a folder with the starter, the grader, the scenes and the handout,
//! but no solutions.
//!
//! A bundle is always generated. The starter comes from the reference. The manifests and the lock
//! file are the workspace's, with staff entries removed. The few files that only students see are
//! in `templates/`. Before a bundle is written, it is searched for [`secrets`].

pub mod archive;
pub mod check;
pub mod crates;
pub mod folders;
mod lock;
mod manifests;
mod part_two;
pub mod secrets;
mod test_modules;
mod version;

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Result, bail, ensure};
use grader::given_files;
use grader::handed_out::{HandedOut, LIGHT};

use crate::light::{LightFiles, part_one};
use crate::starter;

/// The files that only students see: their paths in the bundle and their contents.
const STUDENT_ONLY: [(&str, &str); 9] = [
    ("README.md", include_str!("templates/README.md")),
    ("student/build.rs", include_str!("templates/build.rs")),
    (".gitignore", include_str!("templates/gitignore")),
    (".gitattributes", include_str!("templates/gitattributes")),
    (
        ".github/workflows/grade.yml",
        include_str!("templates/grade.yml"),
    ),
    (
        ".vscode/extensions.json",
        include_str!("templates/vscode/extensions.json"),
    ),
    (
        ".vscode/settings.json",
        include_str!("templates/vscode/settings.json"),
    ),
    (
        ".vscode/tasks.json",
        include_str!("templates/vscode/tasks.json"),
    ),
    (
        ".devcontainer/devcontainer.json",
        include_str!("templates/devcontainer.json"),
    ),
];

/// Stands for the assignment's id in templates. An output format is for one assignment.
pub(crate) const ASSIGNMENT_ID: &str = "ASSIGNMENT_ID";

/// Options for the contents of a bundle.
#[derive(Clone, Copy, Debug, Default)]
pub struct BundleOptions<'a> {
    /// The folder with the built book, if it is to be included.
    pub book: Option<&'a Path>,
    /// Part two's files.
    pub light: LightFiles,
}

/// The files of a bundle or package.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bundle {
    /// The contents of each file, keyed by its path with `/` as the separator. The map is sorted,
    /// so that the same workspace always gives the same archive.
    pub files: BTreeMap<String, Vec<u8>>,
}

impl Bundle {
    /// Collects an assignment's bundle from the workspace at `root`. Fails if the book has chapters
    /// for instructors.
    pub fn collect(root: &Path, handed_out: &HandedOut, options: BundleOptions) -> Result<Self> {
        let BundleOptions { book, light } = options;
        ensure!(
            *handed_out != LIGHT || light == LightFiles::Stubs,
            "the assignment `light` needs --light stubs: otherwise, the files contain its solution"
        );
        let mut bundle = Bundle::default();
        folders::copy(root, &mut bundle)?;
        test_modules::remove(&mut bundle);
        if let Some(book) = book {
            folders::copy_tree(book, "handout/book", &mut bundle)?;
            // Leaving out the pages wouldn't be enough, because the book's search index also
            // contains their text.
            let pages = folders::staff_pages("handout/book", &bundle);
            if !pages.is_empty() {
                bail!(
                    "the book contains chapters for instructors ({}): use the one that `cargo book \
                     --students` builds in target/students-handout",
                    pages.join(", ")
                );
            }
        }
        for (path, text) in STUDENT_ONLY {
            bundle.insert(path, text.replace(ASSIGNMENT_ID, handed_out.assignment.id));
        }
        // Generate these files instead of reading them from `student`, where staff may have solved
        // the assignment.
        let starter = starter::generated_files(root, part_one(handed_out))?;
        part_two::add_exam(root, light, &mut bundle)?;
        for file in starter.into_iter().chain(light.generate(root)?) {
            bundle.insert(file.path, file.contents);
        }
        manifests::add_trimmed(root, &mut bundle)?;
        version::add(root, handed_out, light, &mut bundle)?;
        bundle.insert(given_files::LIST, given_files::list(&bundle.files));
        let lock = lock::lock_file(root, &bundle)?;
        bundle.insert("Cargo.lock", lock);
        Ok(bundle)
    }

    /// Returns the version, or `None` if the bundle's manifests don't contain one.
    pub fn version(&self) -> Option<String> {
        version::find(self.text("Cargo.toml")?)
    }

    /// Removes the files that students write, so that the bundle can be unpacked over an older one.
    pub fn without_students_files(mut self, handed_out: &HandedOut, light: LightFiles) -> Self {
        self.files
            .retain(|path, _| !light.is_students_own(path, handed_out));
        self
    }

    /// Inserts a file, replacing any existing file with the same path.
    pub fn insert(&mut self, path: impl Into<String>, contents: impl Into<Vec<u8>>) {
        self.files.insert(path.into(), contents.into());
    }

    /// Returns the text of a file, or `None` if it is missing or not UTF-8.
    pub fn text(&self, path: &str) -> Option<&str> {
        std::str::from_utf8(self.files.get(path)?).ok()
    }

    /// Returns the paths and texts of all files that are UTF-8.
    pub fn text_files(&self) -> impl Iterator<Item = (&str, &str)> {
        let files = self.files.iter();
        files.filter_map(|(path, contents)| {
            Some((path.as_str(), std::str::from_utf8(contents).ok()?))
        })
    }

    /// Returns the total size of all files, in bytes.
    pub fn size(&self) -> usize {
        self.files.values().map(Vec::len).sum()
    }
}
