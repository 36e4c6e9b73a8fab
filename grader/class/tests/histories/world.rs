//! A course: its students' submissions, its exams and policies, and the commands that staff run.

use std::collections::BTreeMap;
use std::fs::{self, File, FileTimes};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use clap::Parser;
use class::cli::{Cli, Command};
use class::error::Error;
use class::grade::{Completion, PrepareGrader, grade_class_with};
use class::merge::merge_shards;
use grader::handed_out::RAYS;

use crate::faulty_disk::{self, DiskFault, Operations};
use crate::observed::all_files;
use crate::recorded_grader::{ProcessFault, RecordedGrader, source};

/// The students of the course.
pub const STUDENTS: [&str; 5] = ["ann", "bob", "carl", "dora", "eve"];
/// The policies of the course. The first is the default.
pub const POLICIES: [&str; 4] = [
    "",
    "[points]\nout_of = 7\n",
    "[points]\nout_of = 50\nrounding = \"up\"\n",
    "[visibility]\npractice = \"points\"\nfinal = \"points\"\n",
];
/// The command-line options for manual points: none, or one of two lists that have a row for the
/// first student.
pub const MANUAL_POINTS: [&str; 3] = [
    "",
    "--manual-points=ROOT/manual-1.csv",
    "--manual-points=ROOT/manual-2.csv",
];
/// The number of shards, if the class is divided.
pub const PARTS: usize = 2;

/// A results folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// The whole class.
    Whole,
    /// A shard of the class. Shards are numbered from 1.
    Part(usize),
    /// The merged shards.
    Merged,
    /// A new folder for a run that other runs are compared with.
    Fresh,
}

/// The course.
#[derive(Debug)]
pub struct World {
    root: PathBuf,
    /// The version each student has submitted. `None` for an empty folder.
    pub submissions: BTreeMap<&'static str, Option<u32>>,
    /// The exam.
    pub exam: usize,
    /// The policy.
    pub policy: usize,
    /// The manual points. For number 0, the option is left out, so the last run's manual points are
    /// used.
    pub manual: usize,
}

/// The result of a finished command.
#[derive(Debug)]
pub struct Ended {
    /// The result of the command.
    pub result: Result<Completion, Error>,
    /// The number of file operations of each kind.
    pub operations: Operations,
    /// Whether the disk's fault occurred.
    pub had_disk_fault: bool,
}

impl World {
    /// Creates a course in a folder, with no submissions yet.
    pub fn new(root: &Path) -> Self {
        let world = World {
            root: root.to_owned(),
            submissions: BTreeMap::new(),
            exam: 0,
            policy: 0,
            manual: 0,
        };
        fs::create_dir(world.input()).unwrap();
        for (number, text) in POLICIES.iter().enumerate() {
            fs::write(world.policy_path(number), text).unwrap();
        }
        for number in 1..MANUAL_POINTS.len() {
            let row = format!("{},camera,0,list {number},Tess", STUDENTS[0]);
            let text = format!("student,task,delta,comment,author\n{row}\n");
            fs::write(root.join(format!("manual-{number}.csv")), text).unwrap();
        }
        let mut gradebook = "Student,ID,SIS User ID,SIS Login ID,Section,Tracer (42)\n".to_owned();
        for (number, student) in STUDENTS.iter().enumerate() {
            gradebook += &format!("{student},{number},,{student},Lab,\n");
        }
        fs::write(root.join("gradebook.csv"), gradebook).unwrap();
        world
    }

    fn input(&self) -> PathBuf {
        self.root.join("class")
    }

    fn policy_path(&self, number: usize) -> PathBuf {
        self.root.join(format!("policy-{number}.toml"))
    }

    /// Returns the path of this results folder.
    pub fn folder(&self, target: Target) -> PathBuf {
        self.root.join(match target {
            Target::Whole => "out".to_owned(),
            Target::Part(part) => format!("part-{part}"),
            Target::Merged => "merged".to_owned(),
            Target::Fresh => "fresh".to_owned(),
        })
    }

    /// Removes a results folder.
    pub fn remove(&self, target: Target) {
        fs::remove_dir_all(self.folder(target)).ok();
    }

    /// Replaces a student's submission. `None` leaves an empty folder.
    pub fn submit(&mut self, student: &'static str, version: Option<u32>) {
        let folder = self.input().join(student);
        fs::remove_dir_all(&folder).ok();
        fs::create_dir(&folder).unwrap();
        if let Some(version) = version {
            for file in RAYS.file_names() {
                fs::write(folder.join(file), source(student, version)).unwrap();
            }
        }
        self.submissions.insert(student, version);
    }

    /// Returns whether the class exists. A single folder is a class of one submission, even if the
    /// folder is empty.
    pub fn is_class(&self) -> bool {
        !self.submissions.is_empty()
    }

    /// Removes a student.
    pub fn withdraw(&mut self, student: &str) {
        fs::remove_dir_all(self.input().join(student)).ok();
        self.submissions.remove(student);
    }

    /// Changes the timestamps of all files as if the clock had jumped by this many days. Nothing
    /// else about a file depends on the clock.
    pub fn jump_clock(&self, days: i64) {
        let by = Duration::from_secs(days.unsigned_abs() * 86_400);
        let now = SystemTime::now();
        let time = if days < 0 { now - by } else { now + by };
        for name in all_files(&self.root).keys() {
            let file = File::options().write(true).open(self.root.join(name));
            let times = FileTimes::new().set_modified(time).set_accessed(time);
            file.unwrap().set_times(times).unwrap();
        }
    }

    /// Grades the whole class or a shard.
    pub fn grade(
        &self,
        target: Target,
        more: &[&str],
        disk: DiskFault,
        process: ProcessFault,
    ) -> Ended {
        let mut words = vec![
            "class".to_owned(),
            text(&self.input()),
            "--jobs=1".to_owned(),
        ];
        if let Target::Part(part) = target {
            words.push(format!("--shard={part}/{PARTS}"));
        }
        words.push(match self.policy {
            0 => "--drop-list=policy".to_owned(),
            number => format!("--policy={}", text(&self.policy_path(number))),
        });
        self.run(words, target, more, disk, process)
    }

    /// Merges the shards.
    pub fn merge(&self, more: &[&str], disk: DiskFault) -> Ended {
        let mut words = vec!["class".to_owned(), "merge".to_owned()];
        words.extend((1..=PARTS).map(|part| text(&self.folder(Target::Part(part)))));
        self.run(words, Target::Merged, more, disk, ProcessFault::None)
    }

    fn run(
        &self,
        mut words: Vec<String>,
        target: Target,
        more: &[&str],
        disk: DiskFault,
        process: ProcessFault,
    ) -> Ended {
        words.push(format!("--out={}", text(&self.folder(target))));
        let root = text(&self.root);
        words.extend(more.iter().map(|word| word.replace("ROOT", &root)));
        let cli = Cli::parse_from(words);
        faulty_disk::start(&self.root, disk);
        let result = match &cli.command {
            Some(Command::Merge(arguments)) => merge_shards(arguments, &RAYS),
            None => {
                let options = cli.class.grading.resolve();
                let prepare: &PrepareGrader =
                    &|options| Ok(Box::new(RecordedGrader::new(options, self.exam, process)?));
                grade_class_with(&cli.class, &options, prepare)
            }
        };
        let (operations, had_disk_fault) = faulty_disk::stop();
        Ended {
            result,
            operations,
            had_disk_fault,
        }
    }

    /// Returns the names of the temporary files left in a folder.
    pub fn temporary_files(&self, target: Target) -> Vec<PathBuf> {
        let is_temporary = |path: &PathBuf| {
            let name = path.file_name().unwrap_or_default();
            name.to_string_lossy().starts_with(".tmp")
        };
        let files = all_files(&self.folder(target));
        files.into_keys().filter(is_temporary).collect()
    }
}

fn text(path: &Path) -> String {
    path.to_str()
        .expect("temporary folders have plain names")
        .to_owned()
}
