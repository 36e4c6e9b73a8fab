//! Generates the starter's files from the reference's.

use std::path::Path;

use anyhow::{Result, anyhow};
use grader::files;
use grader::handed_out::HandedOut;

use crate::generated_file::GeneratedFile;

/// Generates every file of an assignment's starter from its reference in the workspace at `root`:
/// for the folder that students edit, and for the copy that is embedded in the grader.
pub fn generated_files(root: &Path, handed_out: &HandedOut) -> Result<Vec<GeneratedFile>> {
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
            projection::starter(&source).map_err(|error| anyhow!("{}:{error}", path.display()))?;
        for folder in &folders {
            generated.push(GeneratedFile::new(format!("{folder}/{file}"), &*starter));
        }
    }
    Ok(generated)
}
