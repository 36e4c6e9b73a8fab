//! Copies of the crates in a lock file, taken from cargo's registry folder on this machine, so that
//! cargo can build without a network.

use std::env;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};
use grader::files;
use serde::Deserialize;

#[derive(Deserialize)]
struct LockFile {
    package: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    version: String,
}

/// Returns the files in cargo's registry folder that cargo needs to build the crates in a lock
/// file: the index entry and the archive of each crate. Each file is paired with its path in that
/// folder. Crates for other systems are skipped, because cargo hasn't fetched them and doesn't need
/// them here.
pub fn registry_files(lock: &str) -> Result<Vec<(String, Vec<u8>)>> {
    let lock: LockFile = toml::from_str(lock)
        .map_err(|error| anyhow!("cannot read the bundle's lock file: {error}"))?;
    let registry = cargo_home()?.join("registry");
    let mut files = Vec::new();
    for path in registry_paths(&lock, &registry)? {
        let file = registry.join(&path);
        if file.is_file() {
            let contents = files::read(&file)?;
            files.push((path, contents));
        }
    }
    Ok(files)
}

fn cargo_home() -> Result<PathBuf> {
    env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(env::home_dir()?.join(".cargo")))
        .context("cannot find cargo's home folder: set CARGO_HOME")
}

/// Returns the paths of all files that could belong to these crates, even if some of the files
/// don't exist. The paths are relative to the registry folder and use `/` as the separator.
fn registry_paths(lock: &LockFile, folder: &Path) -> Result<Vec<String>> {
    let mut paths = Vec::new();
    for registry in entry_names(&folder.join("index"))? {
        let index = format!("index/{registry}");
        let index_files = entry_names(&folder.join(&index))?;
        paths.extend(index_files.iter().map(|name| format!("{index}/{name}")));
        for Package { name, version } in &lock.package {
            paths.push(format!("{index}/.cache/{}", index_path(name)));
            paths.push(format!("cache/{registry}/{name}-{version}.crate"));
        }
    }
    Ok(paths)
}

fn entry_names(folder: &Path) -> Result<Vec<String>> {
    let paths = files::read_dir(folder)?.into_iter();
    let names = paths.filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned()));
    Ok(names.collect())
}

/// Returns the path of a crate's entry in a registry index (The Cargo Book, "Registry Index").
fn index_path(name: &str) -> String {
    let name = name.to_lowercase();
    match name.len() {
        length @ 1..=2 => format!("{length}/{name}"),
        3 => format!("3/{}/{name}", &name[..1]),
        _ => format!("{}/{}/{name}", &name[..2], &name[2..4]),
    }
}

#[cfg(test)]
mod tests {
    use super::index_path;

    #[test]
    fn index_paths_follow_the_length_and_first_letters() {
        let names = ["a", "md", "syn", "Glam"];
        let paths = ["1/a", "2/md", "3/s/syn", "gl/am/glam"];
        assert_eq!(names.map(index_path), paths);
    }
}
