//! Linux namespaces: separate mounts, network, System V IPC objects and host name, plus separate
//! processes for the compiler. The new root contains only the files listed in the profile.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use rustix::fs::StatVfsMountFlags;
use rustix::mount::{
    MountFlags, MountPropagationFlags, UnmountFlags, mount, mount_bind_recursive, mount_change,
    mount_remount, unmount,
};
use rustix::process::{getegid, geteuid, pivot_root};
use rustix::thread::{UnshareFlags, unshare_unsafe};

use super::super::launch_request::Profile;
use super::start::Program;
use super::while_doing;

/// The mount point of the new root. Any folder that exists on every system would do.
const NEW_ROOT: &str = "/tmp";
/// The path of the machine's root inside the new root, until it is unmounted.
const OLD_ROOT: &str = "/host";
/// The path of a probe in the new root.
const PROBE_PATH: &str = "/probe";

/// Moves this process into new namespaces. Returns the program with its path in the new root.
pub(super) fn enter(profile: &Profile, program: Program) -> io::Result<Program> {
    let (program, mounts) = match profile {
        Profile::Probe => {
            let mount = BindMount::read_only(program.path(), PathBuf::from(PROBE_PATH));
            (
                Program::with_path(program.into_command(), PROBE_PATH.into()),
                vec![mount?],
            )
        }
        Profile::Compiler { readable, writable } => {
            let null = Path::new("/dev/null");
            let mut mounts = readable
                .iter()
                .map(|path| BindMount::read_only(path, path.clone()))
                .collect::<io::Result<Vec<_>>>()?;
            for path in [null, writable.as_path()] {
                let mount = BindMount::read_only(path, path.to_owned())?;
                mounts.push(BindMount {
                    is_writable: true,
                    ..mount
                });
            }
            (program, mounts)
        }
    };
    unshare(profile)?;
    switch_root(&mounts)?;
    // Relative paths in the arguments start from this folder.
    let folder = match profile {
        Profile::Probe => Path::new("/"),
        Profile::Compiler { writable, .. } => writable,
    };
    std::env::set_current_dir(folder)?;
    Ok(program)
}

/// A file or folder on the machine that is mounted in the new root.
struct BindMount {
    /// The path on the machine. It must not contain symbolic links, because they would be resolved
    /// in the new root.
    source: PathBuf,
    target: PathBuf,
    is_writable: bool,
    /// Whether the source is mounted `noexec` on the machine. An unprivileged user cannot remove
    /// that flag.
    is_noexec: bool,
}

impl BindMount {
    fn read_only(source: &Path, target: PathBuf) -> io::Result<Self> {
        let source =
            fs::canonicalize(source).map_err(while_doing(&format!("find {}", source.display())))?;
        let flags = rustix::fs::statvfs(&source)?.f_flag;
        Ok(BindMount {
            source,
            target,
            is_writable: false,
            is_noexec: flags.contains(StatVfsMountFlags::NOEXEC),
        })
    }
}

#[allow(
    unsafe_code,
    reason = "the call would be unsound only with a flag that is not used here"
)]
fn unshare(profile: &Profile) -> io::Result<()> {
    let (uid, gid) = (geteuid(), getegid());
    let mut flags = UnshareFlags::NEWNS
        | UnshareFlags::NEWNET
        | UnshareFlags::NEWIPC
        | UnshareFlags::NEWUTS
        | UnshareFlags::NEWCGROUP;
    match profile {
        // A probe cannot start processes, so none can outlive it.
        Profile::Probe => {}
        // The compiler becomes the namespace's first process. When it ends, all other processes in
        // the namespace are killed.
        Profile::Compiler { .. } => flags |= UnshareFlags::NEWPID,
    }
    if !uid.is_root() {
        flags |= UnshareFlags::NEWUSER;
    }
    // SAFETY: the call is only unsafe with the flag FILES, which is not set.
    unsafe { unshare_unsafe(flags) }.map_err(while_doing(
        "create namespaces: a container's rules or the system's settings (`sysctl \
            kernel.apparmor_restrict_unprivileged_userns user.max_user_namespaces`) forbid it",
    ))?;
    if !uid.is_root() {
        // Map only this user, and to the same id. If the user were mapped to root, the compiler
        // would behave differently.
        let itself = |id: u32| format!("{id} {id} 1");
        let map = || while_doing("map the user into the namespace");
        fs::write("/proc/self/setgroups", "deny").map_err(map())?;
        fs::write("/proc/self/uid_map", itself(uid.as_raw())).map_err(map())?;
        fs::write("/proc/self/gid_map", itself(gid.as_raw())).map_err(map())?;
    }
    Ok(())
}

fn switch_root(mounts: &[BindMount]) -> io::Result<()> {
    let private = MountPropagationFlags::PRIVATE | MountPropagationFlags::REC;
    mount_change("/", private).map_err(while_doing("make mounts private"))?;
    let safe = MountFlags::NOSUID | MountFlags::NODEV;
    mount("tmpfs", NEW_ROOT, "tmpfs", safe, c"size=1m,mode=755")
        .map_err(while_doing("mount a tmpfs"))?;
    let new_root = Path::new(NEW_ROOT);
    let old_root = new_root.join(OLD_ROOT.trim_start_matches('/'));
    fs::create_dir(&old_root)?;
    pivot_root(new_root, &old_root).map_err(while_doing("change the root"))?;
    std::env::set_current_dir("/")?;

    let mut folders: Vec<&Path> = Vec::new();
    for mount in mounts {
        if folders
            .iter()
            .any(|folder| mount.target.starts_with(folder))
        {
            continue;
        }
        bind(mount).map_err(while_doing(&format!("mount {}", mount.target.display())))?;
        if mount.target.is_dir() {
            folders.push(&mount.target);
        }
    }

    unmount(OLD_ROOT, UnmountFlags::DETACH).map_err(while_doing("unmount the old root"))?;
    fs::remove_dir(OLD_ROOT)?;
    let read_only = MountFlags::BIND | MountFlags::RDONLY | safe;
    mount_remount("/", read_only, c"").map_err(while_doing("make the new root read-only"))
}

fn bind(mount: &BindMount) -> io::Result<()> {
    let source = Path::new(OLD_ROOT).join(mount.source.strip_prefix("/").unwrap_or(&mount.source));
    let target = mount.target.as_path();
    if source.is_dir() {
        fs::create_dir_all(target)?;
    } else {
        fs::create_dir_all(target.parent().unwrap_or(Path::new("/")))?;
        fs::File::create(target)?;
    }
    mount_bind_recursive(&source, target)?;
    // The only writable file is `/dev/null`. Don't remount it, because NODEV would make it
    // unusable.
    if mount.is_writable && !source.is_dir() {
        return Ok(());
    }
    let mut flags = MountFlags::BIND | MountFlags::NOSUID | MountFlags::NODEV;
    flags.set(MountFlags::RDONLY, !mount.is_writable);
    flags.set(MountFlags::NOEXEC, mount.is_noexec);
    Ok(mount_remount(target, flags, c"")?)
}
