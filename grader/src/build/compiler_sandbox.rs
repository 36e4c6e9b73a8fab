//! The files that the compiler can access in a sandbox: its own files, the linker's files and those
//! of one crate. It cannot read the workspace, other submissions or home directories.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::build::dependencies::Dependencies;
use crate::build::source_crate::{Crate, CrateKind};
use crate::sandbox::Profile;

/// Paths where systems keep C compilers, linkers and libraries. Unlike `/usr/local` and
/// `/usr/share`, they contain nothing that is specific to a machine.
const SYSTEM_PATHS: [&str; 14] = [
    "/bin",
    "/lib",
    "/lib64",
    "/usr/bin",
    "/usr/lib",
    "/usr/lib64",
    "/usr/libexec",
    "/usr/x86_64-linux-gnu",
    "/usr/aarch64-linux-gnu",
    "/nix/store",
    "/gnu/store",
    "/etc/alternatives",
    "/etc/ld.so.cache",
    "/etc/ld.so.conf",
];

/// Adds arguments that replace the information the compiler usually reads from `/proc`, which the
/// sandbox hides.
pub(super) fn arguments(sysroot: &Path, source: &Crate, command: &mut Command) {
    command
        .env("LD_LIBRARY_PATH", sysroot.join("lib"))
        .arg("--sysroot")
        .arg(sysroot);
    match source.kind {
        // Link statically, so that the program opens no libraries when it starts.
        CrateKind::Program => _ = command.arg("-Ctarget-feature=+crt-static"),
        CrateKind::Library => {}
    }
}

/// Returns whether the compiler may read a program.
pub(super) fn can_read_program(sysroot: &Path, program: &Path) -> bool {
    let system = SYSTEM_PATHS.iter().map(Path::new);
    let mut readable = system.chain([sysroot]);
    readable.any(|folder| program.starts_with(folder))
}

/// Returns the files that the compiler may read and write.
pub(super) fn profile(sysroot: &Path, dependencies: &Dependencies, source: &Crate) -> Profile {
    let links = source.links.iter().map(|(_, library)| *library);
    let own = [sysroot, &dependencies.folder];
    let own = own.into_iter().chain(source.dependency_folder);
    let own = own.chain(dependencies.externs.values().map(PathBuf::as_path));
    let system = SYSTEM_PATHS
        .iter()
        .map(Path::new)
        .filter(|path| path.exists());
    Profile::Compiler {
        readable: system.chain(own).chain(links).map(Path::to_owned).collect(),
        writable: source.folder.to_owned(),
    }
}
