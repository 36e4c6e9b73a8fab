//! Lists of allowed system calls, by number. Calls that only exist on x86 are listed separately,
//! since newer architectures use different calls for the same purpose.

use libc::*;

/// Calls that every program needs to start, compute and exit.
pub(super) const COMMON: &[c_long] = &[
    // memory
    SYS_brk,
    SYS_mmap,
    SYS_munmap,
    SYS_mprotect,
    SYS_mremap,
    SYS_madvise,
    // open file descriptors
    SYS_read,
    SYS_write,
    SYS_readv,
    SYS_writev,
    SYS_close,
    SYS_fstat,
    SYS_lseek,
    SYS_dup,
    SYS_dup3,
    SYS_pipe2,
    SYS_ppoll,
    // threads and signals
    SYS_clone3,
    SYS_futex,
    SYS_set_robust_list,
    SYS_set_tid_address,
    SYS_rseq,
    SYS_sched_yield,
    SYS_sched_getaffinity,
    SYS_gettid,
    SYS_getpid,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_sigaltstack,
    SYS_restart_syscall,
    // time and random numbers
    SYS_nanosleep,
    SYS_clock_nanosleep,
    SYS_clock_gettime,
    SYS_clock_getres,
    SYS_gettimeofday,
    SYS_getrandom,
    // start and exit
    SYS_execve,
    SYS_exit,
    SYS_exit_group,
];

/// Additional calls that a compiler and a linker need.
pub(super) const COMPILER: &[c_long] = &[
    // files (Landlock and the mount namespace restrict which files are accessible)
    SYS_openat,
    SYS_newfstatat,
    SYS_statx,
    SYS_statfs,
    SYS_fstatfs,
    SYS_faccessat,
    SYS_faccessat2,
    SYS_readlinkat,
    SYS_getdents64,
    SYS_getcwd,
    SYS_chdir,
    SYS_fchdir,
    SYS_mkdirat,
    SYS_unlinkat,
    SYS_renameat2,
    SYS_linkat,
    SYS_symlinkat,
    SYS_fchmod,
    SYS_fchmodat,
    SYS_umask,
    SYS_truncate,
    SYS_ftruncate,
    SYS_fallocate,
    SYS_fsync,
    SYS_fdatasync,
    SYS_msync,
    SYS_pread64,
    SYS_pwrite64,
    SYS_preadv,
    SYS_pwritev,
    SYS_copy_file_range,
    SYS_sendfile,
    SYS_fadvise64,
    SYS_utimensat,
    SYS_fcntl,
    SYS_flock,
    SYS_ioctl,
    SYS_eventfd2,
    // child processes
    SYS_wait4,
    SYS_waitid,
    SYS_pidfd_open,
    SYS_pselect6,
    SYS_recvfrom,
    SYS_recvmsg,
    SYS_sendto,
    SYS_sendmsg,
    SYS_execveat,
    SYS_getppid,
    SYS_getpgid,
    SYS_setpgid,
    SYS_tgkill,
    SYS_prlimit64,
    SYS_prctl,
    SYS_getrusage,
    SYS_times,
    SYS_membarrier,
    SYS_rt_sigtimedwait,
    SYS_rt_sigsuspend,
    SYS_setitimer,
    SYS_sched_setaffinity,
    SYS_sched_getparam,
    SYS_sched_getscheduler,
    SYS_mincore,
    SYS_mlock,
    SYS_munlock,
    // identity and system information
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_getgroups,
    SYS_uname,
    SYS_sysinfo,
    SYS_getcpu,
    SYS_getpriority,
];

/// Calls that belong to [`COMMON`] but only exist on x86.
#[cfg(target_arch = "x86_64")]
pub(super) const COMMON_X86: &[c_long] = &[SYS_arch_prctl, SYS_dup2, SYS_pipe, SYS_poll];

/// Calls that belong to [`COMPILER`] but only exist on x86.
#[cfg(target_arch = "x86_64")]
pub(super) const COMPILER_X86: &[c_long] = &[
    SYS_open,
    SYS_creat,
    SYS_stat,
    SYS_lstat,
    SYS_access,
    SYS_readlink,
    SYS_mkdir,
    SYS_rmdir,
    SYS_unlink,
    SYS_rename,
    SYS_renameat,
    SYS_link,
    SYS_symlink,
    SYS_chmod,
    SYS_select,
    SYS_vfork,
    SYS_fork,
    SYS_getpgrp,
    SYS_time,
    SYS_alarm,
    SYS_utime,
];

/// These calls don't exist on this architecture.
#[cfg(not(target_arch = "x86_64"))]
pub(super) const COMMON_X86: &[c_long] = &[];

/// These calls don't exist on this architecture.
#[cfg(not(target_arch = "x86_64"))]
pub(super) const COMPILER_X86: &[c_long] = &[];
