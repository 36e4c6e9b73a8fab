//! Selects the linker. It is found on the PATH once and passed to the compiler as an absolute path.
//! The compiler's environment contains no PATH, because the source code being compiled could read
//! it.

use std::env;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::machine::system;

/// Path of the linker bundled with the toolchain on x86-64 Linux, where it is the default. The path
/// is relative to the sysroot.
const BUNDLED_LINKER: &str = "lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld";
/// The C compiler that `rustc` links with, and the linker that the C compiler looks for.
const DRIVER: &str = "cc";
const LINKER: &str = "ld";
/// Programs that stand in for a C compiler and would look for the real compiler on the PATH.
const WRAPPERS: [&str; 4] = ["ccache", "sccache", "distcc", "icecc"];

/// The system's linker.
#[derive(Clone, Debug, Default)]
pub struct SystemLinker {
    /// The C compilers on the PATH, in PATH order. If there are none, `rustc` reports an error.
    drivers: Vec<PathBuf>,
    /// The linkers on the PATH, in PATH order. A C compiler calls one of them.
    linkers: Vec<PathBuf>,
}

impl SystemLinker {
    /// Finds the linker on the PATH.
    pub fn find() -> Self {
        let path = env::var_os("PATH").unwrap_or_default();
        // On Windows, `rustc` finds the linker in the registry or on the PATH.
        let find = |name| {
            if cfg!(windows) {
                Vec::new()
            } else {
                find_programs(name, &path)
            }
        };
        SystemLinker {
            drivers: find(DRIVER),
            linkers: find(LINKER),
        }
    }

    /// Adds arguments that select the linker for a program in this folder.
    ///
    /// The toolchain's own linker is used if it exists. The wrapper that `rustc` calls is bypassed,
    /// because it finds the linker via `/proc`, which the sandbox hides. One thread is enough for
    /// programs this small: a second thread costs more than it saves. `-O0` skips merging strings,
    /// which isn't worth the time for a program that is deleted soon after. The system's linker may
    /// lack these options, and compiling with it takes a third longer.
    ///
    /// `is_readable` returns whether the compiler can read a program.
    pub(super) fn arguments(
        &self,
        sysroot: &Path,
        folder: &Path,
        is_readable: impl Fn(&Path) -> bool,
        command: &mut Command,
    ) -> io::Result<()> {
        let first = |programs: &[PathBuf]| {
            let mut programs = programs.iter();
            programs.find(|program| is_readable(program)).cloned()
        };
        if let Some(driver) = first(&self.drivers) {
            command.arg(option_with_path("-Clinker=", &driver));
        }
        let own = sysroot.join(BUNDLED_LINKER);
        if cfg!(all(target_os = "linux", target_arch = "x86_64")) && own.is_file() {
            let link = folder.join("ld.lld");
            // An earlier attempt that was killed may have left the link behind.
            fs::remove_file(&link).ok();
            system::symlink(&own, &link)?;
            command.args([
                "-Clinker-features=-lld",
                "-Clink-args=-fuse-ld=lld -B. -Wl,--threads=1,-O0",
            ]);
        } else if let Some(folder) = first(&self.linkers).as_deref().and_then(Path::parent) {
            command.arg(option_with_path("-Clink-arg=-B", folder));
        }
        Ok(())
    }
}

/// Returns a compiler option that ends with a path.
pub(super) fn option_with_path(option: &str, path: &Path) -> OsString {
    let mut argument = OsString::from(option);
    argument.push(path);
    argument
}

/// Returns the programs with this name in the folders of a search path.
fn find_programs(name: &str, path: &OsStr) -> Vec<PathBuf> {
    env::split_paths(path)
        .map(|folder| folder.join(name))
        .filter(|program| program.is_absolute() && program.is_file() && !is_wrapper(program))
        .collect()
}

fn is_wrapper(program: &Path) -> bool {
    let program = program.canonicalize().unwrap_or_default();
    let name = program.file_name().unwrap_or_default();
    WRAPPERS.iter().any(|wrapper| name == *wrapper)
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn skips_relative_folders_and_wrappers() {
        let folder = tempfile::tempdir().unwrap();
        let [wrapped, real] = ["wrapped", "real"].map(|name| folder.path().join(name));
        for folder in [&wrapped, &real] {
            fs::create_dir(folder).unwrap();
        }
        fs::write(wrapped.join("ccache"), "").unwrap();
        system::symlink(&wrapped.join("ccache"), &wrapped.join("cc")).unwrap();
        fs::write(real.join("cc"), "").unwrap();
        let path = env::join_paths([Path::new("."), &wrapped, &real]).unwrap();
        assert_eq!(find_programs("cc", &path), [real.join("cc")]);
        assert_eq!(find_programs("ld", &path), [] as [PathBuf; 0]);
    }
}
