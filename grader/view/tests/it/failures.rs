//! Submissions that are unfinished or fail. The page shows as much as possible and says what is
//! missing.

use serde_json::{Value, json};
#[cfg(target_os = "linux")]
use test_support::processes::{eventually, family, is_running};

use crate::harness::{Submission, Viewer, notes};

#[test]
fn the_starter_lists_the_tasks_that_are_missing_with_their_lines() {
    let viewer = Viewer::start(&Submission::starter(), "spheres --size 16x12");
    let notes = notes(&viewer.wait_for_picture());
    for (task, file) in [
        ("`Camera::sample_ray` is not written yet", "camera.rs:"),
        ("`Triangle::hit` is not written yet", "triangle.rs:"),
        ("`Sphere::hit` is not written yet", "sphere.rs:"),
        ("`BBox::hit` is not written yet", "bbox.rs:"),
    ] {
        let line = notes.lines().find(|line| line.starts_with(task));
        assert!(line.is_some_and(|line| line.contains(file)), "{notes}");
    }
}

#[test]
fn before_the_tree_and_the_spheres_the_rest_is_shown() {
    let submission = Submission::reference();
    let starter = Submission::starter();
    submission.write("sphere.rs", &starter.read("sphere.rs"));
    submission.write("bvh.rs", &starter.read("bvh.rs"));
    let viewer = Viewer::start(&submission, "spheres --size 32x24 --samples 1");
    let notes = notes(&viewer.wait_for_picture());
    assert!(notes.contains("spheres are left out"), "{notes}");
    assert!(
        notes.contains("`Bvh::build` is not written yet, so each ray tests all"),
        "{notes}"
    );
    let traversal = "`Bvh::hit` is not written yet";
    let line = notes.lines().find(|line| line.starts_with(traversal));
    let text = starter.read("bvh.rs");
    let hit = text.lines().position(|line| line.contains("pub fn hit("));
    let number = hit.unwrap() + 1;
    assert!(
        line.is_some_and(|line| line.contains(&format!("bvh.rs:{number}"))),
        "{notes}"
    );
    assert!(
        viewer.picture().iter().any(|pixel| *pixel != [0, 0, 0]),
        "the floor is shown"
    );
    let ray = &viewer.explain([16, 2], None)["rays"][0];
    let note = ray["notes"][0].as_str().unwrap();
    assert!(note.contains("There is no tree yet"), "{note}");
    assert_eq!(ray["boxes"], 0);
}

#[test]
fn a_traversal_without_a_tree_does_not_test_all_primitives() {
    let submission = Submission::reference();
    submission.write("bvh.rs", &Submission::starter().read("bvh.rs"));
    submission.replace_traversal(
        "    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        self.nodes.get(self.root)?.bbox.hit(ray, ray.range)?;
        None
    }
",
    );
    let viewer = Viewer::start(&submission, "spheres --size 16x12 --samples 1");
    let notes = notes(&viewer.wait_for_picture());
    let note = "`Bvh::build` is not written yet, so `Bvh::hit` has no tree to traverse.";
    assert!(notes.starts_with(note), "{notes}");
}

/// A viewer that explains a pixel after its camera has been moved.
struct Explored {
    viewer: Viewer,
    state: Value,
    picture: Vec<[u8; 3]>,
}

impl Explored {
    fn start(submission: &Submission) -> Self {
        let viewer = Viewer::start(submission, "flat --size 24x20 --samples 2");
        viewer.wait_for_picture();
        viewer.command(&json!({ "move": { "orbit": [0.3, 0.1] } }));
        viewer.explain([12, 10], None);
        Explored {
            state: viewer.wait_for_picture(),
            picture: viewer.picture(),
            viewer,
        }
    }

    /// Checks that the picture is still shown.
    fn assert_stale(&self, state: &Value) {
        assert_eq!(state["is_stale"], true);
        assert!(self.viewer.picture() == self.picture, "the picture changed");
    }

    /// Waits until the picture is drawn again and checks that everything is as before.
    fn assert_restored(&self) {
        let after = self
            .viewer
            .wait_for(|state| state["is_stale"] == false && state["is_picture_complete"] == true);
        for part in ["errors", "notes", "camera", "pinned"] {
            assert_eq!(after[part], self.state[part], "{part}");
        }
        assert!(self.viewer.picture() == self.picture);
        assert_eq!(self.viewer.explanation()["pixel"], json!([12, 10]));
    }
}

#[test]
fn an_error_of_the_compiler_leaves_the_picture_until_it_is_fixed() {
    let submission = Submission::reference();
    let explored = Explored::start(&submission);
    let correct = submission.read("bvh.rs");
    submission.write("bvh.rs", &format!("{correct}\nfn broken( {{\n"));
    let failed = explored.viewer.wait_for(|state| state["build"] == "failed");
    let error = &failed["errors"][0];
    assert_eq!(error["file"], "bvh.rs");
    let line = correct.lines().count() as u64 + 2;
    assert!(error["line"].as_u64().unwrap() >= line, "{error}");
    explored.assert_stale(&failed);

    submission.write("bvh.rs", &correct);
    explored.assert_restored();
}

#[test]
fn a_panic_paints_its_pixels_and_names_its_place() {
    let submission = Submission::reference();
    let panic = "assert!(pixel.x != 3, \"column {}\", pixel.x);";
    submission.insert_into_camera(panic);
    let viewer = Viewer::start(&submission, "flat --size 20x10 --samples 1");
    let state = viewer.wait_for_picture();
    assert_eq!(viewer.panicked_pixels(), 10);
    let note = &state["panics"][0];
    assert_eq!(
        (&note["message"], &note["count"]),
        (&json!("column 3"), &json!(10))
    );
    let code = submission.read("camera.rs");
    let columns = code.lines().map(|line| line.find(panic));
    let (line, column) = (1..)
        .zip(columns)
        .find_map(|(line, column)| Some((line, column? + 1)))
        .unwrap();
    let location = format!("camera.rs:{line}:{column}");
    assert_eq!(note["location"], location);
}

/// Makes `Bvh::build` loop forever.
fn make_build_endless(submission: &Submission) {
    submission.insert_into_build("while max_leaf_size > 0 { std::hint::black_box(()); }");
}

#[test]
fn an_endless_build_ends_at_its_limit_and_can_be_fixed() {
    let submission = Submission::reference();
    let correct = submission.read("bvh.rs");
    let explored = Explored::start(&submission);
    let viewer = &explored.viewer;
    make_build_endless(&submission);
    viewer.wait_for(|state| state["is_opening"] == true && state["is_stale"] == true);
    let stopped = viewer.wait_for(|state| state["has_stopped"] == true);
    let notes = notes(&stopped);
    assert!(
        notes.contains("`Bvh::build`") && notes.contains("it took too long"),
        "{notes}"
    );
    assert_eq!(stopped["is_opening"], false);
    let why = stopped["explanation_fault"].as_str().unwrap();
    assert!(why.contains("as soon as the scene can be opened"), "{why}");
    explored.assert_stale(&stopped);

    submission.write("bvh.rs", &correct);
    explored.assert_restored();
}

#[test]
fn a_panic_or_a_stack_overflow_while_building_is_reported_and_can_be_fixed() {
    let submission = Submission::reference();
    let correct = submission.read("bvh.rs");
    let mut lines = correct.lines();
    let line = lines
        .position(|line| line.contains("pub fn build("))
        .unwrap()
        + 1;
    submission.insert_into_build("assert!(primitives.is_empty(), \"not today\");");
    let viewer = Viewer::start(&submission, "flat --size 8x8 --samples 1");
    let state = viewer.wait_for(|state| state["notes"] != json!([]));
    let panic = notes(&state);
    assert!(
        panic.contains("panicked: not today") && panic.contains(&format!("bvh.rs:{line}")),
        "{panic}"
    );
    submission.write("bvh.rs", &correct);
    assert_eq!(viewer.wait_for_picture()["notes"], json!([]));

    submission.insert_into_build(
        "if primitives.len() < usize::MAX { return Self::build(primitives, max_leaf_size); }",
    );
    let state = viewer.wait_for(|state| state["has_stopped"] == true);
    let overflow = notes(&state);
    // The compiler may have turned the recursion into a loop.
    assert!(
        overflow.contains("stack overflowed") || overflow.contains("stopped because"),
        "{overflow}"
    );
    submission.write("bvh.rs", &correct);
    assert_eq!(viewer.wait_for_picture()["notes"], json!([]));
}

#[cfg(target_os = "linux")]
#[test]
fn a_killed_viewer_leaves_no_program_running_even_one_that_hangs() {
    let submission = Submission::reference();
    let hang = "while pixel.x < 9999 { std::hint::black_box(()); }";
    submission.insert_into_camera(hang);
    let viewer = Viewer::start(&submission, "flat --size 16x12");
    viewer.wait_for(|state| state["build"] == "ready");
    let programs = || family(viewer.process()).split_off(1);
    let programs = eventually(|| Some(programs()).filter(|programs| !programs.is_empty()));
    viewer.kill();
    let have_ended = || !programs.iter().copied().any(is_running);
    eventually(|| have_ended().then_some(()));
}

#[cfg(target_os = "linux")]
#[test]
fn a_save_ends_programs_that_hang_before_their_limit() {
    let submission = Submission::reference();
    make_build_endless(&submission);
    let viewer = Viewer::start(&submission, "flat --size 8x8");
    viewer.wait_for(|state| state["is_opening"] == true);
    submission.write("bvh.rs", "not Rust");
    viewer.wait_for(|state| state["build"] == "failed");
    eventually(|| (family(viewer.process()).len() == 1).then_some(()));
    let state = viewer.get_json("/state?after=0");
    assert_eq!(state["notes"], json!([]), "a program ran until its limit");
}
