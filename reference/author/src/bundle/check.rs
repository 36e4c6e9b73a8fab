//! Tries out a bundle the way a student with a fresh installation of Rust would: runs `.ci/bundle`
//! with an empty home folder and without a network.

use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use grader::files::{self, AtPath};
use grader::handed_out::HandedOut;

use crate::bundle::{Bundle, archive, crates};
use crate::light::LightFiles;

/// The folder for the check, relative to the workspace's root. Compiled files stay there for the
/// next check.
const TEST_FOLDER: &str = "target/bundle";
/// The script that uses a bundle as a student would.
const SCRIPT: &str = ".ci/bundle";

/// Archives an assignment's bundle, with and without the students' own files, and runs the script
/// on both archives. The bundle comes from the workspace at `root`.
pub fn check(
    root: &Path,
    handed_out: &HandedOut,
    light: LightFiles,
    bundle: &Bundle,
) -> Result<()> {
    let root = &root.canonicalize().at("read", root)?;
    let folder = root.join(TEST_FOLDER);
    let [all, update] = ["pathtracing.zip", "update.zip"].map(|name| folder.join(name));
    files::write_with_parents(&all, archive::zip(bundle)?)?;
    let without_students_files = bundle.clone().without_students_files(handed_out, light);
    files::write(&update, archive::zip(&without_students_files)?)?;

    // The home folder contains only the crates the bundle needs.
    let home = folder.join("home");
    if home.exists() {
        fs::remove_dir_all(&home).at("remove", &home)?;
    }
    let lock = bundle.text("Cargo.lock").unwrap_or_default();
    for (path, contents) in crates::registry_files(lock)? {
        files::write_with_parents(home.join(".cargo/registry").join(path), &contents)?;
    }
    let mut command = Command::new("bash");
    for (name, _) in env::vars_os() {
        let text = name.to_string_lossy();
        if text.starts_with("CARGO") || text.starts_with("RUST") {
            command.env_remove(&name);
        }
    }
    // Rustup's proxies wouldn't work, since they look for toolchains in the home folder.
    let cargo = env::var_os("CARGO").unwrap_or_default();
    let programs = Path::new(&cargo).parent();
    let programs = programs.context("CARGO is not set: run `cargo author bundle --check`")?;
    let path = env::var_os("PATH").unwrap_or_default();
    let path = [programs.to_owned()]
        .into_iter()
        .chain(env::split_paths(&path));
    let status = command
        .arg(root.join(SCRIPT))
        .args([all, update])
        .env("PATH", env::join_paths(path)?)
        .env("HOME", &home)
        .env("USERPROFILE", &home)
        .env("CARGO_HOME", home.join(".cargo"))
        .env("CARGO_NET_OFFLINE", "true")
        .env("CARGO_TARGET_DIR", folder.join("built"))
        .status()
        .at("run", "bash")?;
    ensure!(status.success(), "the bundle failed its check: see above");
    Ok(())
}
