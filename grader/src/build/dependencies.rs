//! The crates that every submission is linked with: `glam`, `protocol`, and `framework` with the
//! probe's features. Cargo compiles them once per toolchain with locked versions, and they are
//! copied to the grader's cache.
//!
//! Cargo uses the target folder where it compiled the grader, so most of the crates are already
//! compiled. Submissions only see the copy, because the target folder also contains the reference
//! and may change at any time.

use std::collections::BTreeMap;
use std::env::consts::DLL_SUFFIX;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use judging::content_hash::ContentHash;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::build::toolchain::Toolchain;
use crate::error::Error;
use crate::machine::files::{self, AtPath};
use crate::machine::printing::print_error_line;
use crate::machine::system;
use crate::workspace::Workspace;

/// The crates that a submission may import.
const EXTERNS: [&str; 3] = ["framework", "glam", "protocol"];
/// Cargo arguments that select two packages. One depends on all of these crates, with the probe's
/// features. The other enables the same features as the grader.
const FRAMEWORK_PACKAGES: [&str; 5] = [
    "--package",
    "framework",
    "--package",
    "workspace-hack",
    "--no-default-features",
];
/// Version of the build recipe. Change it when the same sources should be compiled differently.
const RECIPE_VERSION: &str = "6";

/// Locations of the compiled dependencies.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Dependencies {
    /// The rlib of each crate that a submission may import.
    pub externs: BTreeMap<String, PathBuf>,
    /// The folder that contains these crates and their dependencies.
    pub folder: PathBuf,
}

impl Dependencies {
    /// Returns the dependencies from the cache, building them if necessary.
    pub fn prepare(workspace: &Workspace, toolchain: &Toolchain) -> Result<Self, Error> {
        let key = cache_key(workspace, toolchain)?;
        let cache = cache_folder(workspace).join(&key[..16]);
        prepare_once(&cache, &EXTERNS, || {
            print_error_line(
                "Compiling the submissions' dependencies, which takes a few seconds and happens \
                 only once.",
            );
            build(&FRAMEWORK_PACKAGES, workspace, toolchain)
        })
    }

    /// Returns the dependencies together with additional crates from the lock file. Only the
    /// course's own solutions are built with these crates, never a submission.
    pub fn with_crates(
        names: &[String],
        workspace: &Workspace,
        toolchain: &Toolchain,
    ) -> Result<Self, Error> {
        let key = cache_key(workspace, toolchain)?;
        let cache = cache_folder(workspace).join(format!("{}-{}", &key[..16], names.join("-")));
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        prepare_once(&cache, &[&EXTERNS[..], &names].concat(), || {
            let mut libraries = build(&FRAMEWORK_PACKAGES, workspace, toolchain)?;
            let packages: Vec<&str> = names.iter().flat_map(|name| ["--package", name]).collect();
            libraries.extend(build(&packages, workspace, toolchain)?);
            Ok(libraries)
        })
    }

    /// Returns the dependencies together with crates from this workspace. `packages` are their names
    /// and folders. Everything is built in one cargo call, so that all crates share the same build
    /// of `framework`.
    pub fn with_packages(
        packages: &[(&str, &str)],
        workspace: &Workspace,
        toolchain: &Toolchain,
    ) -> Result<Self, Error> {
        let mut hash = ContentHash::default().with(cache_key(workspace, toolchain)?.as_bytes());
        for (_, folder) in packages {
            let folder = workspace.root().join(folder);
            let mut sources = vec![folder.join("Cargo.toml")];
            list_sources(&folder.join("src"), &mut sources)?;
            for file in sources {
                hash.add(&files::read(&file)?);
            }
        }
        let names: Vec<&str> = packages.iter().map(|(name, _)| *name).collect();
        let cache = format!("{}-{}", &hash.hex()[..16], names.join("-"));
        let cache = cache_folder(workspace).join(cache);
        let crates: Vec<String> = names.iter().map(|name| name.replace('-', "_")).collect();
        let crates = crates.iter().map(String::as_str);
        let externs: Vec<&str> = EXTERNS.into_iter().chain(crates).collect();
        prepare_once(&cache, &externs, || {
            let selected = names.iter().flat_map(|name| ["--package", name]);
            let selected: Vec<&str> = FRAMEWORK_PACKAGES.into_iter().chain(selected).collect();
            build(&selected, workspace, toolchain)
        })
    }
}

fn cache_folder(workspace: &Workspace) -> PathBuf {
    workspace.cache_folder().join("dependencies")
}

/// Returns the dependencies in this folder, building them there if necessary. Existing files are
/// never rebuilt, because another process may be reading them. `externs` are the crates that a
/// submission may import.
fn prepare_once(
    cache: &Path,
    externs: &[&str],
    build: impl FnOnce() -> Result<Vec<(String, PathBuf)>, Error>,
) -> Result<Dependencies, Error> {
    let record = cache.join("dependencies.json");
    if let Some(ready) = read(&record) {
        return Ok(ready);
    }

    let _lock = lock(cache)?;
    // Another process may have built the dependencies while this one waited.
    if let Some(ready) = read(&record) {
        return Ok(ready);
    }
    let built = copy(build()?, externs, &cache.join("crates"))?;
    let text = serde_json::to_vec_pretty(&built).expect("paths are valid UTF-8");
    files::write(&record, text)?;
    Ok(built)
}

/// Locks this folder until the returned file is dropped.
fn lock(cache: &Path) -> Result<File, Error> {
    files::create_dir_all(cache)?;
    let path = cache.join("lock");
    let lock = File::create(&path).at("create", &path)?;
    lock.lock().at("lock", &path)?;
    Ok(lock)
}

fn read(record: &Path) -> Option<Dependencies> {
    let ready: Dependencies = serde_json::from_slice(&fs::read(record).ok()?).ok()?;
    ready
        .externs
        .values()
        .all(|rlib| rlib.is_file())
        .then_some(ready)
}

/// Returns a hash of everything the compiled dependencies depend on: the compiler, the lock file
/// and the sources.
fn cache_key(workspace: &Workspace, toolchain: &Toolchain) -> Result<String, Error> {
    let mut hash = ContentHash::default()
        .with(RECIPE_VERSION.as_bytes())
        .with(toolchain.fingerprint().as_bytes());
    let files = ["Cargo.lock", "grader/workspace-hack/Cargo.toml"];
    let mut files: Vec<PathBuf> = files.map(|file| workspace.root().join(file)).into();
    for folder in ["protocol", "framework"] {
        let folder = workspace.root().join("student").join(folder);
        files.push(folder.join("Cargo.toml"));
        list_sources(&folder.join("src"), &mut files)?;
    }
    for file in files {
        let name = file.strip_prefix(workspace.root()).unwrap_or(&file);
        hash.add(name.as_os_str().as_encoded_bytes());
        hash.add(&files::read(&file)?);
    }
    Ok(hash.hex())
}

fn list_sources(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Error> {
    for path in files::read_dir(folder)? {
        if path.is_dir() {
            list_sources(&path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}

/// Builds packages with cargo. Uses the network only if necessary. `package` contains the cargo
/// arguments that select the packages. Returns the name and the library of each crate.
fn build(
    package: &[&str],
    workspace: &Workspace,
    toolchain: &Toolchain,
) -> Result<Vec<(String, PathBuf)>, Error> {
    let run = |offline: bool| {
        let mut cargo = system::command_killed_at_eof(&toolchain.cargo);
        cargo
            .arg("build")
            .args(package)
            .args([
                "--release",
                "--locked",
                "--message-format=json-render-diagnostics",
            ])
            .args(offline.then_some("--offline"))
            .current_dir(workspace.root())
            .stderr(if offline {
                Stdio::null()
            } else {
                Stdio::inherit()
            });
        // Use the same flags on every machine, regardless of the environment and cargo's
        // configuration. They match the profile in Cargo.toml. With other flags, cargo would
        // recompile the crates that it has already compiled for the grader.
        cargo
            .env("CARGO_ENCODED_RUSTFLAGS", "")
            .env_remove("RUSTC_WRAPPER")
            .env_remove("RUSTC_WORKSPACE_WRAPPER")
            .env("RUSTC", &toolchain.rustc)
            .env("CARGO_INCREMENTAL", "0")
            .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "2")
            .env("CARGO_PROFILE_RELEASE_DEBUG", "false")
            .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "1")
            .env("CARGO_PROFILE_RELEASE_LTO", "false")
            .env("CARGO_PROFILE_RELEASE_PANIC", "unwind");
        output(&mut cargo).at("run", &toolchain.cargo)
    };
    let mut output = run(true)?;
    if !output.status.success() {
        output = run(false)?;
    }
    if !output.status.success() {
        return Err(Error::machine(
            "cargo could not build student/framework (see its messages above); the first run needs \
             network access",
        ));
    }
    Ok(libraries(&String::from_utf8_lossy(&output.stdout)))
}

/// Runs the command and returns its output. The command's standard input is kept open until the
/// command ends, because closing it would kill the command.
fn output(cargo: &mut Command) -> io::Result<Output> {
    let mut child = cargo.stdout(Stdio::piped()).spawn()?;
    let tie = child.stdin.take();
    let output = child.wait_with_output();
    drop(tie);
    output
}

/// Finds each crate's library in cargo's messages, which are one JSON value per line. For a
/// procedural macro, the library is dynamic, and rustc needs it even though nothing is linked with
/// it.
fn libraries(messages: &str) -> Vec<(String, PathBuf)> {
    messages
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .filter(|message| message["reason"] == "compiler-artifact")
        .filter_map(|message| {
            let files = message["filenames"].as_array()?;
            let library = files
                .iter()
                .filter_map(Value::as_str)
                .find(|file| file.ends_with(".rlib") || file.ends_with(DLL_SUFFIX))?;
            Some((
                message["target"]["name"].as_str()?.to_owned(),
                library.into(),
            ))
        })
        .collect()
}

/// Copies all libraries into one folder. `names` are the crates that a submission may import.
fn copy(
    libraries: Vec<(String, PathBuf)>,
    names: &[&str],
    folder: &Path,
) -> Result<Dependencies, Error> {
    files::create_dir_all(folder)?;
    let mut externs = BTreeMap::new();
    for (name, library) in libraries {
        let copy = folder.join(library.file_name().expect("cargo prints paths of files"));
        files::copy(&library, &copy)?;
        if names.contains(&&*name) {
            externs.insert(name, copy);
        }
    }
    if let Some(name) = names.iter().find(|name| !externs.contains_key(**name)) {
        return Err(Error::Machine(format!(
            "cargo did not build the crate {name}: has student/framework been changed?"
        )));
    }
    Ok(Dependencies {
        externs,
        folder: folder.to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Barrier;
    use std::sync::atomic::{AtomicU32, Ordering};
    use std::thread;

    use super::*;

    #[test]
    fn concurrent_callers_build_the_dependencies_once() {
        let folder = tempfile::tempdir().unwrap();
        let cache = folder.path().join("key");
        let built = AtomicU32::new(0);
        let all_at_once = Barrier::new(8);
        let build = || {
            built.fetch_add(1, Ordering::SeqCst);
            let rlib = folder.path().join("libglam.rlib");
            files::write(&rlib, "a library")?;
            Ok(vec![("glam".to_owned(), rlib)])
        };
        thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    all_at_once.wait();
                    prepare_once(&cache, &["glam"], build).unwrap();
                });
            }
        });
        assert_eq!(built.load(Ordering::SeqCst), 1, "number of builds");
    }
}
