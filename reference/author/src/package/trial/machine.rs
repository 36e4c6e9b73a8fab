//! A machine like a platform's: an empty root with this system's programs, no network, the platform's
//! user and rights, half of a core and 768 MiB.
//!
//! It takes root, which is asked of `sudo` where we are not.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use crate::package::trial::{TrialError, io_error};

/// How it is entered.
const ENTER_SCRIPT: &str = include_str!("../own/trial/machine.sh");
/// What it may use.
const LIMIT_SCRIPT: &str = include_str!("../own/trial/limits.sh");
/// What it has for itself.
const NAMESPACES: [&str; 5] = ["--mount", "--net", "--pid", "--fork", "--kill-child"];
/// The exit code of `LIMIT` where nothing can be limited.
const NO_LIMITS_CODE: i32 = 125;

/// Who runs there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum User {
    /// Root, with the rights that Docker leaves.
    Container,
    /// The user of GitHub's runners.
    Runner,
}

/// What it may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limits {
    /// As much as there is: while an image is made.
    None,
    /// Half of a core, and 768 MiB.
    Platform,
}

/// One program, and how it is to run.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// As whom.
    pub user: User,
    /// Within what.
    pub limits: Limits,
    /// In which folder of the machine.
    pub folder: &'a str,
    /// What it sees of the platform: `NAME=value`.
    pub variables: &'a [&'a str],
    /// The program and its arguments.
    pub command: &'a [&'a str],
}

/// How it ended.
#[derive(Clone, Debug)]
pub struct JobResult {
    /// Of the program.
    pub code: Option<i32>,
    /// On both outputs.
    pub output: String,
    /// By the clock on the wall.
    pub wall_time: Duration,
    /// What it has used, where that was limited.
    pub usage: Option<ResourceUsage>,
}

/// What a program and all that it started have used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ResourceUsage {
    /// Of a core that is as fast as this machine's.
    pub cpu: Duration,
    /// At most at a time, in bytes. None where the system does not tell.
    pub peak_memory: Option<u64>,
}

/// A root directory, and how it is entered.
#[derive(Clone, Debug)]
pub struct Machine {
    /// Its root directory, from outside.
    pub root: PathBuf,
    toolchain: PathBuf,
    root_prefix: Vec<&'static str>,
    is_limited: bool,
}

impl Machine {
    /// An empty one at this place. None, and a line that says why, where this system gives us none.
    pub fn create(root: &Path) -> Result<Option<Self>, TrialError> {
        let cargo = env::var_os("CARGO").ok_or(TrialError::NoCargo)?;
        let toolchain = Path::new(&cargo).parent().and_then(Path::parent);
        let toolchain = toolchain.ok_or(TrialError::NoCargo)?.to_owned();
        let mut ways = [vec![], vec!["sudo", "-n"]].into_iter();
        let Some(as_root) = ways.find(|way| can_unshare(way)) else {
            let missing = "the trial takes root, Linux and namespaces";
            return skip_or_fail(missing).map(|()| None);
        };
        let mut machine = Machine {
            root: root.to_owned(),
            toolchain,
            root_prefix: as_root,
            is_limited: true,
        };
        machine.remove(root)?;
        fs::create_dir_all(root).map_err(io_error(root))?;
        machine.is_limited = machine.can_limit()?;
        if !machine.is_limited {
            skip_or_fail("no control group can be made here: the trial is run without its limits")?;
        }
        Ok(Some(machine))
    }

    /// Where a path of the machine's lies.
    pub fn host_path(&self, path: &str) -> PathBuf {
        self.root.join(path.trim_start_matches('/'))
    }

    /// Takes a folder away, whosever it is.
    pub fn remove(&self, folder: &Path) -> Result<(), TrialError> {
        let mut command = self.root_command("rm");
        command.arg("-rf").arg(folder);
        command.status().map_err(io_error(folder)).map(drop)
    }

    /// Runs a job there.
    pub fn run(&self, job: Job) -> Result<JobResult, TrialError> {
        let used = &self.root.with_extension("used");
        let is_limited = self.is_limited && job.limits == Limits::Platform;
        let mut command = match is_limited {
            true => {
                let mut command = self.root_command("sh");
                command
                    .args(["-c", LIMIT_SCRIPT, "sh"])
                    .arg(used)
                    .arg("unshare");
                command
            }
            false => self.root_command("unshare"),
        };
        let who = match job.user {
            User::Container => "container",
            User::Runner => "runner",
        };
        command
            .args(NAMESPACES)
            .args(["sh", "-c", ENTER_SCRIPT, "sh"])
            .args([&self.root, &self.toolchain])
            .args([who, job.folder, "LANG=C.UTF-8"])
            .arg(self.path_variable())
            .args(job.variables)
            .args(job.command);
        let began = Instant::now();
        let output = command.output().map_err(io_error(Path::new("unshare")))?;
        let said = [output.stdout, output.stderr].concat();
        let used = is_limited.then(|| fs::read_to_string(used)).transpose();
        let used = used.map_err(io_error(&self.root))?;
        Ok(JobResult {
            code: output.status.code(),
            output: String::from_utf8_lossy(&said).into_owned(),
            wall_time: began.elapsed(),
            usage: used.map(|text| ResourceUsage::read(&text)),
        })
    }

    /// `env -i` forgets where programs are.
    fn path_variable(&self) -> String {
        let toolchain = self.toolchain.display();
        format!("PATH={toolchain}/bin:/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin")
    }

    fn can_limit(&self) -> Result<bool, TrialError> {
        let mut command = self.root_command("sh");
        command
            .args(["-c", LIMIT_SCRIPT, "sh", "/dev/null", "true"])
            .status()
            .map(|status| status.code() != Some(NO_LIMITS_CODE))
            .map_err(io_error(Path::new("sh")))
    }

    fn root_command(&self, program: &str) -> Command {
        prefixed_command(&self.root_prefix, program)
    }
}

impl ResourceUsage {
    /// From what `LIMIT` writes.
    fn read(text: &str) -> Self {
        let mut used = ResourceUsage::default();
        for line in text.lines() {
            let Some((what, number)) = line.split_once(' ') else {
                continue;
            };
            let number = number.parse().unwrap_or(0);
            match what {
                "cpu_us" => used.cpu = Duration::from_micros(number),
                "cpu_ns" => used.cpu = Duration::from_nanos(number),
                "memory" => used.peak_memory = Some(number),
                _ => {}
            }
        }
        used
    }
}

/// What the machine lacks is skipped loudly, but where `CI` is set: there it has to be had.
fn skip_or_fail(what: &str) -> Result<(), TrialError> {
    match env::var_os("CI") {
        Some(_) => Err(TrialError::Unsupported(what.to_owned())),
        None => {
            eprintln!("SKIPPED: {what}");
            Ok(())
        }
    }
}

/// Whether this system gives us a machine of our own in this way.
fn can_unshare(as_root: &[&'static str]) -> bool {
    let tried = prefixed_command(as_root, "unshare")
        .args(NAMESPACES)
        .arg("true")
        .output();
    matches!(tried, Ok(output) if output.status.success())
}

fn prefixed_command(as_root: &[&'static str], program: &str) -> Command {
    let mut words = as_root.iter().copied().chain([program]);
    let mut command = Command::new(words.next().unwrap_or(program));
    command.args(words);
    command
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_resource_usage_of_either_cgroup_version() {
        let new = ResourceUsage::read("cpu_us 2500000\nmemory 4096\n");
        assert_eq!(new, ResourceUsage::read("cpu_ns 2500000000\nmemory 4096\n"));
        assert_eq!((new.cpu.as_millis(), new.peak_memory), (2500, Some(4096)));
        assert_eq!(ResourceUsage::read("cpu_us 1\n").peak_memory, None);
    }
}
