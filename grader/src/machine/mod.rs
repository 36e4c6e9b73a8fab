//! The machine: its files, processes and terminal.

pub(crate) mod backup;
pub mod capture;
pub mod desktop;
pub mod disk;
pub mod files;
pub mod printing;
pub(crate) mod run_permit;
pub mod system;
pub(crate) mod zipfile;
