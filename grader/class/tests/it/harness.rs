//! Classes made on the spot, a small exam for them, and the program that grades them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

pub const TASK_FILES: [&str; 5] = ["camera.rs", "triangle.rs", "sphere.rs", "bbox.rs", "bvh.rs"];

/// The folder of the whole project.
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A folder for a class and what comes of it, which vanishes.
pub struct TestClass {
    folder: TempDir,
    pub name: String,
}

impl TestClass {
    /// A class in a folder of this name.
    pub fn named(name: &str) -> Self {
        let place = TestClass {
            folder: TempDir::new().unwrap(),
            name: name.to_owned(),
        };
        fs::create_dir(place.input()).unwrap();
        place
    }

    pub fn input(&self) -> PathBuf {
        self.folder.path().join(&self.name)
    }

    /// A path beside the class.
    pub fn path_beside(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Puts a file into the class.
    pub fn with(self, path: &str, bytes: impl AsRef<[u8]>) -> Self {
        let path = self.input().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
        self
    }

    /// Puts five files of one word each into the class, for whoever only looks.
    pub fn with_minimal_submission(self, folder: &str) -> Self {
        TASK_FILES.iter().fold(self, |place, file| {
            let path = match folder {
                "" => (*file).to_owned(),
                folder => format!("{folder}/{file}"),
            };
            place.with(&path, "text")
        })
    }

    /// Puts the reference's five files into the class.
    pub fn with_reference(self, folder: &str) -> Self {
        self.with_files_of("reference/src", folder)
    }

    /// Puts the starter's five files into the class.
    pub fn with_starter(self, folder: &str) -> Self {
        self.with_files_of("grader/starter", folder)
    }

    fn with_files_of(self, source: &str, folder: &str) -> Self {
        TASK_FILES.iter().fold(self, |place, file| {
            let text = fs::read(workspace().join(source).join(file)).unwrap();
            place.with(&format!("{folder}/{file}"), text)
        })
    }

    /// An empty folder of the class.
    pub fn with_folder(self, name: &str) -> Self {
        fs::create_dir_all(self.input().join(name)).unwrap();
        self
    }

    /// Replaces text that must be there.
    pub fn with_replaced(self, path: &str, from: &str, to: &str) -> Self {
        let text = fs::read_to_string(self.input().join(path)).unwrap();
        assert!(text.contains(from), "{path} has no {from:?} any more");
        self.with(path, text.replace(from, to))
    }

    /// Writes a file beside the class.
    pub fn write_beside(&self, name: &str, text: &str) -> String {
        let path = self.path_beside(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    }

    /// An exam of these items of the practice exam alone: most tests need no more.
    pub fn small_exam(&self, items: &[&str]) -> String {
        let path = workspace().join("grader/exams/practice.json");
        let mut exam: Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
        let all = exam["items"].as_array_mut().unwrap();
        all.retain(|item| items.contains(&item["id"].as_str().unwrap()));
        assert_eq!(
            all.len(),
            items.len(),
            "an item is not in the exam any more"
        );
        for item in all.iter_mut() {
            item["needs"] = Value::Array(Vec::new());
        }
        exam["id"] = "small".into();
        self.write_beside("exam.json", &exam.to_string())
    }

    /// Who would be graded from what.
    pub fn preview(&self) -> String {
        self.preview_of(&self.input(), &[])
    }

    pub fn preview_of(&self, input: &Path, more: &[&str]) -> String {
        let output = class_command()
            .arg(input)
            .arg("--dry-run")
            .args(more)
            .output()
            .unwrap();
        successful_stdout(&output);
        String::from_utf8(output.stdout)
            .unwrap()
            .trim_matches('\n')
            .to_owned()
    }

    /// Grades the class into `out` beside it.
    pub fn grade(&self, exam: &str, more: &[&str]) -> Output {
        self.command(exam, more).output().unwrap()
    }

    pub fn command(&self, exam: &str, more: &[&str]) -> Command {
        let mut command = class_command();
        command
            .arg(self.input())
            .arg("--out")
            .arg(self.out())
            // What is kept apart from what is the grader's own tests' matter.
            .args(["--exam", exam, "--no-reference", "--isolation", "none"])
            .args(more);
        command
    }

    pub fn out(&self) -> PathBuf {
        self.path_beside("out")
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.out().join(name)).unwrap()
    }
}

/// The program itself, run from the workspace's folder.
pub fn class_command() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_class"));
    command.current_dir(workspace());
    command
}

/// What a run said; it must have gone well.
pub fn successful_stdout(output: &Output) -> String {
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{error}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// What a run complained of, and its exit code.
pub fn exit_code_and_stderr(output: &Output) -> (i32, String) {
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code().unwrap(), error)
}

/// All files below a folder but for what no two runs have alike: how long it took.
pub fn comparable_files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    collect_files(folder, folder, &mut files);
    files
}

fn collect_files(root: &Path, folder: &Path, files: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect_files(root, &path, files);
            continue;
        }
        let mut bytes = fs::read(&path).unwrap();
        if path.ends_with("score.json") {
            let mut score: Value = serde_json::from_slice(&bytes).unwrap();
            score["timings"] = Value::Null;
            bytes = serde_json::to_vec(&score).unwrap();
        }
        files.insert(path.strip_prefix(root).unwrap().to_owned(), bytes);
    }
}
