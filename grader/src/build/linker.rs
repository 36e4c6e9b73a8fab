//! What makes a program of what was compiled.

use std::io;
use std::path::Path;
use std::process::Command;

use crate::system;

/// Where the toolchain's own linker lies, on the one system where it is the usual one.
const BUNDLED_LINKER: &str = "lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld";

/// Says which linker to use, in a command that compiles a program in this folder.
///
/// The toolchain's own, if it has one, and without the wrapper that `rustc` calls it by: that looks
/// for it in `/proc`, which is not there for a compiler that is kept apart. In one thread, because
/// for a program so small a second one costs more than it saves; and without `-O1`, which merges
/// texts that nobody keeps. The system's linker, which knows no such options, would make a compile a
/// third slower.
pub(super) fn arguments(sysroot: &Path, folder: &Path, command: &mut Command) -> io::Result<()> {
    let own = sysroot.join(BUNDLED_LINKER);
    if cfg!(all(target_os = "linux", target_arch = "x86_64")) && own.is_file() {
        system::symlink(&own, &folder.join("ld.lld"))?;
        command.args([
            "-Clinker-features=-lld",
            "-Clink-args=-fuse-ld=lld -B. -Wl,--threads=1,-O0",
        ]);
    }
    Ok(())
}
