//! The launcher: gives up, one after the other, all that the confined program shall not have, and
//! then becomes that program. One thread, no fork of its own memory: whatever state it has, it has
//! read from its arguments.
//!
//! The order matters. Namespaces first, as long as there are rights to make them; then the user,
//! which ends those rights; then limits; Landlock, which no file can be opened after; and last the
//! list of system calls, on which none of the calls before stands.

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

/// Confines itself as it was ordered, and becomes the program after the order.
pub(super) fn launch(mut arguments: impl Iterator<Item = OsString>) -> io::Result<ExitCode> {
    let order = arguments.next().unwrap_or_default();
    let order = serde_json::from_slice(order.as_encoded_bytes())?;
    let program = arguments.next().unwrap_or_default();
    let mut command = Command::new(program);
    command.args(arguments);
    confine(&order, command)
}

fn confine(order: &LaunchRequest, command: Command) -> io::Result<ExitCode> {
    // No terminal, and a group that can be ended as one.
    setsid().map_err(while_doing("leave the session"))?;
    descriptors::close_inherited()?;

    let own_user = identity::dedicated_user(order);
    let program = Program::open(command, order)?;
    let program = match order.level {
        Isolation::Full => namespaces::enter(&order.profile, program)?,
        Isolation::NoNamespaces | Isolation::SeccompOnly | Isolation::None => program,
    };
    // Not earlier: the folders of the new root are for everyone.
    umask(Mode::RWXG | Mode::RWXO);
    identity::drop_privileges(order, own_user)?;
    limits::set(order, own_user)?;
    match order.profile {
        Profile::Probe => start::die_with_grader(order.grader)?,
        Profile::Compiler { .. } => {}
    }
    if order.level >= Isolation::NoNamespaces {
        files::restrict(order, &program)?;
    }
    syscalls::restrict(&order.profile)?;
    match order.profile {
        Profile::Probe => program.exec(),
        Profile::Compiler { .. } => program.supervise(order.limits.cpu),
    }
}

/// Tells the grader that all is in place.
fn signal_ready() -> io::Result<()> {
    let mut stdout = io::stdout();
    stdout.write_all(&[READY])?;
    stdout.flush()
}

/// An error that says what was being done.
fn while_doing<E: Display>(what: &str) -> impl FnOnce(E) -> io::Error {
    let what = what.to_owned();
    move |error| io::Error::other(format!("can not {what}: {error}"))
}
