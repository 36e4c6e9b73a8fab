//! The page's layout: the picture fills the window, and nothing moves it.

use serde_json::{Value, json};
use test_support::Tab;

use crate::browser::{HAS_TABLE, point_at, start, text, wait, wait_until_shown};
use crate::harness::{SLIDES_HIT, Submission};

/// The picture, the level slider and the table of steps, each as [left, top, right, bottom].
const BOXES: &str = "['stage', 'level', 'explanation'].map((id) => { \
     const box = document.getElementById(id).getBoundingClientRect(); \
     return [box.left, box.top, box.right, box.bottom]; })";

fn boxes(tab: &mut Tab) -> Vec<[f64; 4]> {
    serde_json::from_value(tab.eval(BOXES)).unwrap()
}

#[test]
fn the_picture_and_the_slider_are_seen_together_and_messages_move_neither() {
    let submission = Submission::reference();
    let arguments = "checkered-teapot --size 48x36 --samples 1";
    let Some((_chromium, viewer, mut tab)) = start(&submission, arguments) else {
        return;
    };
    viewer.explain([24, 18], None);
    wait(&mut tab, HAS_TABLE);
    for (width, height) in [(1280, 800), (1920, 1080)] {
        tab.resize(width, height);
        let [picture, slider, steps] = boxes(&mut tab).try_into().unwrap();
        let window = [width, height].map(f64::from);
        for ([left, top, right, bottom], name) in [(picture, "picture"), (slider, "slider")] {
            let is_inside = left >= 0.0 && top >= 0.0 && right <= window[0] && bottom <= window[1];
            assert!(
                is_inside,
                "{name} at {width} × {height}: {left} {top} {right} {bottom}"
            );
        }
        assert!(steps[1] < window[1], "the first steps are seen");
        let [left, top, right, bottom] = picture;
        let share = (right - left) * (bottom - top) / (window[0] * window[1]);
        assert!(share > 0.4, "{share} of the window");
        assert!(((right - left) / (bottom - top) - 4.0 / 3.0).abs() < 0.01);
    }
    // Each step takes one line.
    let heights = tab.eval(
        "[...document.querySelectorAll('#explanation tbody tr')].map((row) => row.clientHeight)",
    );
    let heights: Vec<f64> = serde_json::from_value(heights).unwrap();
    assert!(heights.iter().all(|height| *height < 32.0), "{heights:?}");

    tab.resize(1280, 800);
    let before = boxes(&mut tab)[..2].to_vec();
    let correct = submission.read("camera.rs");
    submission.write("camera.rs", &format!("{correct}\nlet oops\n"));
    wait_until_shown(&mut tab, "errors");
    assert_eq!(boxes(&mut tab)[..2], before, "a compile error");
    let covers = tab.eval(
        "(({ right, bottom }, stage) => right > stage.left && bottom > stage.top)\
         (document.getElementById('errors').getBoundingClientRect(), \
         document.getElementById('stage').getBoundingClientRect())",
    );
    assert_eq!(covers, true, "the errors lie over the picture");
    let line = correct.lines().count() + 2;
    let path = submission.path().join("camera.rs");
    let link = tab.eval("document.querySelector('#errors h3 a').href");
    assert_eq!(link, format!("vscode://file{}:{line}:1", path.display()));
    let link = tab.eval("document.querySelector('#errors pre a').href");
    let start = format!("vscode://file{}:{line}:", path.display());
    assert!(link.as_str().unwrap().starts_with(&start), "{link}");

    submission.write("camera.rs", &correct);
    submission.insert_into_camera("assert!(pixel.x != 3, \"not here\");");
    wait(&mut tab, "document.getElementById('errors').hidden");
    wait_until_shown(&mut tab, "messages");
    assert_eq!(boxes(&mut tab)[..2], before, "a panic");
}

#[test]
fn on_a_phone_the_picture_comes_first() {
    let arguments = "flat --size 40x30 --samples 1";
    let Some((_chromium, _viewer, mut tab)) = start(&Submission::reference(), arguments) else {
        return;
    };
    tab.resize(420, 800);
    wait_until_shown(&mut tab, "tree-content");
    let [picture, slider, _] = boxes(&mut tab).try_into().unwrap();
    let [left, top, right, bottom] = picture;
    assert!(right - left > 380.0 && top < 150.0, "{picture:?}");
    assert!(slider[1] > bottom, "a single column");
}

#[test]
fn marks_link_to_the_traversal_and_the_mouse_shows_values() {
    let submission = Submission::reference();
    submission.replace_traversal(SLIDES_HIT);
    let arguments = "gyroid --size 24x24 --samples 1";
    let Some((_chromium, viewer, mut tab)) = start(&submission, arguments) else {
        return;
    };
    let pixels = (0..36).map(|n| [2 + 4 * (n % 6), 2 + 4 * (n / 6)]);
    let has_marks = |explanation: &Value| {
        let rows = explanation["rays"][0]["rows"].as_array().unwrap();
        rows.iter().any(|row| row["marks"] != json!([]))
    };
    let mut pixels = pixels.filter(|pixel| has_marks(&viewer.explain(*pixel, None)));
    assert!(pixels.next().is_some(), "no pixel has a mark");
    let is_shown = "document.querySelector('#explanation p.rule a') !== null";
    wait(&mut tab, is_shown);
    let link = tab.eval("document.querySelector('#explanation p.rule a').href");
    let code = submission.read("bvh.rs");
    let mut lines = code.lines();
    let line = lines.position(|line| line.contains("pub fn hit(&self"));
    let path = submission.path().join("bvh.rs");
    let expected = format!("vscode://file{}:{}:1", path.display(), line.unwrap() + 1);
    assert_eq!(link, expected);

    viewer.show("depth");
    let point = point_at("stage", 0.5, 0.5);
    let is_value =
        "/^\\(12, 11\\): (distance|no hit)/.test(document.getElementById('hovered').innerText)";
    wait(&mut tab, &format!("{point} && {is_value}"));
    let hovered = text(&mut tab, "#hovered");
    assert!(hovered.len() < 120, "{hovered}");
}
