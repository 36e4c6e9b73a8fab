//! Writes archives.

use std::io::{Cursor, Write};

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Returns the options of a file in an archive. Without a time, the archive depends only on the
/// files.
pub fn options() -> SimpleFileOptions {
    SimpleFileOptions::default().last_modified_time(zip::DateTime::default())
}

/// Returns an archive with these files, by their names.
pub fn pack<'a>(files: impl Iterator<Item = (&'a str, &'a str)>) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in files {
        let started = writer.start_file(name, options());
        started.expect("the names of task files are short and differ");
        let written = writer.write_all(text.as_bytes());
        written.expect("writing to memory succeeds");
    }
    let archive = writer.finish().expect("writing to memory succeeds");
    archive.into_inner()
}
