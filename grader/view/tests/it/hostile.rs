//! Submissions that deliberately do harm. The viewer must still answer the page, in time and with
//! bounded memory.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::harness::{Submission, Viewer, notes};

const ARGUMENTS: &str = "flat --size 4x3 --samples 1";

#[test]
fn a_tree_that_is_too_large_is_refused_and_the_picture_goes_on() {
    let submission = Submission::reference();
    submission.change_tree("bvh.nodes.resize(1_500_000, bvh.nodes[0]);");
    let viewer = Viewer::start(&submission, ARGUMENTS);
    viewer.command(&json!({ "view": "bvh" }));
    let state = viewer.wait_for_picture();
    let note = notes(&state);
    assert!(
        note.contains("it has 1500000 nodes, but a binary tree over"),
        "{note}"
    );
    assert_eq!(state["has_stopped"], false);
    viewer.command(&json!({ "pick": { "pixel": [1, 1], "sample": null } }));
    let state = viewer.wait_for(|state| state["explanation_fault"].is_string());
    let why = state["explanation_fault"].as_str().unwrap();
    assert!(why.contains("it has 1500000 nodes"), "{why}");
}

/// Requests everything the page can request, for a tree whose leaves all claim to contain every
/// primitive and whose boxes are all equal. The tree has as many levels as nodes, and its last node
/// leads back to the first.
#[test]
fn a_deep_cyclic_tree_of_equal_leaves_is_shown_in_time() {
    let submission = Submission::reference();
    submission.change_tree(
        "let (n, all) = (bvh.primitives.len(), bvh.nodes[bvh.root].bbox); \
         bvh.root = 0; \
         bvh.nodes = (0..2 * n).map(|i| match i % 2 { \
             0 => Node::interior(all, i + 1, (i + 2) % (2 * n)), \
             _ => Node::leaf(all, if i == 1 { usize::MAX } else { 0 }, usize::MAX) }).collect();",
    );
    submission.replace_traversal(
        "    pub fn hit(&self, ray: &Ray) -> Option<Trace> {\n        \
         for _ in 0..3 { for node in &self.nodes { \
         std::hint::black_box(node.bbox.hit(ray, ray.range)); } }\n        \
         self.primitives[0].hit(ray)\n    }\n",
    );
    let viewer = Viewer::start(&submission, "gyroid --size 4x3 --samples 1");
    viewer.command(&json!({ "view": "bvh" }));
    let started_at = Instant::now();
    let slowest = |path: &str| {
        let started_at = Instant::now();
        assert_eq!(viewer.get(path).status, 200, "{path}");
        started_at.elapsed()
    };
    let mut longest = Duration::ZERO;
    loop {
        let state = viewer.get_json("/state?after=0");
        longest = longest.max(slowest("/state?after=0"));
        if state["is_picture_complete"] == true {
            assert!(state["tree_levels"].as_u64() > Some(10_000), "{state:#}");
            break;
        }
        assert!(started_at.elapsed() < Duration::from_secs(300), "{state:#}");
    }
    for path in ["/tree", "/boxes?level=0&below=true", "/node?node=7"] {
        longest = longest.max(slowest(path));
    }
    assert!(longest < Duration::from_secs(5), "{longest:?}");
    let explanation = viewer.explain([1, 1], None);
    let rows = explanation["rays"][0]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4000);
    assert!(viewer.get("/explanation").body.len() < 16 << 20);
}

#[test]
fn a_long_panic_with_odd_characters_is_short_and_harmless_on_the_page() {
    let submission = Submission::reference();
    let panic = "panic!(\"\\u{202e}\\u{1b}[2J\\u{7}\\r\\u{8}\\u{c}\\u{7f}\\u{85}\\t<b>\\\"\\\\{}\", \
         \"é\".repeat(50 << 20));";
    submission.insert_into_camera(panic);
    let viewer = Viewer::start(&submission, ARGUMENTS);
    let state = viewer.wait_for_picture();
    let message = state["panics"][0]["message"].as_str().unwrap();
    let start = "\\u{202e}\\u{1b}[2J\\u{7}\\r\\u{8}\\u{c}\\u{7f}\\u{85}\t<b>\"\\ééé";
    assert!(message.starts_with(start), "{message}");
    assert!(message.len() < 700, "{}", message.len());
    assert_eq!(state["panics"][0]["count"], 12);
}

/// Programs that write to the viewer's pipe themselves. Outside the sandbox, safe code can do that.
#[cfg(target_os = "linux")]
mod pipe {
    use super::*;
    use test_support::processes::peak_memory;

    /// Writes to the response pipe while the tree is being built.
    fn write_to_pipe(submission: &Submission, code: &str) {
        submission.insert_into_build(&format!(
            "for number in 3..20 {{ \
             let info = std::fs::read_to_string(format!(\"/proc/self/fdinfo/{{number}}\")); \
             let is_output = info.is_ok_and(|info| info.lines().any(|line| \
                 line.starts_with(\"flags:\") && line.ends_with('1'))); \
             if !is_output {{ continue; }} \
             let path = format!(\"/proc/self/fd/{{number}}\"); \
             let mut pipe = std::fs::OpenOptions::new().write(true).open(path).unwrap(); \
             use std::io::Write; \
             let mut send = |bytes: &[u8]| {{ let _ = pipe.write_all(bytes); }}; \
             {code} }}"
        ));
    }

    #[test]
    fn responses_that_nothing_asked_for_are_refused_in_bounded_memory() {
        let submission = Submission::reference();
        let correct = submission.read("bvh.rs");
        let viewer = Viewer::start(&submission, ARGUMENTS);
        viewer.wait_for_picture();
        let before = peak_memory(viewer.process()).unwrap();
        let header = "send(&LENGTH_u32.to_le_bytes()); send(&1u64.to_le_bytes());";
        let frame = |length: &str| header.replace("LENGTH_u32", length);
        for (code, why) in [
            // Both frames are longer than any response and are refused before they are read.
            (frame("u32::MAX"), "the limit is"),
            (frame("500_000_000u32"), "the limit is"),
            // A list whose stated length, 1 << 34 elements, exceeds the number of bytes sent.
            (
                frame("8u32") + "send(&[0, 255, 255, 255, 255, 63, 0, 0]);",
                "invalid answer",
            ),
            // The response to another request.
            (frame("1u32") + "send(&[1]);", "does not match"),
            // Endless frames.
            (
                format!("loop {{ {} send(&[0; 1000]); }}", frame("1000u32")),
                "invalid answer",
            ),
        ] {
            submission.write("bvh.rs", &correct);
            write_to_pipe(&submission, &code);
            let state = viewer.wait_for(|state| state["has_stopped"] == true);
            assert!(notes(&state).contains(why), "{code}: {state:#}");
            submission.write("bvh.rs", "not Rust");
            viewer.wait_for(|state| state["build"] == "failed");
        }
        let used = peak_memory(viewer.process()).unwrap() - before;
        assert!(used < 64 << 20, "{used} bytes");
        submission.write("bvh.rs", &correct);
        let is_fine =
            |state: &Value| state["is_picture_complete"] == true && state["notes"] == json!([]);
        viewer.wait_for(is_fine);
    }
}
