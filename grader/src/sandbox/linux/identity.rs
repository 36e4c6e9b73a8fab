//! Selects the user that a confined program runs as and drops its privileges.

use std::fs;
use std::io;

use rustix::fs::{Gid, Uid, chown};
use rustix::process::geteuid;
use rustix::thread::{
    CapabilitySet, CapabilitySets, set_capabilities, set_no_new_privs, set_thread_groups,
    set_thread_res_gid, set_thread_res_uid,
};

use super::super::isolation::Isolation;
use super::super::launch_request::{LaunchRequest, Profile};
use super::while_doing;

/// The first id for dedicated users. It is far above all ids that machines assign to people or
/// services.
const HIGH_UID_BASE: u32 = 0x7000_0000;
/// The first id for dedicated users and the number of such ids, on systems without ids as high as
/// [`HIGH_UID_BASE`], e.g. most rootless containers. Systemd leaves these 500 ids unassigned
/// (`systemd.io/UIDS-GIDS`).
const LOW_UIDS: (u32, u32) = (60_600, 500);

/// Switches to the dedicated user, if any, and drops all capabilities for good.
pub(super) fn drop_privileges(request: &LaunchRequest, user: Option<u32>) -> io::Result<()> {
    if let Some(user) = user {
        let switch = || while_doing("switch to another user (root needs CAP_SETUID for this)");
        let (uid, gid) = (Uid::from_raw(user), Gid::from_raw(user));
        if let Profile::Compiler { writable, .. } = &request.profile {
            chown(writable.as_path(), Some(uid), Some(gid)).map_err(switch())?;
        }
        set_thread_groups(&[]).map_err(switch())?;
        set_thread_res_gid(gid, gid, gid).map_err(switch())?;
        set_thread_res_uid(uid, uid, uid).map_err(switch())?;
    }
    // Otherwise, a program started as root would regain root's capabilities.
    set_no_new_privs(true).map_err(while_doing("set no_new_privs"))?;
    let nothing = CapabilitySets {
        effective: CapabilitySet::empty(),
        permitted: CapabilitySet::empty(),
        inheritable: CapabilitySet::empty(),
    };
    set_capabilities(None, nothing).map_err(while_doing("drop capabilities"))
}

/// Returns a user id dedicated to this program. It is derived from the process id, so that programs
/// running at the same time run as different users. Two programs can only get the same id if the
/// few low ids are used.
///
/// Returns `None` if this process isn't root. Also returns `None` for a compiler without
/// namespaces, because its toolchain may be in root's home folder, which no other user can read.
pub(super) fn dedicated_user(request: &LaunchRequest) -> Option<u32> {
    let is_reachable = match request.profile {
        Profile::Probe => true,
        Profile::Compiler { .. } => request.level == Isolation::Full,
    };
    if !geteuid().is_root() || !is_reachable {
        return None;
    }
    let process = std::process::id();
    Some(match fs::read_to_string("/proc/self/uid_map") {
        Ok(map) if is_mapped(&map, HIGH_UID_BASE) => HIGH_UID_BASE + process,
        Ok(_) | Err(_) => LOW_UIDS.0 + process % LOW_UIDS.1,
    })
}

/// Returns whether a user id is mapped by the text of a `uid_map` file, whose lines look like
/// `first outside count`.
fn is_mapped(map: &str, user: u32) -> bool {
    map.lines().any(|line| {
        let mut numbers = line.split_whitespace().map(str::parse::<u64>);
        match (numbers.next(), numbers.next(), numbers.next()) {
            (Some(Ok(first)), Some(Ok(_)), Some(Ok(count))) => {
                (first..first + count).contains(&u64::from(user))
            }
            _ => false,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn high_user_ids_are_used_only_where_they_are_mapped() {
        assert!(is_mapped(
            "         0          0 4294967295\n",
            HIGH_UID_BASE
        ));
        assert!(!is_mapped("0 100000 65536\n", HIGH_UID_BASE));
        assert!(is_mapped("0 100000 65536\n", LOW_UIDS.0));
        assert!(!is_mapped("no map", LOW_UIDS.0));
    }
}
