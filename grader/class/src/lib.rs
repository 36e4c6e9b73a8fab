//! Grades a class from a learning platform's export, in one command. It can be killed at any time,
//! and resumes when it is run again.
//!
//! Each submission is graded in this process, as `cargo grade` would grade it; student code runs in
//! separate processes. A submission that fails affects only its own result.
//!
//! Layers, from top to bottom; a module imports only from its own layer or those below:
//!
//! | layer | modules |
//! |---|---|
//! | commands | [`grade`], [`merge`]; [`output`] |
//! | reports | [`report`], [`gradebook`], [`hand_back`], [`similarity`], [`estimate`], [`summary`], [`distribution`] |
//! | grading of entries | [`entry_grader`], [`submission_grader`], [`queue`], [`progress`] |
//! | results | [`drift`], [`final_grades`], [`list_memory`], [`store`], [`run`], [`outcome`], [`model`], [`attempts`], [`late`], [`manual`] |
//! | input | [`input`], [`unpack`], [`layout`], [`listing`], [`lists`], [`list_kind`], [`roster`], [`groups`], [`table`], [`entry`], [`moodle_status`], [`identity`], [`names`], [`shard`], [`paths`], [`archive`], [`cli`], [`error`] |

pub mod archive;
pub mod attempts;
pub mod cli;
pub mod distribution;
pub mod drift;
pub mod entry;
pub mod entry_grader;
pub mod error;
pub mod estimate;
pub mod final_grades;
pub mod grade;
pub mod gradebook;
pub mod groups;
pub mod hand_back;
pub mod identity;
pub mod input;
pub mod late;
pub mod layout;
pub mod list_kind;
pub mod list_memory;
pub mod listing;
pub mod lists;
pub mod manual;
pub mod merge;
pub mod model;
pub mod moodle_status;
pub mod names;
pub mod outcome;
pub mod output;
pub mod paths;
pub mod progress;
pub mod queue;
pub mod report;
pub mod roster;
pub mod run;
pub mod shard;
pub mod similarity;
pub mod store;
pub mod submission_grader;
pub mod summary;
pub mod table;
pub mod unpack;
