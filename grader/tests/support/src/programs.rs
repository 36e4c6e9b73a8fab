//! Programs that stand in for others, such as a linker that fails.

use std::env;
use std::ffi::OsString;
use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

/// Writes an executable shell script and creates its folder.
pub fn write_program(path: &Path, script: &str) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, format!("#!/bin/sh\n{script}")).unwrap();
    make_executable(path);
}

/// Makes a file executable.
pub fn make_executable(path: &Path) {
    fs::set_permissions(path, Permissions::from_mode(0o755)).unwrap();
}

/// Returns `PATH` with this folder of programs added at the front.
pub fn path_with(programs: &Path) -> OsString {
    let path = env::var_os("PATH").unwrap_or_default();
    let own: PathBuf = programs.to_owned();
    env::join_paths([own].into_iter().chain(env::split_paths(&path))).unwrap()
}
