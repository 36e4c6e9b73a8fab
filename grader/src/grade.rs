//! The main job, from a command line to a score.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::again::Again;
use crate::ask::Budget;
use crate::build::{Build, BuildError, Builder, NotCompiled};
use crate::cli::Arguments;
use crate::error::Error;
use crate::exam::Exam;
use crate::exam_file::{self, ExamFile};
use crate::examine::examine;
use crate::exhibit::Exhibits;
use crate::files::Files;
use crate::format::Seen;
use crate::format::outputs::{NoOutput, Outputs};
use crate::isolate::isolated;
use crate::policy::{Policy, PolicyError};
use crate::report::html::Reload;
use crate::sandbox::Isolation;
use crate::score::{BuildReport, ExamName, FileReport, Score};
use crate::submission::Submission;
use crate::verdict::{file_line, file_message, unasked};
use crate::workspace::Workspace;

/// A submission's score, and where it was written, if it was.
#[derive(Debug)]
pub struct Graded {
    /// The score.
    pub score: Score,
    /// The files that tell it.
    pub files: Option<Files>,
    /// As much of it as students may see.
    pub seen: Seen,
}

impl Graded {
    /// What a runner is to be told on standard output, if one was asked for.
    pub fn commands(&self) -> Option<String> {
        self.files.as_ref()?.outputs.commands(&self.seen)
    }
}

/// Loads the exam, collects the submission, builds it, asks, judges, scores.
pub fn grade(arguments: &Arguments) -> Result<Graded, Error> {
    let began = Instant::now();
    let grader = Grader::prepare(arguments)?;
    let submission = grader.collect()?;
    let prepared = began.elapsed();
    let built = grader.build_telling(&submission, say_what_does_not_compile())?;
    let exam = grader.exam();
    let mut files = grader.files(&submission);
    if let Some(files) = &mut files {
        files.outputs = grader.outputs(&submission, &files.folder)?;
    }
    let mut score = grader.unasked(&submission, &built);
    let mut writing = Duration::ZERO;
    grader.examine(exam, &built, &mut score, |score, exhibits| {
        let began = Instant::now();
        let files = files.as_mut();
        let written = files.map_or(Ok(()), |files| {
            files.write(score, exam, exhibits)?;
            files.outputs.write(&|| grader.seen(score))?;
            Ok::<(), Error>(())
        });
        writing += began.elapsed();
        written
    })?;
    score.timings.stages.prepare = prepared;
    score.timings.stages.report = writing;
    let seen = grader.seen(&score);
    Ok(Graded { score, files, seen })
}

/// All that stays as it is from one version of a submission to the next.
pub struct Grader<'a> {
    arguments: &'a Arguments,
    workspace: Workspace,
    exam: Exam,
    exam_name: ExamName,
    policy: Policy,
    builder: Builder,
}

/// One version of a submission, built.
pub struct Built {
    build: Build,
    took: Duration,
}

impl<'a> Grader<'a> {
    /// Loads the exam, and whatever submissions are built with.
    pub fn prepare(arguments: &'a Arguments) -> Result<Self, Error> {
        let workspace = Workspace::find()?;
        let file = exam_file::load(arguments.exam.as_deref())?;
        // A submission that is nowhere is told of before anything is compiled.
        collect(arguments, &workspace)?;
        Grader::of(arguments, workspace, file)
    }

    /// The same for whoever brings submissions of their own.
    pub fn for_many(arguments: &'a Arguments) -> Result<Self, Error> {
        let file = exam_file::load(arguments.exam.as_deref())?;
        Grader::of(arguments, Workspace::find()?, file)
    }

    fn of(arguments: &'a Arguments, workspace: Workspace, file: ExamFile) -> Result<Self, Error> {
        let policy = policy(arguments, &file.exam)?;
        Ok(Grader {
            arguments,
            exam_name: file.name(),
            exam: match arguments.task {
                Some(task) => file.exam.with_what_it_needs(|item| item.task == task),
                None => file.exam,
            },
            policy,
            builder: isolated(builder(arguments, &workspace)?, arguments)?,
            workspace,
        })
    }

    /// As much of a score as the policy lets students see.
    pub fn seen(&self, score: &Score) -> Seen {
        Seen::of(score, &self.policy)
    }

    /// The formats that were asked for, in `folder` unless they belong elsewhere.
    fn outputs(&self, submission: &Submission, folder: &Path) -> Result<Outputs, NoOutput> {
        let submitted = submitted(self.arguments, &self.workspace);
        let (formats, hints) = (&self.arguments.format, self.arguments.hints);
        Outputs::of(formats, folder, &submitted, submission, hints)
    }

    /// What the exam is called.
    pub fn exam_name(&self) -> &ExamName {
        &self.exam_name
    }

    /// What scores follow from, beside submission and exam: compiler, dependencies, reference.
    pub fn built_with(&self) -> String {
        self.builder.identity()
    }

    /// How submissions will be kept apart from the machine.
    pub fn isolation(&self) -> Isolation {
        self.builder.isolation()
    }

    /// The course's rules.
    pub fn policy(&self) -> &Policy {
        &self.policy
    }

    /// What is asked: all of the exam, or one task of it and what that needs.
    pub fn exam(&self) -> &Exam {
        &self.exam
    }

    /// The submission, as it is now.
    pub fn collect(&self) -> Result<Submission, Error> {
        collect(self.arguments, &self.workspace)
    }

    /// Makes a program of it, as far as it compiles.
    pub fn build(&self, submission: &Submission) -> Result<Built, Error> {
        self.build_telling(submission, |_| {})
    }

    /// The same; says what does not compile as soon as that is known.
    fn build_telling(
        &self,
        submission: &Submission,
        tell: impl FnMut(&BTreeMap<&'static str, NotCompiled>),
    ) -> Result<Built, Error> {
        let began = Instant::now();
        let build = self.builder.build_telling(submission, tell)?;
        Ok(Built {
            build,
            took: began.elapsed(),
        })
    }

    /// The score before anything is asked.
    pub fn unasked(&self, submission: &Submission, built: &Built) -> Score {
        let mut score = unasked(&self.exam, self.exam_name.clone(), &submission.name);
        score.again = Again {
            submission: self.arguments.submission.clone(),
            exam: self.arguments.exam.clone(),
        };
        score.isolation = built.build.isolation();
        score.build = build_report(submission, &built.build);
        score.timings.build_ms = millis(built.took);
        score.timings.stages.build = built.took;
        score
    }

    /// Asks some or all of the exam, and shows the score to `progress` after each item, with the
    /// answers that are worth a look.
    pub fn examine<E: From<io::Error>>(
        &self,
        exam: &Exam,
        built: &Built,
        score: &mut Score,
        mut progress: impl FnMut(&Score, &Exhibits) -> Result<(), E>,
    ) -> Result<(), E> {
        let began = Instant::now();
        let budget = budget(self.arguments);
        examine(exam, &built.build, budget, score, |score, exhibits| {
            score.timings.exam_ms = millis(began.elapsed());
            progress(score, exhibits)
        })
    }

    /// Where the score goes. One task's points are no score.
    pub fn files(&self, submission: &Submission) -> Option<Files> {
        let folder = match &self.arguments.out {
            Some(folder) => folder.clone(),
            None => self.workspace.grade().join(&submission.name),
        };
        let reload = match self.arguments.watch {
            true => Reload::WhileAway,
            false => Reload::Never,
        };
        match self.arguments.task {
            Some(_) => None,
            None => Some(Files::of(&folder, reload)),
        }
    }
}

/// The policy that the command line names, or the default.
fn policy(arguments: &Arguments, exam: &Exam) -> Result<Policy, PolicyError> {
    let Some(path) = &arguments.policy else {
        return Ok(Policy::default());
    };
    let policy = Policy::read(path)?;
    policy.check(path, exam)?;
    Ok(policy)
}

/// What submissions are built with: with the reference, where it is at hand and not declined.
fn builder(arguments: &Arguments, workspace: &Workspace) -> Result<Builder, BuildError> {
    let builder = Builder::prepare(workspace)?;
    match workspace.reference() {
        Some(reference) if !arguments.no_reference => builder.with_reference(&reference, workspace),
        Some(_) | None => Ok(builder),
    }
}

/// The submission that the command line names.
pub fn collect(arguments: &Arguments, workspace: &Workspace) -> Result<Submission, Error> {
    Ok(Submission::collect(&submitted(arguments, workspace))?)
}

/// Where it lies.
fn submitted(arguments: &Arguments, workspace: &Workspace) -> PathBuf {
    match &arguments.submission {
        Some(path) => workspace.resolve(path),
        None => workspace.student(),
    }
}

/// What an item may use.
pub fn budget(arguments: &Arguments) -> Budget {
    Budget {
        cpu: Duration::from_secs(arguments.cpu_limit),
    }
}

/// On standard error, each file once and in short: the report that follows has all the compiler's
/// words.
fn say_what_does_not_compile() -> impl FnMut(&BTreeMap<&'static str, NotCompiled>) {
    let mut said = BTreeSet::new();
    move |files| {
        for (file, why) in files.iter().filter(|(file, _)| said.insert(**file)) {
            let message = file_message(file, why);
            let first = message.lines().next().unwrap_or_default();
            anstream::eprintln!("{file}: {first}; grading the rest");
        }
    }
}

fn build_report(submission: &Submission, build: &Build) -> BuildReport {
    let not_compiled = build.not_compiled.iter().map(|(file, why)| FileReport {
        file: (*file).to_owned(),
        line: file_line(why),
        message: file_message(file, why),
    });
    BuildReport {
        not_compiled: not_compiled.collect(),
        notes: notes(submission, build),
    }
}

/// What is worth knowing of a submission's files and costs nothing.
fn notes(submission: &Submission, build: &Build) -> Vec<String> {
    let mut notes = submission.notes.clone();
    let compiled = submission
        .files
        .iter()
        .filter(|(file, _)| !build.not_compiled.contains_key(file.name));
    for (file, text) in compiled {
        let changed = text.as_ref().map_or(Vec::new(), |text| file.changed(text));
        if !changed.is_empty() {
            let (file, changed) = (file.name, changed.join(", "));
            notes.push(format!(
                "{file}: given methods were changed, at no cost by itself: {changed}"
            ));
        }
    }
    notes
}

fn millis(duration: Duration) -> u64 {
    u64::try_from(duration.as_millis()).unwrap_or(u64::MAX)
}
