//! The bytes of the archive. The same files always produce the same bytes, on any machine.

use std::io::Write;

use flate2::Compression;
use flate2::write::DeflateEncoder;
use rawzip::time::UtcDateTime;
use rawzip::{CompressionMethod, Error, ZipArchiveWriter};

use crate::submission::Submission;

/// The time of every file in the archive: noon on 1 January 2000, in seconds since 1970.
const FIXED_TIME: i64 = 946_728_000;

/// Returns the bytes of a ZIP archive with the task files at its top level, sorted by name. Files
/// that are missing or cannot be read are left out.
pub fn archive_bytes(submission: &Submission) -> Result<Vec<u8>, Error> {
    let readable = submission.files.iter();
    let mut files: Vec<(&str, &str)> = readable
        .filter_map(|(file, text)| Some((file.name, text.as_deref().ok()?)))
        .collect();
    files.sort_unstable();
    let mut archive = ZipArchiveWriter::new(Vec::new());
    for (name, text) in files {
        let (mut entry, config) = archive
            .new_file(name)
            .compression_method(CompressionMethod::DEFLATE)
            .last_modified(UtcDateTime::from_unix(FIXED_TIME))
            .unix_permissions(0o644)
            .start()?;
        let encoder = DeflateEncoder::new(&mut entry, Compression::default());
        let mut writer = config.wrap(encoder);
        writer.write_all(text.as_bytes())?;
        let (encoder, output) = writer.finish()?;
        encoder.finish()?;
        entry.finish(output)?;
    }
    archive.finish()
}
