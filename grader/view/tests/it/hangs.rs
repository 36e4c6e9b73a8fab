//! Code that doesn't return. The page names the method within a few seconds.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::browser::{start, text, wait_until_shown};
use crate::harness::{Submission, Viewer, notes};

/// The maximum time until the page names the method that hangs. Three seconds are enough if nothing
/// else is running, but the limits apply to CPU time, and other tests may be running at the same
/// time.
const NAMED_WITHIN: Duration = Duration::from_secs(12);

/// A statement inserted after the line that contains `declaration`.
struct Hang {
    method: &'static str,
    file: &'static str,
    declaration: &'static str,
    statement: &'static str,
}

const LOOP: &str = "loop { std::hint::black_box(()); }";
/// A loop that few rays reach: only some rays in the scene `spheres` point down that steeply, and
/// only after a bounce.
const RARELY: &str = "while ray.dir.y < -0.99 { std::hint::black_box(()); }";

impl Hang {
    const fn in_hit(method: &'static str, file: &'static str, statement: &'static str) -> Self {
        Hang {
            method,
            file,
            declaration: "pub fn hit(&self, ray: &Ray",
            statement,
        }
    }

    fn write(&self, submission: &Submission) -> usize {
        let text = submission.read(self.file);
        let is_declaration = |line: &&str| line.contains(self.declaration);
        let line = text.lines().find(is_declaration).unwrap();
        let number = text.lines().position(|other| other == line).unwrap() + 1;
        submission.replace(self.file, line, &format!("{line} {}", self.statement));
        number
    }
}

const HANGS: [Hang; 9] = [
    Hang {
        method: "Bvh::build",
        file: "bvh.rs",
        declaration: "pub fn build(",
        statement: LOOP,
    },
    Hang {
        method: "Camera::sample_ray",
        file: "camera.rs",
        declaration: "pub fn sample_ray(",
        statement: LOOP,
    },
    Hang::in_hit("Triangle::hit", "triangle.rs", LOOP),
    Hang::in_hit("Sphere::hit", "sphere.rs", LOOP),
    Hang::in_hit("BBox::hit", "bbox.rs", LOOP),
    Hang::in_hit("Bvh::hit", "bvh.rs", LOOP),
    Hang::in_hit("Triangle::hit", "triangle.rs", RARELY),
    Hang::in_hit("BBox::hit", "bbox.rs", RARELY),
    Hang::in_hit("Bvh::hit", "bvh.rs", RARELY),
];

/// Returns the notes, the slow-build warning and the panics in a state, one per line, each with its
/// location.
fn messages(state: &Value) -> String {
    let slow = &state["slow_build"];
    let panics = state["panics"].as_array().unwrap().iter();
    let others = panics.map(|panic| (&panic["message"], &panic["location"]));
    let others = others.chain([(&slow["text"], &slow["location"])]);
    let others = others.map(|(text, location)| format!("{text} ({location})\n"));
    notes(state) + &others.collect::<String>()
}

#[test]
fn an_endless_loop_is_named_with_its_method_and_line() {
    let submission = Submission::reference();
    let viewer = Viewer::start(&submission, "spheres --samples 4");
    viewer.wait_for_picture();
    for hang in &HANGS {
        let correct = submission.read(hang.file);
        let line = hang.write(&submission);
        viewer.wait_for(|state| state["build"] == "compiling");
        viewer.wait_for(|state| state["build"] == "ready");
        let started_at = Instant::now();
        let method = format!("`{}`", hang.method);
        let state = viewer.wait_for(|state| messages(state).contains(&method));
        let took = started_at.elapsed();
        let found = messages(&state);
        let is_line = |text: &&str| {
            let expected = format!("(\"{}:{line}\")", hang.file);
            text.contains(&method) && text.contains("infinite loop") && text.ends_with(&expected)
        };
        let statement = hang.statement;
        assert!(
            found.lines().any(|text| is_line(&text)),
            "{statement}: {found}"
        );
        assert!(took < NAMED_WITHIN, "{method}, {statement}: {took:?}");
        // This fix and the next loop are saved in quick succession and built together.
        submission.write(hang.file, &correct);
    }
}

#[test]
fn a_hang_ends_and_its_pixel_is_found() {
    let submission = Submission::reference();
    let hang = "while pixel == UVec2::new(5, 6) { std::hint::black_box(()); }";
    submission.insert_into_camera(hang);
    let viewer = Viewer::start(&submission, "flat --size 16x12 --samples 1");
    let state = viewer.wait_for_picture();
    assert_eq!(viewer.panicked_pixels(), 1);
    let note = &state["panics"][0];
    assert_eq!(note["pixel"], json!([5, 6]));
    let message = note["message"].as_str().unwrap();
    assert!(
        message.starts_with("`Camera::sample_ray`: stopped because"),
        "{note}"
    );
}

#[test]
fn a_pixel_whose_ray_never_returns_is_explained_by_the_method() {
    let submission = Submission::reference();
    let viewer = Viewer::start(&submission, "flat --size 16x12 --samples 1");
    viewer.wait_for_picture();
    Hang::in_hit(
        "Bvh::hit",
        "bvh.rs",
        "while ray.range.min == 0.0 && ray.dir.x > 0.1 { std::hint::black_box(()); }",
    )
    .write(&submission);
    viewer.wait_for(|state| state["build"] == "ready" && state["panics"] != json!([]));
    viewer.command(&json!({ "pick": { "pixel": [14, 6], "sample": null } }));
    let state = viewer.wait_for(|state| state["explanation_fault"].is_string());
    let why = state["explanation_fault"].as_str().unwrap();
    assert!(
        why.starts_with("`Bvh::hit`: stopped because") && why.contains("(bvh.rs:"),
        "{why}"
    );
}

#[test]
fn the_page_shows_a_hang_over_the_picture() {
    let submission = Submission::reference();
    let arguments = "flat --size 16x12 --samples 1";
    let Some((_chromium, _viewer, mut tab)) = start(&submission, arguments) else {
        return;
    };
    let line = HANGS[2].write(&submission);
    wait_until_shown(&mut tab, "stopped");
    let shown = text(&mut tab, "#stopped-text");
    assert!(
        shown.starts_with("Triangle::hit: stopped because"),
        "{shown}"
    );
    let link = tab.eval("document.querySelector('#stopped-text a').href");
    let path = submission.path().join("triangle.rs");
    assert_eq!(link, format!("vscode://file{}:{line}:1", path.display()));
}
