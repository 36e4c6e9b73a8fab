//! A machine that runs out of memory. Most tests send the signal that the kernel would send.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use test_support::processes::{self, children, cpu_time, eventually};

use super::assert_grader_fault;
use crate::cases::compile_dependencies;
use crate::harness::{GradeRun, Submission, assert_fails, workspace};

/// CPU time after which a process has certainly started its work.
const BUSY: Duration = Duration::from_millis(100);
/// The name of the control program that shows whether the machine is the reason for a failure.
const CONTROL: &str = "control";

fn kill(process: u32) {
    let kill = format!("kill -KILL {process}");
    let status = Command::new("sh").args(["-c", &kill]).status();
    assert!(status.unwrap().success());
}

/// Grades a submission and, while it is being graded, kills children of the grader one after the
/// other. Each victim is specified by its name and by the minimum CPU time that it must have used.
fn grade_while_killing(victims: &[(&str, Duration)], submission: &Submission) -> GradeRun {
    compile_dependencies();
    let mut command = submission.command();
    // If an isolation level is given, tasks run one at a time, so all victims belong to the same
    // task.
    command.args(["--cpu-limit", "2", "--isolation", "none"]);
    let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let grader = command.spawn().unwrap();
    let mut last = 0;
    for (name, busy) in victims {
        let is_named = |child: &u32| processes::name(*child).is_some_and(|its| its == *name);
        let is_next = |child: &u32| *child != last && cpu_time(*child) >= Some(*busy);
        let child_named = || children(grader.id()).into_iter().find(is_named);
        last = eventually(|| child_named().filter(is_next));
        kill(last);
    }
    submission.results(grader.wait_with_output().unwrap())
}

/// Returns the reference with an additional item in `sphere.rs`.
fn with_constant(name: &str, item: &str) -> Submission {
    let first = "use framework::math;";
    let submission = Submission::reference(name);
    submission.with_replaced("sphere.rs", first, &format!("{first}\n{item}"))
}

/// Returns a submission that takes a long time to compile.
fn long_to_compile() -> Submission {
    let long = "#[allow(long_running_const_eval)]\nconst LONG: u32 = {\nlet mut n = \
                0_u32;\nwhile n < 2 { n = (n + 1) % 2; }\nn\n};";
    with_constant("long", long)
}

#[test]
fn if_every_compiler_is_killed_it_is_not_the_submissions_fault() {
    let victims = [("rustc", BUSY), ("rustc", BUSY), ("rustc", Duration::ZERO)];
    let graded = grade_while_killing(&victims, &long_to_compile());
    assert_grader_fault(&graded, "give this machine more memory");
}

#[test]
fn if_only_the_submissions_compiler_is_killed_it_is_the_submissions_fault() {
    let graded = grade_while_killing(&[("rustc", BUSY); 2], &long_to_compile());
    let why = &graded.score()["build"]["not_compiled"][0]["message"];
    let why = why.as_str().unwrap();
    assert!(why.contains("while nothing else was running"), "{why}");
}

#[test]
fn a_program_killed_once_is_run_again() {
    let graded = grade_while_killing(&[("probe", BUSY)], &Submission::looping());
    assert_eq!(graded.items("sphere")[0]["verdict"], "timed_out");
}

#[test]
fn if_every_program_is_killed_it_costs_no_points() {
    let victims = [("probe", BUSY), ("probe", BUSY), (CONTROL, Duration::ZERO)];
    let graded = grade_while_killing(&victims, &Submission::looping());
    assert_fails(&graded.output, 3, "the system killed the program");
    assert_eq!(graded.written_score()["complete"], false);
}

#[test]
fn if_only_the_submissions_program_is_killed_it_is_the_submissions_fault() {
    let graded = grade_while_killing(&[("probe", BUSY); 2], &Submission::looping());
    let item = &graded.items("sphere")[0];
    assert_eq!(item["verdict"], "crashed", "{item}");
}

/// A control group with a memory limit. It is removed when this value is dropped.
struct Group(PathBuf);

impl Group {
    /// Creates a group, if this machine allows it.
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
    compile_dependencies();
    let grade = |submission: &Submission| submission.results(group.run(&submission.command()));
    // The compiler has to build these values in memory.
    for value in [
        "#[used]\npub static HUGE: [u8; 1_500_000_000] = [1; 1_500_000_000];",
        "#[used]\npub static LONG: &[[u64; 1000]] = &[[7; 1000]; 200_000];",
    ] {
        let score = grade(&with_constant("bomb", value)).score();
        assert_eq!(score["complete"], true);
        assert!(score["points"].as_u64() < Some(100), "{score}");
        let why = score["build"].to_string();
        assert!(!why.contains("nothing else was running"), "killed: {why}");
    }
    let honest = grade(&Submission::reference("honest"));
    assert_eq!(honest.score()["points"], 100);
}
