//! The crates that a lock file names, as cargo has fetched them to this machine: what it needs to
//! build without a network.

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;

/// The crates are not at hand.
#[derive(Debug, thiserror::Error)]
pub enum CratesError {
    /// There is no folder of fetched crates.
    #[error("can not find cargo's own folder: set CARGO_HOME")]
    NoCargoHome,
    /// The lock file makes no sense.
    #[error("the bundle's lock file: {0}")]
    Lock(#[from] toml::de::Error),
    /// The system does not let us.
    #[error("can not read {}: {source}", path.display())]
    Io {
        /// What.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

#[derive(Deserialize)]
struct LockFile {
    package: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    version: String,
}

/// The files of cargo's registry folder that this lock file needs, with their paths in it: what is
/// told of each crate, and its archive. Crates for other systems are not there, and not needed.
pub fn registry_files(lock: &str) -> Result<Vec<(String, Vec<u8>)>, CratesError> {
    let lock: LockFile = toml::from_str(lock)?;
    let from = cargo_home()?.join("registry");
    let mut files = Vec::new();
    for path in registry_paths(&lock, &from)? {
        let place = from.join(&path);
        if place.is_file() {
            let contents = fs::read(&place).map_err(io_error(&place))?;
            files.push((path, contents));
        }
    }
    Ok(files)
}

fn cargo_home() -> Result<PathBuf, CratesError> {
    env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(env::home_dir()?.join(".cargo")))
        .ok_or(CratesError::NoCargoHome)
}

fn io_error(path: &Path) -> impl FnOnce(io::Error) -> CratesError {
    let path = path.to_owned();
    move |source| CratesError::Io { path, source }
}

/// The paths that there may be, with `/`.
fn registry_paths(lock: &LockFile, from: &Path) -> Result<Vec<String>, CratesError> {
    let index = from.join("index");
    let mut paths = Vec::new();
    for registry in entry_names(&index)? {
        let place = format!("index/{registry}");
        let told_of_all = entry_names(&from.join(&place))?;
        paths.extend(told_of_all.iter().map(|name| format!("{place}/{name}")));
        for Package { name, version } in &lock.package {
            paths.push(format!("{place}/.cache/{}", index_path(name)));
            paths.push(format!("cache/{registry}/{name}-{version}.crate"));
        }
    }
    Ok(paths)
}

fn entry_names(folder: &Path) -> Result<Vec<String>, CratesError> {
    let entries = fs::read_dir(folder).map_err(io_error(folder))?;
    let names = entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    let mut names: Vec<String> = names.collect::<io::Result<_>>().map_err(io_error(folder))?;
    names.sort();
    Ok(names)
}

/// Where a registry's index tells of a crate (The Cargo Book, "Registry Index").
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
        let places = ["1/a", "2/md", "3/s/syn", "gl/am/glam"];
        assert_eq!(names.map(index_path), places);
    }
}
