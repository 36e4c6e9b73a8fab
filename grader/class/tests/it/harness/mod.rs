//! Test classes, a small exam for them, and functions that run the binary.

mod files;

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use grader::handed_out::RAYS;
use serde_json::Value;
use tempfile::TempDir;

pub use files::{comparable_files, files_below, unzip, zip};

/// Returns the root folder of the repository.
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A temporary folder with a class and its results.
pub struct TestClass {
    folder: TempDir,
    pub name: String,
}

impl TestClass {
    /// Creates a class in a folder with this name.
    pub fn named(name: &str) -> Self {
        let class = TestClass {
            folder: TempDir::new().unwrap(),
            name: name.to_owned(),
        };
        fs::create_dir(class.input()).unwrap();
        class
    }

    /// Creates a class of three submissions, in a folder with the kind of name that Moodle uses.
    pub fn of_three() -> Self {
        TestClass::named("CG-Path tracing (2)")
            .with_reference("ann")
            .with_starter("bob")
            .with("carl.zip", "no archive")
    }

    pub fn input(&self) -> PathBuf {
        self.folder.path().join(&self.name)
    }

    /// Returns a path next to the class's folder.
    pub fn path_beside(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Adds a file to the class.
    pub fn with(self, path: &str, bytes: impl AsRef<[u8]>) -> Self {
        let path = self.input().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
        self
    }

    /// Adds a minimal submission, for tests that never compile it.
    pub fn with_minimal_submission(self, folder: &str) -> Self {
        RAYS.file_names().fold(self, |class, file| {
            let path = match folder {
                "" => (*file).to_owned(),
                folder => format!("{folder}/{file}"),
            };
            class.with(&path, "text")
        })
    }

    /// Adds a submission with the reference's task files.
    pub fn with_reference(self, folder: &str) -> Self {
        self.with_files_of("reference/src", folder)
    }

    /// Adds a submission with the starter's task files.
    pub fn with_starter(self, folder: &str) -> Self {
        self.with_files_of("grader/starter", folder)
    }

    /// Adds a submission that ignores the offset within a pixel.
    pub fn with_offset_mistake(self, folder: &str) -> Self {
        let file = format!("{folder}/camera.rs");
        let class = self.with_reference(folder);
        class.with_replaced(&file, "pixel.as_vec2() + offset", "pixel.as_vec2() + 0.5")
    }

    fn with_files_of(self, source: &str, folder: &str) -> Self {
        RAYS.file_names().fold(self, |class, file| {
            let text = self::source(&format!("{source}/{file}"));
            class.with(&format!("{folder}/{file}"), text)
        })
    }

    /// Adds an empty folder to the class.
    pub fn with_folder(self, name: &str) -> Self {
        fs::create_dir_all(self.input().join(name)).unwrap();
        self
    }

    /// Replaces text in a file. Panics if the file doesn't contain it.
    pub fn with_replaced(self, path: &str, from: &str, to: &str) -> Self {
        let text = fs::read_to_string(self.input().join(path)).unwrap();
        assert!(text.contains(from), "{path} no longer contains {from:?}");
        self.with(path, text.replace(from, to))
    }

    /// Writes a byte order mark at the beginning of a file.
    pub fn with_byte_order_mark(self, path: &str) -> Self {
        let text = fs::read_to_string(self.input().join(path)).unwrap();
        self.with(path, format!("\u{feff}{text}"))
    }

    /// Writes a file next to the class's folder. Returns its path.
    pub fn write_beside(&self, name: &str, text: &str) -> String {
        let path = self.path_beside(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    }

    /// Writes an exam with only these items from the practice exam, so that grading is fast.
    /// Returns the path of the exam.
    pub fn small_exam(&self, items: &[&str]) -> String {
        let path = workspace().join("grader/exams/practice.json");
        let mut exam: Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
        let all = exam["items"].as_array_mut().unwrap();
        all.retain(|item| items.contains(&item["id"].as_str().unwrap()));
        assert_eq!(
            all.len(),
            items.len(),
            "every item must be in the practice exam"
        );
        for item in all.iter_mut() {
            item["needs"] = Value::Array(Vec::new());
            // Tests take points away from this item, so it must have two, whatever the practice
            // exam says.
            if item["id"] == "camera.offset" {
                item["points"] = 2.into();
            }
        }
        exam["id"] = "small".into();
        self.write_beside("exam.json", &exam.to_string())
    }

    /// Returns the output of `--dry-run`.
    pub fn preview(&self) -> String {
        self.previewed(&[])
    }

    /// Previews the class with lists and additional options.
    pub fn previewed_with(&self, lists: &[(&str, &str)], more: &[&str]) -> String {
        let lists = self.lists(lists);
        let lists: Vec<&str> = lists.iter().map(String::as_str).collect();
        self.previewed(&[&lists, more].concat())
    }

    /// Previews the class with additional options.
    pub fn previewed(&self, more: &[&str]) -> String {
        self.preview_of(&self.input(), more)
    }

    pub fn preview_of(&self, input: &Path, more: &[&str]) -> String {
        let mut command = class_command();
        command.arg(input).arg("--dry-run").args(more);
        let preview = successful_stdout(&command.output().unwrap());
        preview.trim_matches('\n').to_owned()
    }

    /// Writes lists next to the class. Returns the command-line options for these lists.
    pub fn lists(&self, lists: &[(&str, &str)]) -> Vec<String> {
        let write = |(list, text): &(&str, &str)| {
            let path = self.write_beside(&format!("{list}.list"), text);
            format!("--{list}={path}")
        };
        lists.iter().map(write).collect()
    }

    /// Grades the class with lists and additional options. Returns the standard output.
    pub fn graded_with(&self, exam: &str, lists: &[(&str, &str)], more: &[&str]) -> String {
        let lists = self.lists(lists);
        let lists: Vec<&str> = lists.iter().map(String::as_str).collect();
        self.graded(exam, &[&lists, more].concat())
    }

    /// Grades the class. Returns the standard output.
    pub fn graded(&self, exam: &str, more: &[&str]) -> String {
        successful_stdout(&self.grade(exam, more))
    }

    /// Tries to grade a class that must be refused. Returns the error.
    pub fn refused(&self, exam: &str, more: &[&str]) -> String {
        refusal(&self.grade(exam, more))
    }

    /// Tries to preview a class that must be refused. Returns the error.
    pub fn refused_preview(&self, more: &[&str]) -> String {
        let mut command = class_command();
        command.arg(self.input()).arg("--dry-run").args(more);
        refusal(&command.output().unwrap())
    }

    /// Grades the class into the folder `out` next to it.
    pub fn grade(&self, exam: &str, more: &[&str]) -> Output {
        self.command(exam, more).output().unwrap()
    }

    pub fn command(&self, exam: &str, more: &[&str]) -> Command {
        self.command_into(&self.out(), exam, more)
    }

    /// Reruns a question with `--replay`, using the results in this folder. Returns the output.
    pub fn replay(&self, out: &Path, arguments: &[&str]) -> Output {
        let mut command = class_command();
        command.args(["--isolation", "none", "--replay"]);
        command.args(arguments).arg("--out").arg(out);
        command.output().unwrap()
    }

    /// Returns a command that grades the class into this folder.
    pub fn command_into(&self, out: &Path, exam: &str, more: &[&str]) -> Command {
        let mut command = class_command();
        command
            .arg(self.input())
            .arg("--out")
            .arg(out)
            // Isolation is tested in the grader's own tests.
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

/// Returns the cell in this column of `grades.csv`, in the row with this submission and name.
pub fn cell(class: &TestClass, submission: &str, name: &str, column: &str) -> String {
    let grades = class.read("grades.csv");
    let mut rows = table(&grades).into_iter();
    let row = rows.find(|row| row["submission"] == submission && row["name"] == name);
    row.unwrap_or_else(|| panic!("{submission}, {name}: {grades}"))[column].clone()
}

/// Returns the rows of a table. The cells of each row are keyed by column title.
pub fn table(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(text.trim_start_matches('\u{feff}').as_bytes());
    reader.deserialize().map(Result::unwrap).collect()
}

/// Returns a command for the binary, run in the root folder of the repository.
pub fn class_command() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_class"));
    command.current_dir(workspace());
    command
}

/// Merges shards. Returns the standard output.
pub fn merge(shards: &[impl AsRef<OsStr>], out: &Path) -> String {
    let mut command = class_command();
    command.arg("merge").args(shards).arg("--out").arg(out);
    successful_stdout(&command.output().unwrap())
}

/// Returns the standard output of a run. Panics if the run failed.
pub fn successful_stdout(output: &Output) -> String {
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{error}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Returns the standard error of a run that must be refused.
pub fn refusal(output: &Output) -> String {
    let (code, error) = exit_code_and_stderr(output);
    assert_eq!(code, 2, "{error}");
    error
}

/// Returns the beginning of a preview's line about a submission that contains all task files.
pub fn all_files(who: &str) -> String {
    format!("{who}: all {} files", RAYS.files.len())
}

/// Panics if `text` lacks any of these parts.
#[track_caller]
pub fn assert_contains(text: &str, parts: &[impl AsRef<str>]) {
    for part in parts.iter().map(AsRef::as_ref) {
        assert!(text.contains(part), "{part:?} is not in {text}");
    }
}

/// Returns a zip with the reference's task files.
pub fn solution() -> Vec<u8> {
    let read = |file: &'static str| (file, source(&format!("reference/src/{file}")));
    zip(RAYS.file_names().map(read))
}

/// Returns the text of a file in the repository.
pub fn source(path: &str) -> String {
    fs::read_to_string(workspace().join(path)).unwrap()
}

/// Returns the exit code and the standard error of a run.
pub fn exit_code_and_stderr(output: &Output) -> (i32, String) {
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code().unwrap(), error)
}
