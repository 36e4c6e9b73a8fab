//! Grades a path-tracing submission: builds it, runs the exam, judges the answers and writes a
//! score.
//!
//! Student code runs in a *probe*, a process that receives questions and never the expected
//! answers. Points come only from comparing its answers here.
//!
//! Layers. A module imports only from modules that come after it in this table, which a test checks:
//!
//! | layer | modules |
//! |---|---|
//! | commands | [`cli`], [`terminal`], [`replay`], [`watch`], [`doctor`], [`reset`], [`hand_in`] |
//! | grading | [`cache_lookup`], [`grade`], [`cached_report`], [`report_files`], [`error`], [`options`] |
//! | exam runs | [`run_exam`], `explain`, [`task_session`], [`kept_state`], [`verdict`] |
//! | reports | [`mod@format`], [`report`], [`report_answers`], [`drawing`], [`svg`] |
//! | steps of an exam run | [`item_outcome`], [`clue`], [`select_isolation`], [`build`], [`probe`] |
//! | results | [`score`], [`rerun_command`], [`source_paths`], [`bundle_version`], [`given_files`], [`stage_times`] |
//! | inputs | [`policy`], [`submission`], [`exam_source`], [`question_ref`], [`task_selection`], [`book`], [`workspace`], [`handed_out`] |
//! | the machine | `backup`, [`sandbox`], [`capture`], [`desktop`], [`printing`], [`zipfile`], [`png_file`], [`files`], [`disk`], [`system`], [`alone`], [`nearest_name`] |
//!
//! The package [`judging`] is below all of them: exams, their keys, and the comparison of answers
//! with keys.

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
pub mod png_file;
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
