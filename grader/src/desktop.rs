//! Showing a file to whoever sits before the machine.

use std::path::Path;
use std::{env, io};

/// Why nothing was opened.
#[derive(Debug, thiserror::Error)]
enum OpenError {
    /// Nobody sees what this machine would show.
    #[error("there is no desktop here")]
    NoDesktop,
    /// There is no program for it, or it does not start.
    #[error("no program opens pages here ({0})")]
    NoProgram(#[from] io::Error),
}

/// Opens the file with the program that the desktop has for it, and does not wait for that. Where
/// there is none it says where the file is: that is no failure.
pub fn show(file: &Path) {
    if let Err(why) = open(file) {
        anstream::eprintln!("{why}: open {} yourself", file.display());
    }
}

fn open(file: &Path) -> Result<(), OpenError> {
    if !has_desktop() {
        return Err(OpenError::NoDesktop);
    }
    Ok(open::that_detached(file)?)
}

/// Elsewhere than on Linux and its like there always is one. There, over a plain ssh connection,
/// an opener would start and fail unseen.
fn has_desktop() -> bool {
    let is_set = |name| env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(any(windows, target_os = "macos"))
        || ["DISPLAY", "WAYLAND_DISPLAY", "WSL_DISTRO_NAME"]
            .into_iter()
            .any(is_set)
}
