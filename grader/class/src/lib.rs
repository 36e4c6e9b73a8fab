//! Grades a class: what people have from their learning platform, in one command that may be
//! killed at any time.
//!
//! Each submission is graded as `cargo grade` does it, in this process; its student's code runs in
//! processes of its own. One student's disaster is one line of the class.
//!
//! Floors, from the ground up; each imports only from below:
//!
//! | floor | modules |
//! |---|---|
//! | the job | [`class`], [`merge`]; [`written`] |
//! | what is told | [`report`], [`gradebook`], [`summary`], [`spread`], [`drift`]: pure |
//! | the work | [`work`], [`queue`], [`progress`] |
//! | what is kept | [`store`], [`run`], [`outcome`], [`model`], [`late`] |
//! | who handed in what | [`input`], [`no_class`], [`unpack`], [`layout`], [`listing`], [`roster`], [`groups`], [`table`], [`entry`], [`shard`] |

pub mod cli;
pub mod distribution;
pub mod drift;
pub mod entry;
pub mod entry_grader;
pub mod error;
pub mod grade;
pub mod gradebook;
pub mod groups;
pub mod input;
pub mod input_error;
pub mod late;
pub mod layout;
pub mod listing;
pub mod merge;
pub mod model;
pub mod outcome;
pub mod output;
pub mod progress;
pub mod queue;
pub mod report;
pub mod roster;
pub mod run;
pub mod shard;
pub mod store;
pub mod summary;
pub mod table;
pub mod unpack;
