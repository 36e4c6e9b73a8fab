//! The system call filters (seccomp) of a confined program.
//!
//! Each profile has a list of allowed calls. All other calls fail, including calls that newer
//! kernels add. A filter is compiled for this machine's architecture. A call made through another
//! architecture's interface kills the program.

use std::collections::BTreeMap;
use std::io;

use libc::c_long;
use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, apply_filter,
};

use super::super::launch_request::Profile;
use super::while_doing;

mod allowed;

/// The system calls that a filter lists, by number. A call matches if it has no rules or if one of
/// its rules is satisfied.
type CallRules = BTreeMap<i64, Vec<SeccompRule>>;

/// Blocks all system calls except those of the profile. This is the last step before the program is
/// executed.
pub(super) fn restrict(profile: &Profile) -> io::Result<()> {
    let filters = filters(profile).map_err(while_doing("compile the system call filter"))?;
    for filter in &filters {
        apply_filter(filter).map_err(while_doing("install the system call filter"))?;
    }
    Ok(())
}

fn filters(profile: &Profile) -> Result<[BpfProgram; 2], seccompiler::Error> {
    // The C library creates threads with `clone3`, whose arguments a filter cannot inspect. It
    // falls back to `clone` only if `clone3` fails with ENOSYS, while a probe's other calls must
    // fail with EPERM. A filter has a single error for all refused calls, so there are two filters.
    // If they disagree about a call, the stricter result applies.
    let no_clone3 = compile_filter(
        [(libc::SYS_clone3, Vec::new())].into(),
        SeccompAction::Allow,
        SeccompAction::Errno(libc::ENOSYS as u32),
    )?;
    let allowed = match profile {
        Profile::Probe => compile_filter(
            probe_calls()?,
            SeccompAction::Errno(libc::EPERM as u32),
            SeccompAction::Allow,
        )?,
        // The error is ENOSYS, because compilers and linkers then fall back to other calls.
        Profile::Compiler { .. } => compile_filter(
            compiler_calls()?,
            SeccompAction::Errno(libc::ENOSYS as u32),
            SeccompAction::Allow,
        )?,
    };
    Ok([no_clone3, allowed])
}

fn compile_filter(
    calls: CallRules,
    default_action: SeccompAction,
    listed_action: SeccompAction,
) -> Result<BpfProgram, seccompiler::Error> {
    let architecture = std::env::consts::ARCH.try_into()?;
    Ok(SeccompFilter::new(calls, default_action, listed_action, architecture)?.try_into()?)
}

/// Returns the calls that a probe may make: it computes, creates threads, and uses its pipes.
fn probe_calls() -> Result<CallRules, seccompiler::Error> {
    let mut calls = unconditional(&[allowed::COMMON, allowed::COMMON_X86]);
    let thread = libc::CLONE_THREAD as u64;
    calls.insert(
        libc::SYS_clone,
        vec![if_argument(0, masked(thread), thread)?],
    );
    // A program may only signal itself, since its user may have other processes, and only with
    // SIGABRT, for `abort`. With other signals, it could choose how it seems to end: SIGKILL looks
    // as if memory had run out, which isn't considered the program's fault, so the grader would
    // have to be run again.
    let own = u64::from(std::process::id());
    let abort = libc::SIGABRT as u64;
    let equal = |argument, value| {
        SeccompCondition::new(argument, SeccompCmpArgLen::Dword, SeccompCmpOp::Eq, value)
    };
    calls.insert(
        libc::SYS_tgkill,
        vec![SeccompRule::new(vec![equal(0, own)?, equal(2, abort)?])?],
    );
    // `F_SETOWN` and similar commands aren't allowed: with them, a program can have the kernel
    // signal any process when data arrives.
    let harmless = [
        libc::F_DUPFD,
        libc::F_DUPFD_CLOEXEC,
        libc::F_GETFD,
        libc::F_SETFD,
        libc::F_GETFL,
    ];
    calls.insert(
        libc::SYS_fcntl,
        if_argument_in(1, harmless.map(|command| command as u64))?,
    );
    // Limits may be read but not set, so the pointer to the new limit must be null.
    calls.insert(
        libc::SYS_prlimit64,
        vec![SeccompRule::new(vec![SeccompCondition::new(
            2,
            SeccompCmpArgLen::Qword,
            SeccompCmpOp::Eq,
            0,
        )?])?],
    );
    // `prctl` may only name threads. In particular, the program must not cancel the signal that
    // kills it when the grader ends.
    calls.insert(
        libc::SYS_prctl,
        if_argument_in(0, [libc::PR_SET_NAME as u64])?,
    );
    Ok(calls)
}

/// Returns the calls that a compiler may make: it reads and writes files and starts programs, but
/// cannot use the network or create namespaces.
fn compiler_calls() -> Result<CallRules, seccompiler::Error> {
    let mut calls = unconditional(&[
        allowed::COMMON,
        allowed::COMMON_X86,
        allowed::COMPILER,
        allowed::COMPILER_X86,
    ]);
    let namespaces = [
        libc::CLONE_NEWNS,
        libc::CLONE_NEWCGROUP,
        libc::CLONE_NEWUTS,
        libc::CLONE_NEWIPC,
        libc::CLONE_NEWUSER,
        libc::CLONE_NEWPID,
        libc::CLONE_NEWNET,
    ];
    let namespaces = namespaces.into_iter().fold(0, |all, one| all | one) as u64;
    calls.insert(
        libc::SYS_clone,
        vec![if_argument(0, masked(namespaces), 0)?],
    );
    // Only allow signals to the process's own group, which is how the launcher kills that group.
    calls.insert(libc::SYS_kill, vec![if_argument(0, SeccompCmpOp::Eq, 0)?]);
    // Rust's standard library uses a socket pair to start programs. Sockets of this type stay
    // connected, while a datagram socket could send messages to other sockets.
    let unix = SeccompCondition::new(
        0,
        SeccompCmpArgLen::Dword,
        SeccompCmpOp::Eq,
        libc::AF_UNIX as u64,
    )?;
    let pair = SeccompCondition::new(
        1,
        SeccompCmpArgLen::Dword,
        masked(0xf),
        libc::SOCK_SEQPACKET as u64,
    )?;
    calls.insert(
        libc::SYS_socketpair,
        vec![SeccompRule::new(vec![unix, pair])?],
    );
    Ok(calls)
}

fn unconditional(lists: &[&[c_long]]) -> CallRules {
    let calls = lists.iter().copied().flatten();
    calls.map(|call| (*call, Vec::new())).collect()
}

fn masked(mask: u64) -> SeccompCmpOp {
    SeccompCmpOp::MaskedEq(mask)
}

/// Returns a rule that compares a 32-bit argument of the call with `value`.
fn if_argument(
    argument: u8,
    operator: SeccompCmpOp,
    value: u64,
) -> Result<SeccompRule, seccompiler::Error> {
    let condition = SeccompCondition::new(argument, SeccompCmpArgLen::Dword, operator, value)?;
    Ok(SeccompRule::new(vec![condition])?)
}

/// Returns one rule for each of `values`. A rule is satisfied if the 32-bit argument equals its
/// value.
fn if_argument_in<const N: usize>(
    argument: u8,
    values: [u64; N],
) -> Result<Vec<SeccompRule>, seccompiler::Error> {
    let rules = values
        .into_iter()
        .map(|value| if_argument(argument, SeccompCmpOp::Eq, value));
    rules.collect()
}
