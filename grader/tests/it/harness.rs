//! The test harness: builds a submission, runs the grader on it, and reads the results.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use grader::handed_out::RAYS;
use serde_json::Value;
use tempfile::TempDir;

/// The full points of each task, in lecture order.
pub static FULL_POINTS: LazyLock<Vec<u64>> = LazyLock::new(|| {
    let tasks = RAYS.assignment.tasks.iter();
    tasks.map(|task| u64::from(task.points)).collect()
});

/// Returns the root folder of the workspace.
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Creates a workspace with the files of this one, into which a test can write more.
#[cfg(unix)]
pub fn linked_workspace() -> TempDir {
    let folder = TempDir::new().unwrap();
    let root = workspace().canonicalize().unwrap();
    for name in ["Cargo.toml", "Cargo.lock", "student", "grader", "target"] {
        std::os::unix::fs::symlink(root.join(name), folder.path().join(name)).unwrap();
    }
    folder
}

/// A submission in a temporary folder. The folder is deleted when this is dropped.
pub struct Submission {
    folder: TempDir,
    name: String,
}

impl Submission {
    /// Creates a submission in a folder called `name`, with the reference's task files.
    pub fn reference(name: &str) -> Self {
        Submission::copy_of(name, &workspace().join("reference/src"))
    }

    /// Copies the task files of the starter.
    pub fn starter(name: &str) -> Self {
        Submission::copy_of(name, &workspace().join("grader/starter"))
    }

    fn copy_of(name: &str, source: &Path) -> Self {
        let submission = Submission {
            folder: TempDir::new().unwrap(),
            name: name.to_owned(),
        };
        fs::create_dir(submission.path()).unwrap();
        for file in RAYS.file_names() {
            fs::copy(source.join(file), submission.path().join(file)).unwrap();
        }
        submission
    }

    pub fn path(&self) -> PathBuf {
        self.folder.path().join(&self.name)
    }

    pub fn with(self, file: &str, text: impl AsRef<[u8]>) -> Self {
        let path = self.path().join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
        self
    }

    pub fn without(self, file: &str) -> Self {
        fs::remove_file(self.path().join(file)).unwrap();
        self
    }

    /// Replaces text in a file, and panics unless the file contains it exactly once.
    pub fn with_replaced(self, file: &str, from: &str, to: &str) -> Self {
        let text = fs::read_to_string(self.path().join(file)).unwrap();
        let count = text.matches(from).count();
        assert_eq!(count, 1, "{file} contains {from:?} {count} times");
        self.with(file, text.replace(from, to))
    }

    /// Grades as on a student's machine, without the reference.
    pub fn grade(&self) -> GradeRun {
        self.grade_with(&[])
    }

    /// Grades as on a student's machine, with additional arguments.
    pub fn grade_with(&self, arguments: &[&str]) -> GradeRun {
        self.run(&[&["--no-reference"], arguments].concat())
    }

    /// Grades as on a staff machine, with the reference.
    pub fn grade_with_reference(&self) -> GradeRun {
        self.run(&[])
    }

    fn run(&self, arguments: &[&str]) -> GradeRun {
        let out = self.folder.path().join("out");
        let output = grader()
            .arg(self.path())
            .arg("--out")
            .arg(&out)
            .args(arguments)
            .output()
            .unwrap();
        GradeRun {
            output,
            submission: self.path(),
            score: fs::read(out.join("score.json")).ok(),
            page: fs::read_to_string(out.join("report.html")).ok(),
        }
    }
}

/// Returns a command that runs the grader in the workspace folder.
pub fn grader() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.current_dir(workspace());
    command
}

/// Checks that a run ended with this exit code and an error that contains `why`.
pub fn assert_fails(output: &Output, code: i32, why: &str) {
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(error.contains(why), "{why}: {error}");
    assert_eq!(output.status.code(), Some(code), "{error}");
}

/// The results of one run of the grader.
pub struct GradeRun {
    pub output: Output,
    /// The folder of the submission.
    submission: PathBuf,
    /// The contents of the score file, if there is one.
    pub score: Option<Vec<u8>>,
    /// The text of the page, if there is one.
    page: Option<String>,
}

impl GradeRun {
    pub fn exit_code(&self) -> i32 {
        self.output
            .status
            .code()
            .expect("the grader was not killed")
    }

    /// Returns the terminal report without the paths of the written files.
    pub fn report(&self) -> String {
        let text = String::from_utf8(self.output.stdout.clone()).unwrap();
        // The reported commands name the submission's folder, which differs in each run.
        let text = text.replace(&*self.submission.to_string_lossy(), "SUBMISSION");
        let is_place = |line: &&str| line.ends_with("score.json") || line.ends_with("report.html");
        let lines: Vec<&str> = text.lines().filter(|line| !is_place(line)).collect();
        lines.join("\n").trim_matches('\n').to_owned()
    }

    pub fn error(&self) -> String {
        String::from_utf8(self.output.stderr.clone()).unwrap()
    }

    pub fn page(&self) -> &str {
        self.page.as_deref().expect("a page was written")
    }

    pub fn score(&self) -> Value {
        assert_eq!(self.exit_code(), 0, "{}", self.error());
        serde_json::from_slice(self.score.as_ref().unwrap()).unwrap()
    }

    /// Returns the points of each task, in lecture order.
    pub fn points(&self) -> Vec<u64> {
        let score = self.score();
        let tasks = score["tasks"].as_array().unwrap();
        tasks
            .iter()
            .map(|task| task["points"].as_u64().unwrap())
            .collect()
    }

    /// Returns the scores of a task's items.
    pub fn items(&self, task: &str) -> Vec<Value> {
        let score = self.score();
        let mut tasks = score["tasks"].as_array().unwrap().iter();
        let task = tasks.find(|scores| scores["id"] == task).unwrap();
        task["items"].as_array().unwrap().clone()
    }

    /// Returns the texts with this key of a task's items.
    pub fn texts(&self, task: &str, key: &str) -> Vec<String> {
        let text = |item: &Value| item[key].as_str().unwrap().to_owned();
        self.items(task).iter().map(text).collect()
    }

    /// Returns the distinct verdicts of a task's items, sorted.
    pub fn verdicts(&self, task: &str) -> Vec<String> {
        let mut verdicts = self.texts(task, "verdict");
        verdicts.sort();
        verdicts.dedup();
        verdicts
    }
}

/// The positions of tasks in lecture order.
pub const TRIANGLE: usize = 1;
pub const SPHERE: usize = 2;
pub const BBOX: usize = 3;
pub const BUILD: usize = 4;
pub const TRAVERSE: usize = 5;

/// Returns the full points of each task, but 0 for the tasks with these indices in lecture order.
pub fn full_points_except(zero: &[usize]) -> Vec<u64> {
    let mut points = FULL_POINTS.to_vec();
    zero.iter().for_each(|&task| points[task] = 0);
    points
}

/// Returns the points of all tasks except the faulty one.
pub fn points_of_other_tasks(points: &[u64], fault: usize) -> u64 {
    points.iter().sum::<u64>() - points[fault]
}
