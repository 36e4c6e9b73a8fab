//! What the compiler needs where it is kept apart from the machine: its own files, the linker's,
//! and those of one crate. Neither the workspace, nor other submissions, nor anybody's home.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::build::rustc::{Crate, CrateKind, Rustc};
use crate::sandbox::Profile;

/// Where systems keep C compilers, linkers and the libraries for them. Nothing of a machine's own
/// stands there: no `/usr/local`, no `/usr/share`.
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

/// Says on the command line what the compiler else finds out from `/proc`, which it does not see.
pub(super) fn arguments(rustc: &Rustc, source: &Crate, command: &mut Command) {
    let sysroot = rustc.toolchain.sysroot();
    command
        .env("LD_LIBRARY_PATH", sysroot.join("lib"))
        .arg("--sysroot")
        .arg(sysroot);
    match source.kind {
        // So that it needs no file when it starts.
        CrateKind::Program => _ = command.arg("-Ctarget-feature=+crt-static"),
        CrateKind::Library => {}
    }
}

/// What it may read and write.
pub(super) fn profile(rustc: &Rustc, source: &Crate) -> Profile {
    let links = source.links.iter().map(|(_, library)| *library);
    let own = [rustc.toolchain.sysroot(), &rustc.dependencies.folder];
    let own = own.into_iter().chain(source.dependency_folder);
    let own = own.chain(rustc.dependencies.externs.values().map(PathBuf::as_path));
    let system = SYSTEM_PATHS
        .iter()
        .map(Path::new)
        .filter(|path| path.exists());
    Profile::Compiler {
        readable: system.chain(own).chain(links).map(Path::to_owned).collect(),
        writable: source.folder.to_owned(),
    }
}
