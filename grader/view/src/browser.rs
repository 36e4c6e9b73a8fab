//! Opens the page in a browser.

use std::io::Write;

use grader::desktop;
use tempfile::NamedTempFile;

/// Opens `url` in a browser, and returns a file that must exist until it has been read.
///
/// The browser gets the path of a file that leads to the address, because a program's arguments can
/// be read by all users of a machine, and the address contains a secret. Only the user can read the
/// file.
pub fn open(url: &str) -> std::io::Result<NamedTempFile> {
    let mut file = tempfile::Builder::new()
        .prefix("cargo-view-")
        .suffix(".html")
        .tempfile()?;
    write!(
        file,
        "<!doctype html><html lang=\"en\"><title>cargo view</title>\
         <meta name=\"referrer\" content=\"no-referrer\">\
         <meta http-equiv=\"refresh\" content=\"0;url={url}\"><a href=\"{url}\">Open the viewer</a></html>"
    )?;
    file.flush()?;
    desktop::show(file.path());
    Ok(file)
}
