//! Compiles a submission's task files and the given files into a probe or a library.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use judging::content_hash::ContentHash;

use crate::build::rustc::Rustc;
use crate::build::source_crate::{CompileOutcome, Crate, CrateKind};
use crate::handed_out::HandedOut;

/// File name of the crate's root, which contains the given root and a `main` function.
pub(super) const ROOT: &str = "probe.rs";

/// Compiles the task files and the given files in `folder`. Each task file is passed as a pair of
/// its name and its text.
pub fn compile(
    files: &[(&str, &str)],
    handed_out: &HandedOut,
    folder: &Path,
    rustc: &Rustc,
) -> io::Result<CompileOutcome> {
    let given = handed_out.given.iter().map(|file| (file.name, file.text));
    let all: Vec<(&str, &str)> = files.iter().copied().chain(given).collect();
    let content = all.iter().chain([&(ROOT, handed_out.entry)]).fold(
        ContentHash::default().with(rustc.identity()),
        |content, (name, text)| content.with(name.as_bytes()).with(text.as_bytes()),
    );
    rustc.compile_cached(&content, || {
        compile_uncached(&all, handed_out, folder, rustc)
    })
}

/// Compiles the starter to find out whether the machine is the reason a submission doesn't compile
/// or start. Returns the program, or the reason there is none.
pub(super) fn compile_starter(
    handed_out: &HandedOut,
    folder: &Path,
    rustc: &Rustc,
) -> Result<PathBuf, String> {
    let starter = handed_out.files.iter();
    let starter: Vec<_> = starter.map(|file| (file.name, file.starter)).collect();
    let compiled = compile(&starter, handed_out, folder, &rustc.for_own_code());
    compiled.map_err(|error| error.to_string())?.into_result()
}

fn compile_uncached(
    files: &[(&str, &str)],
    handed_out: &HandedOut,
    folder: &Path,
    rustc: &Rustc,
) -> io::Result<CompileOutcome> {
    fs::create_dir_all(folder)?;
    for (name, text) in files {
        fs::write(folder.join(name), text)?;
    }
    let root = handed_out.given[0].text;
    fs::write(folder.join(ROOT), format!("{root}{}", handed_out.entry))?;
    let (name, kind) = match handed_out.entry {
        "" => (handed_out.assignment.id, CrateKind::Library),
        _ => ("probe", CrateKind::Program),
    };
    rustc.compile(&Crate::new(name, kind, folder, ROOT))
}
