//! Finds the Rust toolchain.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::UNIX_EPOCH;

use crate::build::linker::SystemLinker;
use crate::error::Error;

/// The real `cargo` and `rustc` instead of rustup's proxies, which take 8 ms per call and obey any
/// `rust-toolchain.toml` in the current folder.
#[derive(Clone, Debug)]
pub struct Toolchain {
    /// Path of `cargo`, which builds the dependencies once.
    pub cargo: PathBuf,
    /// Path of `rustc`, which compiles submissions.
    pub rustc: PathBuf,
    /// The linker that `rustc` calls.
    pub linker: SystemLinker,
}

impl Toolchain {
    /// Finds the toolchain whose `cargo` is running this program or, failing that, the toolchain on
    /// the PATH.
    pub fn find() -> Result<Self, Error> {
        if let Some(toolchain) =
            env::var_os("CARGO").and_then(|cargo| toolchain_beside(Path::new(&cargo)))
        {
            return Ok(toolchain);
        }
        let output = Command::new("rustc")
            .args(["--print", "sysroot"])
            .output()
            .map_err(|error| not_found(&error.to_string()))?;
        let sysroot = String::from_utf8_lossy(&output.stdout);
        let cargo = format!("cargo{}", env::consts::EXE_SUFFIX);
        toolchain_beside(&Path::new(sysroot.trim()).join("bin").join(cargo))
            .ok_or_else(|| not_found(&format!("no toolchain found in {:?}", sysroot.trim())))
    }

    /// Returns the toolchain's root folder.
    pub fn sysroot(&self) -> &Path {
        let bin = self.rustc.parent();
        bin.and_then(Path::parent).unwrap_or(Path::new("/"))
    }

    /// Returns text that changes when the compiler changes. It isn't the compiler's version,
    /// because running the compiler to ask for its version would take 10 ms.
    pub fn fingerprint(&self) -> String {
        let driver = self.sysroot().join("lib");
        let [rustc, driver] = [&self.rustc, &driver].map(|path| file_fingerprint(path));
        format!("{} {rustc} {driver}", self.rustc.display())
    }
}

/// Returns text that changes when a file or the contents of a folder are replaced. It consists of
/// the size and the modification time.
pub fn file_fingerprint(path: &Path) -> String {
    let metadata = fs::metadata(path);
    let size = metadata.as_ref().map_or(0, fs::Metadata::len);
    let age = metadata.and_then(|metadata| metadata.modified()).ok();
    let age = age.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
    format!("{size} {age:?}")
}

fn not_found(why: &str) -> Error {
    Error::Machine(format!(
        "cannot find rustc: install Rust, or add rustc to the PATH ({why})"
    ))
}

fn toolchain_beside(cargo: &Path) -> Option<Toolchain> {
    let rustc = cargo.with_file_name(format!("rustc{}", env::consts::EXE_SUFFIX));
    (cargo.is_file() && rustc.is_file()).then(|| Toolchain {
        cargo: cargo.to_owned(),
        rustc,
        linker: SystemLinker::find(),
    })
}
