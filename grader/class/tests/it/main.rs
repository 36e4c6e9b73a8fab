//! Tests of the `class` binary, with classes like those that platforms export.

mod faulty_submissions;
mod gradebooks;
mod harness;
#[cfg(target_os = "linux")]
mod large_class;
mod layouts;
mod machine_faults;
mod resuming;
mod shards;
