//! The trials of packages: each laid out and run as its platform does it.

pub mod classroom50;
pub mod gradescope;

use std::io;
use std::path::{Path, PathBuf};

use zip::result::ZipError;

/// A package was not tried: our fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum NotTried {
    /// Cargo did not start us.
    #[error("cargo has to say where it is: run `cargo author package … --check`")]
    NoCargo,
    /// It can not be unpacked.
    #[error("the zip: {0}")]
    Zip(#[from] ZipError),
    /// The system does not let us.
    #[error("can not use {}: {source}", path.display())]
    Io {
        /// What.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

fn at(path: &Path) -> impl FnOnce(io::Error) -> NotTried {
    let path = path.to_owned();
    move |source| NotTried::Io { path, source }
}
