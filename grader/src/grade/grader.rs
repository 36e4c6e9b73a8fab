//! What grades submissions: the exam, the builder and the rules, prepared once.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

use super::build_report::build_report;
use super::resolve::{budget, builder, collect, default_folder, lateness, policy, submission_path};
use crate::build::{Build, BuildError, Builder, NotCompiled};
use crate::cli::Arguments;
use crate::error::Error;
use crate::exam::Exam;
use crate::exam_file::{self, ExamFile, ExamName};
use crate::format::StudentView;
use crate::format::outputs::{OutputError, Outputs};
use crate::policy::{Lateness, Policy};
use crate::report::html::Reload;
use crate::report_answers::ReportAnswers;
use crate::report_files::ReportFiles;
use crate::rerun_command::RerunCommand;
use crate::run_exam::run_exam;
use crate::sandbox::Isolation;
use crate::score::Score;
use crate::select_isolation::with_requested_level;
use crate::submission::Submission;
use crate::verdict::pending_score;
use crate::workspace::Workspace;

/// All that stays as it is from one version of a submission to the next.
pub struct Grader<'a> {
    arguments: &'a Arguments,
    workspace: Workspace,
    exam: Exam,
    exam_name: ExamName,
    policy: Policy,
    lateness: Lateness,
    builder: Builder,
}

/// One version of a submission, built.
pub struct BuiltSubmission {
    build: Build,
    took: Duration,
}

impl BuiltSubmission {
    /// Makes a program of a submission, as far as it compiles; says what does not as soon as that is
    /// known.
    fn new(
        builder: &Builder,
        submission: &Submission,
        tell: impl FnMut(&BTreeMap<&'static str, NotCompiled>),
    ) -> Result<Self, BuildError> {
        let began = Instant::now();
        let build = builder.build_with_progress(submission, tell)?;
        Ok(BuiltSubmission {
            build,
            took: began.elapsed(),
        })
    }

    /// How long that took.
    pub(super) fn took(&self) -> Duration {
        self.took
    }

    /// Whether as much of it would compile on any day.
    pub(super) fn is_reproducible(&self) -> bool {
        let mut why = self.build.not_compiled.values();
        why.all(NotCompiled::is_reproducible)
    }
}

impl<'a> Grader<'a> {
    /// Loads the exam, and whatever submissions are built with.
    pub fn prepare(arguments: &'a Arguments) -> Result<Self, Error> {
        let workspace = Workspace::find()?;
        let file = exam_file::load(arguments.exam.as_deref())?;
        // A submission that is nowhere is told of before anything is compiled.
        collect(arguments, &workspace)?;
        let builder = with_requested_level(builder(arguments, &workspace)?, arguments)?;
        Grader::new(arguments, workspace, builder, file)
    }

    /// The same for one submission, which is built meanwhile: reading an exam takes a tenth of the
    /// time that compiling does, and neither waits for the other.
    pub(super) fn prepare_and_build(
        arguments: &'a Arguments,
        tell: impl FnMut(&BTreeMap<&'static str, NotCompiled>),
    ) -> Result<(Self, Submission, BuiltSubmission), Error> {
        let workspace = Workspace::find()?;
        let submission = collect(arguments, &workspace)?;
        let (builder, built, file) = thread::scope(|scope| {
            let reading = scope.spawn(|| exam_file::load(arguments.exam.as_deref()));
            let read = |reading: ScopedJoinHandle<'_, _>| reading.join().expect("it reads a file");
            let builder = with_requested_level(builder(arguments, &workspace)?, arguments)?;
            // The first time, all that took its time: a bad exam need not wait for more.
            let (built, file) = match reading.is_finished() {
                true => {
                    let file = read(reading)?;
                    (BuiltSubmission::new(&builder, &submission, tell)?, file)
                }
                false => {
                    let built = BuiltSubmission::new(&builder, &submission, tell)?;
                    (built, read(reading)?)
                }
            };
            Ok::<_, Error>((builder, built, file))
        })?;
        let grader = Grader::new(arguments, workspace, builder, file)?;
        Ok((grader, submission, built))
    }

    /// The same for whoever brings submissions of their own.
    pub fn for_many(arguments: &'a Arguments) -> Result<Self, Error> {
        let file = exam_file::load(arguments.exam.as_deref())?;
        let workspace = Workspace::find()?;
        let builder = with_requested_level(builder(arguments, &workspace)?, arguments)?;
        Grader::new(arguments, workspace, builder, file)
    }

    fn new(
        arguments: &'a Arguments,
        workspace: Workspace,
        builder: Builder,
        file: ExamFile,
    ) -> Result<Self, Error> {
        let policy = policy(arguments, &file.exam)?;
        Ok(Grader {
            arguments,
            lateness: lateness(arguments, &policy)?,
            exam_name: file.name(),
            exam: match arguments.task {
                Some(task) => file.exam.with_needed_items(|item| item.task == task),
                None => file.exam,
            },
            policy,
            builder,
            workspace,
        })
    }

    /// As much of a score as the policy lets students see.
    pub fn student_view(&self, score: &Score) -> StudentView {
        StudentView::new(score, &self.policy, self.lateness)
    }

    /// The formats that were asked for, in `folder` unless they belong elsewhere.
    pub(super) fn outputs(
        &self,
        submission: &Submission,
        folder: &Path,
    ) -> Result<Outputs, OutputError> {
        let submitted = submission_path(self.arguments, &self.workspace);
        let (formats, hints) = (&self.arguments.format, self.arguments.hints);
        Outputs::new(formats, folder, &submitted, submission, hints)
    }

    /// What the exam is called.
    pub fn exam_name(&self) -> &ExamName {
        &self.exam_name
    }

    /// What scores follow from, beside submission and exam: compiler, dependencies, reference.
    pub fn builder_identity(&self) -> String {
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
    pub fn build(&self, submission: &Submission) -> Result<BuiltSubmission, Error> {
        Ok(BuiltSubmission::new(&self.builder, submission, |_| {})?)
    }

    /// The score before anything is asked.
    pub fn pending_score(&self, submission: &Submission, built: &BuiltSubmission) -> Score {
        let mut score = pending_score(&self.exam, self.exam_name.clone(), &submission.name);
        score.rerun_command = RerunCommand {
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
    pub fn run_exam<E: From<io::Error>>(
        &self,
        exam: &Exam,
        built: &BuiltSubmission,
        score: &mut Score,
        mut progress: impl FnMut(&Score, &ReportAnswers) -> Result<(), E>,
    ) -> Result<(), E> {
        let began = Instant::now();
        let budget = budget(self.arguments);
        run_exam(exam, &built.build, budget, score, |score, exhibits| {
            score.timings.exam_ms = millis(began.elapsed());
            progress(score, exhibits)
        })
    }

    /// Where the score goes. One task's points are no score.
    pub fn files(&self, submission: &Submission) -> Option<ReportFiles> {
        let folder = match &self.arguments.out {
            Some(folder) => folder.clone(),
            None => default_folder(&self.workspace, submission),
        };
        let reload = match self.arguments.watch {
            true => Reload::WhileUnfocused,
            false => Reload::Never,
        };
        match self.arguments.task {
            Some(_) => None,
            None => Some(ReportFiles::new(&folder, reload)),
        }
    }
}

fn millis(duration: Duration) -> u64 {
    u64::try_from(duration.as_millis()).unwrap_or(u64::MAX)
}
