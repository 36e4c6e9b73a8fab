//! The bundle's manifests and cargo aliases. They are copied from the workspace, without the
//! entries for staff crates, tests and benches.

use std::path::Path;

use anyhow::{Context, Result, anyhow};
use grader::files;
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, value};

use crate::bundle::Bundle;

/// The cargo aliases that work without the `reference` and `author` crates.
const ALIASES: [&str; 5] = ["grade", "handin", "render", "view", "examples"];
/// The manifests of the only crates whose tests are in the bundle. These tests are the worked
/// examples.
const STUDENT_MANIFESTS: [&str; 2] = ["student/Cargo.toml", "student/light/Cargo.toml"];
/// The manifest keys for tests and benches, which aren't in the bundle.
const TEST_KEYS: [&str; 3] = ["dev-dependencies", "bench", "test"];

/// The profile for benches. It configures packages that aren't in the bundle.
const STAFF_PROFILE: &str = "bench";
/// The package that has its own settings in a profile but isn't in the bundle.
const STAFF_PACKAGE: &str = "author";

/// Adds the cargo aliases, the root manifest and the manifests of the students' crates, without the
/// entries for staff. Also trims the manifests that are already in the bundle.
pub(super) fn add_trimmed(root: &Path, bundle: &mut Bundle) -> Result<()> {
    let text = |path: &str| files::read_to_string(root.join(path));
    for path in STUDENT_MANIFESTS {
        bundle.insert(path, text(path)?);
    }
    let paths: Vec<String> = bundle.files.keys().cloned().collect();
    for path in paths.iter().filter(|path| path.ends_with("Cargo.toml")) {
        let mut manifest = parse(path, bundle.text(path).unwrap_or_default())?;
        for key in TEST_KEYS {
            manifest.remove(key);
        }
        if !STUDENT_MANIFESTS.contains(&path.as_str()) {
            leave_out_tests(&mut manifest);
        }
        // Only staff commands need default features.
        if let Some(features) = manifest.get_mut("features").and_then(Item::as_table_mut) {
            features.remove("default");
        }
        bundle.insert(path, manifest.to_string());
    }

    let mut manifest = parse("Cargo.toml", &text("Cargo.toml")?)?;
    let members = manifest["workspace"].get_mut("members");
    let members = members
        .and_then(Item::as_array_mut)
        .with_context(|| missing_key("Cargo.toml", "workspace.members"))?;
    keep_members(members, bundle);
    // Cargo warns about profile settings for missing packages.
    if let Some(profiles) = manifest["profile"].as_table_like_mut() {
        profiles.remove(STAFF_PROFILE);
        for (_, profile) in profiles.iter_mut() {
            if let Some(packages) = profile.get_mut("package").and_then(Item::as_table_like_mut) {
                packages.remove(STAFF_PACKAGE);
            }
        }
    }
    bundle.insert("Cargo.toml", manifest.to_string());

    let path = ".cargo/config.toml";
    let mut config = parse(path, &text(path)?)?;
    let aliases = config["alias"].as_table_mut();
    let aliases = aliases.with_context(|| missing_key(path, "alias"))?;
    aliases.retain(|name, _| ALIASES.contains(&name));
    bundle.insert(path, config.to_string());
    Ok(())
}

/// Declares that a crate contains no tests or benches. Otherwise, editors would try to compile what
/// is left of its tests after each save and fail.
fn leave_out_tests(manifest: &mut DocumentMut) {
    let programs = manifest.get_mut("bin");
    let programs = programs.and_then(Item::as_array_of_tables_mut);
    for program in programs.into_iter().flat_map(ArrayOfTables::iter_mut) {
        program["test"] = value(false);
        program["bench"] = value(false);
    }
    let lib = manifest.entry("lib").or_insert_with(toml_edit::table);
    lib["test"] = value(false);
    lib["bench"] = value(false);
}

/// Keeps only the workspace members that are in the bundle.
fn keep_members(members: &mut Array, bundle: &Bundle) {
    members.retain(|member| {
        let manifest = member.as_str().map(|folder| format!("{folder}/Cargo.toml"));
        manifest.is_some_and(|manifest| bundle.files.contains_key(&manifest))
    });
}

pub(super) fn parse(path: &str, text: &str) -> Result<DocumentMut> {
    text.parse()
        .map_err(|error| anyhow!("{path} is not valid TOML: {error}"))
}

fn missing_key(path: &str, key: &str) -> String {
    format!("{path} no longer has the key `{key}`: update reference/author/src/bundle/manifests.rs")
}
