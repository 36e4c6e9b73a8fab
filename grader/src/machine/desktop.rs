//! Opens a file in the user's default application for its type.

use std::env;
use std::path::Path;

use crate::machine::printing::print_error_line;

/// Opens a file with the desktop's default program for its type, without waiting for the program to
/// exit. If this fails, prints the path of the file instead of returning an error.
pub fn show(file: &Path) {
    if let Err(why) = open(file) {
        print_error_line(format_args!("{why}: open {} yourself", file.display()));
    }
}

/// Opens a file with the desktop's default program for its type, without waiting for the program to
/// exit.
///
/// # Errors
///
/// Returns a message with the reason: there is either no desktop or no program for this type of
/// file.
pub fn open(file: &Path) -> Result<(), String> {
    if !has_desktop() {
        return Err("no desktop session is available".to_owned());
    }
    let opened = open::that_detached(file);
    opened.map_err(|error| format!("no program could open the page ({error})"))
}

/// Returns whether there is a desktop session. Windows and macOS always have one. On other systems
/// there may be none, e.g. over a plain ssh connection. Without one, the program would start and
/// fail without the user noticing.
fn has_desktop() -> bool {
    let is_set = |name| env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(any(windows, target_os = "macos"))
        || ["DISPLAY", "WAYLAND_DISPLAY", "WSL_DISTRO_NAME"]
            .into_iter()
            .any(is_set)
}
