//! A Slurm cluster that consists of this machine only. Its daemons run as the current user, without
//! systemd or cgroups, and keep all of their files in a temporary folder.

use std::fs;
use std::io::Read;
use std::net::TcpListener;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::harness::successful_stdout;

/// The daemons and commands a cluster needs, from the Debian packages munge, slurmctld, slurmd and
/// slurm-client.
const PROGRAMS: [&str; 6] = [
    "munged",
    "slurmctld",
    "slurmd",
    "sbatch",
    "scontrol",
    "squeue",
];
/// How long a test waits before it fails.
const PATIENCE: Duration = Duration::from_secs(300);

/// A running cluster. When it is dropped, even by a panicking test, its daemons and jobs are
/// killed.
pub struct Cluster {
    folder: TempDir,
}

impl Cluster {
    /// Returns whether Slurm is installed.
    pub fn is_installed() -> bool {
        let works = |program: &&str| {
            let mut version = Command::new(program);
            version.arg(if *program == "munged" {
                "--version"
            } else {
                "-V"
            });
            version.output().is_ok()
        };
        PROGRAMS.iter().all(works)
    }

    /// Starts the daemons and waits until the cluster accepts jobs.
    pub fn start() -> Self {
        let cluster = Cluster {
            folder: TempDir::new().unwrap(),
        };
        let folder = cluster.folder.path();
        fs::create_dir(folder.join("state")).unwrap();
        fs::create_dir(folder.join("spool")).unwrap();
        fs::write(folder.join("slurm.conf"), configuration(folder)).unwrap();
        // By default, slurmd looks for cgroups, which containers lack and only root can change.
        // This plugin doesn't touch them until a job needs it.
        fs::write(folder.join("cgroup.conf"), "CgroupPlugin=cgroup/v1\n").unwrap();

        let mut key = [0; 1024];
        let mut random = fs::File::open("/dev/urandom").unwrap();
        random.read_exact(&mut key).unwrap();
        fs::write(folder.join("munge.key"), key).unwrap();
        let option = |name: &str, file: &str| format!("--{name}={}", folder.join(file).display());
        let own_files = [
            option("socket", "munge.socket"),
            option("key-file", "munge.key"),
            option("pid-file", "munged.pid"),
            option("log-file", "munged.log"),
            option("seed-file", "munged.seed"),
        ];
        let own_files: Vec<&str> = own_files.iter().map(String::as_str).collect();
        set_private(&folder.join("munge.key"));
        // Without `--force`, munged refuses a socket in a folder that only this user can enter.
        cluster.spawn(
            "munged",
            &[&["--foreground", "--force"], &own_files[..]].concat(),
        );
        cluster.wait("munged has started", || {
            folder.join("munge.socket").exists()
        });
        cluster.spawn("slurmctld", &["-D", "-c"]);
        cluster.spawn("slurmd", &["-D", "-N", "localhost"]);
        cluster.wait("the node is idle", || {
            let state = cluster.command("sinfo").args(["-h", "-o", "%T"]).output();
            state.is_ok_and(|output| output.stdout == b"idle\n")
        });
        cluster
    }

    /// Returns a command that uses this cluster.
    pub fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        self.configure(&mut command);
        command
    }

    /// Makes a command use this cluster.
    pub fn configure<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command.env("SLURM_CONF", self.folder.path().join("slurm.conf"))
    }

    /// Returns Slurm's description of a job. For an array, the description has a paragraph for each
    /// task.
    pub fn describe(&self, job: &str) -> String {
        let output = self.command("scontrol").args(["show", "job", job]).output();
        successful_stdout(&output.unwrap())
    }

    /// Waits until no job is queued or running.
    pub fn wait_for_jobs(&self) {
        self.wait("every job has ended", || {
            let output = self.command("squeue").arg("-h").output().unwrap();
            successful_stdout(&output).is_empty()
        });
    }

    /// Starts a daemon that writes its output to a log. The daemon is killed if the test's thread
    /// ends without dropping the cluster.
    fn spawn(&self, daemon: &str, arguments: &[&str]) {
        let log = fs::File::create(self.folder.path().join(format!("{daemon}.txt"))).unwrap();
        let mut command = self.command("setpriv");
        command
            .args(["--pdeathsig", "KILL", daemon])
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(log.try_clone().unwrap())
            .stderr(log);
        let mut child = command.spawn().unwrap();
        // Reap the daemon when it is killed.
        thread::spawn(move || child.wait());
    }

    /// Polls until the condition is true. The daemons can't report it themselves.
    fn wait(&self, condition: &str, is_true: impl Fn() -> bool) {
        let start = Instant::now();
        while !is_true() {
            let waited = start.elapsed();
            assert!(
                waited < PATIENCE,
                "not after {waited:?}: {condition}\n{}",
                self.logs()
            );
            thread::sleep(Duration::from_millis(50));
        }
    }

    fn logs(&self) -> String {
        let files = ["munged.txt", "slurmctld.txt", "slurmd.txt"];
        let log = |name: &str| fs::read_to_string(self.folder.path().join(name));
        files
            .map(|name| format!("{name}:\n{}\n", log(name).unwrap_or_default()))
            .concat()
    }

    /// Returns the process ids of the daemons and of the jobs they started. The environment of each
    /// of these processes contains the path of this cluster's folder.
    fn processes(&self) -> Vec<String> {
        let path = self.folder.path().as_os_str().as_bytes();
        let is_own = |id: &String| {
            let environment = fs::read(format!("/proc/{id}/environ")).unwrap_or_default();
            environment.windows(path.len()).any(|window| window == path)
        };
        let entries = fs::read_dir("/proc").unwrap().flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        let ids = names.filter(|name| name.bytes().all(|byte| byte.is_ascii_digit()));
        ids.filter(is_own).collect()
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        // Before a process is killed, it may start a new process, so one round may not be enough.
        for _ in 0..100 {
            let processes = self.processes();
            if processes.is_empty() {
                return;
            }
            let _ = Command::new("kill").arg("-KILL").args(processes).output();
        }
        eprintln!(
            "processes of the cluster are still running: {:?}",
            self.processes()
        );
    }
}

/// Returns the text of `slurm.conf`, with ports that are currently free.
fn configuration(folder: &Path) -> String {
    let listeners = [0; 2].map(|port| TcpListener::bind(("127.0.0.1", port)).unwrap());
    let [controller, node] = listeners.map(|listener| listener.local_addr().unwrap().port());
    let user = Command::new("id").arg("-un").output().unwrap();
    let user = successful_stdout(&user).trim().to_owned();
    let folder = folder.display();
    format!(
        "ClusterName=test
SlurmctldHost=localhost
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
# The node has more cores and memory than this machine may have.
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1
MailProg=/bin/true
ReturnToService=2
NodeName=localhost CPUs=4 RealMemory=4000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"
    )
}

/// Makes a file readable only by its owner, as munged requires for its key.
fn set_private(path: &Path) {
    use std::os::unix::fs::PermissionsExt;

    fs::set_permissions(path, fs::Permissions::from_mode(0o600)).unwrap();
}
