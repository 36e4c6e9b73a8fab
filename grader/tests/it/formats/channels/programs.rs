//! Real programs that send bits. Two submissions differ only in the bits they send, so students
//! must not be able to tell their outputs apart.

use serde_json::Value;

use crate::formats::{FormatTexts, grade_in_all_formats, small_exam};
use crate::harness::Submission;

/// Sends bits in the message and the line number of a panic.
const PANICS: &str = r#"
fn send() {
    if BITS % 2 == 0 {
        panic!("{BITS}");
    }
    panic!("{BITS}");
}
"#;
const EXITS: &str = r#"
fn send() {
    std::process::exit((BITS % 128) as i32);
}
"#;
/// Sends bits in the length of a frame.
#[cfg(target_os = "linux")]
const WRITES_FRAMES: &str = r#"
fn send() {
    use std::io::Write;
    let open = (0..64).map(|number| format!("/proc/self/fd/{number}"));
    for path in open {
        if let Ok(mut file) = std::fs::OpenOptions::new().write(true).open(path) {
            file.write_all(&BITS.to_le_bytes()).ok();
            file.write_all(&[0; 8]).ok();
        }
    }
}
"#;
#[cfg(not(target_os = "linux"))]
const WRITES_FRAMES: &str = EXITS;
/// Sends bits as printed text and as the time that a call takes.
const PRINTS_AND_WAITS: &str = r#"
fn send() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        println!("{BITS}");
        eprintln!("{BITS}");
        std::thread::sleep(std::time::Duration::from_millis(u64::from(BITS % 100)));
    });
}
"#;
/// Sends bits as wrong answers and as the number of wrong answers.
const ANSWERS_WRONGLY: &str = r#"
fn send(mut trace: Trace) -> Trace {
    static COUNT: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(0);
    if COUNT.fetch_add(1, std::sync::atomic::Ordering::Relaxed) % 4 <= BITS % 4 {
        trace.distance += 1.0 + (BITS % 1000) as f32;
    }
    trace
}
"#;

/// The tasks whose code sends bits.
const SENDERS: [&str; 5] = ["camera", "triangle", "sphere", "bbox", "build"];

/// Returns a submission that sends these bits in a different way in each of these tasks.
fn sender(bits: u32) -> Submission {
    let with = |submission: Submission, file: &str, head: &str, call: &str, code: &str| {
        let text = std::fs::read_to_string(submission.path().join(file)).unwrap();
        let (before, after) = text.split_once(head).unwrap();
        let text = format!("{before}{head}{call}{after}\nconst BITS: u32 = {bits};{code}");
        submission.with(file, text)
    };
    let hit = "pub fn hit(&self, ray: &Ray) -> Option<Trace> {\n";
    let submission = Submission::reference("sender");
    let head = "offset: Vec2) -> Ray {\n";
    let submission = with(submission, "camera.rs", head, "send();", PANICS);
    let submission = with(submission, "triangle.rs", hit, "send();", EXITS);
    let wrapper = "self.correct_hit(ray).map(send)
        }
        fn correct_hit(&self, ray: &Ray) -> Option<Trace> {";
    let submission = with(submission, "sphere.rs", hit, wrapper, ANSWERS_WRONGLY);
    let head = "times: Interval) -> Option<Interval> {\n";
    let submission = with(submission, "bbox.rs", head, "send();", WRITES_FRAMES);
    let head = "max_leaf_size: usize) -> Self {\n";
    with(submission, "bvh.rs", head, "send();", PRINTS_AND_WAITS)
}

/// Returns the output without the parts that differ from run to run: the path of the output folder
/// and the progress of the first run on a machine.
fn comparable(text: &str) -> String {
    let lines = text.lines().filter(|line| {
        let is_path = line.contains("/out/") || line.contains("\\out\\");
        let is_first_run = line.starts_with("Compiling the dependencies");
        !is_path && !is_first_run
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Returns the message of the first item of each task that sends bits.
fn messages(written: &FormatTexts) -> [String; SENDERS.len()] {
    let score: Value = serde_json::from_str(&written["json"]).unwrap();
    let tasks = score["tasks"].as_array().unwrap();
    SENDERS.map(|id| {
        let task = tasks.iter().find(|task| task["id"] == id).unwrap();
        format!("{} {}", task["items"][0], task["printed"])
    })
}

#[test]
fn students_cannot_tell_what_a_program_sent() {
    const BITS: u32 = super::MESSAGE;
    for level in ["feedback", "hidden"] {
        let policy = format!("[visibility]\nfinal = '{level}'");
        let outputs = [BITS, !BITS].map(|bits| {
            let submission = sender(bits);
            let policy = submission.file_option("--policy", "policy.toml", &policy);
            grade_in_all_formats(&submission, &small_exam("final"), &policy)
        });
        let [one, other] = outputs.each_ref().map(messages);
        for (task, (one, other)) in SENDERS.iter().zip(one.iter().zip(&other)) {
            assert_ne!(one, other, "{task} sends the bits, and staff see them");
        }
        let [one, other] = &outputs;
        for (output, text) in one.iter().filter(|(output, _)| **output != "json") {
            assert_eq!(
                comparable(text),
                comparable(&other[output]),
                "{level}: {output} reveals the bits"
            );
        }
    }
}
