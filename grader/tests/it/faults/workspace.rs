//! A copy of the workspace with its own `target/`.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use test_support::programs::write_program;

use crate::cases::compile_dependencies;
use crate::harness;

/// A copy of the workspace. The copy is deleted when this value is dropped.
pub struct WorkspaceCopy {
    folder: TempDir,
}

impl WorkspaceCopy {
    pub fn new() -> Self {
        let copy = WorkspaceCopy {
            folder: TempDir::new().unwrap(),
        };
        let original = harness::workspace().canonicalize().unwrap();
        fs::create_dir(copy.path().join("grader")).unwrap();
        for folder in ["student", "grader/workspace-hack"] {
            symlink(original.join(folder), copy.path().join(folder)).unwrap();
        }
        fs::copy(original.join("Cargo.lock"), copy.path().join("Cargo.lock")).unwrap();
        copy
    }

    /// Creates a copy that shares the compiled dependencies of this workspace.
    pub fn with_dependencies() -> Self {
        compile_dependencies();
        let copy = WorkspaceCopy::new();
        let original = harness::workspace().canonicalize().unwrap();
        fs::create_dir_all(copy.path().join("target/grade/.cache")).unwrap();
        let dependencies = "target/grade/.cache/dependencies";
        symlink(original.join(dependencies), copy.path().join(dependencies)).unwrap();
        copy
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Creates a fake toolchain in the copy, with this shell script as its cargo. Returns the path
    /// of the script.
    pub fn fake_cargo(&self, script: &str) -> PathBuf {
        let tools = self.path().join("tools");
        for (name, script) in [("rustc", ""), ("cargo", script)] {
            write_program(&tools.join(name), script);
        }
        tools.join("cargo")
    }
}
