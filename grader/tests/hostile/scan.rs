//! Makes forbidden system calls, one after the other, with `unsafe` code, which the compiler
//! wouldn't allow in a submission. `syscalls.rs` compiles it and runs it in place of a submission.
//!
//! Prints a line for each call that was not refused. The arguments are chosen so that a successful
//! call does no harm.

use std::io::Error;

unsafe extern "C" {
    fn syscall(number: i64, ...) -> i64;
}

/// The error codes that a refused call may return: EPERM, EACCES, ENOSYS, ENOENT.
const REFUSED: [i32; 4] = [1, 13, 38, 2];

fn main() {
    let parent = std::os::unix::process::parent_id() as i64;
    let own = std::process::id() as i64;
    let here = c"/".as_ptr() as i64;
    let name = c"hostile".as_ptr() as i64;
    let buffer = [0_u64; 64];
    let buffer = buffer.as_ptr() as i64;
    // The system call numbers are those of x86_64.
    let calls: [(&str, i64, [i64; 5]); 66] = [
        ("open", 2, [here, 0, 0, 0, 0]),
        ("openat", 257, [-100, here, 0, 0, 0]),
        ("openat2", 437, [-100, here, buffer, 24, 0]),
        ("open_by_handle_at", 304, [-100, buffer, 0, 0, 0]),
        ("name_to_handle_at", 303, [-100, here, buffer, buffer, 0]),
        ("stat", 4, [here, buffer, 0, 0, 0]),
        ("statx", 332, [-100, here, 0, 0xfff, buffer]),
        ("access", 21, [here, 0, 0, 0, 0]),
        ("readlink", 89, [here, buffer, 64, 0, 0]),
        ("mkdir", 83, [name, 0o700, 0, 0, 0]),
        ("unlink", 87, [name, 0, 0, 0, 0]),
        ("symlink", 88, [here, name, 0, 0, 0]),
        ("chdir", 80, [here, 0, 0, 0, 0]),
        ("chroot", 161, [here, 0, 0, 0, 0]),
        ("inotify_init1", 294, [0, 0, 0, 0, 0]),
        ("fanotify_init", 300, [0, 0, 0, 0, 0]),
        ("socket, UDP", 41, [2, 2, 0, 0, 0]),
        ("socket, TCP", 41, [2, 1, 0, 0, 0]),
        ("socket, IPv6", 41, [10, 2, 0, 0, 0]),
        ("socket, Unix", 41, [1, 2, 0, 0, 0]),
        ("socket, netlink", 41, [16, 3, 0, 0, 0]),
        ("socket, vsock", 41, [40, 1, 0, 0, 0]),
        ("socket, packet", 41, [17, 3, 0, 0, 0]),
        ("socket, alg", 41, [38, 5, 0, 0, 0]),
        ("socketpair", 53, [1, 2, 0, buffer, 0]),
        ("io_uring_setup", 425, [1, buffer, 0, 0, 0]),
        ("kill the parent", 62, [parent, 0, 0, 0, 0]),
        ("kill everyone", 62, [-1, 0, 0, 0, 0]),
        ("kill the group", 62, [0, 0, 0, 0, 0]),
        ("tgkill the parent", 234, [parent, parent, 0, 0, 0]),
        // SIGCHLD does no harm if it arrives.
        ("tgkill itself, not SIGABRT", 234, [own, own, 17, 0, 0]),
        ("tkill itself", 200, [own, 17, 0, 0, 0]),
        ("rt_sigqueueinfo", 129, [own, 17, buffer, 0, 0]),
        ("rt_tgsigqueueinfo", 297, [own, own, 17, buffer, 0]),
        ("pidfd_send_signal", 424, [0, 17, 0, 0, 0]),
        ("pidfd_open", 434, [parent, 0, 0, 0, 0]),
        ("ptrace", 101, [16, parent, 0, 0, 0]),
        ("process_vm_readv", 310, [parent, buffer, 0, buffer, 0]),
        ("process_vm_writev", 311, [parent, buffer, 0, buffer, 0]),
        ("kcmp", 312, [parent, parent, 1, 0, 0]),
        ("unshare", 272, [0x1000_0000, 0, 0, 0, 0]),
        ("setns", 308, [0, 0, 0, 0, 0]),
        ("mount", 165, [0, here, 0, 1 << 18, 0]),
        ("umount", 166, [name, 0, 0, 0, 0]),
        ("pivot_root", 155, [here, here, 0, 0, 0]),
        ("setsid", 112, [0, 0, 0, 0, 0]),
        ("setpgid", 109, [0, 0, 0, 0, 0]),
        ("setresuid", 117, [0, 0, 0, 0, 0]),
        ("setgroups", 116, [0, 0, 0, 0, 0]),
        ("capset", 126, [buffer, buffer, 0, 0, 0]),
        ("personality", 135, [0xffff_ffff, 0, 0, 0, 0]),
        ("shmget", 29, [0, 4096, 0o1600, 0, 0]),
        ("semget", 64, [0, 1, 0o1600, 0, 0]),
        ("msgget", 68, [0, 0o1600, 0, 0, 0]),
        ("mq_open", 240, [name, 0o102, 0o600, 0, 0]),
        ("memfd_create", 319, [name, 0, 0, 0, 0]),
        (
            "add_key",
            248,
            [c"user".as_ptr() as i64, name, buffer, 8, -2],
        ),
        ("keyctl", 250, [0, -2, 0, 0, 0]),
        ("bpf", 321, [0, buffer, 64, 0, 0]),
        ("perf_event_open", 298, [buffer, 0, -1, -1, 0]),
        ("userfaultfd", 323, [1, 0, 0, 0, 0]),
        ("flock", 73, [1, 8, 0, 0, 0]),
        ("ioctl TIOCSTI", 16, [0, 0x5412, buffer, 0, 0]),
        ("fcntl F_SETOWN", 72, [0, 8, parent, 0, 0]),
        ("setpriority", 141, [0, 0, 0, 0, 0]),
        // If this succeeds, both processes print a line and the child exits.
        ("fork", 57, [0, 0, 0, 0, 0]),
    ];
    for (what, number, [a, b, c, d, e]) in calls {
        // SAFETY: every pointer refers to memory that outlives the call and is large enough for the
        // result.
        let answer = unsafe { syscall(number, a, b, c, d, e, 0_i64) };
        let error = Error::last_os_error().raw_os_error().unwrap_or(0);
        let refused = answer < 0 && REFUSED.contains(&error);
        if !refused {
            println!("{what}");
        }
        if number == 57 && answer == 0 {
            return;
        }
    }
    println!("end");
}
