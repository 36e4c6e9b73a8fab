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
    describe, exam, exam_file, judge, picture, recognise, section, shown, tame, tells,
};

pub mod again;
pub mod ask;
pub mod build;
pub mod capture;
pub mod cli;
pub mod desktop;
pub mod doctor;
pub mod drawing;
pub mod earlier;
pub mod error;
pub mod examine;
pub mod exhibit;
pub mod files;
pub mod format;
pub mod given;
pub mod grade;
pub mod isolate;
pub mod place;
pub mod policy;
pub mod replay;
pub mod report;
pub mod sandbox;
pub mod score;
pub mod stages;
pub mod submission;
pub mod system;
pub mod unchanged;
pub mod verdict;
pub mod watch;
pub mod workspace;
pub mod zipfile;
