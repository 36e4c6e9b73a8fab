//! Keeps the confined program from inheriting the file descriptors that the grader inherited from
//! its own parent process.

use std::fs;
use std::io;
use std::os::fd::BorrowedFd;

use rustix::io::{FdFlags, fcntl_setfd};

use super::while_doing;

/// Ensures that the confined program inherits nothing except the three standard streams.
#[allow(
    unsafe_code,
    reason = "a number read from /proc is used as a descriptor"
)]
pub(super) fn close_inherited() -> io::Result<()> {
    let error = while_doing("list open files in /proc/self/fd");
    let entries: Vec<_> = fs::read_dir("/proc/self/fd").map_err(error)?.collect();
    for entry in entries {
        let name = entry?.file_name();
        let Some(number) = name.to_str().and_then(|name| name.parse::<i32>().ok()) else {
            continue;
        };
        if number <= 2 {
            continue;
        }
        // SAFETY: the descriptor is borrowed for one call in a single-threaded process, so it
        // cannot be closed meanwhile. The call only changes a flag that no owner relies on.
        let descriptor = unsafe { BorrowedFd::borrow_raw(number) };
        match fcntl_setfd(descriptor, FdFlags::CLOEXEC) {
            // The descriptor used for listing is closed by now.
            Ok(()) | Err(rustix::io::Errno::BADF) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}
