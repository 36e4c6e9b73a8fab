//! The crates that a lock file names, as cargo has fetched them to this machine: what it needs to
//! build without a network.

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;

/// The crates are not at hand.
#[derive(Debug, thiserror::Error)]
pub enum NoCrates {
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
struct Lock {
    package: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    version: String,
}

/// The files of cargo's registry folder that this lock file needs, with their paths in it: what is
/// told of each crate, and its archive. Crates for other systems are not there, and not needed.
pub fn fetched(lock: &str) -> Result<Vec<(String, Vec<u8>)>, NoCrates> {
    let lock: Lock = toml::from_str(lock)?;
    let from = cargo_home()?.join("registry");
    let mut files = Vec::new();
    for path in paths(&lock, &from)? {
        let place = from.join(&path);
        if place.is_file() {
            let contents = fs::read(&place).map_err(at(&place))?;
            files.push((path, contents));
        }
    }
    Ok(files)
}

fn cargo_home() -> Result<PathBuf, NoCrates> {
    env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(env::home_dir()?.join(".cargo")))
        .ok_or(NoCrates::NoCargoHome)
}

fn at(path: &Path) -> impl FnOnce(io::Error) -> NoCrates {
    let path = path.to_owned();
    move |source| NoCrates::Io { path, source }
}

/// The paths that there may be, with `/`.
fn paths(lock: &Lock, from: &Path) -> Result<Vec<String>, NoCrates> {
    let index = from.join("index");
    let mut paths = Vec::new();
    for registry in names(&index)? {
        let place = format!("index/{registry}");
        let told_of_all = names(&from.join(&place))?;
        paths.extend(told_of_all.iter().map(|name| format!("{place}/{name}")));
        for Package { name, version } in &lock.package {
            paths.push(format!("{place}/.cache/{}", in_index(name)));
            paths.push(format!("cache/{registry}/{name}-{version}.crate"));
        }
    }
    Ok(paths)
}

fn names(folder: &Path) -> Result<Vec<String>, NoCrates> {
    let entries = fs::read_dir(folder).map_err(at(folder))?;
    let names = entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    let mut names: Vec<String> = names.collect::<io::Result<_>>().map_err(at(folder))?;
    names.sort();
    Ok(names)
}

/// Where a registry's index tells of a crate (The Cargo Book, "Registry Index").
fn in_index(name: &str) -> String {
    let name = name.to_lowercase();
    match name.len() {
        length @ 1..=2 => format!("{length}/{name}"),
        3 => format!("3/{}/{name}", &name[..1]),
        _ => format!("{}/{}/{name}", &name[..2], &name[2..4]),
    }
}

#[cfg(test)]
mod tests {
    use super::in_index;

    #[test]
    fn an_index_has_a_folder_for_each_length_and_beginning() {
        let names = ["a", "md", "syn", "Glam"];
        let places = ["1/a", "2/md", "3/s/syn", "gl/am/glam"];
        assert_eq!(names.map(in_index), places);
    }
}
