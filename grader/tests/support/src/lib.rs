//! The parts shared by the tests of several packages.
//!
//! Pages are tested in headless Chromium, controlled over the DevTools protocol. If Chromium isn't
//! installed, [`Chromium::start`] prints a notice and the tests pass, or fail if `CI` is set.

mod chromium;
mod devtools;
pub mod processes;
#[cfg(unix)]
pub mod programs;
mod watch;

pub use chromium::Chromium;
pub use devtools::{DESKTOP, Tab, Viewer, violations};
pub use watch::WatchProcess;
