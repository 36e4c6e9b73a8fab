//! Generates the starter's files from the reference's.

use std::path::{Path, PathBuf};

use grader::files::{self, PathError};
use grader::handed_out::HandedOut;
use projection::MarkError;

use crate::generated_file::GeneratedFile;

/// The reason why the starter cannot be generated.
#[derive(Debug, thiserror::Error)]
pub enum StarterError {
    /// A file of the reference cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// A mark in a file of the reference is wrong.
    #[error("{}:{error}", path.display())]
    Mark {
        /// The path of the file.
        path: PathBuf,
        /// The line of the mark, and the problem.
        error: MarkError,
    },
}

/// Generates every file of an assignment's starter from its reference in the workspace at `root`:
/// for the folder that students edit, and for the copy that is embedded in the grader.
pub fn generated_files(
    root: &Path,
    handed_out: &HandedOut,
) -> Result<Vec<GeneratedFile>, StarterError> {
    let folders = [
        format!("{}/src", handed_out.student),
        handed_out.starter.to_owned(),
    ];
    let mut generated = Vec::new();
    let given = handed_out.given.iter().chain([&handed_out.main]);
    let given = given.map(|file| file.name);
    for file in handed_out.files.iter().map(|file| file.name).chain(given) {
        let path = root.join(handed_out.reference).join(file);
        let source = files::read_to_string(&path)?;
        let starter =
            projection::starter(&source).map_err(|error| StarterError::Mark { path, error })?;
        for folder in &folders {
            generated.push(GeneratedFile::new(format!("{folder}/{file}"), &*starter));
        }
    }
    Ok(generated)
}
