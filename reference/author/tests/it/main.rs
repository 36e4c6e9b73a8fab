//! Tests of the whole package: the exam, the proof that it is right, and the files made for
//! students.

mod bundle;
mod cost;
mod harness;
mod in_sync;
mod items;
mod layers;
mod package;
mod proof;
mod toy;
mod trees;
mod workflow;
