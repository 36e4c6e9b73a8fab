//! A home without anything in it but the archives of the crates that the bundle needs: what cargo
//! would have fetched, so that nothing asks the network.

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::bundle::crates::{self, CratesError};

/// A home, and the programs of a freshly installed Rust.
#[derive(Debug)]
pub(super) struct Home {
    folder: PathBuf,
    /// The folder with cargo and rustc themselves: rustup's stand-ins would miss their own home.
    programs: PathBuf,
}

/// There is no home.
#[derive(Debug, thiserror::Error)]
pub enum HomeError {
    /// Cargo did not start us.
    #[error("cargo has to say where it is: run `cargo author bundle --check`")]
    NoCargo,
    /// The crates are not at hand.
    #[error(transparent)]
    Crates(#[from] CratesError),
    /// The system does not let us.
    #[error("can not furnish {}: {source}", path.display())]
    Io {
        /// What.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

impl Home {
    /// Makes the home in `place`, with the crates that this lock file names and this machine has.
    pub(super) fn create(place: &Path, lock: &str) -> Result<Self, HomeError> {
        let cargo = env::var_os("CARGO").ok_or(HomeError::NoCargo)?;
        let programs = Path::new(&cargo).parent().ok_or(HomeError::NoCargo)?;
        let home = Home {
            folder: place.join("home"),
            programs: programs.to_owned(),
        };
        let at = |source| HomeError::Io {
            path: home.folder.clone(),
            source,
        };
        if home.folder.exists() {
            fs::remove_dir_all(&home.folder).map_err(at)?;
        }
        let registry = home.cargo_home().join("registry");
        for (path, contents) in crates::registry_files(lock)? {
            write_file(&registry.join(path), &contents).map_err(at)?;
        }
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
    pub(super) fn apply_to(&self, command: &mut Command) {
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

fn write_file(path: &Path, contents: &[u8]) -> io::Result<()> {
    path.parent().map_or(Ok(()), fs::create_dir_all)?;
    fs::write(path, contents)
}
