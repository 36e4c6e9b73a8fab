//! What whoever started the grader had open, and forgot to close.

use std::fs;
use std::io;
use std::os::fd::BorrowedFd;

use rustix::io::{FdFlags, fcntl_setfd};

use super::while_doing;

/// Sees to it that the confined program has the three standard streams and nothing else.
#[allow(unsafe_code, reason = "a number read from /proc is made a descriptor")]
pub(super) fn close_inherited() -> io::Result<()> {
    let own = while_doing("list open files in /proc/self/fd");
    let entries: Vec<_> = fs::read_dir("/proc/self/fd").map_err(own)?.collect();
    for entry in entries {
        let name = entry?.file_name();
        let Some(number) = name.to_str().and_then(|name| name.parse::<i32>().ok()) else {
            continue;
        };
        if number <= 2 {
            continue;
        }
        // SAFETY: borrowed for one call, in a process of one thread, so that nobody closes it
        // meanwhile; and that call changes a flag, which no owner of it relies upon.
        let descriptor = unsafe { BorrowedFd::borrow_raw(number) };
        match fcntl_setfd(descriptor, FdFlags::CLOEXEC) {
            // The one that listed them is closed again by now.
            Ok(()) | Err(rustix::io::Errno::BADF) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}
