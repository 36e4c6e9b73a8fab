//! Tests of the whole package: the exam, the proof that it is right, and the files made for
//! students.

mod bundle;
mod calibration;
mod cost;
mod harness;
mod in_sync;
mod items;
mod layers;
mod mutants;
mod package;
mod proof;
mod sample_exams;
mod toy;
mod trees;
mod workflow;
