//! Generates everything in this repository that isn't written by hand: the starter, the exams, and
//! the bundles and packages that are handed out. Also tests the exam by grading many solutions
//! ([`proof`]).
//!
//! This crate never links the reference. Keys are computed in [`oracle`] from the definitions, in
//! double precision. Grading the reference then shows that the reference and the keys agree.
//!
//! The modules form layers. A module only uses modules from layers below its own:
//!
//! | layer | modules |
//! |---|---|
//! | the subcommands | [`commands`] |
//! | the handout, which is checked against the command line | [`handout`] |
//! | the command line | [`cli`] |
//! | packages for platforms; the proof that the exam is right, and what it covers | [`package`], [`proof`], [`coverage`] |
//! | whole exams; the students' bundle | [`exams`], [`bundle`] |
//! | additions to an exam; part two's files | [`hints`], [`drawing_data`], [`light`] |
//! | solutions, and how they are built and run | [`solutions`] |
//! | assignments as data | [`authoring`] |
//! | an exam's items | [`items`] |
//! | what the contract allows | [`domains`] |
//! | trees with decoys; other generated files | [`tree`], [`starter`] |
//! | correct answers, random numbers, files | [`oracle`], [`seed`], [`generated_file`], [`long_runs`] |

pub mod authoring;
pub mod bundle;
pub mod cli;
pub mod commands;
pub mod coverage;
pub mod domains;
pub mod drawing_data;
pub mod exams;
pub mod generated_file;
pub mod handout;
pub mod hints;
pub mod items;
pub mod light;
pub mod long_runs;
pub mod oracle;
pub mod package;
pub mod proof;
pub mod seed;
pub mod solutions;
pub mod starter;
pub mod tree;
