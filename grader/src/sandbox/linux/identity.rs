//! Who the confined program is: nobody in particular, with no rights beyond that.

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

/// Far above what any machine gives to people or services.
const HIGH_UID_BASE: u32 = 0x7000_0000;
/// Where so many do not exist, as in most containers without root outside: 500 ids that systemd
/// keeps free of use (`systemd.io/UIDS-GIDS`).
const LOW_UIDS: (u32, u32) = (60_600, 500);

/// Becomes a user of its own if it may, and gives up all rights that go beyond that user's.
pub(super) fn drop_privileges(order: &LaunchRequest, own_user: Option<u32>) -> io::Result<()> {
    if let Some(user) = own_user {
        let switch = || while_doing("become another user, which root needs CAP_SETUID for");
        let (uid, gid) = (Uid::from_raw(user), Gid::from_raw(user));
        if let Profile::Compiler { writable, .. } = &order.profile {
            chown(writable.as_path(), Some(uid), Some(gid)).map_err(switch())?;
        }
        set_thread_groups(&[]).map_err(switch())?;
        set_thread_res_gid(gid, gid, gid).map_err(switch())?;
        set_thread_res_uid(uid, uid, uid).map_err(switch())?;
    }
    // A program that root starts would get root's rights back, were it not for this.
    set_no_new_privs(true).map_err(while_doing("renounce privileges"))?;
    let nothing = CapabilitySets {
        effective: CapabilitySet::empty(),
        permitted: CapabilitySet::empty(),
        inheritable: CapabilitySet::empty(),
    };
    set_capabilities(None, nothing).map_err(while_doing("renounce capabilities"))
}

/// The id of the user that nobody else is. A process's number makes it one that no other program
/// has at the same time. None where we are not root, or the program could not be read by it: the
/// toolchain may lie in root's home, which only namespaces open.
pub(super) fn dedicated_user(order: &LaunchRequest) -> Option<u32> {
    let is_reachable = match order.profile {
        Profile::Probe => true,
        Profile::Compiler { .. } => order.level == Isolation::Full,
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

/// Whether the map, of lines `first there count`, knows this user.
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
