//! Grades a class from a learning platform's export in one command. It can be killed at any time
//! and resumes when run again.
//!
//! Each submission is graded in this process, as `cargo grade` would grade it. Student code runs in
//! separate processes. A failing submission only affects its own result.
//!
//! Layers, from top to bottom. A module imports only from layers below its own:
//!
//! | layer | modules |
//! |---|---|
//! | merging of shards | [`merge`] |
//! | grading of a class | [`grade`] |
//! | files of a class | [`output`], [`similarity`] |
//! | reports for people | [`report`] |
//! | grading of entries, changes in scores, and questions about them | [`entry_grader`], [`regrade_diff`], [`replay`] |
//! | results derived from grades, and the input | [`anonymous`], [`final_grades`], [`gradebook`], [`hand_back`], [`hand_in_again`], [`summary`], [`input`] |
//! | grades, lists and the grader | [`attempts`], [`corrected`], [`entry_completion`], [`list_memory`], [`submission_grader`], [`unpack`] |
//! | a graded class | [`graded_class`] |
//! | results, layouts and rules for people | [`groups`], [`late`], [`layout`], [`manual_points`], [`progress`], [`similar_pairs`], [`store`] |
//! | outcomes and people in lists | [`identity`], [`outcome`], [`roster`] |
//! | options, entries and tables | [`cli`], [`entry`], [`moodle_status`], [`run`], [`table`] |
//! | tools | [`distribution`], [`error`], [`estimate`], [`file_tree`], [`layout_kind`], [`list_kind`], [`names`], [`paths`], [`queue`], [`shard`] |

pub mod anonymous;
pub mod attempts;
pub mod cli;
pub mod corrected;
pub mod distribution;
pub mod entry;
pub mod entry_completion;
pub mod entry_grader;
pub mod error;
pub mod estimate;
pub mod file_tree;
pub mod final_grades;
pub mod grade;
pub mod gradebook;
pub mod graded_class;
pub mod groups;
pub mod hand_back;
pub mod hand_in_again;
pub mod identity;
pub mod input;
pub mod late;
pub mod layout;
pub mod layout_kind;
pub mod list_kind;
pub mod list_memory;
pub mod manual_points;
pub mod merge;
pub mod moodle_status;
pub mod names;
pub mod outcome;
pub mod output;
pub mod paths;
pub mod progress;
pub mod queue;
pub mod regrade_diff;
pub mod replay;
pub mod report;
pub mod roster;
pub mod run;
pub mod shard;
pub mod similar_pairs;
pub mod similarity;
pub mod store;
pub mod submission_grader;
pub mod summary;
pub mod table;
pub mod unpack;
