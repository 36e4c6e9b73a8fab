//! The bundle as a folder, and as a ZIP archive that is the same, byte for byte, whenever and
//! wherever it is made.

use std::fs;
use std::io::{self, Cursor, Read, Write};
use std::path::{Path, PathBuf};

use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipArchive, ZipWriter};

use crate::bundle::Bundle;

/// The folder that the archive unpacks to.
pub const TOP_FOLDER: &str = "pathtracing";

/// A bundle was not handed over.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The folder holds something already, which may be somebody's work.
    #[error(
        "{} is not empty: name a new folder, or empty it (its .git may stay), or end the name with .zip",
        .0.display()
    )]
    NotEmpty(PathBuf),
    /// The system does not let us.
    #[error("can not write {}: {source}", path.display())]
    Io {
        /// What.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// There is no archive.
    #[error("can not make the archive: {0}")]
    Zip(#[from] ZipError),
}

/// Writes an archive if `out` ends with `.zip`, else a folder that can be a Git repository.
pub fn write(bundle: &Bundle, out: &Path) -> Result<(), WriteError> {
    let at = |source| WriteError::Io {
        path: out.to_owned(),
        source,
    };
    if out.extension().is_some_and(|extension| extension == "zip") {
        return fs::write(out, zip(bundle)?).map_err(at);
    }
    write_folder(bundle, out)
}

/// Writes a folder, which can be a Git repository, or the root of something else.
pub fn write_folder(bundle: &Bundle, out: &Path) -> Result<(), WriteError> {
    let at = |source| WriteError::Io {
        path: out.to_owned(),
        source,
    };
    fs::create_dir_all(out).map_err(at)?;
    for entry in fs::read_dir(out).map_err(at)? {
        if entry.map_err(at)?.file_name() != ".git" {
            return Err(WriteError::NotEmpty(out.to_owned()));
        }
    }
    write_files(bundle, out).map_err(at)
}

/// Writes all files below `folder`.
pub(crate) fn write_files(bundle: &Bundle, folder: &Path) -> io::Result<()> {
    for (path, contents) in &bundle.files {
        let path = folder.join(path);
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::write(path, contents)?;
    }
    Ok(())
}

/// The archive's bytes: one folder, as students unpack it.
pub fn zip(bundle: &Bundle) -> Result<Vec<u8>, ZipError> {
    zip_with_prefix(bundle, &format!("{TOP_FOLDER}/"))
}

/// The archive's bytes, with all files below `top`, which is empty or ends with `/`.
pub fn zip_with_prefix(bundle: &Bundle, top: &str) -> Result<Vec<u8>, ZipError> {
    // Whatever would differ from one machine or day to another is fixed here.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(9))
        .last_modified_time(DateTime::from_date_and_time(2000, 1, 1, 12, 0, 0)?)
        .system(System::Unix);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, contents) in &bundle.files {
        let options = options.unix_permissions(unix_mode(contents));
        archive.start_file(format!("{top}{path}"), options)?;
        archive.write_all(contents)?;
    }
    Ok(archive.finish()?.into_inner())
}

/// Scripts can be run.
fn unix_mode(contents: &[u8]) -> u32 {
    match contents.starts_with(b"#!") {
        true => 0o755,
        false => 0o644,
    }
}

/// What an archive holds, with the folder at its top taken off.
pub fn unzip(archive: &[u8]) -> Result<Bundle, ZipError> {
    let mut archive = ZipArchive::new(Cursor::new(archive))?;
    let mut bundle = Bundle::default();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index)?;
        let mut contents = Vec::new();
        file.read_to_end(&mut contents)?;
        let name = file.name()?;
        let path = name.strip_prefix(TOP_FOLDER).unwrap_or(&name);
        bundle.insert(path.trim_start_matches('/'), contents);
    }
    Ok(bundle)
}
