//! Which system calls the confined program may make. All others fail, whatever their arguments.
//!
//! Both are lists of what is allowed: a call that is not known here, of a newer kernel or by another
//! way into it, is refused. Compiled for this machine's architecture; calls of any other end the
//! program.

use std::collections::BTreeMap;
use std::io;

use libc::c_long;
use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, apply_filter,
};

use super::super::launch_request::Profile;
use super::while_doing;

mod lists;

/// The calls, each with the conditions of which one must hold, if there are any.
type CallRules = BTreeMap<i64, Vec<SeccompRule>>;

/// Closes all system calls but those of the profile. The last step before the program itself.
pub(super) fn restrict(profile: &Profile) -> io::Result<()> {
    let filters = filters(profile).map_err(while_doing("write the list of system calls"))?;
    for filter in &filters {
        apply_filter(filter).map_err(while_doing("close system calls"))?;
    }
    Ok(())
}

fn filters(profile: &Profile) -> Result<[BpfProgram; 2], seccompiler::Error> {
    // Threads are made by `clone3`, whose arguments a filter can not see. Where it does not exist,
    // the C library turns to `clone`, but only then: so it must seem not to exist, while every other
    // call is refused. A filter knows one answer, hence two; of two answers the stricter counts.
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
        // What does not exist, compilers and linkers do in another way.
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
    others: SeccompAction,
    these: SeccompAction,
) -> Result<BpfProgram, seccompiler::Error> {
    let architecture = std::env::consts::ARCH.try_into()?;
    Ok(SeccompFilter::new(calls, others, these, architecture)?.try_into()?)
}

/// Computes, makes threads, speaks through its pipes.
fn probe_calls() -> Result<CallRules, seccompiler::Error> {
    let mut calls = unconditional(&[lists::COMMON, lists::COMMON_X86]);
    let thread = libc::CLONE_THREAD as u64;
    calls.insert(
        libc::SYS_clone,
        vec![if_argument(0, masked(thread), thread)?],
    );
    // `abort` signals its own process. There are other processes of the same user.
    let own = u64::from(std::process::id());
    calls.insert(
        libc::SYS_tgkill,
        vec![if_argument(0, SeccompCmpOp::Eq, own)?],
    );
    // Not `F_SETOWN` and its like: with those, the arrival of data kills whomever one names.
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
    // Limits may be read.
    calls.insert(
        libc::SYS_prlimit64,
        vec![SeccompRule::new(vec![SeccompCondition::new(
            2,
            SeccompCmpArgLen::Qword,
            SeccompCmpOp::Eq,
            0,
        )?])?],
    );
    // Threads may be named, and nothing else be changed: not whose end ends the program either.
    calls.insert(
        libc::SYS_prctl,
        if_argument_in(0, [libc::PR_SET_NAME as u64])?,
    );
    Ok(calls)
}

/// Reads and writes files, starts programs. No network, no other users of the machine.
fn compiler_calls() -> Result<CallRules, seccompiler::Error> {
    let mut calls = unconditional(&[
        lists::COMMON,
        lists::COMMON_X86,
        lists::COMPILER,
        lists::COMPILER_X86,
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
    // Its own group: how the launcher ends it.
    calls.insert(libc::SYS_kill, vec![if_argument(0, SeccompCmpOp::Eq, 0)?]);
    // Rust's standard library starts programs with one. Connected for good: no message through it
    // can be addressed to another socket, as through one of datagrams.
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

/// If this argument, of 32 bits, compares so.
fn if_argument(
    argument: u8,
    how: SeccompCmpOp,
    value: u64,
) -> Result<SeccompRule, seccompiler::Error> {
    let condition = SeccompCondition::new(argument, SeccompCmpArgLen::Dword, how, value)?;
    Ok(SeccompRule::new(vec![condition])?)
}

/// If this argument, of 32 bits, is one of these.
fn if_argument_in<const N: usize>(
    argument: u8,
    values: [u64; N],
) -> Result<Vec<SeccompRule>, seccompiler::Error> {
    let rules = values
        .into_iter()
        .map(|value| if_argument(argument, SeccompCmpOp::Eq, value));
    rules.collect()
}
