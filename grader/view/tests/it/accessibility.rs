//! Tests that the page can be used with only a keyboard, in light and dark mode and on a phone, and
//! that it follows the WCAG rules that axe checks.

use glam::Vec3;
use serde_json::{Value, json};
use test_support::{Chromium, DESKTOP, Tab, Viewer as Reader, violations};

use crate::browser::{
    HAS_TABLE, focus, open, property, run, start, text, wait, wait_for_text, wait_until_shown,
};
use crate::harness::{Submission, Viewer};

#[test]
fn the_keyboard_alone_explains_a_pixel_and_shows_the_tree() {
    let arguments = "flat --size 64x48 --samples 1";
    let Some((_chromium, _viewer, mut tab)) = start(&Submission::reference(), arguments) else {
        return;
    };
    let press_enter = |tab: &mut Tab, selector: &str| {
        focus(tab, selector);
        tab.press("Enter", 13);
    };
    press_enter(&mut tab, "#stage");
    wait(&mut tab, HAS_TABLE);
    wait_until_shown(&mut tab, "tree-content");
    focus(&mut tab, "#level");
    tab.press("ArrowRight", 39);
    wait_for_text(&mut tab, "boxes-count", "box");
    assert_eq!(text(&mut tab, "#level-value"), "1");
    press_enter(&mut tab, "#nodes summary");
    press_enter(&mut tab, "#worst button");
    let node = text(&mut tab, "#node");
    assert!(node.contains("of the SAH cost"), "{node}");
    // Go from node to node, and read the table of the boxes in the picture.
    run(&mut tab, "document.getElementById('node-index').value = 0");
    press_enter(&mut tab, "#choose-node button");
    let is_root = "document.getElementById('node').innerText.startsWith('Node 0, level 0')";
    wait(&mut tab, is_root);
    assert_eq!(property(&mut tab, "node-parent", "disabled"), true);
    press_enter(&mut tab, "#node-second");
    let is_child = "/^(Node|Leaf) \\d+, level 1/.test(document.getElementById('node').innerText)";
    wait(&mut tab, is_child);
    let rows = tab.eval("document.querySelectorAll('#drawn-boxes tbody tr').length");
    let count = text(&mut tab, "#boxes-count");
    assert_eq!(count, format!("{rows} boxes"));
}

/// Returns the camera's position and its backward direction.
fn position_and_backward(state: &Value) -> [Vec3; 2] {
    let camera = &state["camera"];
    [&camera["position"], &camera["axes"][2]]
        .map(|vector| serde_json::from_value(vector.clone()).unwrap())
}

#[test]
fn keys_alone_move_the_camera_in_every_way() {
    let arguments = "flat --size 16x12 --samples 1";
    let Some((_chromium, viewer, mut tab)) = start(&Submission::reference(), arguments) else {
        return;
    };
    // The picture is reached with the Tab key.
    let mut tabs = 0;
    while tab.eval("document.activeElement.id") != "stage" {
        tab.press("Tab", 9);
        tabs += 1;
        assert!(tabs < 50, "the picture has no focus");
    }
    let state = viewer.wait_for_picture();
    let own = state["camera"].clone();
    let [position, backward] = position_and_backward(&state);
    let right: Vec3 = serde_json::from_value(own["axes"][0].clone()).unwrap();
    let up = backward.cross(right);

    // Presses a key and returns the change in position and the new backward direction. Each
    // movement starts at the scene's camera.
    let mut movement = |key: &str, code: u32, with_shift: bool| {
        if with_shift {
            tab.press_with_shift(key, code);
        } else {
            tab.press(key, code);
        }
        let moved = viewer.wait_for(|state| state["camera"] != own);
        tab.press("Home", 36);
        viewer.wait_for(|state| state["camera"] == own);
        let [there, backward] = position_and_backward(&moved);
        (there - position, backward)
    };
    let is_along = |(moved, now): (Vec3, Vec3), direction: Vec3| {
        moved.normalize().distance(direction) < 1e-3 && now.distance(backward) < 1e-5
    };
    for (key, code, direction) in [
        ("ArrowLeft", 37, -right),
        ("ArrowUp", 38, up),
        ("ArrowRight", 39, right),
        ("ArrowDown", 40, -up),
    ] {
        let pan = movement(key, code, true);
        assert!(is_along(pan, direction), "Shift with {key}: {pan:?}");
        let (moved, now) = movement(key, code, false);
        assert!(moved.dot(direction).abs() > 1e-3, "{key}: {moved}");
        assert!(now.distance(backward) > 1e-3, "{key} does not turn");
    }
    for (key, code, direction) in [
        ("+", 187, -backward),
        ("-", 189, backward),
        ("w", 87, -backward),
        ("s", 83, backward),
    ] {
        let straight = movement(key, code, false);
        assert!(is_along(straight, direction), "{key}: {straight:?}");
    }
    for (key, code, direction) in [("a", 65, -right), ("d", 68, right)] {
        let (moved, now) = movement(key, code, false);
        assert_eq!(moved, Vec3::ZERO, "{key}");
        assert!((backward - now).dot(direction) > 1e-3, "{key}: {now}");
    }
}

/// Opens the page. Once the page is in the expected state, checks the WCAG rules and the page's
/// width.
fn check(viewer: &Viewer, chromium: &Chromium, reader: Reader, is_shown: &str) {
    let mut tab = open(viewer, chromium, reader);
    wait(&mut tab, is_shown);
    run(&mut tab, "document.getElementById('history').open = true");
    let name = format!("width {}, dark: {}", reader.width, reader.dark);
    assert_eq!(violations(&mut tab), [""; 0], "{name}");
    let width = tab.eval("document.documentElement.scrollWidth");
    let is_whole = width.as_u64() <= Some(reader.width.into());
    assert!(is_whole, "{name}: {width}");
}

#[test]
fn axe_finds_nothing_in_light_and_dark_mode_and_on_a_phone() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let submission = Submission::reference();
    submission.write("sphere.rs", &Submission::starter().read("sphere.rs"));
    let viewer = Viewer::start(&submission, "spheres --size 32x24 --samples 1");
    viewer.wait_for_picture();
    viewer.explain([16, 4], Some(0));
    viewer.command(&json!({ "view": "tests" }));
    let is_shown = format!("{HAS_TABLE} && !document.getElementById('tree-content').hidden");
    let phone = Reader {
        width: 390,
        dark: false,
        reduced_motion: true,
    };
    let dark = Reader {
        dark: true,
        ..DESKTOP
    };
    for reader in [DESKTOP, dark, phone] {
        check(&viewer, &chromium, reader, &is_shown);
    }
}

#[test]
fn axe_finds_nothing_while_the_code_panics_or_does_not_compile() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let submission = Submission::reference();
    let correct = submission.read("camera.rs");
    let panic = "assert!(pixel.x != 3, \"column {} {}\", pixel.x, \"x\".repeat(999));";
    submission.insert_into_camera(panic);
    let viewer = Viewer::start(&submission, "flat --size 20x10 --samples 1");
    viewer.wait_for_picture();
    let phone = Reader {
        width: 390,
        ..DESKTOP
    };
    let check_all = |is_shown: &str| {
        for reader in [DESKTOP, phone] {
            for dark in [false, true] {
                check(&viewer, &chromium, Reader { dark, ..reader }, is_shown);
            }
        }
    };
    check_all(
        "/10 samples, the first in pixel .3, \\d.: column 3 x+ .camera.rs:\\d+/.test(document.getElementById('notes').innerText)",
    );
    submission.write("camera.rs", &format!("{correct}\nlet oops\n"));
    check_all(
        "!document.getElementById('errors').hidden && document.getElementById('stage').className === 'stale'",
    );
}
