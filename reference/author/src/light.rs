//! Part two's files, generated from its reference. Students get them either as stubs or solved. If
//! they are solved, part one's pictures are fully lit.

use std::path::Path;

use anyhow::{Result, anyhow};
use clap::ValueEnum;
use grader::files;
use grader::handed_out::{HandedOut, LIGHT, RAYS};

use crate::generated_file::GeneratedFile;
use crate::starter;

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
        let mut generated = starter::generated_files(root, &LIGHT)?;
        if self == LightFiles::Stubs {
            return Ok(generated);
        }
        for file in &mut generated {
            // The grader's own copy keeps its stubs.
            if let Some(name) = task_file(&file.path, &LIGHT) {
                let path = root.join(LIGHT.reference).join(name);
                let text = projection::solution(&files::read_to_string(&path)?)
                    .map_err(|error| anyhow!("{}:{error}", path.display()))?;
                file.contents = without_examples(&text).to_owned();
            }
        }
        Ok(generated)
    }

    /// Returns whether students write this file of an assignment's bundle.
    pub fn is_students_own(self, path: &str, handed_out: &HandedOut) -> bool {
        let is_light = self == LightFiles::Stubs && task_file(path, &LIGHT).is_some();
        is_light || task_file(path, part_one(handed_out)).is_some()
    }
}

/// Returns the assignment in the folder `student`: part one if the assignment is part two, whose
/// program uses part one's files.
pub fn part_one(handed_out: &HandedOut) -> &HandedOut {
    if *handed_out == LIGHT {
        &RAYS
    } else {
        handed_out
    }
}

/// Returns the name of an assignment's task file in the folder that students get.
fn task_file<'a>(path: &str, handed_out: &'a HandedOut) -> Option<&'a str> {
    let name = path
        .strip_prefix(handed_out.student)?
        .strip_prefix("/src/")?;
    handed_out.task_file(name).map(|file| file.name)
}

/// Returns the text of a file without the worked examples, which only help students who write the
/// file themselves.
fn without_examples(text: &str) -> &str {
    // The line before the examples is empty.
    let end = text.find(EXAMPLES).map(|start| start - 1);
    &text[..end.unwrap_or(text.len())]
}
