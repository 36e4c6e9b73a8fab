//! Simulates a platform's machine: a root directory with only this system's programs, no network,
//! the platform's user and capabilities, half a core and 768 MiB of memory.
//!
//! This needs root privileges, directly or via `sudo`.

use std::env;
use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use grader::files::{self, AtPath};

/// The script that runs a command on the simulated machine.
const ENTER_SCRIPT: &str = include_str!("../templates/trial/machine.sh");
/// The script that stands in for `cargo` and `rustc` on a machine with rustup.
const PROXY_SCRIPT: &str = include_str!("../templates/trial/rust_proxy.sh");
/// The script that runs a command with limited CPU time and memory.
const LIMIT_SCRIPT: &str = include_str!("../templates/trial/limits.sh");
/// The folders with the system's programs.
const SYSTEM_PATH: &str = "/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin";
/// The arguments for `unshare` that give the machine its own namespaces.
const NAMESPACES: [&str; 5] = ["--mount", "--net", "--pid", "--fork", "--kill-child"];
const NO_CARGO: &str = "CARGO is not set: run `cargo author package … --check`";
/// The exit code of [`LIMIT_SCRIPT`] if control groups cannot be used.
const NO_LIMITS_CODE: i32 = 125;

/// The result of a command.
#[derive(Clone, Debug)]
pub struct JobResult {
    /// The exit code, or `None` if the command was killed by a signal.
    pub code: Option<i32>,
    /// Standard output and standard error.
    pub output: String,
    /// The elapsed time.
    pub wall_time: Duration,
    /// The resources used, if the job was limited.
    pub usage: Option<ResourceUsage>,
}

/// The resources that a command and its child processes used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ResourceUsage {
    /// The CPU time.
    pub cpu: Duration,
    /// The peak memory, in bytes. `None` if the system doesn't report it.
    pub peak_memory: Option<u64>,
}

/// A simulated machine.
#[derive(Clone, Debug)]
pub struct Machine {
    /// The machine's root directory, as a path on the host.
    pub root: PathBuf,
    toolchain: PathBuf,
    /// The prefix for running a command as root: empty, or `sudo -n`.
    root_prefix: Vec<&'static str>,
    is_limited: bool,
}

impl Machine {
    /// Creates an empty machine in the folder `root`. If this system cannot simulate a machine,
    /// prints the reason and returns `None`.
    pub fn create(root: &Path) -> Result<Option<Self>> {
        let cargo = env::var_os("CARGO").unwrap_or_default();
        let toolchain = Path::new(&cargo).parent().and_then(Path::parent);
        let toolchain = toolchain.context(NO_CARGO)?.to_owned();
        let mut prefixes = [vec![], vec!["sudo", "-n"]].into_iter();
        let Some(root_prefix) = prefixes.find(|prefix| can_unshare(prefix)) else {
            let missing = "the trial requires Linux with namespaces, and root or sudo";
            return skip_or_fail(missing).map(|()| None);
        };
        let mut machine = Machine {
            root: root.to_owned(),
            toolchain,
            root_prefix,
            is_limited: true,
        };
        machine.remove(root)?;
        files::create_dir_all(root)?;
        machine.is_limited = machine.can_limit()?;
        if !machine.is_limited {
            skip_or_fail("control groups cannot be created: the trial runs without limits")?;
        }
        Ok(Some(machine))
    }

    /// Installs Rust for root as rustup does: with proxies that look for the toolchain in the home
    /// folder. Returns the definition of a `PATH` that contains these proxies but not the toolchain
    /// itself.
    pub fn install_rustup(&self) -> Result<String> {
        let toolchains = self.host_path("root/.rustup/toolchains");
        files::create_dir_all(&toolchains)?;
        let default = toolchains.join("default");
        symlink(&self.toolchain, &default).at("create", &default)?;
        let proxies = self.host_path("root/.cargo/bin");
        files::create_dir_all(&proxies)?;
        for name in ["cargo", "rustc"] {
            let proxy = proxies.join(name);
            files::write(&proxy, PROXY_SCRIPT)?;
            let mode = Permissions::from_mode(0o755);
            fs::set_permissions(&proxy, mode).at("change", &proxy)?;
        }
        Ok(format!("PATH=/root/.cargo/bin:{SYSTEM_PATH}"))
    }

    /// Converts a path on the machine to a path on the host.
    pub fn host_path(&self, path: &str) -> PathBuf {
        self.root.join(path.trim_start_matches('/'))
    }

    /// Removes a folder on the host, regardless of its owner.
    pub fn remove(&self, folder: &Path) -> Result<()> {
        let mut command = self.root_command("rm");
        command.arg("-rf").arg(folder);
        Ok(command.status().map(drop).at("remove", folder)?)
    }

    /// Runs a command in a folder on the machine. `variables` are the platform's environment
    /// variables, each in the form `NAME=value`.
    ///
    /// `user` is `container`, i.e. root with the capabilities of a Docker container, or `runner`,
    /// the user on GitHub's runners. If `is_limited` is true, the command gets half a core and 768
    /// MiB of memory. Platforms set no limits while they build an image.
    pub fn run(
        &self,
        user: &str,
        folder: &str,
        variables: &[String],
        is_limited: bool,
        command_line: &[String],
    ) -> Result<JobResult> {
        let usage_file = &self.root.with_extension("used");
        let is_limited = self.is_limited && is_limited;
        let mut command = self.root_command(if is_limited { "sh" } else { "unshare" });
        if is_limited {
            let script = command.args(["-c", LIMIT_SCRIPT, "sh"]);
            script.arg(usage_file).arg("unshare");
        }
        command
            .args(NAMESPACES)
            .args(["sh", "-c", ENTER_SCRIPT, "sh"])
            .args([&self.root, &self.toolchain])
            .args([user, folder, "LANG=C.UTF-8"])
            // `PATH` is passed as an argument, because `env -i` clears the environment.
            .arg(format!(
                "PATH={}/bin:{SYSTEM_PATH}",
                self.toolchain.display()
            ))
            .args(variables)
            .args(command_line);
        let start = Instant::now();
        let output = command.output().at("run", "unshare")?;
        let text = [output.stdout, output.stderr].concat();
        let usage = is_limited.then(|| files::read_to_string(usage_file));
        let usage = usage.transpose()?;
        Ok(JobResult {
            code: output.status.code(),
            output: String::from_utf8_lossy(&text).into_owned(),
            wall_time: start.elapsed(),
            usage: usage.map(|text| ResourceUsage::read(&text)),
        })
    }

    fn can_limit(&self) -> Result<bool> {
        let mut command = self.root_command("sh");
        command.args(["-c", LIMIT_SCRIPT, "sh", "/dev/null", "true"]);
        let status = command.status().at("run", "sh")?;
        Ok(status.code() != Some(NO_LIMITS_CODE))
    }

    fn root_command(&self, program: &str) -> Command {
        prefixed_command(&self.root_prefix, program)
    }
}

impl ResourceUsage {
    /// Parses the file that [`LIMIT_SCRIPT`] writes.
    fn read(text: &str) -> Self {
        let mut lines = text.lines();
        let mut number = |name| lines.find_map(|line| line.strip_prefix(name)?.parse().ok());
        ResourceUsage {
            cpu: Duration::from_micros(number("cpu_us ").unwrap_or(0)),
            peak_memory: number("memory "),
        }
    }
}

/// Reports that all or part of the trial is skipped for this reason. Returns an error instead if
/// `CI` is set.
fn skip_or_fail(reason: &str) -> Result<()> {
    match env::var_os("CI") {
        Some(_) => bail!("{reason}; a trial must not be skipped when CI is set"),
        None => {
            eprintln!("SKIPPED: {reason}");
            Ok(())
        }
    }
}

/// Returns whether a command with this prefix can create namespaces.
fn can_unshare(prefix: &[&'static str]) -> bool {
    let result = prefixed_command(prefix, "unshare")
        .args(NAMESPACES)
        .arg("true")
        .output();
    matches!(result, Ok(output) if output.status.success())
}

fn prefixed_command(prefix: &[&'static str], program: &str) -> Command {
    let mut words = prefix.iter().copied().chain([program]);
    let mut command = Command::new(words.next().unwrap_or(program));
    command.args(words);
    command
}
