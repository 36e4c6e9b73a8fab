//! A home without anything in it but the archives of the crates that the bundle needs: what cargo
//! would have fetched, so that nothing asks the network.

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

/// A home, and the programs of a freshly installed Rust.
#[derive(Debug)]
pub(super) struct Home {
    folder: PathBuf,
    /// The folder with cargo and rustc themselves: rustup's stand-ins would miss their own home.
    programs: PathBuf,
}

/// There is no home.
#[derive(Debug, thiserror::Error)]
pub enum NoHome {
    /// Cargo did not start us.
    #[error("cargo has to say where it is: run `cargo author bundle --check`")]
    NoCargo,
    /// There is no folder of fetched crates.
    #[error("can not find cargo's own folder: set CARGO_HOME")]
    NoCargoHome,
    /// The lock file makes no sense.
    #[error("the bundle's lock file: {0}")]
    Lock(#[from] toml::de::Error),
    /// The system does not let us.
    #[error("can not furnish {}: {source}", path.display())]
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

impl Home {
    /// Makes the home in `place`, with the crates that this lock file names and this machine has.
    pub(super) fn furnish(place: &Path, lock: &str) -> Result<Self, NoHome> {
        let cargo = env::var_os("CARGO").ok_or(NoHome::NoCargo)?;
        let programs = Path::new(&cargo).parent().ok_or(NoHome::NoCargo)?;
        let home = Home {
            folder: place.join("home"),
            programs: programs.to_owned(),
        };
        let at = |source| NoHome::Io {
            path: home.folder.clone(),
            source,
        };
        if home.folder.exists() {
            fs::remove_dir_all(&home.folder).map_err(at)?;
        }
        let lock: Lock = toml::from_str(lock)?;
        let fetched = cargo_home()?.join("registry");
        fetch(&lock, &fetched, &home.cargo_home().join("registry")).map_err(at)?;
        Ok(home)
    }

    fn cargo_home(&self) -> PathBuf {
        self.folder.join(".cargo")
    }

    /// A program of this name: Rust's, if it is one.
    pub(super) fn program(&self, name: &str) -> PathBuf {
        let program = self
            .programs
            .join(format!("{name}{}", env::consts::EXE_SUFFIX));
        if program.is_file() {
            program
        } else {
            PathBuf::from(name)
        }
    }

    /// Lets a command know of this home, and of nothing that this shell has set for Rust.
    pub(super) fn enter(&self, command: &mut Command) {
        for (name, _) in env::vars_os() {
            let text = name.to_string_lossy();
            if text.starts_with("CARGO") || text.starts_with("RUST") {
                command.env_remove(&name);
            }
        }
        let path = env::var_os("PATH").unwrap_or_default();
        let path = [self.programs.clone()]
            .into_iter()
            .chain(env::split_paths(&path));
        // Joining fails only for names that the split could not have given.
        if let Ok(path) = env::join_paths(path) {
            command.env("PATH", path);
        }
        command
            .env("HOME", &self.folder)
            .env("USERPROFILE", &self.folder)
            .env("CARGO_HOME", self.cargo_home())
            .env("CARGO_NET_OFFLINE", "true")
            // Beside the home, where it stays from one trial to the next.
            .env("CARGO_TARGET_DIR", self.folder.with_file_name("built"));
    }
}

fn cargo_home() -> Result<PathBuf, NoHome> {
    env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(env::home_dir()?.join(".cargo")))
        .ok_or(NoHome::NoCargoHome)
}

/// Copies of a registry's folder what the lock file names: what is told of each crate, and its
/// archive. Crates for other systems are not there, and not needed.
fn fetch(lock: &Lock, from: &Path, to: &Path) -> io::Result<()> {
    for registry in fs::read_dir(from.join("index"))? {
        let registry = registry?.file_name();
        let place = Path::new("index").join(&registry);
        for entry in fs::read_dir(from.join(&place))? {
            copy_if_there(from, to, &place.join(entry?.file_name()))?;
        }
        for Package { name, version } in &lock.package {
            let told = place.join(".cache").join(in_index(name));
            copy_if_there(from, to, &told)?;
            let archive = Path::new("cache").join(&registry);
            copy_if_there(from, to, &archive.join(format!("{name}-{version}.crate")))?;
        }
    }
    Ok(())
}

/// Where a registry's index tells of a crate (The Cargo Book, "Registry Index").
fn in_index(name: &str) -> PathBuf {
    let name = name.to_lowercase();
    match name.len() {
        length @ 1..=2 => Path::new(&length.to_string()).join(name),
        3 => Path::new("3").join(&name[..1]).join(name),
        _ => Path::new(&name[..2]).join(&name[2..4]).join(name),
    }
}

fn copy_if_there(from: &Path, to: &Path, path: &Path) -> io::Result<()> {
    let (from, to) = (from.join(path), to.join(path));
    if from.is_file() {
        to.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::copy(from, to)?;
    }
    Ok(())
}
