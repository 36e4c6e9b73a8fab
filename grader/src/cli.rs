//! The command line of `cargo grade`.

use std::env;
use std::ffi::OsString;
use std::path::PathBuf;

use clap::builder::StyledStr;
use clap::{CommandFactory, FromArgMatches, Id, Parser, value_parser};

use judging::assignment::{Assignment, Task};

use crate::build::select_isolation::IsolationRequest;
use crate::error::Error;
use crate::format::{FORMATS, OutputSpec};
use crate::grade::options::{Dependents, GradeOptions};
use crate::handed_out::{ASSIGNMENTS, HandedOut};
use crate::inputs::exam_source::ExamSource;
use crate::inputs::question_ref::QuestionRef;
use crate::inputs::task_selection::{TaskOrFile, TaskSelection};
use crate::machine::printing::exit_with;
use crate::probe::Budget;
use crate::report::text::HintDetail;
use crate::sandbox::Isolation;
use crate::terminal::PrintOptions;

/// The heading for options that students don't need. Only `--help-staff` shows them.
const STAFF_OPTIONS: &str = "Options for course staff and CI";
/// The arguments that can be combined with `--reset`. All others affect only grading.
const WITH_RESET: [&str; 4] = ["submission", "reset", "assignment", "help_staff"];
/// The last line of the help for students.
const MORE_HELP: &str =
    "`cargo grade --help-staff` also shows the options for course staff and CI.";

/// A command with all of its options.
#[derive(Clone, Debug)]
pub enum Command {
    /// Grade one assignment of a submission.
    Grade(GradeOptions, PrintOptions),
    /// Grade each assignment that a submission has started.
    GradeStarted(GradeOptions, PrintOptions),
    /// Grade a submission again whenever a file is saved.
    Watch {
        /// The options for grading.
        options: GradeOptions,
        /// Whether to open the report's page in a browser.
        open: bool,
    },
    /// Run one question again.
    Replay(GradeOptions, QuestionRef),
    /// Reset some tasks and files in a submission's folder.
    Reset {
        /// The assignment.
        handed_out: &'static HandedOut,
        /// The folder, or `None` for the student's own work.
        folder: Option<PathBuf>,
        /// The tasks and files to reset.
        names: Vec<TaskOrFile>,
    },
    /// Show the tools and isolation levels available on this machine.
    Diagnose,
    /// Print the JSON schema of the score file.
    PrintSchema,
    /// Print the default policy.
    PrintDefaultPolicy,
    /// Print this help text, which covers all options.
    PrintHelp(StyledStr),
}

/// Grades a path-tracing submission: builds it, runs the exam and writes a score
///
/// Exit codes: 0 graded, regardless of the score; 1 graded, but below --require; 2 invalid command
/// line, submission or exam; 3 the grader itself failed.
#[derive(Clone, Debug, Parser)]
#[command(name = "cargo grade", bin_name = "cargo grade", version)]
pub struct Arguments {
    /// The folder, .zip, .tar or .tar.gz that contains the task files (at the top level, in src/ or
    /// in student/src/); default: student
    pub submission: Option<PathBuf>,

    /// Grade only one task (e.g. sphere) or all tasks in a file (e.g. bvh); no score is written
    #[arg(long, value_name = "TASK")]
    pub task: Option<String>,

    /// Rerun one question, such as sphere.from_inside#7, and show the full answer; without a
    /// number, rerun the item's first wrongly answered question
    #[arg(long, value_name = "ITEM[#N]", conflicts_with_all = ["task", "require", "out"])]
    pub replay: Option<QuestionRef>,

    /// Reset a task (sphere) or a whole file (bvh) to its stub, or restore a given file (world.rs);
    /// your version is kept as a copy (bvh.rs.bak-1)
    #[arg(long, value_name = "TASK")]
    pub reset: Option<String>,

    /// Show only what to do next and where, instead of the whole report
    #[arg(long, conflicts_with_all = ["replay", "watch", "format"])]
    pub next: bool,

    /// If a known mistake is recognised, show its full hint instead of a nudge
    #[arg(long)]
    pub hints: bool,

    /// Grade again whenever a file is saved, starting with what failed; press Ctrl-C to stop
    #[arg(long, conflicts_with_all = ["replay", "require"])]
    pub watch: bool,

    /// Open the HTML report in a browser
    #[arg(long, conflicts_with_all = ["task", "replay"])]
    pub open: bool,

    /// Grade again even if nothing has changed since the last time
    #[arg(long)]
    pub fresh: bool,

    /// Print how long each step took
    #[arg(long, conflicts_with_all = ["replay", "watch"])]
    pub timings: bool,

    /// Show the compiler, the available isolation levels, and what is missing on this machine
    #[arg(long)]
    pub doctor: bool,

    /// The assignment; default: the exam file's assignment, or every assignment that has been
    /// started
    #[arg(long, value_name = "ID", value_parser = HandedOut::find, help_heading = STAFF_OPTIONS)]
    pub assignment: Option<&'static HandedOut>,

    /// The exam file, or - for standard input; default: the practice exam
    #[arg(long, value_name = "FILE", help_heading = STAFF_OPTIONS)]
    pub exam: Option<PathBuf>,

    /// The folder for score.json and report.html; default: target/grade/NAME
    #[arg(long, value_name = "FOLDER", help_heading = STAFF_OPTIONS)]
    pub out: Option<PathBuf>,

    /// Exit with code 1 if the score is below POINTS
    #[arg(long, value_name = "POINTS", help_heading = STAFF_OPTIONS)]
    pub require: Option<u32>,

    /// Treat the code as untrusted: run it in a sandbox or refuse to grade it
    #[arg(long, help_heading = STAFF_OPTIONS)]
    pub untrusted: bool,

    /// Require this isolation level; --untrusted chooses full if available, otherwise no-namespaces
    #[arg(long, value_name = "LEVEL", help_heading = STAFF_OPTIONS)]
    pub isolation: Option<Isolation>,

    /// Leave items that depend on a failed task blocked, as on a student's machine, instead of
    /// grading them with the reference's parts
    #[arg(long, help_heading = STAFF_OPTIONS)]
    pub no_reference: bool,

    /// CPU time limit for each item, in seconds; default: 50 times what the slowest passing item
    /// has taken, but at least 2 and at most 10 seconds
    #[arg(long, value_name = "SECONDS", help_heading = STAFF_OPTIONS)]
    #[arg(value_parser = value_parser!(u64).range(1..=Budget::MAX_SECONDS))]
    pub cpu_limit: Option<u64>,

    /// The course's policy: how points become a grade and what students see; --policy-default
    /// prints the default
    #[arg(long, value_name = "FILE", help_heading = STAFF_OPTIONS)]
    pub policy: Option<PathBuf>,

    /// Print the default policy, with comments on every key, and exit
    #[arg(long, help_heading = STAFF_OPTIONS)]
    pub policy_default: bool,

    /// Gradescope's submission_metadata.json, which contains the submission time and the due date
    /// that the policy's late days depend on
    #[arg(long, value_name = "FILE", help_heading = STAFF_OPTIONS)]
    pub gradescope_metadata: Option<PathBuf>,

    /// Additional output formats.
    #[arg(long, value_name = "FORMAT", num_args = 1.., value_delimiter = ',', help = format_help())]
    #[arg(conflicts_with_all = ["task", "replay", "watch"], help_heading = STAFF_OPTIONS)]
    pub format: Vec<OutputSpec>,

    /// Print the JSON schema of score.json and exit
    #[arg(long, help_heading = STAFF_OPTIONS)]
    pub schema: bool,

    /// Print help with the options for course staff and CI
    #[arg(long, help_heading = STAFF_OPTIONS)]
    pub help_staff: bool,
}

impl Arguments {
    /// Parses this process's command line. If it is invalid or asks for help, prints a message and
    /// exits.
    pub fn from_command_line() -> Self {
        let arguments = env::args_os().map(with_two_dashes);
        let matches = Self::for_students().try_get_matches_from(arguments);
        let arguments = matches.and_then(|matches| Self::from_arg_matches(&matches));
        arguments.unwrap_or_else(|error| exit_with(&error))
    }

    /// Returns the definition of the command line. Its help text shows only the options for
    /// students.
    fn for_students() -> clap::Command {
        let is_staff = |arg: &clap::Arg| arg.get_help_heading() == Some(STAFF_OPTIONS);
        let command = Self::command().mut_args(|arg| {
            let hidden = is_staff(&arg);
            arg.hide(hidden)
        });
        let all = command.get_arguments().map(|arg| arg.get_id().clone());
        let grading: Vec<Id> = all
            .filter(|id| !WITH_RESET.contains(&id.as_str()))
            .collect();
        let command = command.mut_arg("reset", |arg| arg.conflicts_with_all(grading));
        command.after_help(MORE_HELP)
    }

    /// Returns the submission argument if it names a task rather than an existing file or folder:
    /// `cargo grade sphere` means `cargo grade --task sphere`. Some options can only be combined
    /// with a task if the task is selected with `--task`.
    fn task_instead_of_submission(&self, assignment: &Assignment) -> Option<String> {
        let submission = self.submission.as_ref()?;
        let is_for_tasks = self.task.is_none()
            && self.replay.is_none()
            && self.reset.is_none()
            && self.exam.is_none()
            && self.out.is_none()
            && self.require.is_none()
            && self.format.is_empty()
            && !self.open
            && !self.next;
        let name = submission.to_str().filter(|_| is_for_tasks)?;
        let is_task = !submission.exists() && TaskSelection::parse(name, assignment).is_ok();
        is_task.then(|| name.to_owned())
    }

    /// Returns the first assignment that has the task named in these arguments, if any.
    fn assignment_with_task(&self) -> Option<&'static HandedOut> {
        let has_task = |handed_out: &&&'static HandedOut| {
            let assignment = handed_out.assignment;
            let is_known = |text: &String| TaskSelection::parse(text, assignment).is_ok();
            let task_of_item = |question: &QuestionRef| {
                Task::in_id(&question.item).is_some_and(|task| assignment.find(task.id()).is_some())
            };
            self.task.as_ref().is_some_and(is_known)
                || self.reset.as_ref().is_some_and(is_known)
                || self.replay.as_ref().is_some_and(task_of_item)
                || self.task_instead_of_submission(assignment).is_some()
        };
        ASSIGNMENTS.iter().find(has_task).copied()
    }

    /// Returns the command that these arguments select. Fails if the arguments name a task that the
    /// assignment doesn't have.
    pub fn resolve(mut self) -> Result<Command, Error> {
        let exam = ExamSource::from_option(self.exam.clone());
        let is_chosen = self.assignment.is_some() || exam != ExamSource::Practice;
        let named = if is_chosen {
            self.assignment
        } else {
            self.assignment_with_task()
        };
        let handed_out = exam.assignment(named);
        let assignment = handed_out.assignment;
        if let Some(name) = self.task_instead_of_submission(assignment) {
            self.task = Some(name);
            self.submission = None;
        }
        let tasks = self.task.map(|text| {
            let tasks = TaskSelection::parse(&text, assignment);
            tasks.map_err(|why| invalid_value("--task <TASK>", &text, &why))
        });
        let tasks = tasks.transpose()?;
        let isolation = match (self.isolation, self.untrusted) {
            (Some(level), _) => IsolationRequest::Level(level),
            (None, true) => IsolationRequest::Untrusted,
            (None, false) => IsolationRequest::OwnWork,
        };
        let options = GradeOptions {
            handed_out,
            submission: self.submission,
            exam,
            tasks: tasks.unwrap_or_default(),
            policy: self.policy,
            gradescope_metadata: self.gradescope_metadata,
            dependents: Dependents::new(self.no_reference),
            isolation,
            budget: self
                .cpu_limit
                .map_or(Budget::default(), Budget::from_seconds),
            hints: if self.hints {
                HintDetail::Full
            } else {
                HintDetail::Nudge
            },
            out: self.out,
            formats: self.format,
        };
        let print = PrintOptions {
            fresh: self.fresh,
            open: self.open,
            timings: self.timings,
            next: self.next,
            require: self.require.unwrap_or(0),
        };
        if let Some(text) = self.reset {
            let names = TaskOrFile::parse_with_given_files(&text, handed_out)
                .map_err(|why| invalid_value("--reset <TASK>", &text, &why))?;
            return Ok(Command::Reset {
                handed_out,
                folder: options.submission,
                names,
            });
        }
        Ok(match self.replay {
            _ if self.help_staff => Command::PrintHelp(Self::command().render_long_help()),
            _ if self.schema => Command::PrintSchema,
            _ if self.policy_default => Command::PrintDefaultPolicy,
            Some(question) => Command::Replay(options, question),
            None if self.doctor => Command::Diagnose,
            None if self.watch => Command::Watch {
                options,
                open: print.open,
            },
            None if is_chosen || !options.tasks.is_all() => Command::Grade(options, print),
            None => Command::GradeStarted(options, print),
        })
    }
}

/// Returns the argument, adding a second dash if it is a long option with a single dash, such as
/// `-task`. The only one-letter options are `-h` and `-V`.
fn with_two_dashes(argument: OsString) -> OsString {
    let is_long =
        |text: &str| text.len() > 2 && text[1..].starts_with(|c: char| c.is_ascii_alphabetic());
    match argument.to_str() {
        Some(text) if text.starts_with('-') && is_long(text) => format!("-{text}").into(),
        Some(_) | None => argument,
    }
}

fn format_help() -> String {
    let known = FORMATS.map(|format| format.id).join(", ");
    // The list comes last, so that when it grows, the text before it doesn't have to be rewrapped.
    format!(
        "Also write the report in these formats, which only show what the policy lets students see. Append \
         =PATH to choose the file; by default, it is written where the platform expects it or, failing \
         that, to the --out folder.\n\
         Formats: {known}"
    )
}

/// Returns an error in clap's wording for a value that can only be checked once the assignment is
/// known.
fn invalid_value(option: &str, value: &str, why: &str) -> Error {
    Error::User(format!(
        "invalid value '{value}' for '{option}': {why}\n\nFor more information, try '--help'."
    ))
}

#[cfg(test)]
mod tests {
    use super::with_two_dashes;

    #[test]
    fn a_long_option_with_one_dash_gets_another() {
        for (typed, meant) in [
            ("-task", "--task"),
            ("-task=sphere", "--task=sphere"),
            ("--task", "--task"),
            ("-h", "-h"),
            ("-", "-"),
            ("student", "student"),
        ] {
            assert_eq!(with_two_dashes(typed.into()), meant, "{typed}");
        }
    }
}
