//! Compiles a submission's task files and the given files into a probe.

use std::fs;
use std::io;
use std::path::Path;

use crate::build::program_cache::ContentHash;
use crate::build::rustc::{CompileOutcome, Crate, CrateKind, Rustc};
use crate::given_files::GIVEN_FILES;

/// File name of the crate's root, which contains the given `lib.rs` and a `main` function.
const ROOT: &str = "probe.rs";
const ENTRY: &str = "
/// Answers the grader's questions.
fn main() -> std::process::ExitCode {
    framework::probe::main(&world::Student)
}
";

/// Compiles the task files, given as pairs of name and text, together with [`GIVEN_FILES`] in
/// `folder`.
pub fn compile(files: &[(&str, &str)], folder: &Path, rustc: &Rustc) -> io::Result<CompileOutcome> {
    let content = files.iter().chain(&GIVEN_FILES).fold(
        ContentHash::default().with(rustc.identity()),
        |content, (name, text)| content.with(name.as_bytes()).with(text.as_bytes()),
    );
    rustc.compile_cached(&content, || compile_uncached(files, folder, rustc))
}

fn compile_uncached(
    files: &[(&str, &str)],
    folder: &Path,
    rustc: &Rustc,
) -> io::Result<CompileOutcome> {
    fs::create_dir_all(folder)?;
    for (name, text) in files.iter().chain(&GIVEN_FILES) {
        fs::write(folder.join(name), text)?;
    }
    let [(_, lib), ..] = GIVEN_FILES;
    fs::write(folder.join(ROOT), format!("{lib}{ENTRY}"))?;
    rustc.compile(&Crate {
        name: "probe",
        kind: CrateKind::Program,
        folder,
        root: ROOT,
        links: &[],
        dependency_folder: None,
    })
}
