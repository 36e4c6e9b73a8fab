//! Grades a path-tracing submission: builds it, runs the exam, judges the answers and writes a
//! score.
//!
//! Student code runs in a *probe*, a process that receives questions but never the expected
//! answers. Points only come from comparing the probe's answers with the expected ones, outside the
//! probe.
//!
//! The modules form layers. A module only imports from modules that come after it in this table,
//! which a test checks:
//!
//! | layer | modules |
//! |---|---|
//! | commands | [`cli`], [`terminal`], [`replay`], [`watch`], [`doctor`], [`reset`], [`hand_in`] |
//! | grading | [`grade`] |
//! | exam runs | [`run_exam`], [`verdict`] |
//! | reports | [`mod@format`], [`report`], [`drawing`], [`svg`] |
//! | steps of an exam run | [`build`], [`probe`] |
//! | results | [`score`] |
//! | inputs | [`policy`], [`submission`], `inputs`, [`workspace`], [`handed_out`] |
//! | the machine | [`sandbox`], [`error`], [`png_file`], `machine` |
//!
//! Some submodules are re-exported at the top level for other packages.
//!
//! The package [`judging`] is below all of them. It contains exams, their keys and the code that
//! compares answers with keys.

pub mod build;
pub mod cli;
pub mod doctor;
pub mod drawing;
pub mod error;
pub mod format;
pub mod grade;
pub mod hand_in;
pub mod handed_out;
mod inputs;
mod machine;
pub mod png_file;
pub mod policy;
pub mod probe;
pub mod replay;
pub mod report;
pub mod reset;
pub mod run_exam;
pub mod sandbox;
pub mod score;
pub mod submission;
pub mod svg;
pub mod terminal;
pub mod verdict;
pub mod watch;
pub mod workspace;

pub use build::select_isolation;
pub use grade::{options, report_files};
pub use inputs::{exam_source, nearest_name, question_ref, task_selection};
pub use machine::{capture, desktop, disk, files, printing, system};
pub use report::answers as report_answers;
pub use run_exam::task_session;
pub use score::rerun_command;
pub use verdict::{clue, item_outcome};
pub use workspace::given_files;
