//! Which compiler, and how it is recognised.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::UNIX_EPOCH;

/// The real `cargo` and `rustc`, not rustup's stand-ins: those cost 8 ms a call, and obey a
/// `rust-toolchain.toml` that lies about.
#[derive(Clone, Debug)]
pub struct Toolchain {
    /// Builds the dependencies, once.
    pub cargo: PathBuf,
    /// Compiles submissions.
    pub rustc: PathBuf,
}

/// There is no compiler.
#[derive(Debug, thiserror::Error)]
#[error("can not find rustc: install Rust, or put it on the PATH ({0})")]
pub struct ToolchainError(String);

impl Toolchain {
    /// The toolchain whose cargo runs us, else the one on the PATH.
    pub fn find() -> Result<Self, ToolchainError> {
        if let Some(toolchain) =
            env::var_os("CARGO").and_then(|cargo| toolchain_beside(Path::new(&cargo)))
        {
            return Ok(toolchain);
        }
        let output = Command::new("rustc")
            .args(["--print", "sysroot"])
            .output()
            .map_err(|error| ToolchainError(error.to_string()))?;
        let sysroot = String::from_utf8_lossy(&output.stdout);
        let cargo = format!("cargo{}", env::consts::EXE_SUFFIX);
        toolchain_beside(&Path::new(sysroot.trim()).join("bin").join(cargo))
            .ok_or_else(|| ToolchainError(format!("nothing in {}", sysroot.trim())))
    }

    /// The folder with all of it.
    pub fn sysroot(&self) -> &Path {
        let bin = self.rustc.parent();
        bin.and_then(Path::parent).unwrap_or(Path::new("/"))
    }

    /// What changes when the compiler does. Asking it for its version would take 10 ms.
    pub fn fingerprint(&self) -> String {
        let driver = self.sysroot().join("lib");
        let [rustc, driver] = [&self.rustc, &driver].map(|path| file_fingerprint(path));
        format!("{} {rustc} {driver}", self.rustc.display())
    }
}

/// What changes when a file, or what a folder holds, is replaced: its size, and when that was.
pub fn file_fingerprint(path: &Path) -> String {
    let metadata = fs::metadata(path);
    let size = metadata.as_ref().map_or(0, fs::Metadata::len);
    let age = metadata.and_then(|metadata| metadata.modified()).ok();
    let age = age.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
    format!("{size} {age:?}")
}

fn toolchain_beside(cargo: &Path) -> Option<Toolchain> {
    let rustc = cargo.with_file_name(format!("rustc{}", env::consts::EXE_SUFFIX));
    (cargo.is_file() && rustc.is_file()).then(|| Toolchain {
        cargo: cargo.to_owned(),
        rustc,
    })
}
