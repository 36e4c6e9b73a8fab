//! A world of its own: other mounts, network, System V objects, host name, and for the compiler
//! other processes. In it are the files of the profile, and no others to find.

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

/// Where the new root is put together. Any folder does that everyone has.
const NEW_ROOT: &str = "/tmp";
/// Where the machine's own root is to be found meanwhile.
const OLD_ROOT: &str = "/host";
/// Where a probe is to be found from then on.
const PROBE_PATH: &str = "/probe";

/// Enters it; returns the program as it is found there.
pub(super) fn enter(profile: &Profile, program: Program) -> io::Result<Program> {
    let (program, shown) = match profile {
        Profile::Probe => {
            let shown = BindMount::read_only(program.path(), PathBuf::from(PROBE_PATH));
            (
                Program::with_path(program.into_command(), PROBE_PATH.into()),
                vec![shown?],
            )
        }
        Profile::Compiler { readable, writable } => {
            let null = Path::new("/dev/null");
            let mut shown = readable
                .iter()
                .map(|path| BindMount::read_only(path, path.clone()))
                .collect::<io::Result<Vec<_>>>()?;
            for path in [null, writable.as_path()] {
                let with_writing = BindMount::read_only(path, path.to_owned())?;
                shown.push(BindMount {
                    is_writable: true,
                    ..with_writing
                });
            }
            (program, shown)
        }
    };
    unshare(profile)?;
    switch_root(&shown)?;
    // Relative arguments are meant from here.
    let folder = match profile {
        Profile::Probe => Path::new("/"),
        Profile::Compiler { writable, .. } => writable,
    };
    std::env::set_current_dir(folder)?;
    Ok(program)
}

/// A file or folder of the machine that is there in the new root as well.
struct BindMount {
    /// Where it is, without symbolic links: those would be followed in the new root.
    source: PathBuf,
    target: PathBuf,
    is_writable: bool,
    /// Whether nothing in it may be run: without rights on the machine itself, that can not be
    /// taken back.
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
    reason = "with one flag, which is not used, it would be unsound"
)]
fn unshare(profile: &Profile) -> io::Result<()> {
    let (uid, gid) = (geteuid(), getegid());
    let mut flags = UnshareFlags::NEWNS
        | UnshareFlags::NEWNET
        | UnshareFlags::NEWIPC
        | UnshareFlags::NEWUTS
        | UnshareFlags::NEWCGROUP;
    match profile {
        // A probe can start nothing, and so leave nothing behind.
        Profile::Probe => {}
        // The compiler will be the first process in there: with it, all end.
        Profile::Compiler { .. } => flags |= UnshareFlags::NEWPID,
    }
    if !uid.is_root() {
        flags |= UnshareFlags::NEWUSER;
    }
    // SAFETY: the flag that this is unsafe for, FILES, is not among them.
    unsafe { unshare_unsafe(flags) }.map_err(while_doing(
        "make namespaces: a container's rules, or the system's (`sysctl \
         kernel.apparmor_restrict_unprivileged_userns user.max_user_namespaces`), forbid it",
    ))?;
    if !uid.is_root() {
        // Itself, and nobody else: with root's number, the compiler would do strange things.
        let itself = |id: u32| format!("{id} {id} 1");
        let map = || while_doing("set the users of a namespace");
        fs::write("/proc/self/setgroups", "deny").map_err(map())?;
        fs::write("/proc/self/uid_map", itself(uid.as_raw())).map_err(map())?;
        fs::write("/proc/self/gid_map", itself(gid.as_raw())).map_err(map())?;
    }
    Ok(())
}

fn switch_root(shown: &[BindMount]) -> io::Result<()> {
    let private = MountPropagationFlags::PRIVATE | MountPropagationFlags::REC;
    mount_change("/", private).map_err(while_doing("keep mounts to itself"))?;
    let safe = MountFlags::NOSUID | MountFlags::NODEV;
    mount("tmpfs", NEW_ROOT, "tmpfs", safe, c"size=1m,mode=755")
        .map_err(while_doing("mount a tmpfs"))?;
    let stage = Path::new(NEW_ROOT);
    let host = stage.join(OLD_ROOT.trim_start_matches('/'));
    fs::create_dir(&host)?;
    pivot_root(stage, &host).map_err(while_doing("change the root"))?;
    std::env::set_current_dir("/")?;

    let mut folders: Vec<&Path> = Vec::new();
    for shown in shown {
        if folders
            .iter()
            .any(|folder| shown.target.starts_with(folder))
        {
            continue;
        }
        bind(shown).map_err(while_doing(&format!("show {}", shown.target.display())))?;
        if shown.target.is_dir() {
            folders.push(&shown.target);
        }
    }

    unmount(OLD_ROOT, UnmountFlags::DETACH).map_err(while_doing("leave the old root"))?;
    fs::remove_dir(OLD_ROOT)?;
    let read_only = MountFlags::BIND | MountFlags::RDONLY | safe;
    mount_remount("/", read_only, c"").map_err(while_doing("close the new root"))
}

fn bind(shown: &BindMount) -> io::Result<()> {
    let source = Path::new(OLD_ROOT).join(shown.source.strip_prefix("/").unwrap_or(&shown.source));
    let target = shown.target.as_path();
    if source.is_dir() {
        fs::create_dir_all(target)?;
    } else {
        fs::create_dir_all(target.parent().unwrap_or(Path::new("/")))?;
        fs::File::create(target)?;
    }
    mount_bind_recursive(&source, target)?;
    // A device that can not be used as one is of no use: `/dev/null` stays as it is.
    if shown.is_writable && !source.is_dir() {
        return Ok(());
    }
    let mut flags = MountFlags::BIND | MountFlags::NOSUID | MountFlags::NODEV;
    flags.set(MountFlags::RDONLY, !shown.is_writable);
    flags.set(MountFlags::NOEXEC, shown.is_noexec);
    Ok(mount_remount(target, flags, c"")?)
}
