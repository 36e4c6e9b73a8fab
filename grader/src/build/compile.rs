//! The five files and ours, made into a program that answers questions.

use std::fs;
use std::io;
use std::path::Path;

use crate::build::kept::Content;
use crate::build::rustc::{Compiled, Crate, Kind, Rustc};
use crate::given::GIVEN_FILES;

/// The crate's root: the given `lib.rs`, and a way in.
const ROOT: &str = "probe.rs";
const ENTRY: &str = "
/// Answers the grader.
fn main() -> std::process::ExitCode {
    framework::probe::main(&world::Student)
}
";

/// Compiles the five files, given as name and text, together with ours, in `folder`.
pub fn compile(files: &[(&str, &str)], folder: &Path, rustc: &Rustc) -> io::Result<Compiled> {
    let content = files.iter().chain(&GIVEN_FILES).fold(
        Content::default().with(rustc.identity()),
        |content, (name, text)| content.with(name.as_bytes()).with(text.as_bytes()),
    );
    rustc.once(&content, || compile_afresh(files, folder, rustc))
}

fn compile_afresh(files: &[(&str, &str)], folder: &Path, rustc: &Rustc) -> io::Result<Compiled> {
    fs::create_dir_all(folder)?;
    for (name, text) in files.iter().chain(&GIVEN_FILES) {
        fs::write(folder.join(name), text)?;
    }
    let [(_, lib), ..] = GIVEN_FILES;
    fs::write(folder.join(ROOT), format!("{lib}{ENTRY}"))?;
    rustc.compile(&Crate {
        name: "probe",
        kind: Kind::Program,
        folder,
        root: ROOT,
        links: &[],
        behind: None,
    })
}
