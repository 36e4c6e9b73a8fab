//! `cargo grade --doctor --package FILE`: a package as the platform will see it, before anybody
//! hands in.

use std::path::Path;

use crate::doctor::folder;
use crate::doctor::package_contents::read_package;

pub use crate::doctor::package_contents::PackageError;

/// What is wrong, a sentence each with what to do. Empty if it will grade.
pub fn problems(path: &Path) -> Result<Vec<String>, PackageError> {
    match path.is_dir() {
        true => Ok(folder::problems(path)),
        false => Ok(read_package(path)?.problems()),
    }
}
