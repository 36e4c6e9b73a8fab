//! The launcher, which drops its privileges one by one and then executes the confined
//! program. It has a single thread and is a fresh process rather than a fork of the grader, so all
//! its state comes from its arguments.
//!
//! The order matters. Namespaces come first, while the launcher may still create them. Next, the
//! launcher switches to another user, which gives up that right, and sets the limits. Once Landlock
//! is in place, no other files can be opened. The system call filter comes last, because it forbids
//! calls that the earlier steps make.

mod descriptors;
mod files;
mod identity;
mod limits;
mod namespaces;
mod start;
mod syscalls;

use std::ffi::OsString;
use std::fmt::Display;
use std::io::{self, Write};
use std::process::{Command, ExitCode};

use rustix::fs::Mode;
use rustix::process::{setsid, umask};

use super::isolation::Isolation;
use super::launch_request::{LaunchRequest, Profile, READY};
use start::Program;

/// Confines this process as requested, then executes the program given by the remaining arguments.
pub(super) fn launch(mut arguments: impl Iterator<Item = OsString>) -> io::Result<ExitCode> {
    let request = arguments.next().unwrap_or_default();
    let request = serde_json::from_slice(request.as_encoded_bytes())?;
    let program = arguments.next().unwrap_or_default();
    let mut command = Command::new(program);
    command.args(arguments);
    confine(&request, command)
}

fn confine(request: &LaunchRequest, command: Command) -> io::Result<ExitCode> {
    // Detach from the terminal and start a process group that can be killed as a whole.
    setsid().map_err(while_doing("start a new session"))?;
    descriptors::close_inherited()?;

    let user = identity::dedicated_user(request);
    let program = Program::open(command, request)?;
    let program = match request.level {
        Isolation::Full => namespaces::enter(&request.profile, program)?,
        Isolation::NoNamespaces | Isolation::None => program,
    };
    // Don't set the umask earlier, because the folders of the new root must be accessible to every
    // user.
    umask(Mode::RWXG | Mode::RWXO);
    identity::drop_privileges(request, user)?;
    limits::set(request, user)?;
    match request.profile {
        Profile::Probe => start::die_with_grader(request.grader)?,
        Profile::Compiler { .. } => {}
    }
    files::restrict(request, &program)?;
    syscalls::restrict(&request.profile)?;
    match request.profile {
        Profile::Probe => program.exec(),
        Profile::Compiler { .. } => program.supervise(request.limits.cpu),
    }
}

/// Tells the grader that the sandbox is in place.
fn signal_ready() -> io::Result<()> {
    let mut stdout = io::stdout();
    stdout.write_all(&[READY])?;
    stdout.flush()
}

/// Returns a function for `map_err` that prefixes the error's message with the failed action.
fn while_doing<E: Display>(what: &str) -> impl FnOnce(E) -> io::Error {
    let what = what.to_owned();
    move |error| io::Error::other(format!("cannot {what}: {error}"))
}
