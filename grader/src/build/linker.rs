//! Selects the linker.

use std::io;
use std::path::Path;
use std::process::Command;

use crate::system;

/// Path of the linker that is bundled with the toolchain, relative to the sysroot, on the platform
/// where this linker is the default.
const BUNDLED_LINKER: &str = "lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld";

/// Adds arguments that select the linker for a program in this folder.
///
/// The toolchain's own linker is used if it exists. The wrapper that `rustc` calls is bypassed,
/// because it finds the linker with the help of `/proc`, which the sandbox hides. One thread is
/// enough for such small programs, and a second one costs more than it saves. `-O0` skips merging
/// strings, which is not worth the time for a program that is deleted soon after. The system's
/// linker may lack these options, and compiling would take a third longer with it.
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
