//! Grades a path-tracing submission: builds it, runs the exam, judges the answers and writes a
//! score.
//!
//! Student code runs in a *probe*, a process that receives questions and never the expected
//! answers. Points come only from comparing its answers here.
//!
//! Layers, from top to bottom. A module imports only from layers below its own:
//!
//! | layer | modules |
//! |---|---|
//! | commands | [`cli`], [`terminal`], [`replay`], [`watch`], [`doctor`], [`reset`], [`hand_in`] |
//! | grading | [`grade`], [`cache_lookup`]; [`options`] |
//! | files of the report | [`cached_report`], [`report_files`] |
//! | exam runs and reports | [`run_exam`], [`verdict`], [`report_answers`], [`report`], [`mod@format`] |
//! | steps of an exam run | [`select_isolation`], [`build`], [`probe`]; [`drawing`] of judged answers, in [`svg`] |
//! | results | [`score`], [`rerun_command`], [`source_paths`], [`bundle_version`], [`given_files`], [`stage_times`] |
//! | inputs | [`policy`], [`submission`], [`handed_out`], [`exam_source`], [`question_ref`], [`task_selection`] |
//! | a separate package | [`judging`]: exams, their keys, and the comparison of answers with keys |
//! | the machine | [`book`], [`workspace`], [`sandbox`], [`capture`], [`desktop`], [`printing`], [`zipfile`]; [`files`], above [`disk`]; [`system`], [`nearest_name`] |

pub mod alone;
mod backup;
pub mod book;
pub mod build;
pub mod bundle_version;
pub mod cache_lookup;
pub mod cached_report;
pub mod capture;
pub mod cli;
pub mod clue;
pub mod desktop;
pub mod disk;
pub mod doctor;
pub mod drawing;
pub mod error;
pub mod exam_source;
mod explain;
pub mod files;
pub mod format;
pub mod given_files;
pub mod grade;
pub mod hand_in;
pub mod handed_out;
pub mod item_outcome;
pub mod kept_state;
pub mod nearest_name;
pub mod options;
pub mod policy;
pub mod printing;
pub mod probe;
pub mod question_ref;
pub mod replay;
pub mod report;
pub mod report_answers;
pub mod report_files;
pub mod rerun_command;
pub mod reset;
pub mod run_exam;
pub mod sandbox;
pub mod score;
pub mod select_isolation;
#[cfg(test)]
mod small_exam;
pub mod source_paths;
pub mod stage_times;
pub mod submission;
pub mod svg;
pub mod system;
pub mod task_selection;
pub mod task_session;
pub mod terminal;
pub mod verdict;
pub mod watch;
pub mod workspace;
pub mod zipfile;
