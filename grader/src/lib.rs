//! Grades a path-tracing submission: builds it, asks it, judges its answers, writes a score.
//!
//! Student code runs in a *probe*, a process that is told questions and never what counts as
//! right. Points come only from comparing its answers here.
//!
//! Floors, from the ground up; each imports only from below:
//!
//! | floor | modules |
//! |---|---|
//! | the job | [`grade`], [`replay`], [`unchanged`], [`watch`], [`doctor`]; [`earlier`], [`files`] |
//! | one exam | [`examine`], [`verdict`], [`exhibit`], [`report`], [`mod@format`] |
//! | its steps | [`isolate`], [`build`], [`ask`]; [`drawing`] of what was judged |
//! | data | [`place`], [`again`], [`policy`], [`submission`], [`given`], [`stages`], [`score`] |
//! | [`judging`], a package of its own | [`exam`], [`judge`] and what else is named below |
//! | the machine | [`workspace`], [`sandbox`], [`capture`], [`desktop`], [`system`], [`zipfile`] |

pub use judging::{
    describe, drawing_data, exam, exam_file, judge, picture, recognise, sanitize, section,
    signatures,
};

pub mod build;
pub mod cache_lookup;
pub mod cached_report;
pub mod capture;
pub mod cli;
pub mod desktop;
pub mod doctor;
pub mod drawing;
pub mod error;
pub mod format;
pub mod given_files;
pub mod grade;
pub mod policy;
pub mod probe;
pub mod question_ref;
pub mod replay;
pub mod report;
pub mod report_answers;
pub mod report_files;
pub mod rerun_command;
pub mod run_exam;
pub mod sandbox;
pub mod score;
pub mod select_isolation;
pub mod stage_times;
pub mod submission;
pub mod system;
pub mod verdict;
pub mod watch;
pub mod workspace;
pub mod zipfile;
