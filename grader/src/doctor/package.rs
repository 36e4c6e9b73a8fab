//! `cargo grade --doctor --package FILE`: a package as the platform will see it, before anybody
//! hands in.

use std::path::Path;

use crate::doctor::contents::contents;
use crate::doctor::folder;

pub use crate::doctor::contents::NoPackage;

/// What is wrong, a sentence each with what to do. Empty if it will grade.
pub fn complaints(path: &Path) -> Result<Vec<String>, NoPackage> {
    match path.is_dir() {
        true => Ok(folder::complaints(path)),
        false => Ok(contents(path)?.complaints()),
    }
}
