//! A grader with recorded scores that starts no processes. A submission's points are determined by
//! the number in its files and by the exam.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicU32, Ordering};

use class::run::Settings;
use class::submission_grader::SubmissionGrader;
use grader::error::Error;
use grader::format::{FormatContext, StudentView, html};
use grader::handed_out::{HandedOut, RAYS};
use grader::options::GradeOptions;
use grader::policy::{Lateness, Policy};
use grader::report_answers::ReportAnswers;
use grader::report_files::ReportFiles;
use grader::score::{Score, Verdict};
use grader::submission::Submission;
use grader::verdict::pending_score;
use judging::exam::Exam;
use judging::exam_file::{self, ExamName};
use serde_json::Value;

/// The number of items in an exam, each from a different task.
const ITEMS: usize = 3;
/// The number of exams.
pub const EXAMS: usize = 3;

/// The exams. They contain the same items with different points.
static ALL: LazyLock<Vec<Exam>> = LazyLock::new(|| {
    let path = Path::new("practice.json");
    let mut file: Value = serde_json::from_str(RAYS.practice_exam).unwrap();
    let items = file["items"].as_array_mut().unwrap();
    let mut tasks: Vec<Value> = Vec::new();
    items.retain(|item| {
        let is_first = tasks.len() < ITEMS && !tasks.contains(&item["task"]);
        tasks.push(item["task"].clone());
        is_first
    });
    for item in items {
        item["needs"] = Value::Array(Vec::new());
    }
    let exam = |number: usize| {
        let mut file = file.clone();
        for item in file["items"].as_array_mut().unwrap() {
            item["points"] = (4 + number).into();
        }
        let bytes = file.to_string().into_bytes();
        exam_file::parse(path, &bytes, RAYS.assignment)
            .unwrap()
            .exam
    };
    (0..EXAMS).map(exam).collect()
});

/// A fault of the grader or of its processes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProcessFault {
    /// No fault.
    None,
    /// This many programs cannot be started.
    CannotStart(u32),
    /// The grader panics this many times.
    Panics(u32),
}

/// A grader that looks up recorded scores.
pub struct RecordedGrader {
    exam: usize,
    policy: Policy,
    fault: ProcessFault,
    failed: AtomicU32,
}

/// Returns the hash of an exam.
pub fn exam_hash(exam: usize) -> String {
    format!("hash-of-exam-{exam}")
}

/// Returns the text of each task file in this version of a student's submission.
pub fn source(student: &str, version: u32) -> String {
    format!("// {student}, version {version}\n")
}

/// Returns the score for this version of a student's submission.
pub fn score(student: &str, version: u32, exam: usize) -> Score {
    let name = ExamName {
        id: "exam".to_owned(),
        hash: exam_hash(exam),
    };
    let mut score = pending_score(&ALL[exam], name, student, &RAYS);
    let lines: Vec<_> = score.items().cloned().collect();
    for (index, mut line) in (0..).zip(lines) {
        let number = version.wrapping_mul(2_654_435_761) >> (5 + 7 * index);
        line.points = number % (line.max_points + 1);
        line.verdict = match line.points {
            0 => Verdict::Wrong,
            points if points == line.max_points => Verdict::Pass,
            _ => Verdict::Partial,
        };
        line.message = format!("the answers of version {version}");
        score.record(line);
    }
    score.update_totals();
    score.complete = true;
    score
}

/// Returns the text of a score file.
pub fn score_file(student: &str, version: u32, exam: usize) -> String {
    score(student, version, exam).to_json()
}

impl RecordedGrader {
    /// Prepares a grader in the same way as the real one.
    pub fn new(options: &GradeOptions, exam: usize, fault: ProcessFault) -> Result<Self, Error> {
        Ok(RecordedGrader {
            exam,
            policy: match &options.policy {
                Some(path) => Policy::read(path)?,
                None => Policy::default(),
            },
            fault,
            failed: AtomicU32::new(0),
        })
    }
}

impl SubmissionGrader for RecordedGrader {
    fn handed_out(&self) -> &'static HandedOut {
        &RAYS
    }

    fn policy(&self) -> &Policy {
        &self.policy
    }

    fn settings(&self) -> Result<Settings, Error> {
        Ok(Settings {
            exam: "exam".to_owned(),
            exam_hash: exam_hash(self.exam),
            grader: "recorded".to_owned(),
            built_with: "nothing".to_owned(),
            isolation: "none".to_owned(),
            options: String::new(),
        })
    }

    fn item_points(&self) -> BTreeMap<String, u32> {
        let items = ALL[self.exam].items.iter();
        items.map(|item| (item.id.clone(), item.points)).collect()
    }

    fn grade(
        &self,
        submission: &Submission,
        files: &mut ReportFiles,
        show_status: &dyn Fn(&str),
    ) -> Result<(Score, String), Error> {
        show_status("looking it up");
        let failed = self.failed.fetch_add(1, Ordering::Relaxed);
        match self.fault {
            ProcessFault::CannotStart(count) if failed < count => {
                let why = "resource temporarily unavailable";
                return Err(io::Error::other(why).into());
            }
            ProcessFault::Panics(count) if failed < count => panic!("a bug of the grader"),
            ProcessFault::None | ProcessFault::CannotStart(_) | ProcessFault::Panics(_) => {}
        }
        let text = submission.files[0].1.as_deref().unwrap_or_default();
        let version = text.trim_end().rsplit(' ').next().unwrap_or_default();
        let version = version.parse().expect("the tests write the files");
        let score = score(&submission.name, version, self.exam);
        files.write(&score, &ALL[self.exam], &ReportAnswers::default())?;
        let view = StudentView::new(&score, &self.policy, Lateness::NONE);
        Ok((score, html::render(&view, &FormatContext::default())))
    }
}
