//! The test harness: builds a submission, runs the grader on it and reads the results.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use grader::handed_out::{HandedOut, RAYS};
use serde_json::Value;
use tempfile::TempDir;

/// The points for each task, keyed by the task's id.
pub type Points = BTreeMap<String, u64>;

/// The full points for each task.
pub static FULL_POINTS: LazyLock<Points> = LazyLock::new(|| {
    let tasks = RAYS.assignment.tasks.iter();
    tasks
        .map(|task| (task.id.to_owned(), u64::from(task.points)))
        .collect()
});

/// Returns the root folder of the workspace.
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Creates a workspace with links to the files of this one. Tests can write more files into it.
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
        Submission::reference_of(name, &RAYS)
    }

    /// Copies the task files of the starter.
    pub fn starter(name: &str) -> Self {
        Submission::copy_of(name, &RAYS, RAYS.starter)
    }

    /// Copies the task files of an assignment's reference.
    pub fn reference_of(name: &str, handed_out: &HandedOut) -> Self {
        Submission::copy_of(name, handed_out, handed_out.reference)
    }

    fn copy_of(name: &str, handed_out: &HandedOut, source: &str) -> Self {
        let source = workspace().join(source);
        let submission = Submission {
            folder: TempDir::new().unwrap(),
            name: name.to_owned(),
        };
        fs::create_dir(submission.path()).unwrap();
        for file in handed_out.file_names() {
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

    /// Replaces text in a file. Panics unless the file contains it exactly once.
    pub fn with_replaced(self, file: &str, from: &str, to: &str) -> Self {
        let text = fs::read_to_string(self.path().join(file)).unwrap();
        let count = text.matches(from).count();
        assert_eq!(count, 1, "{file} contains {from:?} {count} times");
        self.with(file, text.replace(from, to))
    }

    /// Writes a file next to the task files. Returns the option that names it.
    pub fn file_option(&self, option: &str, file: &str, text: impl AsRef<[u8]>) -> [String; 2] {
        let path = self.path().join(file);
        fs::write(&path, text).unwrap();
        [option.to_owned(), path.to_str().unwrap().to_owned()]
    }

    /// Grades as on a student's machine, without the reference.
    pub fn grade(&self) -> GradeRun {
        self.run(&mut self.command())
    }

    /// Grades as on a student's machine, with additional arguments.
    pub fn grade_with(&self, arguments: &[impl AsRef<OsStr>]) -> GradeRun {
        self.run(self.command().args(arguments))
    }

    /// Grades as on a staff machine, with the reference.
    pub fn grade_with_reference(&self) -> GradeRun {
        self.run(&mut grade_into(&self.path(), &self.out()))
    }

    /// Grades with and without the reference. Items that take longer than a second are stopped.
    pub fn grade_impatiently(&self) -> [GradeRun; 2] {
        let mut with_reference = grade_into(&self.path(), &self.out());
        let limit = ["--cpu-limit", "1"];
        let with_reference = self.run(with_reference.args(limit));
        [with_reference, self.grade_with(&limit)]
    }

    /// Returns the folder for the outputs.
    pub fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    /// Returns the command that grades as on a student's machine, without the reference.
    pub fn command(&self) -> Command {
        let mut command = grade_into(&self.path(), &self.out());
        command.arg("--no-reference");
        command
    }

    /// Runs a command that grades this submission.
    pub fn run(&self, command: &mut Command) -> GradeRun {
        self.results(command.output().unwrap())
    }

    /// Reads the results of running [`Submission::command`].
    pub fn results(&self, output: Output) -> GradeRun {
        GradeRun {
            output,
            submission: self.path(),
            score: fs::read(self.out().join("score.json")).ok(),
            page: fs::read_to_string(self.out().join("report.html")).ok(),
        }
    }
}

/// Returns a command that runs the grader in the workspace folder.
pub fn grader() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.current_dir(workspace());
    command
}

/// Returns a command that grades a folder or an archive and writes the outputs into a folder.
pub fn grade_into(submission: &Path, out: &Path) -> Command {
    let mut command = grader();
    command.arg(submission).arg("--out").arg(out);
    command
}

/// Returns a command's program and arguments as a shell command line.
#[cfg(unix)]
pub fn shell_line(command: &Command) -> String {
    let words = [command.get_program()]
        .into_iter()
        .chain(command.get_args());
    let quoted: Vec<String> = words.map(|word| format!("'{}'", word.display())).collect();
    quoted.join(" ")
}

/// Checks that a run ended with this exit code and an error that contains `why`.
#[track_caller]
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
    /// The contents of the score file, if any.
    pub score: Option<Vec<u8>>,
    /// The text of the page, if any.
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

    /// Returns the score of a successful run.
    pub fn score(&self) -> Value {
        assert_eq!(self.exit_code(), 0, "{}", self.error());
        self.written_score()
    }

    /// Returns the score that was written, even if the run failed.
    pub fn written_score(&self) -> Value {
        let score = self.score.as_ref().expect("a score was written");
        serde_json::from_slice(score).unwrap()
    }

    /// Returns the scores of the tasks, in lecture order.
    pub fn tasks(&self) -> Vec<Value> {
        self.score()["tasks"].as_array().unwrap().clone()
    }

    /// Returns the points of each task.
    pub fn points(&self) -> Points {
        let id = |task: &Value| task["id"].as_str().unwrap().to_owned();
        let tasks = self.tasks().into_iter();
        tasks
            .map(|task| (id(&task), task["points"].as_u64().unwrap()))
            .collect()
    }

    /// Returns the scores of a task's items.
    pub fn items(&self, task: &str) -> Vec<Value> {
        let mut tasks = self.tasks().into_iter();
        let task = tasks.find(|scores| scores["id"] == task).unwrap();
        task["items"].as_array().unwrap().clone()
    }

    /// Returns the scores of all items.
    pub fn all_items(&self) -> Vec<Value> {
        let items = |task: Value| task["items"].as_array().unwrap().clone();
        self.tasks().into_iter().flat_map(items).collect()
    }

    /// Returns the texts with this key in a task's items.
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

/// Returns 0 points for these tasks and the full points for all others.
pub fn full_points_except(zero: &[&str]) -> Points {
    let mut points = FULL_POINTS.clone();
    for task in zero {
        *points.get_mut(*task).unwrap() = 0;
    }
    points
}

/// Returns 0 points for each task.
pub fn no_points() -> Points {
    let ids: Vec<&str> = RAYS.assignment.tasks.iter().map(|task| task.id).collect();
    full_points_except(&ids)
}

/// Returns the points of all tasks except these.
pub fn without(mut points: Points, tasks: &[&str]) -> Points {
    points.retain(|task, _| !tasks.contains(&task.as_str()));
    points
}
