//! Tests the views that show tests and mistakes. The sums over all rays must appear without a click
//! and be correct both before and after a save.

use serde_json::{Value, json};
use test_support::{Chromium, DESKTOP};

use crate::browser::{open, text, wait_for_text, wait_until_shown};
use crate::expected_tests::marks;
use crate::harness::{Submission, Viewer};

const SIZE: [u32; 2] = [48, 36];

#[test]
fn a_save_that_visits_the_farther_child_first_changes_the_sums_and_the_picture() {
    let submission = Submission::reference();
    let [width, height] = SIZE;
    let arguments = format!("checkered-teapot --size {width}x{height} --samples 1");
    let viewer = Viewer::start(&submission, &arguments);
    let state = viewer.show("mistakes");
    let correct = &state["tests"];
    assert_eq!(correct["marked"], 0.0, "{correct}");
    assert_eq!(correct["broken"], json!([0.0, 0.0, 0.0]));
    assert_eq!(
        (&correct["before"], &correct["problem"]),
        (&Value::Null, &Value::Null)
    );
    let is_grey = |[r, g, b]: [u8; 3]| r == g && g == b;
    assert!(viewer.picture().into_iter().all(is_grey));

    submission.replace(
        "bvh.rs",
        "if in_l.min <= in_r.min {",
        "if in_l.min > in_r.min {",
    );
    let state = viewer.wait_for(|state| {
        state["is_picture_complete"] == true && state["tests"]["before"] != Value::Null
    });
    let wrong = &state["tests"];
    for part in ["mean", "marked", "broken"] {
        assert_eq!(wrong["before"][part], correct[part], "{part}");
    }
    assert!(wrong["mean"].as_f64() > correct["mean"].as_f64(), "{wrong}");
    let [missed, _, farther] = [0, 1, 2].map(|rule| wrong["broken"][rule].as_f64().unwrap());
    assert!(missed == 0.0 && farther > 0.1, "{wrong}");

    // The coloured pixels are the pixels whose explanations contain marks.
    let picture = viewer.picture();
    let coloured = picture.iter().filter(|pixel| !is_grey(**pixel)).count();
    let share = coloured as f64 / f64::from(width * height);
    assert!(
        (share - wrong["marked"].as_f64().unwrap()).abs() < 1e-9,
        "{share}"
    );
    let mut marked = 0;
    for pixel in (0..12).map(|i| [2 + 4 * i, 3 + 29 * i % 30]) {
        let explanation = viewer.explain(pixel, None);
        let is_marked = !marks(&explanation["rays"][0]).is_empty();
        let index = (height - 1 - pixel[1]) * width + pixel[0];
        assert_eq!(is_marked, !is_grey(picture[index as usize]), "{pixel:?}");
        marked += u32::from(is_marked);
    }
    assert!((1..12).contains(&marked), "{marked}");

    if let Some(chromium) = Chromium::start() {
        let mut tab = open(&viewer, &chromium, DESKTOP);
        wait_until_shown(&mut tab, "sums");
        let sums = text(&mut tab, "#sums");
        let farther = "% of rays visit the farther child first (before the last save: 0%)";
        assert!(sums.contains(farther), "{sums}");
        viewer.command(&json!({ "view": "tests" }));
        wait_for_text(&mut tab, "legend", "1000 or more");
        let sums = text(&mut tab, "#sums");
        let average = "tests per ray on average (before the last save: ";
        assert!(sums.contains(average), "{sums}");
        assert_eq!(tab.errors(), [""; 0]);
    }
    // Saves made while another view is shown: the last version's tests are not known.
    viewer.show("shaded");
    for save in 1..=2 {
        let text = submission.read("bvh.rs");
        submission.write("bvh.rs", &format!("{text}// save {save}\n"));
        viewer.wait_for(|state| state["is_picture_complete"] == false);
        viewer.wait_for_picture();
    }
    let state = viewer.show("mistakes");
    assert_eq!(state["tests"]["before"], Value::Null);
    // A different camera produces different rays.
    viewer.command(&json!({ "side": "top" }));
    let state = viewer.show("mistakes");
    assert_eq!(state["tests"]["before"], Value::Null);
}

#[test]
fn a_traversal_without_box_tests_is_not_judged_and_the_page_says_so() {
    let submission = Submission::reference();
    submission.replace_traversal(
        "    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        self.primitives.iter().map(|primitive| primitive.hit(ray)).fold(None, Trace::nearer)
    }
",
    );
    // No click is needed, since the view can be chosen on the command line.
    let viewer = Viewer::start(&submission, "flat --size 16x12 --samples 1 --view mistakes");
    let state = viewer.wait_for_picture();
    assert_eq!(state["view"], "mistakes");
    let problem = state["tests"]["problem"].as_str().unwrap();
    assert!(problem.contains("does not call `BBox::hit`"), "{problem}");
    assert_eq!(state["tests"]["marked"], 0.0);
}
