//! The version of the students' bundle, which is stored as build metadata in the versions of its
//! packages. The packages in this repository itself have no such metadata.

use std::fs;

use crate::workspace::Workspace;

/// The manifests of the code that students get besides the grader.
const MANIFESTS: [(&str, &str); 4] = [
    ("student/framework", "student/framework/Cargo.toml"),
    ("student/protocol", "student/protocol/Cargo.toml"),
    ("student/light", "student/light/Cargo.toml"),
    ("student", "student/Cargo.toml"),
];

/// Returns the version of the bundle that this program comes from.
pub fn bundle_version() -> Option<&'static str> {
    metadata(env!("CARGO_PKG_VERSION"))
}

/// Returns a note if folders in the workspace come from a different version than this program.
pub fn mixed_versions(workspace: &Workspace) -> Option<String> {
    let version_of = |(folder, manifest): (&'static str, &str)| {
        let text = fs::read_to_string(workspace.root().join(manifest)).ok()?;
        Some((folder, manifest_version(&text)?))
    };
    let versions: Vec<(&str, Option<String>)> =
        MANIFESTS.into_iter().filter_map(version_of).collect();
    mixed(bundle_version(), &versions)
}

fn mixed(grader: Option<&str>, folders: &[(&str, Option<String>)]) -> Option<String> {
    let name = |version: Option<&str>| {
        version.map_or("unversioned".to_owned(), |version| {
            format!("version {version}")
        })
    };
    let others: Vec<String> = folders
        .iter()
        .filter(|(_, version)| version.as_deref() != grader)
        .map(|(folder, version)| format!("{folder} is {}", name(version.as_deref())))
        .collect();
    (!others.is_empty()).then(|| {
        format!(
            "this folder contains a mix of versions: the grader is {}, and {}. Unpack the latest \
             archive again, overwriting all the provided files",
            name(grader),
            others.join(", ")
        )
    })
}

/// Returns the bundle's version, taken from a package's version. The inner `None` means that the
/// package's version doesn't include it. The outer `None` means that the manifest doesn't contain a
/// version.
fn manifest_version(text: &str) -> Option<Option<String>> {
    let manifest: toml::Table = text.parse().ok()?;
    let version = manifest.get("package")?.get("version")?.as_str()?;
    Some(metadata(version).map(str::to_owned))
}

fn metadata(version: &str) -> Option<&str> {
    version.split_once('+').map(|(_, metadata)| metadata)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_is_the_build_metadata_of_a_package() {
        let of = |version: &str| manifest_version(&format!("[package]\nversion = \"{version}\""));
        assert_eq!(of("0.1.0+3f9a"), Some(Some("3f9a".to_owned())));
        assert_eq!(of("0.1.0"), Some(None));
        let inherited = "[package]\nversion.workspace = true";
        assert_eq!(manifest_version(inherited), None);
    }

    #[test]
    fn a_mix_of_versions_is_named_in_a_line() {
        let same = ["student/framework", "student"];
        let same = same.map(|folder| (folder, Some("3f9a".to_owned())));
        assert_eq!(mixed(Some("3f9a"), &same), None);
        let note = mixed(Some("77aa"), &same[..1]).expect("the versions differ");
        assert_eq!(
            note,
            "this folder contains a mix of versions: the grader is version 77aa, and \
             student/framework is version 3f9a. Unpack the latest archive again, overwriting all \
             the provided files"
        );
    }

    #[test]
    fn this_repository_has_no_mix() {
        let workspace = Workspace::find().unwrap();
        assert_eq!(mixed_versions(&workspace), None);
    }
}
