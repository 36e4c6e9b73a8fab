//! What grades submissions: the exam, the builder and the rules, prepared once.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

use super::files_said::build_report;
use super::named::{budget, builder, collect, lateness, policy, submitted, usual_folder};
use crate::again::Again;
use crate::build::{Build, BuildError, Builder, NotCompiled};
use crate::cli::Arguments;
use crate::error::Error;
use crate::exam::Exam;
use crate::exam_file::{self, ExamFile, ExamName};
use crate::examine::examine;
use crate::exhibit::Exhibits;
use crate::files::Files;
use crate::format::Seen;
use crate::format::outputs::{NoOutput, Outputs};
use crate::isolate::isolated;
use crate::policy::{Lateness, Policy};
use crate::report::html::Reload;
use crate::sandbox::Isolation;
use crate::score::Score;
use crate::submission::Submission;
use crate::verdict::unasked;
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
pub struct Built {
    build: Build,
    took: Duration,
}

impl Built {
    /// Makes a program of a submission, as far as it compiles; says what does not as soon as that is
    /// known.
    fn of(
        builder: &Builder,
        submission: &Submission,
        tell: impl FnMut(&BTreeMap<&'static str, NotCompiled>),
    ) -> Result<Self, BuildError> {
        let began = Instant::now();
        let build = builder.build_telling(submission, tell)?;
        Ok(Built {
            build,
            took: began.elapsed(),
        })
    }

    /// How long that took.
    pub(super) fn took(&self) -> Duration {
        self.took
    }

    /// Whether as much of it would compile on any day.
    pub(super) fn is_settled(&self) -> bool {
        let mut why = self.build.not_compiled.values();
        why.all(NotCompiled::is_settled)
    }
}

impl<'a> Grader<'a> {
    /// Loads the exam, and whatever submissions are built with.
    pub fn prepare(arguments: &'a Arguments) -> Result<Self, Error> {
        let workspace = Workspace::find()?;
        let file = exam_file::load(arguments.exam.as_deref())?;
        // A submission that is nowhere is told of before anything is compiled.
        collect(arguments, &workspace)?;
        let builder = isolated(builder(arguments, &workspace)?, arguments)?;
        Grader::of(arguments, workspace, builder, file)
    }

    /// The same for one submission, which is built meanwhile: reading an exam takes a tenth of the
    /// time that compiling does, and neither waits for the other.
    pub(super) fn prepare_building(
        arguments: &'a Arguments,
        tell: impl FnMut(&BTreeMap<&'static str, NotCompiled>),
    ) -> Result<(Self, Submission, Built), Error> {
        let workspace = Workspace::find()?;
        let submission = collect(arguments, &workspace)?;
        let (builder, built, file) = thread::scope(|scope| {
            let reading = scope.spawn(|| exam_file::load(arguments.exam.as_deref()));
            let read = |reading: ScopedJoinHandle<'_, _>| reading.join().expect("it reads a file");
            let builder = isolated(builder(arguments, &workspace)?, arguments)?;
            // The first time, all that took its time: a bad exam need not wait for more.
            let (built, file) = match reading.is_finished() {
                true => {
                    let file = read(reading)?;
                    (Built::of(&builder, &submission, tell)?, file)
                }
                false => {
                    let built = Built::of(&builder, &submission, tell)?;
                    (built, read(reading)?)
                }
            };
            Ok::<_, Error>((builder, built, file))
        })?;
        let grader = Grader::of(arguments, workspace, builder, file)?;
        Ok((grader, submission, built))
    }

    /// The same for whoever brings submissions of their own.
    pub fn for_many(arguments: &'a Arguments) -> Result<Self, Error> {
        let file = exam_file::load(arguments.exam.as_deref())?;
        let workspace = Workspace::find()?;
        let builder = isolated(builder(arguments, &workspace)?, arguments)?;
        Grader::of(arguments, workspace, builder, file)
    }

    fn of(
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
                Some(task) => file.exam.with_what_it_needs(|item| item.task == task),
                None => file.exam,
            },
            policy,
            builder,
            workspace,
        })
    }

    /// As much of a score as the policy lets students see.
    pub fn seen(&self, score: &Score) -> Seen {
        Seen::of(score, &self.policy, self.lateness)
    }

    /// The formats that were asked for, in `folder` unless they belong elsewhere.
    pub(super) fn outputs(
        &self,
        submission: &Submission,
        folder: &Path,
    ) -> Result<Outputs, NoOutput> {
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
        Ok(Built::of(&self.builder, submission, |_| {})?)
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
            None => usual_folder(&self.workspace, submission),
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

fn millis(duration: Duration) -> u64 {
    u64::try_from(duration.as_millis()).unwrap_or(u64::MAX)
}
