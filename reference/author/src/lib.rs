//! Generates everything in this repository that is not written by hand: the starter, the exams, the
//! scenes' meshes, the handout's figures, and the bundles and packages that are handed out. Also
//! tests the exam, by grading many solutions ([`proof`]).
//!
//! This crate never links the reference. Keys are computed from the definitions, in double
//! precision, in [`oracle`]. Grading the reference then shows that the reference and the keys
//! agree.

pub mod bundle;
pub mod cli;
pub mod drawing_data;
pub mod exams;
pub mod generated_file;
pub mod handout;
pub mod hints;
pub mod items;
pub mod oracle;
pub mod package;
pub mod proof;
pub mod recording;
pub mod scenes;
pub mod seed;
pub mod starter;
pub mod tree;
