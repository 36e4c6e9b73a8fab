//! Opens a file in the user's default application for its type.

use std::path::Path;
use std::{env, io};

use crate::printing::print_error_line;

/// Reasons why a file was not opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// There is no desktop session in which the user would see the file.
    #[error("no desktop session is available")]
    NoDesktop,
    /// No program is associated with this type of file, or the program does not start.
    #[error("no program can open the page ({0})")]
    NoProgram(#[from] io::Error),
}

/// Opens a file with the desktop's default program for it, without waiting for that program. If
/// this fails, prints the path of the file instead of returning an error.
pub fn show(file: &Path) {
    if let Err(why) = open(file) {
        print_error_line(format_args!("{why}: open {} yourself", file.display()));
    }
}

/// Opens a file with the desktop's default program for it, without waiting for that program.
pub fn open(file: &Path) -> Result<(), OpenError> {
    if !has_desktop() {
        return Err(OpenError::NoDesktop);
    }
    Ok(open::that_detached(file)?)
}

/// Returns whether there is a desktop session. Windows and macOS always have one. On other systems
/// there may be none, for example over a plain ssh connection, and the program would then start and
/// fail without the user noticing.
fn has_desktop() -> bool {
    let is_set = |name| env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(any(windows, target_os = "macos"))
        || ["DISPLAY", "WAYLAND_DISPLAY", "WSL_DISTRO_NAME"]
            .into_iter()
            .any(is_set)
}
