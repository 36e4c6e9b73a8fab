//! What differs between operating systems, and nothing else: all of this crate's `cfg` for them
//! stands here.

use std::fs::File;
use std::io;

/// Moves the grader's pipes away from standard input and output: the first is where questions come
/// from, the second where answers go. What a submission prints then goes to standard error, and
/// what it tries to read is at its end.
#[cfg(unix)]
pub(crate) fn claim_standard_streams() -> io::Result<(File, File)> {
    use std::os::fd::AsFd;

    let questions = io::stdin().as_fd().try_clone_to_owned()?;
    let answers = io::stdout().as_fd().try_clone_to_owned()?;
    // A pipe whose other end is closed: no file is opened, so this also works in a sandbox.
    let (nothing, _) = rustix::pipe::pipe()?;
    rustix::stdio::dup2_stdin(nothing)?;
    rustix::stdio::dup2_stdout(io::stderr())?;
    Ok((File::from(questions), File::from(answers)))
}

/// The same. The standard library looks its streams up each time, so that it follows.
#[cfg(windows)]
pub(crate) fn claim_standard_streams() -> io::Result<(File, File)> {
    use filedescriptor::{FileDescriptor, Pipe, StdioDescriptor};

    let nothing = Pipe::new().map_err(io::Error::other)?.read;
    let claim = |stream, instead: &FileDescriptor| {
        FileDescriptor::redirect_stdio(instead, stream)?.as_file()
    };
    let questions = claim(StdioDescriptor::Stdin, &nothing).map_err(io::Error::other)?;
    let words = FileDescriptor::dup(&io::stderr()).map_err(io::Error::other)?;
    let answers = claim(StdioDescriptor::Stdout, &words).map_err(io::Error::other)?;
    Ok((questions, answers))
}

/// Ends this process when the grader ends, however that does: what hangs would go on for minutes
/// after a Ctrl-C. A sandbox may forbid it, and sees to it itself.
#[cfg(target_os = "linux")]
pub(crate) fn end_with_the_grader() {
    use rustix::process::{Signal, set_parent_process_death_signal};

    set_parent_process_death_signal(Some(Signal::KILL)).ok();
}

/// The same, where nothing tells: what computes goes on to its limit, what waits ends with the
/// questions.
#[cfg(not(target_os = "linux"))]
pub(crate) fn end_with_the_grader() {}
