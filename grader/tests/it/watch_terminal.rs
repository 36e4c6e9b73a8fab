//! Tests for `--watch` in a terminal. The terminal is `tmux`, which can report the contents of the
//! screen.

use std::fs;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use grader::handed_out::RAYS;

use crate::harness::{Submission, shell_line, workspace};

/// A grader that watches a submission in a terminal. The grader is stopped when this is dropped.
struct Terminal {
    /// The name of this test's own tmux server.
    server: String,
}

impl Terminal {
    /// Starts the grader in a terminal with this many rows of 80 columns. Returns `None` if tmux
    /// isn't installed. In CI, tmux is required.
    fn watch(submission: &Submission, rows: u32, options: &[&str]) -> Option<Self> {
        if Command::new("tmux").arg("-V").output().is_err() {
            assert!(std::env::var_os("CI").is_none(), "tmux is not installed");
            eprintln!("SKIPPED: tmux is not installed");
            return None;
        }
        let path = submission.path().display().to_string();
        let terminal = Terminal {
            server: format!(
                "grader-{}-{rows}-{}",
                std::process::id(),
                path.replace('/', "-")
            ),
        };
        let mut grade = submission.command();
        grade.arg("--watch").args(options);
        let mut tmux = terminal.tmux();
        tmux.current_dir(workspace());
        tmux.args(["-f", "/dev/null", "new-session", "-d", "-x", "80", "-y"]);
        let started = tmux.args([rows.to_string(), shell_line(&grade)]).status();
        assert!(started.is_ok_and(|status| status.success()));
        Some(terminal)
    }

    fn tmux(&self) -> Command {
        let mut command = Command::new("tmux");
        command.args(["-L", &self.server]);
        // The tests check colours.
        command.env("TERM", "xterm-256color").env_remove("NO_COLOR");
        command
    }

    /// Changes the number of rows.
    fn resize(&self, rows: u32) {
        let mut tmux = self.tmux();
        let resized = tmux.args(["resize-window", "-y", &rows.to_string()]);
        assert!(resized.status().is_ok_and(|status| status.success()));
    }

    /// Returns the screen, with escape sequences for colours.
    fn screen(&self) -> String {
        let captured = self.tmux().args(["capture-pane", "-p", "-e"]).output();
        String::from_utf8(captured.unwrap().stdout).unwrap()
    }

    /// Waits until the screen contains the text. Returns the screen.
    fn wait_for(&self, text: &str) -> String {
        let deadline = Instant::now() + Duration::from_secs(100);
        loop {
            let screen = self.screen();
            if screen.contains(text) {
                return screen;
            }
            assert!(Instant::now() < deadline, "no {text:?} in:\n{screen}");
            thread::sleep(Duration::from_millis(10));
        }
    }

    /// Waits until the grader is waiting. Returns the lines of the screen without colours.
    fn lines_of_the_report(&self) -> Vec<String> {
        let screen = self.wait_for("save a file");
        let plain = anstream::adapter::strip_str(&screen).to_string();
        plain
            .lines()
            .map(|line| line.trim_end().to_owned())
            .collect()
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        let _ = self.tmux().arg("kill-server").output();
    }
}

fn wrong_camera(name: &str) -> Submission {
    Submission::reference(name).with_replaced("camera.rs", "- 0.5;", "- 0.4;")
}

#[test]
fn twelve_lines_show_the_failing_item_and_a_short_table() {
    let submission = wrong_camera("twelve");
    let Some(terminal) = Terminal::watch(&submission, 12, &[]) else {
        return;
    };
    let lines = terminal.lines_of_the_report();
    assert!(lines[0].contains("twelve: graded in"), "{lines:#?}");
    assert!(lines[1].contains("camera.corners"), "{lines:#?}");
    let last: Vec<&String> = lines.iter().filter(|line| !line.is_empty()).collect();
    let [.., rest, table] = &last[..] else {
        panic!("{lines:#?}")
    };
    assert!(rest.contains("… the rest: cargo grade "), "{lines:#?}");
    let is_whole = rest.ends_with("--task camera") || rest.ends_with('…');
    assert!(is_whole, "{lines:#?}");
    let points = RAYS.assignment.tasks[0].points;
    let points = format!(" / 100: camera 0/{points}, triangle ✓");
    assert!(table.contains(&points), "{lines:#?}");
    assert!(!lines.concat().contains("TASK"), "{lines:#?}");
}

#[test]
fn the_report_is_arranged_again_when_the_terminal_is_resized() {
    let submission = wrong_camera("resized");
    let Some(terminal) = Terminal::watch(&submission, 12, &[]) else {
        return;
    };
    let lines = terminal.lines_of_the_report().join("\n");
    assert!(!lines.contains("Task 3: boxes"), "{lines}");
    // The report's table has a row for each task.
    let tasks = u32::try_from(RAYS.assignment.tasks.len()).unwrap();
    terminal.resize(18 + tasks);
    let screen = terminal.wait_for("Task 3: boxes");
    assert!(screen.contains("more items in this task"), "{screen}");
    terminal.resize(12);
    terminal.wait_for("the rest: cargo grade");
}

#[test]
fn a_save_interrupts_an_endless_loop_and_old_results_are_grey() {
    let camera = fs::read_to_string(wrong_camera("x").path().join("camera.rs")).unwrap();
    let submission = wrong_camera("hanging");
    // With this limit, the loop would run for five minutes.
    let Some(terminal) = Terminal::watch(&submission, 24, &["--cpu-limit", "300"]) else {
        return;
    };
    terminal.wait_for("save a file");
    let right = camera.replace("- 0.4;", "- 0.5;");
    let hanging = camera.replace(
        "        let height =",
        "        while self.film.x > 0 { std::hint::black_box(self); }\n        let height =",
    );
    assert_ne!(hanging, camera);
    fs::write(submission.path().join("camera.rs"), hanging).unwrap();
    let screen = terminal.wait_for("testing what failed before, 0 of");
    assert!(screen.contains("grey: before this save"), "{screen}");
    let grey = screen.find("\u{1b}[2m").expect("something is grey");
    assert!(screen[grey..].contains("camera.corners"), "{screen}");
    fs::write(submission.path().join("camera.rs"), right).unwrap();
    let screen = terminal.wait_for("100 / 100");
    assert!(!screen.contains("out of time"), "{screen}");
    let last = terminal.lines_of_the_report().join("\n");
    assert!(last.contains("cargo render cornell-box"), "{last}");
}
