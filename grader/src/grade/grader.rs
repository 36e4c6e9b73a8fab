//! Grades submissions with an exam, a builder and a policy that are prepared once.

use std::io;
use std::num::NonZero;
use std::path::Path;
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

use judging::exam::Exam;
use judging::exam_file::{ExamFile, ExamName};

use super::build_report::build_report;
use super::prepared::{
    PreparedSubmission, builder, collect, default_folder, lateness, policy, source_paths,
    submission_path,
};
use super::print_compile_errors;
use crate::build::select_isolation::{IsolationRequest, with_requested_level};
use crate::build::{Build, Builder};
use crate::error::Error;
use crate::format::StudentView;
use crate::format::outputs::Outputs;
use crate::grade::options::GradeOptions;
use crate::grade::report_files::ReportFiles;
use crate::handed_out::HandedOut;
use crate::policy::{Lateness, Policy};
use crate::report::answers::ReportAnswers;
use crate::report::html::Reload;
use crate::run_exam::run_exam;
use crate::sandbox::Isolation;
use crate::score::Score;
use crate::score::rerun_command::RerunCommand;
use crate::submission::Submission;
use crate::verdict::pending_score;
use crate::workspace::Workspace;
use crate::workspace::book::Book;
use crate::workspace::bundle_version::mixed_versions;
use crate::workspace::given_files;
use crate::workspace::source_paths::SourcePaths;

/// The exam, the builder, the policy and the options, which stay the same for all versions of a
/// submission.
pub struct Grader<'a> {
    options: &'a GradeOptions,
    workspace: Workspace,
    exam: Exam,
    exam_name: ExamName,
    policy: Policy,
    lateness: Lateness,
    builder: Builder,
}

impl<'a> Grader<'a> {
    /// Loads the exam, prepares the builder and builds the submission. Reading the exam takes a
    /// tenth as long as compiling and is done in parallel.
    pub(super) fn build_prepared(
        prepared: &mut PreparedSubmission<'a>,
    ) -> Result<(Self, Build), Error> {
        let options = prepared.options;
        let report_errors = print_compile_errors(prepared.source_paths());
        let (builder, build, file) = thread::scope(|scope| {
            let reading = scope.spawn(|| options.exam.load(options.handed_out));
            let read = |reading: ScopedJoinHandle<'_, _>| {
                reading.join().expect("reading the exam does not panic")
            };
            let builder = prepared.builder()?.clone();
            let builder = with_requested_level(builder, options.isolation)?;
            let submission = &prepared.submission;
            // In the first run, preparing the builder takes longer than reading the exam, so an
            // invalid exam is reported before the submission is compiled.
            let build = || builder.build_with_progress(submission, report_errors);
            let (build, file) = if reading.is_finished() {
                let file = read(reading)?;
                (build()?, file)
            } else {
                (build()?, read(reading)?)
            };
            Ok::<_, Error>((builder, build, file))
        })?;
        let grader = Grader::new(options, prepared.workspace.clone(), builder, file)?;
        Ok((grader, build))
    }

    /// Loads the exam and prepares the builder.
    pub fn prepare(options: &'a GradeOptions) -> Result<Self, Error> {
        let file = options.exam.load(options.handed_out)?;
        let workspace = Workspace::find()?;
        let builder = with_requested_level(builder(options, &workspace)?, options.isolation)?;
        Grader::new(options, workspace, builder, file)
    }

    fn new(
        options: &'a GradeOptions,
        workspace: Workspace,
        builder: Builder,
        file: ExamFile,
    ) -> Result<Self, Error> {
        let policy = policy(options, &file.exam)?;
        Ok(Grader {
            options,
            lateness: lateness(options, &policy)?,
            exam_name: file.name(),
            exam: if options.tasks.is_all() {
                file.exam
            } else {
                file.exam
                    .with_needed_items(|item| options.tasks.includes(item.task))
            },
            policy,
            builder,
            workspace,
        })
    }

    /// Returns the part of a score that the policy lets students see.
    pub fn student_view(&self, score: &Score) -> StudentView {
        StudentView::new(score, &self.policy, self.lateness)
    }

    /// Returns the requested output formats. They are written to `folder` unless another location
    /// is specified for them.
    pub(super) fn outputs(&self, submission: &Submission, folder: &Path) -> Result<Outputs, Error> {
        let submitted = submission_path(self.options, &self.workspace);
        let (formats, hints) = (&self.options.formats, self.options.hints);
        Outputs::new(formats, folder, &submitted, submission, hints)
    }

    /// Returns the options.
    pub fn options(&self) -> &GradeOptions {
        self.options
    }

    /// Returns the assignment.
    pub fn handed_out(&self) -> &'static HandedOut {
        self.options.handed_out
    }

    /// Returns the exam's id and the hash of its file.
    pub fn exam_name(&self) -> &ExamName {
        &self.exam_name
    }

    /// Returns a hash of everything that scores depend on besides the submission and the exam: the
    /// compiler, the dependencies and the reference.
    pub fn builder_identity(&self) -> String {
        self.builder.identity()
    }

    /// Returns the isolation level for compiling and running submissions.
    pub fn isolation(&self) -> Isolation {
        self.builder.isolation()
    }

    /// Returns the course's policy.
    pub fn policy(&self) -> &Policy {
        &self.policy
    }

    /// Returns the exam. If only some tasks are graded, it contains the items of these tasks and
    /// all items that they depend on.
    pub fn exam(&self) -> &Exam {
        &self.exam
    }

    /// Returns the paths of the submission's task files.
    pub fn source_paths(&self) -> SourcePaths {
        source_paths(self.options, &self.workspace)
    }

    /// Reads the current version of the submission's files.
    pub fn collect(&self) -> Result<Submission, Error> {
        collect(self.options, &self.workspace)
    }

    /// Builds a submission. Files that don't compile are replaced by the starter's versions.
    pub fn build(&self, submission: &Submission) -> Result<Build, Error> {
        self.builder.build(submission)
    }

    /// Returns the score before any item is graded.
    pub fn pending_score(&self, submission: &Submission, build: &Build) -> Score {
        let mut score = pending_score(
            &self.exam,
            self.exam_name.clone(),
            &submission.name,
            self.options.handed_out,
        );
        score.rerun_command = RerunCommand {
            assignment: self.options.assignment_option(),
            submission: self.options.submission.clone(),
            exam: self.options.exam.option().map(Path::to_owned),
            is_untrusted: !matches!(
                self.options.isolation,
                IsolationRequest::OwnWork | IsolationRequest::Level(Isolation::None)
            ),
        };
        score.book = Book::find(&self.workspace);
        score.isolation = build.isolation();
        score.build = build_report(submission, build);
        for task in &mut score.tasks {
            let file = self.options.handed_out.assignment.info(task.id).file;
            if let Some(method) = build.methods.get(&task.id) {
                task.method = format!("{file}:{}", method.line);
                task.methods.clone_from(&method.methods);
            }
            let warnings = build.warnings.iter();
            task.warnings = warnings
                .filter_map(|warning| warning.line_of_text(file))
                .collect();
        }
        let notes = &mut score.build.notes;
        notes.extend(mixed_versions(&self.workspace));
        notes.extend(given_files::changed(self.workspace.root()));
        score.timings.build_ms = millis(build.took);
        score.timings.stages.build = build.took;
        score
    }

    /// Grades some or all items of the exam. After each item, `progress` is called with the score
    /// and the answers to draw.
    pub fn run_exam<E: From<io::Error>>(
        &self,
        exam: &Exam,
        build: &Build,
        score: &mut Score,
        mut progress: impl FnMut(&Score, &ReportAnswers) -> Result<(), E>,
    ) -> Result<(), E> {
        let started_at = Instant::now();
        let budget = self.options.budget;
        run_exam(
            exam,
            build,
            budget,
            self.threads(),
            score,
            |score, answers| {
                score.timings.exam_ms = millis(started_at.elapsed());
                progress(score, answers)
            },
        )
    }

    /// Returns the number of tasks that may run at the same time. Other people's submissions run
    /// one process at a time, since grading a class already uses every core.
    fn threads(&self) -> usize {
        match self.options.isolation {
            IsolationRequest::OwnWork => thread::available_parallelism().map_or(1, NonZero::get),
            IsolationRequest::Untrusted | IsolationRequest::Level(_) => 1,
        }
    }

    /// Returns the report's files, or `None` if only some tasks are graded, because their points
    /// don't make up a score.
    pub fn files(&self, submission: &Submission, reload: Reload) -> Option<ReportFiles> {
        let folder = match &self.options.out {
            Some(folder) => folder.clone(),
            None => default_folder(&self.workspace, submission),
        };
        let is_score = self.options.tasks.is_all();
        is_score.then(|| ReportFiles::new(&folder, reload))
    }
}

fn millis(duration: Duration) -> u64 {
    u64::try_from(duration.as_millis()).unwrap_or(u64::MAX)
}
