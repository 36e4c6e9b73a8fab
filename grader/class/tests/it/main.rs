//! Tests the `class` binary with classes like those that platforms export.

mod anonymous;
mod attempts;
mod characters;
mod clones;
mod every_oddity;
mod faulty_submissions;
mod gradebooks;
mod handing_back;
mod handing_in_again;
mod harness;
mod identity;
mod layouts;
mod manual_points;
mod numbers;
mod page;
mod people;
mod platforms;
mod policy_changes;
mod random_names;
mod recipes;
mod replay;
mod resuming;
#[cfg(unix)]
mod runner_commands;
mod second_run;
mod shards;
mod similar_pairs;
mod similarity;
mod stored_class;
mod times;
mod ungraded_files;
mod void_items;
