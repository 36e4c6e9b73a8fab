//! Writes a bundle as a folder or as a ZIP archive. The archive is reproducible: the same bundle
//! gives the same bytes on every machine.

use std::io::{Cursor, Read, Write};
use std::path::Path;

use anyhow::{Result, bail};
use grader::files::{self, PathError};
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipArchive, ZipWriter};

use crate::bundle::Bundle;

/// The folder that the archive unpacks into.
pub const TOP_FOLDER: &str = "pathtracing";

/// Writes the bundle as an archive if `out` ends with `.zip`, and otherwise as a folder. The folder
/// may be an empty Git repository.
pub fn write(bundle: &Bundle, out: &Path) -> Result<()> {
    if out.extension().is_some_and(|extension| extension == "zip") {
        return Ok(files::write(out, zip(bundle)?)?);
    }
    write_folder(bundle, out)
}

/// Writes the bundle as a folder. The folder may already exist if it contains nothing but `.git`.
pub fn write_folder(bundle: &Bundle, out: &Path) -> Result<()> {
    files::create_dir_all(out)?;
    if files::read_dir(out)?
        .iter()
        .any(|path| !path.ends_with(".git"))
    {
        bail!(
            "{} is not empty: choose a new folder or a name that ends with .zip, or empty this \
             folder except for .git",
            out.display()
        );
    }
    Ok(write_files(bundle, out)?)
}

/// Writes all files of the bundle below `folder`.
pub(crate) fn write_files(bundle: &Bundle, folder: &Path) -> Result<(), PathError> {
    let mut files = bundle.files.iter();
    files.try_for_each(|(path, contents)| files::write_with_parents(folder.join(path), contents))
}

/// Returns the bytes of an archive that unpacks into a single folder.
pub fn zip(bundle: &Bundle) -> Result<Vec<u8>, ZipError> {
    zip_with_prefix(bundle, &format!("{TOP_FOLDER}/"))
}

/// Returns the bytes of an archive in which every path begins with `top`. `top` is empty or ends
/// with `/`.
pub fn zip_with_prefix(bundle: &Bundle, top: &str) -> Result<Vec<u8>, ZipError> {
    // Use a fixed time, system and permissions. Otherwise, the bytes would depend on when and where
    // the archive is created.
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

/// Returns the permissions of a file: scripts are executable.
fn unix_mode(contents: &[u8]) -> u32 {
    if contents.starts_with(b"#!") {
        0o755
    } else {
        0o644
    }
}

/// Reads an archive and strips the top folder from its paths.
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
