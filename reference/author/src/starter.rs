//! Generates the starter's files from the reference's.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::{Result, anyhow};
use grader::files;
use grader::handed_out::HandedOut;

use crate::generated_file::GeneratedFile;

/// Generates every file of an assignment's starter from its reference in the workspace at `root`,
/// both for the folder that students edit and for the copy embedded in the grader.
pub fn generated_files(root: &Path, handed_out: &HandedOut) -> Result<Vec<GeneratedFile>> {
    let folders = [
        format!("{}/src", handed_out.student),
        handed_out.starter.to_owned(),
    ];
    let mut generated = Vec::new();
    let given = handed_out.given.iter().chain([&handed_out.main]);
    let given = given.map(|file| file.name);
    for file in handed_out.file_names().chain(given) {
        let path = root.join(handed_out.reference).join(file);
        let source = if file == handed_out.given[0].name {
            reference_root(root, handed_out)?.contents
        } else {
            files::read_to_string(&path)?
        };
        let starter =
            projection::starter(&source).map_err(|error| anyhow!("{}:{error}", path.display()))?;
        for folder in &folders {
            generated.push(GeneratedFile::new(format!("{folder}/{file}"), &*starter));
        }
    }
    Ok(generated)
}

/// Generates `lib.rs` of the reference's crate, which declares a module for each file.
pub fn reference_root(root: &Path, handed_out: &HandedOut) -> Result<GeneratedFile> {
    let path = format!("{}/{}", handed_out.reference, handed_out.given[0].name);
    let source = files::read_to_string(root.join(&path))?;
    Ok(GeneratedFile::new(path, with_modules(&source, handed_out)))
}

/// Replaces the module declarations at the end of the crate's `lib.rs` with one declaration for
/// each file.
fn with_modules(root: &str, handed_out: &HandedOut) -> String {
    let (before, _) = root.split_once("pub mod ").unwrap_or((root, ""));
    let given = handed_out.given.iter().skip(1).map(|file| file.name);
    let files: BTreeSet<&str> = handed_out.file_names().chain(given).collect();
    let modules = files.iter().map(|file| file.trim_end_matches(".rs"));
    let declarations = modules.map(|module| format!("pub mod {module};\n"));
    before.to_owned() + &declarations.collect::<String>()
}
