//! The page in a browser, used like a student does.

use browser_support::{Chromium, DESKTOP, Tab, Viewer as Reader, violations};
use glam::{UVec2, Vec3, uvec2};
use serde_json::{Value, json};

use crate::expected_tests::Expected;
use crate::explanations::TESTS_TWICE;
use crate::harness::{Submission, Viewer};

const IS_COMPLETE: &str = "document.body.dataset.complete === 'true'";
const HAS_TABLE: &str = "document.querySelector('#explanation tbody tr') !== null";
const TEXT: &str = "document.body.innerText";

/// Opens the address that the viewer has printed.
fn open(viewer: &Viewer, chromium: &Chromium, reader: Reader) -> Tab {
    let mut tab = chromium.tab();
    tab.open_url(
        &format!("http://127.0.0.1:{}{}", viewer.port, viewer.first),
        reader,
    );
    // The page with the token leads on to the viewer by itself.
    tab.wait_until_loaded();
    tab
}

fn text(tab: &mut Tab, selector: &str) -> String {
    let text = tab.eval(&format!("document.querySelector('{selector}').innerText"));
    text.as_str().unwrap().to_owned()
}

/// Explains a pixel with the page's form.
fn explain(tab: &mut Tab, viewer: &Viewer, pixel: UVec2) {
    let UVec2 { x, y } = pixel;
    tab.eval(&format!(
        "document.getElementById('pick-x').value = {x}; document.getElementById('pick-y').value = {y}; \
         document.getElementById('pick').requestSubmit(); 0"
    ));
    viewer.wait_for(|state| {
        state["pinned"]["pixel"] == json!([x, y]) && state["explanation"].is_number()
    });
    let title = format!("Pixel ({x}, {y})");
    let is_shown =
        format!("document.querySelector('#explanation h3')?.innerText.startsWith('{title}')");
    tab.wait_until(&is_shown, TEXT);
}

/// Returns the tests in the page's table, in the form of [`Expected::tests`].
fn table(tab: &mut Tab) -> Vec<String> {
    let cells = tab.eval(
        "[...document.querySelectorAll('#explanation tbody tr td:nth-child(2)')]\
         .map((cell) => cell.innerText.replace(/triangle (\\d+), in leaf \\d+/, 'shape $1')\
         .replace(/ \\(level \\d+\\)/, ''))",
    );
    serde_json::from_value(cells).unwrap()
}

/// Returns the middle of the picture in the window.
fn middle(tab: &mut Tab) -> (f64, f64) {
    let at = tab.eval(
        "document.getElementById('stage').scrollIntoView(); \
         (({ x, y, width, height }) => [x + width / 2, y + height / 2])\
         (document.getElementById('pixels').getBoundingClientRect())",
    );
    (at[0].as_f64().unwrap(), at[1].as_f64().unwrap())
}

#[test]
fn a_student_orbits_explains_a_pixel_breaks_the_code_and_repairs_it() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let submission = Submission::reference();
    let arguments = ["checkered-teapot", "--size", "96x72", "--samples", "2"];
    let viewer = Viewer::start(&submission, &arguments);
    let mut tab = open(&viewer, &chromium, DESKTOP);
    tab.wait_until(IS_COMPLETE, TEXT);
    let own = viewer.wait_for_picture();

    tab.eval("document.getElementById('stage').focus(); 0");
    tab.press("ArrowRight", 39);
    viewer.wait_for(|state| state["camera"] != own["camera"]);
    tab.wait_until(IS_COMPLETE, TEXT);

    let middle = middle(&mut tab);
    tab.drag(middle, middle);
    tab.wait_until(HAS_TABLE, TEXT);
    let explanation = viewer.explanation();
    assert_eq!(explanation["pixel"][0], 48, "the middle of 96 pixels");
    let rows = explanation["rays"][0]["rows"].as_array().unwrap().len();
    let shown = tab.eval("document.querySelectorAll('#explanation tbody tr').length");
    assert_eq!(shown, rows);
    // No tree is drawn here, so the camera is the scene's own again.
    tab.eval("document.querySelector('[data-own]').click(); 0");
    viewer.wait_for(|state| state["camera"]["is_own"] == true);
    let expected = Expected::of_scene("checkered-teapot", uvec2(96, 72));
    for pixel in [uvec2(48, 36), uvec2(40, 40), uvec2(3, 70)] {
        explain(&mut tab, &viewer, pixel);
        assert_eq!(table(&mut tab), expected.tests(pixel), "{pixel}");
    }
    let row = text(&mut tab, "#explanation tbody tr");
    assert!(row.contains("node 0 (level 0)"), "{row}");
    // Step by step, forward and backward.
    let steps = "document.querySelector('[aria-current=step] button').innerText";
    tab.eval("document.querySelector('[aria-label=\"First step\"]').click(); 0");
    tab.eval("document.querySelector('[aria-label=\"Step forward\"]').click(); 0");
    assert_eq!(tab.eval(steps), "2");
    tab.eval("document.querySelector('[aria-label=\"Step back\"]').click(); 0");
    assert_eq!(tab.eval(steps), "1");

    let before = viewer.wait_for_picture();
    let correct = submission.read("bvh.rs");
    submission.write(
        "bvh.rs",
        &correct.replace("pub fn hit(&self", "pub fn hit(&self,"),
    );
    submission.write("bvh.rs", &format!("{correct}\nlet oops\n"));
    tab.wait_until("!document.getElementById('errors').hidden", TEXT);
    let heading = text(&mut tab, "#errors h3");
    let line = correct.lines().count() + 2;
    assert_eq!(heading, format!("bvh.rs:{line}"));
    assert!(text(&mut tab, "#errors pre").contains("let oops"));
    assert_eq!(
        tab.eval("document.getElementById('stage').className"),
        "stale"
    );

    submission.write("bvh.rs", &correct);
    tab.wait_until("document.getElementById('errors').hidden", TEXT);
    tab.wait_until(IS_COMPLETE, TEXT);
    tab.wait_until("document.getElementById('stage').className === ''", TEXT);
    let after = viewer.wait_for_picture();
    assert_eq!(after["camera"], before["camera"]);
    assert_eq!(tab.errors(), [""; 0]);
    let here = format!("http://127.0.0.1:{}/", viewer.port);
    assert!(
        tab.requests().iter().all(|url| url.starts_with(&here)),
        "{:?}",
        tab.requests()
    );
}

#[test]
fn the_keyboard_alone_explains_a_pixel_and_shows_the_tree() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let arguments = ["flat", "--size", "64x48", "--samples", "1"];
    let viewer = Viewer::start(&Submission::reference(), &arguments);
    let mut tab = open(&viewer, &chromium, DESKTOP);
    tab.wait_until(IS_COMPLETE, TEXT);
    tab.eval("document.getElementById('stage').focus(); 0");
    tab.press("Enter", 13);
    tab.wait_until(HAS_TABLE, TEXT);
    tab.wait_until("!document.getElementById('tree-content').hidden", TEXT);
    tab.eval("document.getElementById('level').focus(); 0");
    tab.press("ArrowRight", 39);
    tab.wait_until(
        "document.getElementById('boxes-count').innerText.includes('box')",
        TEXT,
    );
    assert_eq!(text(&mut tab, "#level-value"), "1");
    tab.eval("document.querySelector('#worst button').focus(); 0");
    tab.press("Enter", 13);
    let node = text(&mut tab, "#node");
    assert!(node.contains("of the SAH cost"), "{node}");
    // From node to node, and the boxes in the picture as a table.
    tab.eval("document.getElementById('node-index').value = 0; 0");
    tab.eval("document.querySelector('#choose-node button').focus(); 0");
    tab.press("Enter", 13);
    let is_root = "document.getElementById('node').innerText.startsWith('Node 0, level 0')";
    tab.wait_until(is_root, TEXT);
    assert_eq!(
        tab.eval("document.getElementById('node-parent').disabled"),
        true
    );
    tab.eval("document.getElementById('node-second').focus(); 0");
    tab.press("Enter", 13);
    let is_child = "/^(Node|Leaf) \\d+, level 1/.test(document.getElementById('node').innerText)";
    tab.wait_until(is_child, TEXT);
    let rows = tab.eval("document.querySelectorAll('#drawn-boxes tbody tr').length");
    let count = text(&mut tab, "#boxes-count");
    assert_eq!(count, format!("{rows} boxes"));
}

/// Returns the camera's position and its direction backward.
fn position_and_backward(state: &Value) -> [Vec3; 2] {
    let camera = &state["camera"];
    [&camera["position"], &camera["axes"][2]]
        .map(|vector| serde_json::from_value(vector.clone()).unwrap())
}

#[test]
fn a_primitive_that_is_tested_twice_is_noted_in_the_table() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let submission = Submission::reference();
    submission.replace_traversal(TESTS_TWICE);
    let viewer = Viewer::start(&submission, &["flat", "--size", "16x16", "--samples", "1"]);
    let mut tab = open(&viewer, &chromium, DESKTOP);
    tab.wait_until(IS_COMPLETE, TEXT);
    explain(&mut tab, &viewer, uvec2(8, 8));
    let rows = tab.eval(
        "[...document.querySelectorAll('#explanation tbody tr')].map((row) => row.innerText)",
    );
    let rows: Vec<String> = serde_json::from_value(rows).unwrap();
    let (first, second) = rows.split_at(rows.len() / 2);
    let is_noted = |row: &String| row.contains("(tested before)");
    assert!(!first.iter().any(is_noted), "{first:?}");
    assert!(
        !second.is_empty() && second.iter().all(is_noted),
        "{second:?}"
    );
}

#[test]
fn keys_alone_move_the_camera_in_every_way() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let arguments = ["flat", "--size", "16x12", "--samples", "1"];
    let viewer = Viewer::start(&Submission::reference(), &arguments);
    let mut tab = open(&viewer, &chromium, DESKTOP);
    tab.wait_until(IS_COMPLETE, TEXT);
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

    // Each movement begins at the scene's camera. It returns the change of the position, and the
    // direction backward.
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

#[test]
fn the_mouse_names_nodes_and_the_picture_can_be_saved() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let arguments = ["flat", "--size", "64x48", "--samples", "1"];
    let viewer = Viewer::start(&Submission::reference(), &arguments);
    let mut tab = open(&viewer, &chromium, DESKTOP);
    tab.wait_until(IS_COMPLETE, TEXT);
    tab.eval("document.getElementById('load-tree').click(); 0");
    tab.wait_until("!document.getElementById('tree-content').hidden", TEXT);
    // Pointed at again until the page reacts, since it draws a canvas some time after it shows it.
    let point = |canvas: &str, x: f64, y: f64| {
        format!(
            "(() => {{ const at = document.getElementById('{canvas}').getBoundingClientRect(); \
             document.getElementById('{canvas}').dispatchEvent(new PointerEvent('pointermove', \
             {{ clientX: at.x + {x} * at.width, clientY: at.y + {y} * at.height }})); return true; }})()"
        )
    };
    // The highest row of the strip is the root.
    let names =
        |start: &str| format!("document.getElementById('node').innerText.startsWith('{start}')");
    let root = point("strip", 0.5, 0.01);
    tab.wait_until(&format!("{root} && {}", names("Node 0, level 0")), TEXT);
    // The boxes of level 1 are drawn over the picture.
    tab.eval(
        "document.getElementById('level').value = 1; \
         document.getElementById('level').dispatchEvent(new Event('input')); 0",
    );
    tab.wait_until(
        "document.getElementById('boxes-count').innerText !== ''",
        TEXT,
    );
    let is_named = "document.getElementById('node').innerText.includes(', level 1: ')";
    let middle = point("lines", 0.5, 0.5);
    tab.wait_until(&format!("{middle} && {is_named}"), TEXT);

    let saved = tab.eval(
        "(async () => { const image = new Image(); image.src = document.getElementById('save').href; \
         await image.decode(); const canvas = document.createElement('canvas'); \
         [canvas.width, canvas.height] = [image.width, image.height]; \
         const context = canvas.getContext('2d'); context.drawImage(image, 0, 0); \
         return [...context.getImageData(0, 0, image.width, image.height).data]; })()",
    );
    let saved: Vec<u8> = serde_json::from_value(saved).unwrap();
    let pixels: Vec<[u8; 3]> = saved
        .chunks(4)
        .map(|rgba| [rgba[0], rgba[1], rgba[2]])
        .collect();
    assert!(pixels == viewer.picture(), "another picture is saved");
    assert_eq!(
        tab.eval("document.getElementById('save').download"),
        "flat.png"
    );
    // A refused command says why.
    tab.eval(
        "document.getElementById('exposure').value = 99; \
         document.getElementById('exposure').dispatchEvent(new Event('change')); 0",
    );
    tab.wait_until(
        "document.getElementById('refused').innerText.includes('out of range')",
        TEXT,
    );
}

#[test]
fn two_windows_show_the_same_camera_and_pixel() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let arguments = ["flat", "--size", "32x24", "--samples", "1"];
    let viewer = Viewer::start(&Submission::reference(), &arguments);
    let mut first = open(&viewer, &chromium, DESKTOP);
    first.wait_until(IS_COMPLETE, TEXT);
    first.eval("document.querySelector('[data-side=top]').click(); 0");
    first.eval("document.getElementById('pick-sample').value = '1'; 0");
    explain(&mut first, &viewer, uvec2(20, 10));
    let mut second = open(&viewer, &chromium, DESKTOP);
    second.wait_until(HAS_TABLE, TEXT);
    for tab in [&mut first, &mut second] {
        assert!(text(tab, "#explanation h3").starts_with("Pixel (20, 10), path 2"));
        assert_eq!(
            tab.eval("document.getElementById('pick-sample').value"),
            "1"
        );
    }
    second.eval("document.getElementById('stage').focus(); 0");
    second.press("Enter", 13);
    first.bring_to_front();
    first.wait_until(
        "document.querySelector('#explanation h3').innerText.startsWith('Pixel (16, 1')",
        TEXT,
    );
}

#[test]
fn axe_finds_nothing_in_light_and_dark_mode_and_on_a_phone() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let submission = Submission::reference();
    submission.write("sphere.rs", &Submission::starter().read("sphere.rs"));
    let viewer = Viewer::start(
        &submission,
        &["spheres", "--size", "32x24", "--samples", "1"],
    );
    viewer.wait_for_picture();
    viewer.explain([16, 4], Some(0));
    assert_eq!(viewer.send(&json!({ "view": "tests" })), 204);
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
        let mut tab = open(&viewer, &chromium, reader);
        tab.wait_until(HAS_TABLE, TEXT);
        tab.wait_until("!document.getElementById('tree-content').hidden", TEXT);
        assert_eq!(violations(&mut tab), [""; 0], "width {}", reader.width);
        let width = tab.eval("document.documentElement.scrollWidth");
        assert!(width.as_u64() <= Some(reader.width.into()), "{width}");
    }
}

#[test]
fn axe_finds_nothing_while_the_code_panics_or_does_not_compile() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let submission = Submission::reference();
    let correct = submission.read("camera.rs");
    let signature = "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {";
    let panic = "assert!(pixel.x != 3, \"column {}\", pixel.x);";
    submission.replace("camera.rs", signature, &format!("{signature} {panic}"));
    let viewer = Viewer::start(&submission, &["flat", "--size", "20x10", "--samples", "1"]);
    viewer.wait_for_picture();
    let phone = Reader {
        width: 390,
        ..DESKTOP
    };
    let readers = [DESKTOP, phone].map(|reader| {
        [
            reader,
            Reader {
                dark: true,
                ..reader
            },
        ]
    });
    let readers = readers.as_flattened();
    let check = |is_shown: &str| {
        for reader in readers {
            let mut tab = open(&viewer, &chromium, *reader);
            tab.wait_until(is_shown, TEXT);
            let name = format!("width {}, dark: {}", reader.width, reader.dark);
            assert_eq!(violations(&mut tab), [""; 0], "{name}");
            let width = tab.eval("document.documentElement.scrollWidth");
            assert!(
                width.as_u64() <= Some(reader.width.into()),
                "{name}: {width}"
            );
        }
    };
    check(
        "/10 samples, the first in pixel .3, \\d.: column 3 .camera.rs:\\d+/.test(document.getElementById('notes').innerText)",
    );
    submission.write("camera.rs", &format!("{correct}\nlet oops\n"));
    check(
        "!document.getElementById('errors').hidden && document.getElementById('stage').className === 'stale'",
    );
}

#[test]
fn ten_tabs_show_the_picture_and_notice_that_the_viewer_has_ended() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let viewer = Viewer::start(
        &Submission::reference(),
        &["flat", "--size", "16x12", "--samples", "1"],
    );
    let mut tabs: Vec<Tab> = (0..10).map(|_| open(&viewer, &chromium, DESKTOP)).collect();
    // A hidden tab waits until it is seen.
    for tab in &mut tabs {
        tab.bring_to_front();
        tab.wait_until(IS_COMPLETE, TEXT);
        tab.wait_until("document.getElementById('pixels').width === 16", TEXT);
    }
    assert_eq!(viewer.send(&json!({ "view": "depth" })), 204);
    for tab in &mut tabs {
        tab.bring_to_front();
        tab.wait_until("document.querySelector('[value=depth]').checked", TEXT);
    }
    drop(viewer);
    for tab in &mut tabs {
        tab.bring_to_front();
        tab.wait_until("!document.getElementById('offline').hidden", TEXT);
    }
}
