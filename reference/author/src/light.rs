//! Part two's files, generated from `reference/light`. Students get them either as stubs or solved.
//! If they are solved, part one's pictures are fully lit.

use std::path::Path;

use anyhow::{Result, anyhow};
use clap::ValueEnum;
use grader::files;

use crate::generated_file::GeneratedFile;

/// The folder with the solution, relative to the workspace.
pub const REFERENCE: &str = "reference/light/src";
/// The folder that students get, relative to the workspace.
pub const STUDENT: &str = "student/light/src";
/// The files that students write, in lecture order.
pub const FILES: [&str; 5] = [
    "material.rs",
    "lights.rs",
    "direct.rs",
    "path.rs",
    "environment.rs",
];
/// The first line of the worked examples at the end of a file.
const EXAMPLES: &str = "#[cfg(test)]\n";

/// Whether students get part two solved or as stubs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LightFiles {
    /// The solution: students write only part one, and its pictures are fully lit.
    #[default]
    Solved,
    /// The files with stubs: students write both parts, and pictures are rendered in clay until
    /// part two is written.
    Stubs,
}

impl LightFiles {
    /// Generates the files from the reference in the workspace at `root`.
    pub fn generate(self, root: &Path) -> Result<Vec<GeneratedFile>> {
        let mut generated = Vec::new();
        for path in files::read_dir(root.join(REFERENCE))? {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let source = files::read_to_string(&path)?;
            let is_solved = self == LightFiles::Solved && FILES.contains(&&*name);
            let text = if is_solved {
                projection::solution(&source).map(|text| without_examples(&text).to_owned())
            } else {
                projection::starter(&source)
            };
            let text = text.map_err(|error| anyhow!("{}:{error}", path.display()))?;
            generated.push(GeneratedFile::new(format!("{STUDENT}/{name}"), text));
        }
        Ok(generated)
    }

    /// Returns whether students write this file of the bundle.
    pub fn is_students_own(self, path: &str) -> bool {
        let name = path.strip_prefix(STUDENT);
        let name = name.and_then(|name| name.strip_prefix('/'));
        self == LightFiles::Stubs && name.is_some_and(|name| FILES.contains(&name))
    }
}

/// Returns the text of a file without the worked examples, which only help students who write the
/// file themselves.
fn without_examples(text: &str) -> &str {
    // The line before the examples is empty.
    let end = text.find(EXAMPLES).map(|start| start - 1);
    &text[..end.unwrap_or(text.len())]
}
