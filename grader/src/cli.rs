//! The command line of `cargo grade`.

use std::path::PathBuf;

use clap::builder::StyledStr;
use clap::{CommandFactory, FromArgMatches, Id, Parser, value_parser};

use crate::build::select_isolation::IsolationRequest;
use crate::error::Error;
use crate::format::{FORMATS, OutputSpec};
use crate::grade::options::{Dependents, GradeOptions};
use crate::handed_out::HandedOut;
use crate::inputs::exam_source::ExamSource;
use crate::inputs::question_ref::QuestionRef;
use crate::inputs::task_selection::{NamedTasks, TaskSelection};
use crate::machine::printing::exit_with;
use crate::probe::Budget;
use crate::report::text::HintDetail;
use crate::sandbox::Isolation;
use crate::terminal::PrintOptions;

/// The heading for options that students don't need. Only `--help-staff` shows them.
const STAFF_OPTIONS: &str = "Options for course staff and CI";
/// The arguments that can be combined with `--reset`. The others are about grading.
const WITH_RESET: [&str; 4] = ["submission", "reset", "assignment", "help_staff"];
/// The last line of the help for students.
const MORE_HELP: &str =
    "`cargo grade --help-staff` also shows the options for course staff and CI.";

/// A command with all of its options.
#[derive(Clone, Debug)]
pub enum Command {
    /// Grade a submission.
    Grade(GradeOptions, PrintOptions),
    /// Grade a submission again whenever a file is saved.
    Watch {
        /// The options for grading.
        options: GradeOptions,
        /// Whether to open the report's page in a browser.
        open: bool,
    },
    /// Run one question again.
    Replay(GradeOptions, QuestionRef),
    /// Reset tasks in a submission's folder.
    Reset {
        /// The assignment.
        handed_out: &'static HandedOut,
        /// The folder; `None` is the folder of students' own work.
        folder: Option<PathBuf>,
        /// The tasks and files to reset.
        names: Vec<NamedTasks>,
    },
    /// Show the tools and isolation levels available on this machine.
    Diagnose,
    /// Print the JSON schema of the score file.
    PrintSchema,
    /// Print the default policy.
    PrintDefaultPolicy,
    /// Print the help with all options (its text is included here).
    PrintHelp(StyledStr),
}

/// Grades a path-tracing submission: builds it, runs the exam and writes a score
///
/// Exit codes: 0 graded, whatever the score; 1 graded, but below --require; 2 invalid command line,
/// submission or exam; 3 the grader itself failed.
#[derive(Clone, Debug, Parser)]
#[command(name = "cargo grade", bin_name = "cargo grade", version)]
pub struct Arguments {
    /// The folder, .zip, .tar or .tar.gz with the task files (at its top, in src/, or in
    /// student/src/); default: student
    pub submission: Option<PathBuf>,

    /// Grade one task only, such as sphere, or all tasks of a file, such as bvh; writes no score
    #[arg(long, value_name = "TASK")]
    pub task: Option<String>,

    /// Run one question again, such as sphere.from_inside#7, and show the whole answer; without a
    /// number, the first wrong question of the item
    #[arg(long, value_name = "ITEM[#N]", conflicts_with_all = ["task", "require", "out"])]
    pub replay: Option<QuestionRef>,

    /// Start a task afresh, such as sphere, or a whole file, such as bvh; keeps a copy of your file,
    /// such as bvh.rs.bak-1
    #[arg(long, value_name = "TASK")]
    pub reset: Option<String>,

    /// If a known mistake is recognised, show its full hint instead of a nudge
    #[arg(long)]
    pub hints: bool,

    /// Grade again whenever a file is saved, starting with what failed; stop with Ctrl-C
    #[arg(long, conflicts_with_all = ["replay", "require"])]
    pub watch: bool,

    /// Open the HTML report when it is written
    #[arg(long, conflicts_with_all = ["task", "replay"])]
    pub open: bool,

    /// Grade again, even if nothing has changed since the last time
    #[arg(long)]
    pub fresh: bool,

    /// Print at the end how long each step took
    #[arg(long, conflicts_with_all = ["replay", "watch"])]
    pub timings: bool,

    /// Show the compiler, the available isolation levels, and what is missing on this machine
    #[arg(long)]
    pub doctor: bool,

    /// The assignment; default: that of the exam file, or rays
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

    /// Treat the code as untrusted: run it in a sandbox, or refuse to grade it
    #[arg(long, help_heading = STAFF_OPTIONS)]
    pub untrusted: bool,

    /// Require this isolation level; --untrusted takes the better of full and no-namespaces
    #[arg(long, value_name = "LEVEL", help_heading = STAFF_OPTIONS)]
    pub isolation: Option<Isolation>,

    /// Block items that depend on a failed task, as on a student's machine, instead of grading them
    /// with the reference's parts
    #[arg(long, help_heading = STAFF_OPTIONS)]
    pub no_reference: bool,

    /// CPU time limit of an item, in seconds; default: 50 times the slowest item that has passed,
    /// at least 2 and at most 10 seconds
    #[arg(long, value_name = "SECONDS", help_heading = STAFF_OPTIONS)]
    #[arg(value_parser = value_parser!(u64).range(1..=Budget::MAX_SECONDS))]
    pub cpu_limit: Option<u64>,

    /// The course's policy: how points count and what students see; --policy-default prints the
    /// default
    #[arg(long, value_name = "FILE", help_heading = STAFF_OPTIONS)]
    pub policy: Option<PathBuf>,

    /// Print the default policy, with comments on every key, and exit
    #[arg(long, help_heading = STAFF_OPTIONS)]
    pub policy_default: bool,

    /// Gradescope's submission_metadata.json, which has the submission time and the due date for
    /// the policy's late days
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
        let matches = Self::for_students().try_get_matches();
        let arguments = matches.and_then(|matches| Self::from_arg_matches(&matches));
        arguments.unwrap_or_else(|error| exit_with(&error))
    }

    /// Returns the definition of the command line, with help that only shows students' options.
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

    /// Returns the command that these arguments select. Fails if the arguments name a task that the
    /// assignment doesn't have.
    pub fn resolve(self) -> Result<Command, Error> {
        let exam = ExamSource::from_option(self.exam);
        let handed_out = exam.assignment(self.assignment);
        let assignment = handed_out.assignment;
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
            require: self.require.unwrap_or(0),
        };
        if let Some(text) = self.reset {
            let names = NamedTasks::parse_list(&text, assignment)
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
            None => Command::Grade(options, print),
        })
    }
}

fn format_help() -> String {
    let known = FORMATS.map(|format| format.id).join(", ");
    // The list is the last paragraph, so that it can grow without rewrapping the rest.
    format!(
        "Also write these formats, which contain what the policy lets students see. Each is written \
         to =PATH if given, else where the platform expects it, else to the --out folder.\n\
         Formats: {known}"
    )
}

/// Returns the error for a value that can only be checked once the assignment is known, in clap's
/// wording.
fn invalid_value(option: &str, value: &str, why: &str) -> Error {
    Error::User(format!(
        "invalid value '{value}' for '{option}': {why}\n\nFor more information, try '--help'."
    ))
}
