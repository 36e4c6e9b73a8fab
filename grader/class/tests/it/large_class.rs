//! A whole class, killed twenty times: the same bytes as undisturbed, and no slower than its cores
//! allow. It takes minutes of all cores, so it is run on purpose:
//!
//! ```text
//! cargo run --release -p author --example submissions -- target/class 200
//! cargo build --release -p class
//! CLASS=target/class PROGRAM=target/release/class \
//!     cargo test -p class --test it -- --ignored --nocapture two_hundred
//! ```

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use std::{env, fs, thread};

use tempfile::TempDir;

use crate::harness::{TASK_FILES, class_command, comparable_files, successful_stdout, workspace};

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

/// CPU time of all children that have ended so far.
fn children_cpu_time() -> Duration {
    let stat = fs::read_to_string("/proc/self/stat").unwrap();
    // After the name, which may hold spaces: fields 16 and 17, in ticks, of which a second has 100.
    let (_, fields) = stat.rsplit_once(") ").unwrap();
    let fields: Vec<&str> = fields.split(' ').collect();
    let ticks = |place: usize| fields[place].parse::<u64>().unwrap();
    Duration::from_millis(10 * (ticks(13) + ticks(14)))
}

#[test]
#[ignore = "it takes minutes of all cores, and a class: see above"]
fn a_large_class_killed_twenty_times_gives_the_same_results() {
    let input = PathBuf::from(env::var_os("CLASS").expect("CLASS names the folder"));
    let input = workspace().join(input);
    let place = TempDir::new().unwrap();
    let (whole, torn) = (place.path().join("whole"), place.path().join("torn"));
    let count = fs::read_dir(&input).unwrap().count();

    // Whatever is compiled once is compiled before anything is measured.
    let one = fs::read_dir(&input).unwrap().next().unwrap().unwrap();
    let small = place.path().join("small");
    fs::create_dir_all(small.join("one")).unwrap();
    for file in TASK_FILES {
        fs::copy(one.path().join(file), small.join("one").join(file)).unwrap();
    }
    successful_stdout(&run(&small, &place.path().join("warm")).output().unwrap());

    let (began, before) = (Instant::now(), children_cpu_time());
    successful_stdout(&run(&input, &whole).output().unwrap());
    let (took, cpu) = (began.elapsed(), children_cpu_time() - before);
    let wanted = comparable_files(&whole);
    println!("{count} submissions: {took:.1?} by the clock, {cpu:.1?} of CPU time");

    // Moments that no pattern of ours could spare, and the same in every run of this test.
    let mut random = 88_172_645_463_325_252_u64;
    let mut killed = 0;
    for _ in 0..KILLS {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        let mut command = run(&input, &torn);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        let mut run = command.spawn().unwrap();
        thread::sleep(took * (random % 1000) as u32 / 1000 / (KILLS / 2));
        killed += u32::from(run.try_wait().unwrap().is_none());
        run.kill().unwrap();
        run.wait().unwrap();
    }
    let kept = fs::read_dir(torn.join("students")).unwrap().count();
    println!("killed {killed} of {KILLS} times, with {kept} submissions begun");
    assert!(
        killed >= KILLS / 2,
        "most runs were over before they were killed"
    );
    successful_stdout(&run(&input, &torn).output().unwrap());
    assert!(comparable_files(&torn) == wanted, "the results differ");
    println!("resumed: {} files, the same bytes", wanted.len());
}
