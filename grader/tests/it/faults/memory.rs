//! A machine that runs out of memory. Most tests send the signal that the kernel would send.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use serde_json::Value;

use super::assert_grader_fault;
use super::processes::{child_named, cpu_time, eventually};
use crate::harness::{Submission, grader, workspace};

/// CPU time after which a process has certainly started its work.
const BUSY: Duration = Duration::from_millis(100);
/// The name of the honest program that shows whether the machine is the reason.
const CONTROL: &str = "control";

/// Starts the grader on a submission, with `out` as the output folder.
fn start(submission: &Submission, out: &Path) -> Child {
    let mut command = grader();
    command.arg(submission.path()).arg("--out").arg(out);
    command.args(["--no-reference", "--cpu-limit", "5"]);
    let command = command.stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

fn kill(process: u32) {
    let kill = format!("kill -KILL {process}");
    let status = Command::new("sh").args(["-c", &kill]).status();
    assert!(status.unwrap().success());
}

/// Grades a submission. Meanwhile, kills children of the grader: one with each name and at least
/// this much CPU time, in this order.
fn grade_while_killing(
    victims: &[(&str, Duration)],
    submission: &Submission,
    out: &Path,
) -> Output {
    let grader = start(submission, out);
    let mut last = 0;
    for (name, busy) in victims {
        let is_next = |child: &u32| *child != last && cpu_time(*child) >= Some(*busy);
        last = eventually(|| child_named(name, grader.id()).filter(is_next));
        kill(last);
    }
    grader.wait_with_output().unwrap()
}

fn score(out: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(out.join("score.json")).unwrap()).unwrap()
}

/// A submission that the compiler works on for a long time.
fn long_to_compile() -> Submission {
    Submission::reference("long").with_replaced(
        "sphere.rs",
        "use framework::math;",
        "use framework::math;\n#[allow(long_running_const_eval)]\nconst LONG: u32 = {\nlet mut n = \
         0_u32;\nwhile n < 2 { n = (n + 1) % 2; }\nn\n};",
    )
}

#[test]
fn if_every_compiler_is_killed_it_is_not_the_submissions_fault() {
    Submission::reference("first").grade();
    let submission = long_to_compile();
    let out = submission.path().join("out");
    let victims = [("rustc", BUSY), ("rustc", BUSY), ("rustc", Duration::ZERO)];
    let output = grade_while_killing(&victims, &submission, &out);
    assert_grader_fault(&output, &out, "give this machine more memory");
}

#[test]
fn if_only_the_submissions_compiler_is_killed_it_is_the_submissions_fault() {
    Submission::reference("first").grade();
    let submission = long_to_compile();
    let out = submission.path().join("out");
    let output = grade_while_killing(&[("rustc", BUSY); 2], &submission, &out);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{error}");
    let why = &score(&out)["build"]["not_compiled"][0]["message"];
    let why = why.as_str().unwrap();
    assert!(why.contains("when nothing else was running"), "{why}");
}

#[test]
fn a_program_killed_once_is_run_again() {
    Submission::reference("first").grade();
    let submission = Submission::looping();
    let out = submission.path().join("out");
    let output = grade_while_killing(&[("probe", BUSY)], &submission, &out);
    assert_eq!(output.status.code(), Some(0));
    let tasks = &score(&out)["tasks"];
    assert_eq!(tasks[2]["items"][0]["verdict"], "timed_out");
}

#[test]
fn if_every_program_is_killed_it_costs_no_points() {
    Submission::reference("first").grade();
    let submission = Submission::looping();
    let out = submission.path().join("out");
    let victims = [("probe", BUSY), ("probe", BUSY), (CONTROL, Duration::ZERO)];
    let output = grade_while_killing(&victims, &submission, &out);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{error}");
    assert!(error.contains("the system killed the program"), "{error}");
    assert_eq!(score(&out)["complete"], false);
}

#[test]
fn if_only_the_submissions_program_is_killed_it_is_the_submissions_fault() {
    Submission::reference("first").grade();
    let submission = Submission::looping();
    let out = submission.path().join("out");
    let output = grade_while_killing(&[("probe", BUSY); 2], &submission, &out);
    assert_eq!(output.status.code(), Some(0));
    let item = &score(&out)["tasks"][2]["items"][0];
    assert_eq!(item["verdict"], "crashed", "{item}");
}

/// A control group with a limit of memory, which is removed when this value is dropped.
struct Group(PathBuf);

impl Group {
    /// Creates a group, if this machine lets us.
    fn new(bytes: u64) -> Option<Self> {
        let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
        let mut lines = groups.lines();
        let memory = lines.find_map(|line| line.split_once(":memory:").map(|(_, path)| path));
        let (mount, limit, path) = match memory {
            Some(path) => ("memory", "memory.limit_in_bytes", path),
            None => (
                "",
                "memory.max",
                groups.lines().next()?.strip_prefix("0::")?,
            ),
        };
        let name = format!("grader-test-{}", std::process::id());
        let parent = Path::new("/sys/fs/cgroup").join(mount);
        let group = Group(parent.join(path.trim_start_matches('/')).join(name));
        fs::create_dir(&group.0).ok()?;
        fs::write(group.0.join(limit), bytes.to_string()).ok()?;
        Some(group)
    }

    /// Runs a command in the group.
    fn run(&self, command: &Command) -> Output {
        let mut shell = Command::new("sh");
        let joined = format!("echo $$ > {}/cgroup.procs && exec \"$@\"", self.0.display());
        shell.args(["-c", &joined, "sh"]).current_dir(workspace());
        shell.arg(command.get_program()).args(command.get_args());
        shell.output().unwrap()
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        fs::remove_dir(&self.0).ok();
    }
}

#[test]
fn in_a_small_container_a_bomb_exceeds_its_own_limit() {
    let Some(group) = Group::new(1 << 30) else {
        eprintln!("SKIPPED: no control group can be created here; this needs root");
        return;
    };
    Submission::reference("first").grade();
    // The compiler builds these values in its memory.
    for value in [
        "#[used]\npub static HUGE: [u8; 1_500_000_000] = [1; 1_500_000_000];",
        "#[used]\npub static LONG: &[[u64; 1000]] = &[[7; 1000]; 200_000];",
    ] {
        let bomb = Submission::reference("bomb").with_replaced(
            "sphere.rs",
            "use framework::math;",
            &format!("use framework::math;\n{value}"),
        );
        let out = bomb.path().join("out");
        let mut command = grader();
        command.arg(bomb.path()).arg("--out").arg(&out);
        let output = group.run(command.arg("--no-reference"));
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{error}");
        let score = score(&out);
        assert_eq!(score["complete"], true);
        assert!(score["points"].as_u64() < Some(100), "{score}");
        let why = score["build"].to_string();
        assert!(!why.contains("nothing else was running"), "killed: {why}");
    }
    let honest = Submission::reference("honest");
    let out = honest.path().join("out");
    let mut command = grader();
    command.arg(honest.path()).arg("--out").arg(&out);
    let output = group.run(command.arg("--no-reference"));
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{error}");
    assert_eq!(score(&out)["points"], 100);
}
