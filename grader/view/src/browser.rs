//! Opens the page in a browser.

use std::io::Write;
use std::path::Path;

use grader::desktop;
use grader::printing::print_error_line;
use tempfile::NamedTempFile;

/// Opens `url` in a browser. Returns a file in `folder` that must not be deleted before the browser
/// has read it. If there is no desktop, prints what to do instead.
///
/// The browser gets the path of a file that redirects it to the address. All users of a machine can
/// read a program's arguments, and the address contains a secret, whereas only the user can read
/// the file. The file isn't in the system's temporary folder, because browsers installed as snaps
/// cannot read that folder.
pub fn open(folder: &Path, url: &str, port: u16) -> std::io::Result<NamedTempFile> {
    let mut file = tempfile::Builder::new()
        .prefix("open-viewer-")
        .suffix(".html")
        .tempfile_in(folder)?;
    write!(
        file,
        "<!doctype html><html lang=\"en\"><title>cargo view</title>\
         <meta name=\"referrer\" content=\"no-referrer\">\
         <meta http-equiv=\"refresh\" content=\"0;url={url}\"><a href=\"{url}\">Open the viewer</a></html>"
    )?;
    file.flush()?;
    if let Err(why) = desktop::open(file.path()) {
        print_error_line(format_args!(
            "{why}: open the address yourself. From another machine, forward the port first, with \
             `ssh -L {port}:localhost:{port}` or in your editor."
        ));
    }
    Ok(file)
}
