//! Manifests and aliases, cut from ours: without what only the staff has.

use std::fs;
use std::io;

use std::path::{Path, PathBuf};

use toml_edit::{Array, DocumentMut, Item, TomlError};

use crate::bundle::Bundle;

/// The commands that work without the reference and the author.
const ALIASES: [&str; 3] = ["grade", "render", "examples"];
/// What a manifest says of folders that are left out.
const TEST_KEYS: [&str; 3] = ["dev-dependencies", "bench", "test"];

/// A manifest is not as expected.
#[derive(Debug, thiserror::Error)]
pub enum ManifestError {
    /// It can not be read.
    #[error("can not read {}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// It is no TOML.
    #[error("{path}: {source}")]
    Toml {
        /// Which.
        path: String,
        /// Line, column, and what is wrong there.
        source: TomlError,
    },
    /// It lacks something that it must have.
    #[error("{path} has no `{key}` any more: adapt the bundle's manifests")]
    MissingKey {
        /// Which.
        path: &'static str,
        /// What.
        key: &'static str,
    },
}

/// Puts the root's manifest, the student's and the aliases into the bundle, and cuts all that are
/// there.
pub(super) fn add_trimmed(root: &Path, bundle: &mut Bundle) -> Result<(), ManifestError> {
    bundle.insert("student/Cargo.toml", read(root, "student/Cargo.toml")?);
    let paths: Vec<String> = bundle.files.keys().cloned().collect();
    for path in paths.iter().filter(|path| path.ends_with("Cargo.toml")) {
        let mut manifest = parse(path, bundle.text(path).unwrap_or_default())?;
        for key in TEST_KEYS {
            manifest.remove(key);
        }
        // What is on unless told otherwise is on for the staff's sake.
        if let Some(features) = manifest.get_mut("features").and_then(Item::as_table_mut) {
            features.remove("default");
        }
        bundle.insert(path, manifest.to_string());
    }

    let mut manifest = parse("Cargo.toml", &read(root, "Cargo.toml")?)?;
    let members = manifest["workspace"].get_mut("members");
    let members = members
        .and_then(Item::as_array_mut)
        .ok_or(ManifestError::MissingKey {
            path: "Cargo.toml",
            key: "workspace.members",
        })?;
    keep_members(members, bundle);
    // Cargo warns of what is said of a package that is not there; benches have no other profile.
    let profiles = &mut manifest["profile"];
    if let Some(packages) = profiles["release"].get_mut("package")
        && let Some(packages) = packages.as_table_like_mut()
    {
        packages.remove("reference");
    }
    if let Some(profiles) = profiles.as_table_like_mut() {
        profiles.remove("bench");
    }
    bundle.insert("Cargo.toml", manifest.to_string());

    let path = ".cargo/config.toml";
    let mut config = parse(path, &read(root, path)?)?;
    let aliases = config["alias"].as_table_mut();
    let aliases = aliases.ok_or(ManifestError::MissingKey { path, key: "alias" })?;
    aliases.retain(|name, _| ALIASES.contains(&name));
    bundle.insert(path, config.to_string());
    Ok(())
}

/// Of the workspace's members, those that are handed out.
fn keep_members(members: &mut Array, bundle: &Bundle) {
    members.retain(|member| {
        let manifest = member.as_str().map(|folder| format!("{folder}/Cargo.toml"));
        manifest.is_some_and(|manifest| bundle.files.contains_key(&manifest))
    });
}

fn read(root: &Path, path: &str) -> Result<String, ManifestError> {
    let path = root.join(path);
    fs::read_to_string(&path).map_err(|source| ManifestError::Io { path, source })
}

fn parse(path: &str, text: &str) -> Result<DocumentMut, ManifestError> {
    text.parse().map_err(|source| ManifestError::Toml {
        path: path.to_owned(),
        source,
    })
}
