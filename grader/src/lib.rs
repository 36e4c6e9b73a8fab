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
//! | one exam | [`examine`], [`recognise`], [`verdict`], [`exhibit`], [`report`], [`mod@format`] |
//! | its steps | [`isolate`], [`build`], [`ask`], [`judge`]; [`picture`] and [`drawing`] of what was judged |
//! | data | [`exam`], [`tells`], [`exam_file`], [`section`], [`shown`], [`place`], [`again`], [`policy`], [`submission`], [`given`], [`stages`], [`score`] |
//! | the machine | [`workspace`], [`sandbox`], [`capture`], [`desktop`], [`system`] |

pub mod again;
pub mod ask;
pub mod build;
pub mod capture;
pub mod cli;
pub mod describe;
pub mod desktop;
pub mod doctor;
pub mod drawing;
pub mod earlier;
pub mod error;
pub mod exam;
pub mod exam_file;
pub mod examine;
pub mod exhibit;
pub mod files;
pub mod format;
pub mod given;
pub mod grade;
pub mod isolate;
pub mod judge;
pub mod picture;
pub mod place;
pub mod policy;
pub mod recognise;
pub mod replay;
pub mod report;
pub mod sandbox;
pub mod score;
pub mod section;
pub mod shown;
pub mod stages;
pub mod submission;
pub mod system;
pub mod tame;
pub mod tells;
pub mod unchanged;
pub mod verdict;
pub mod watch;
pub mod workspace;
