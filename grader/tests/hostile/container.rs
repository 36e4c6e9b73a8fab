//! The restrictions of an ordinary container that matter here.

use std::collections::BTreeMap;

use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, apply_filter,
};

/// The flags for all namespaces that `clone` can create.
const NAMESPACES: i32 = libc::CLONE_NEWCGROUP
    | libc::CLONE_NEWIPC
    | libc::CLONE_NEWNET
    | libc::CLONE_NEWNS
    | libc::CLONE_NEWPID
    | libc::CLONE_NEWUSER
    | libc::CLONE_NEWUTS;

/// Forbids namespaces and mounts for this process and all processes it starts. The error codes are
/// the same as those of Docker's filter, which also makes `clone3` appear not to exist.
pub fn enter() {
    let refused = [
        libc::SYS_unshare,
        libc::SYS_setns,
        libc::SYS_mount,
        libc::SYS_umount2,
        libc::SYS_pivot_root,
    ];
    let mut calls: BTreeMap<i64, Vec<SeccompRule>> =
        refused.into_iter().map(|call| (call, Vec::new())).collect();
    let each = (0..32)
        .map(|bit| NAMESPACES & (1 << bit))
        .filter(|flag| *flag != 0);
    let has_flag = |flag: i32| {
        let flag = flag as u64;
        let is_set = SeccompCmpOp::MaskedEq(flag);
        let condition = SeccompCondition::new(0, SeccompCmpArgLen::Qword, is_set, flag);
        SeccompRule::new(vec![condition.expect("the first argument")]).expect("a rule")
    };
    calls.insert(libc::SYS_clone, each.map(has_flag).collect());
    refuse(calls, libc::EPERM);
    refuse([(libc::SYS_clone3, Vec::new())].into(), libc::ENOSYS);
}

fn refuse(calls: BTreeMap<i64, Vec<SeccompRule>>, error: i32) {
    let architecture = std::env::consts::ARCH
        .try_into()
        .expect("a supported architecture");
    let action = SeccompAction::Errno(error as u32);
    let filter = SeccompFilter::new(calls, SeccompAction::Allow, action, architecture);
    let program: BpfProgram = filter.expect("a filter").try_into().expect("a program");
    apply_filter(&program).expect("the filter is installed");
}
