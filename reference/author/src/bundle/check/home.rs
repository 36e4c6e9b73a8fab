//! A home directory like that of a student with a fresh installation of Rust. It contains only the
//! crates that the bundle needs, so that cargo does not use the network.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use grader::files::{self, AtPath, PathError};

use crate::bundle::crates::{self, CratesError};

/// A home directory that contains only crates, and the toolchain that is used with it.
#[derive(Debug)]
pub(super) struct Home {
    folder: PathBuf,
    /// The toolchain's `bin` folder. Rustup's proxies would not work, since they look for
    /// toolchains in the home directory.
    programs: PathBuf,
}

/// The reason why the home directory cannot be created.
#[derive(Debug, thiserror::Error)]
pub enum HomeError {
    /// The environment variable `CARGO` is not set.
    #[error("CARGO is not set: run `cargo author bundle --check`")]
    NoCargo,
    /// The crates cannot be read.
    #[error(transparent)]
    Crates(#[from] CratesError),
    /// A file operation failed.
    #[error(transparent)]
    File(#[from] PathError),
}

impl Home {
    /// Creates the home directory in `parent`, with the crates of a lock file that cargo has
    /// fetched on this machine.
    pub(super) fn create(parent: &Path, lock: &str) -> Result<Self, HomeError> {
        let cargo = env::var_os("CARGO").ok_or(HomeError::NoCargo)?;
        let programs = Path::new(&cargo).parent().ok_or(HomeError::NoCargo)?;
        let home = Home {
            folder: parent.join("home"),
            programs: programs.to_owned(),
        };
        if home.folder.exists() {
            fs::remove_dir_all(&home.folder).at("remove", &home.folder)?;
        }
        let registry = home.cargo_home().join("registry");
        for (path, contents) in crates::registry_files(lock)? {
            files::write_with_parents(registry.join(path), &contents)?;
        }
        Ok(home)
    }

    fn cargo_home(&self) -> PathBuf {
        self.folder.join(".cargo")
    }

    /// Returns the path of the toolchain's program with this name, or the name itself if the
    /// toolchain has no such program.
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

    /// Makes a command use this home directory, without the Rust settings of the current
    /// environment.
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
        // Joining fails only if a folder's name contains a character that `PATH` cannot hold.
        if let Ok(path) = env::join_paths(path) {
            command.env("PATH", path);
        }
        command
            .env("HOME", &self.folder)
            .env("USERPROFILE", &self.folder)
            .env("CARGO_HOME", self.cargo_home())
            .env("CARGO_NET_OFFLINE", "true")
            // This folder is outside the home directory, so that the next check reuses the compiled
            // files.
            .env("CARGO_TARGET_DIR", self.folder.with_file_name("built"));
    }
}
