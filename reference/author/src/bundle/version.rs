//! The version of a bundle: a hash of everything in it except the students' own files.
//!
//! It is part of each package's version, as in `1.0.0+3f9a1c02e1d4`. This makes Cargo recompile
//! everything after an update, even though the unpacked files are older than its build output. It
//! also lets the grader recognise the version of each part.

use std::path::Path;

use anyhow::Result;
use grader::files;
use grader::handed_out::HandedOut;
use judging::content_hash::ContentHash;
use toml_edit::{DocumentMut, Item, value};

use crate::bundle::Bundle;
use crate::bundle::manifests::parse;
use crate::light::LightFiles;

/// The number of digits in a version.
const DIGITS: usize = 12;

/// Adds the version to all manifests in a bundle. The bundle must not have a lock file yet.
pub(super) fn add(
    root: &Path,
    handed_out: &HandedOut,
    light: LightFiles,
    bundle: &mut Bundle,
) -> Result<()> {
    let mut hash = ContentHash::default();
    // The dependencies are part of what students get.
    hash.add(&files::read(root.join("Cargo.lock"))?);
    let given = bundle.files.iter();
    for (path, contents) in given.filter(|(path, _)| !light.is_students_own(path, handed_out)) {
        hash.add(path.as_bytes());
        hash.add(contents);
    }
    let hash = hash.hex();
    let version = &hash[..DIGITS];
    let paths: Vec<String> = bundle.files.keys().cloned().collect();
    for path in paths.iter().filter(|path| path.ends_with("Cargo.toml")) {
        let mut manifest = parse(path, bundle.text(path).unwrap_or_default())?;
        let package = manifest.get_mut("package");
        add_to(package, version);
        let workspace = manifest.get_mut("workspace");
        add_to(workspace.and_then(|item| item.get_mut("package")), version);
        bundle.insert(path, manifest.to_string());
    }
    Ok(())
}

/// Returns the version in the text of the root manifest.
pub(super) fn find(manifest: &str) -> Option<String> {
    let manifest: DocumentMut = manifest.parse().ok()?;
    let version = manifest.get("workspace")?.get("package")?.get("version")?;
    let (_, version) = version.as_str()?.split_once('+')?;
    Some(version.to_owned())
}

/// Appends the bundle's version to the version in a `package` table, if there is one.
fn add_to(package: Option<&mut Item>, version: &str) {
    if let Some(item) = package.and_then(|package| package.get_mut("version"))
        && let Some(plain) = item.as_str()
    {
        *item = value(format!("{plain}+{version}"));
    }
}
