//! Code that depends on the operating system. All `cfg` attributes for operating systems in this
//! crate are in this module.

use std::fs::File;
use std::io;

/// Moves the grader's pipes away from standard input and output and returns them: the first is for
/// reading questions, the second for writing answers. Afterwards, a submission's output goes to
/// standard error, and its standard input is empty.
#[cfg(unix)]
pub(crate) fn claim_standard_streams() -> io::Result<(File, File)> {
    use std::os::fd::AsFd;

    let questions = io::stdin().as_fd().try_clone_to_owned()?;
    let answers = io::stdout().as_fd().try_clone_to_owned()?;
    // Use a pipe whose write end is closed. This opens no file, so it also works in a sandbox.
    let (nothing, _) = rustix::pipe::pipe()?;
    rustix::stdio::dup2_stdin(nothing)?;
    rustix::stdio::dup2_stdout(io::stderr())?;
    Ok((File::from(questions), File::from(answers)))
}

/// The same function for Windows. The standard library looks up its streams at each use, so it uses
/// the redirected streams.
#[cfg(windows)]
pub(crate) fn claim_standard_streams() -> io::Result<(File, File)> {
    use filedescriptor::{FileDescriptor, Pipe, StdioDescriptor};

    let nothing = Pipe::new().map_err(io::Error::other)?.read;
    let claim = |stream, instead: &FileDescriptor| {
        FileDescriptor::redirect_stdio(instead, stream)?.as_file()
    };
    let questions = claim(StdioDescriptor::Stdin, &nothing).map_err(io::Error::other)?;
    let stderr = FileDescriptor::dup(&io::stderr()).map_err(io::Error::other)?;
    let answers = claim(StdioDescriptor::Stdout, &stderr).map_err(io::Error::other)?;
    Ok((questions, answers))
}

/// Makes the operating system kill this process when the grader ends, no matter how it ends.
/// Otherwise, an infinite loop would keep running for minutes after a Ctrl-C. A sandbox may forbid
/// this call, but then the sandbox itself ends the process when the grader ends.
#[cfg(target_os = "linux")]
pub(crate) fn end_with_the_grader() {
    use rustix::process::{Signal, set_parent_process_death_signal};

    set_parent_process_death_signal(Some(Signal::KILL)).ok();
}

/// Does nothing, because there is no portable way to do this on other systems. A busy probe keeps
/// running until its time limit. A probe that is waiting for a question ends when the stream of
/// questions ends.
#[cfg(not(target_os = "linux"))]
pub(crate) fn end_with_the_grader() {}
