//! A large class whose grading is killed twenty times: the results are the same as those of an
//! uninterrupted run. The test uses all cores for minutes, so it is ignored by default. Run it
//! with:
//!
//! ```text
//! cargo run --release -p author --example submissions -- target/class 200
//! cargo build --release -p class
//! CLASS=target/class PROGRAM=target/release/class \
//!     cargo test -p class --test it -- --ignored --nocapture large_class
//! ```

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use std::{env, fs, thread};

use grader::handed_out::RAYS;
use tempfile::TempDir;

use crate::harness::{class_command, comparable_files, successful_stdout, workspace};

const KILLS: u32 = 20;

fn run(input: &Path, out: &Path) -> Command {
    let mut command = match env::var_os("PROGRAM") {
        Some(program) => Command::new(workspace().join(program)),
        None => class_command(),
    };
    let command_line = command.current_dir(workspace()).arg(input);
    command_line.arg("--out").arg(out);
    command
}

/// Returns the CPU time of all child processes that have ended.
fn children_cpu_time() -> Duration {
    let stat = fs::read_to_string("/proc/self/stat").unwrap();
    // Fields 16 and 17, in ticks of 10 ms. Fields are counted from the end of the name, which may
    // contain spaces.
    let (_, fields) = stat.rsplit_once(") ").unwrap();
    let fields: Vec<&str> = fields.split(' ').collect();
    let ticks = |index: usize| fields[index].parse::<u64>().unwrap();
    Duration::from_millis(10 * (ticks(13) + ticks(14)))
}

#[test]
#[ignore = "takes minutes on all cores, and needs a class: see above"]
fn a_large_class_killed_twenty_times_gives_the_same_results() {
    let input = PathBuf::from(env::var_os("CLASS").expect("CLASS names the folder"));
    let input = workspace().join(input);
    let folder = TempDir::new().unwrap();
    let (uninterrupted, interrupted) = (
        folder.path().join("uninterrupted"),
        folder.path().join("interrupted"),
    );
    let count = fs::read_dir(&input).unwrap().count();

    // Compiles the shared dependencies before anything is measured.
    let one = fs::read_dir(&input).unwrap().next().unwrap().unwrap();
    let small = folder.path().join("small");
    fs::create_dir_all(small.join("one")).unwrap();
    for file in RAYS.file_names() {
        fs::copy(one.path().join(file), small.join("one").join(file)).unwrap();
    }
    successful_stdout(&run(&small, &folder.path().join("warm")).output().unwrap());

    let (began, before) = (Instant::now(), children_cpu_time());
    successful_stdout(&run(&input, &uninterrupted).output().unwrap());
    let (took, cpu) = (began.elapsed(), children_cpu_time() - before);
    let wanted = comparable_files(&uninterrupted);
    println!("{count} submissions: wall time {took:.1?}, CPU time {cpu:.1?}");

    // The times are pseudorandom, and the same in every run of this test.
    let mut random = 88_172_645_463_325_252_u64;
    let mut killed = 0;
    for _ in 0..KILLS {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        let mut command = run(&input, &interrupted);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        let mut run = command.spawn().unwrap();
        thread::sleep(took * (random % 1000) as u32 / 1000 / (KILLS / 2));
        killed += u32::from(run.try_wait().unwrap().is_none());
        run.kill().unwrap();
        run.wait().unwrap();
    }
    let kept = fs::read_dir(interrupted.join("students")).unwrap().count();
    println!("killed {killed} of {KILLS} times, with {kept} submissions started");
    assert!(
        killed >= KILLS / 2,
        "most runs must still be running when they are killed"
    );
    successful_stdout(&run(&input, &interrupted).output().unwrap());
    assert!(
        comparable_files(&interrupted) == wanted,
        "the results differ"
    );
    println!("resumed: {} files, the same bytes", wanted.len());
}
