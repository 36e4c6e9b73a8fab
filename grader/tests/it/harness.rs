//! One builder that drives every test: a submission, a command line, what came of it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

pub const TASK_FILES: [&str; 5] = ["camera.rs", "triangle.rs", "sphere.rs", "bbox.rs", "bvh.rs"];

/// The points of camera, triangle, sphere, bbox, build, traverse.
pub const FULL_POINTS: [u64; 6] = [15, 20, 15, 10, 20, 20];

/// The folder of the whole project.
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A submission in a folder of its own, which vanishes with it.
pub struct Submission {
    folder: TempDir,
    name: String,
}

impl Submission {
    /// The five files of the reference.
    pub fn reference(name: &str) -> Self {
        Submission::copy_of(name, &workspace().join("reference/src"))
    }

    /// The five files of the starter.
    pub fn starter(name: &str) -> Self {
        Submission::copy_of(name, &workspace().join("grader/starter"))
    }

    /// The reference, with the files of `tests/submissions/NAME` in place of its own.
    pub fn case(name: &str) -> Self {
        let submission = Submission::reference(name);
        let case = workspace().join("grader/tests/submissions").join(name);
        for entry in fs::read_dir(&case).unwrap().flatten() {
            fs::copy(entry.path(), submission.path().join(entry.file_name())).unwrap();
        }
        submission
    }

    fn copy_of(name: &str, source: &Path) -> Self {
        let submission = Submission {
            folder: TempDir::new().unwrap(),
            name: name.to_owned(),
        };
        fs::create_dir(submission.path()).unwrap();
        for file in TASK_FILES {
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

    /// Replaces text that must be there.
    pub fn with_replaced(self, file: &str, from: &str, to: &str) -> Self {
        let text = fs::read_to_string(self.path().join(file)).unwrap();
        assert!(text.contains(from), "{file} has no {from:?} any more");
        self.with(file, text.replace(from, to))
    }

    /// As on a student's machine.
    pub fn grade(&self) -> GradeRun {
        self.grade_with(&[])
    }

    /// As on a student's machine, with more arguments.
    pub fn grade_with(&self, arguments: &[&str]) -> GradeRun {
        self.run(&[&["--no-reference"], arguments].concat())
    }

    /// As on the staff's machines.
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
        }
    }
}

/// The program itself, run from the workspace's folder.
pub fn grader() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.current_dir(workspace());
    command
}

/// What came of one run.
pub struct GradeRun {
    pub output: Output,
    /// Where the submission lies.
    submission: PathBuf,
    /// The score file's bytes, if there is one.
    pub score: Option<Vec<u8>>,
}

impl GradeRun {
    pub fn exit_code(&self) -> i32 {
        self.output.status.code().expect("it was not killed")
    }

    /// What is read on a terminal, but for the last lines: where the files are.
    pub fn report(&self) -> String {
        let text = String::from_utf8(self.output.stdout.clone()).unwrap();
        // In the commands that it gives: another folder in each run.
        let text = text.replace(&*self.submission.to_string_lossy(), "SUBMISSION");
        let is_place = |line: &&str| line.ends_with("score.json") || line.ends_with("report.html");
        let lines = text.lines().filter(|line| !is_place(line));
        lines
            .collect::<Vec<_>>()
            .join("\n")
            .trim_matches('\n')
            .to_owned()
    }

    pub fn error(&self) -> String {
        String::from_utf8(self.output.stderr.clone()).unwrap()
    }

    pub fn score(&self) -> Value {
        assert_eq!(self.exit_code(), 0, "{}", self.error());
        serde_json::from_slice(self.score.as_ref().unwrap()).unwrap()
    }

    /// The points of each task, in lecture order.
    pub fn points(&self) -> Vec<u64> {
        let score = self.score();
        let tasks = score["tasks"].as_array().unwrap();
        tasks
            .iter()
            .map(|task| task["points"].as_u64().unwrap())
            .collect()
    }

    /// The verdicts of one task's items, each once.
    pub fn verdicts(&self, task: &str) -> Vec<String> {
        let score = self.score();
        let tasks = score["tasks"].as_array().unwrap();
        let task = tasks.iter().find(|scores| scores["id"] == task).unwrap();
        let items = task["items"].as_array().unwrap();
        let mut verdicts: Vec<String> = items
            .iter()
            .map(|item| item["verdict"].as_str().unwrap().to_owned())
            .collect();
        verdicts.sort();
        verdicts.dedup();
        verdicts
    }
}
