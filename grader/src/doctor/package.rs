//! Checks a package for Gradescope, classroom50 or GitHub as the platform will see it. Used by
//! `cargo author package --check`.

use std::path::Path;

use crate::doctor::folder;
use crate::doctor::package_contents::read_package;
use crate::error::Error;
use crate::handed_out::HandedOut;

/// Returns a message for each problem, including what to do about it. If there is none, the package
/// will work.
pub fn problems(path: &Path, handed_out: &HandedOut) -> Result<Vec<String>, Error> {
    if path.is_dir() {
        Ok(folder::problems(path, handed_out))
    } else {
        Ok(read_package(path)?.problems(handed_out))
    }
}
