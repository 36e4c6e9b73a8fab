//! The baseline: one `rustc` call for the five task files and the given `lib.rs` and
//! `primitive.rs`. All their dependencies are already compiled.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Creates bare `rustc` calls, with or without code generation.
pub struct BareRustc {
    dependencies: Value,
}

impl BareRustc {
    /// Prepares calls that use the dependencies compiled for the most recent grading run.
    pub fn prepare(cache: &Path) -> Self {
        BareRustc {
            dependencies: newest(cache),
        }
    }

    /// Returns the command that compiles the five files.
    pub fn compile(&self, folder: &Path) -> Command {
        self.rustc(
            folder,
            &["--crate-name=baseline", "--crate-type=rlib", "lib.rs"],
        )
    }

    /// Returns the command that checks the five files for errors.
    pub fn check(&self, folder: &Path) -> Command {
        let mut command = self.compile(folder);
        command.arg("--emit=metadata");
        command
    }

    /// Returns the command that compiles the five files to a program, with `root` as the crate
    /// root.
    pub fn program(&self, folder: &Path, root: &str) -> Command {
        self.rustc(folder, &["--crate-type=bin", root])
    }

    fn rustc(&self, folder: &Path, arguments: &[&str]) -> Command {
        // This bypasses rustup's proxy, which takes 8 ms.
        let rustc = Path::new(env!("CARGO")).with_file_name("rustc");
        let mut command = Command::new(rustc);
        command.current_dir(folder);
        command.arg("--edition=2024").args(arguments);
        command.args(["-Copt-level=2", "-Ccodegen-units=1", "-Cdebuginfo=0"]);
        command.args(["-Coverflow-checks=on", "-Awarnings"]);
        let text = |value: &Value| value.as_str().expect("the value is a path").to_owned();
        let folder = text(&self.dependencies["folder"]);
        command.arg(format!("-Ldependency={folder}"));
        let externs = self.dependencies["externs"].as_object();
        for (name, rlib) in externs.expect("the value is a map") {
            command
                .arg("--extern")
                .arg(format!("{name}={}", text(rlib)));
        }
        command
    }
}

fn newest(cache: &Path) -> Value {
    let entries = fs::read_dir(cache)
        .expect("a grade has filled the cache")
        .flatten();
    let records = entries.map(|entry| entry.path().join("dependencies.json"));
    let newest: Option<PathBuf> = records
        .filter(|record| record.is_file())
        .max_by_key(|record| fs::metadata(record).and_then(|file| file.modified()).ok());
    let text =
        fs::read(newest.expect("a grade has filled the cache")).expect("the record can be read");
    serde_json::from_slice(&text).expect("the grader wrote valid JSON")
}
