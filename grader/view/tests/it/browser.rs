//! The page in a browser, used as a student would use it.

use glam::{UVec2, uvec2};
use serde_json::{Value, json};
use test_support::{Chromium, DESKTOP, Tab, Viewer as Reader};

use crate::expected_tests::Expected;
use crate::harness::{Submission, Viewer};

pub const IS_COMPLETE: &str = "document.body.dataset.complete === 'true'";
pub const HAS_TABLE: &str = "document.querySelector('#explanation tbody tr') !== null";
const TEXT: &str = "document.body.innerText";

/// Opens the address printed by the viewer.
pub fn open(viewer: &Viewer, chromium: &Chromium, reader: Reader) -> Tab {
    let mut tab = chromium.tab();
    tab.open_url(
        &format!("http://127.0.0.1:{}{}", viewer.port, viewer.first),
        reader,
    );
    tab
}

/// Waits until a condition is true on the page.
pub fn wait(tab: &mut Tab, condition: &str) {
    tab.wait_until(condition, TEXT);
}

/// Waits until the element with this id is shown.
pub fn wait_until_shown(tab: &mut Tab, id: &str) {
    wait(tab, &format!("!document.getElementById('{id}').hidden"));
}

/// Waits until the text of the element with this id contains `text`.
pub fn wait_for_text(tab: &mut Tab, id: &str, text: &str) {
    let content = format!("document.getElementById('{id}').innerText");
    wait(tab, &format!("{content}.includes('{text}')"));
}

/// Runs statements on the page.
pub fn run(tab: &mut Tab, statements: &str) {
    tab.eval(&format!("{statements}; 0"));
}

/// Clicks on the first element that matches a selector.
pub fn click(tab: &mut Tab, selector: &str) {
    run(
        tab,
        &format!("document.querySelector('{selector}').click()"),
    );
}

/// Moves the focus to the first element that matches a selector.
pub fn focus(tab: &mut Tab, selector: &str) {
    run(
        tab,
        &format!("document.querySelector('{selector}').focus()"),
    );
}

/// Returns a condition that moves the mouse to a position in the element with this id, given as
/// fractions of the element's size. Wait for it together with the expected reaction, since the page
/// may not be ready yet when it is first evaluated.
pub fn point_at(id: &str, x: f64, y: f64) -> String {
    format!(
        "(() => {{ const at = document.getElementById('{id}').getBoundingClientRect(); \
         document.getElementById('{id}').dispatchEvent(new PointerEvent('pointermove', \
         {{ clientX: at.x + {x} * at.width, clientY: at.y + {y} * at.height }})); return true; }})()"
    )
}

/// Returns a property of the element with this id.
pub fn property(tab: &mut Tab, id: &str, name: &str) -> Value {
    tab.eval(&format!("document.getElementById('{id}').{name}"))
}

/// Starts a browser and the viewer and waits until the picture is complete. Returns `None` if there
/// is no browser.
pub fn start(submission: &Submission, arguments: &str) -> Option<(Chromium, Viewer, Tab)> {
    let chromium = Chromium::start()?;
    let viewer = Viewer::start(submission, arguments);
    let mut tab = open(&viewer, &chromium, DESKTOP);
    wait(&mut tab, IS_COMPLETE);
    Some((chromium, viewer, tab))
}

pub fn text(tab: &mut Tab, selector: &str) -> String {
    let text = tab.eval(&format!("document.querySelector('{selector}').innerText"));
    text.as_str().unwrap().to_owned()
}

/// Picks a pixel with the page's form and waits until the pixel is explained.
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
    wait(tab, &is_shown);
}

/// Returns the tests in the page's table, in the format of [`Expected::tests`].
fn table(tab: &mut Tab) -> Vec<String> {
    let cells = tab.eval(
        "[...document.querySelectorAll('#explanation tbody tr td:nth-child(2)')]\
         .map((cell) => cell.innerText.replace('triangle', 'shape'))",
    );
    serde_json::from_value(cells).unwrap()
}

/// Returns the position of the picture's centre in the window.
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
    let submission = Submission::reference();
    let arguments = "checkered-teapot --size 96x72 --samples 2";
    let Some((_chromium, viewer, mut tab)) = start(&submission, arguments) else {
        return;
    };
    let own = viewer.wait_for_picture();

    focus(&mut tab, "#stage");
    tab.press("ArrowRight", 39);
    viewer.wait_for(|state| state["camera"] != own["camera"]);
    wait(&mut tab, IS_COMPLETE);

    let middle = middle(&mut tab);
    tab.drag(middle, middle);
    wait(&mut tab, HAS_TABLE);
    let explanation = viewer.explanation();
    assert_eq!(explanation["pixel"][0], 48, "the middle of 96 pixels");
    let rows = explanation["rays"][0]["rows"].as_array().unwrap().len();
    let shown = tab.eval("document.querySelectorAll('#explanation tbody tr').length");
    assert_eq!(shown, rows);
    // No tree is drawn here, so use the scene's own camera again.
    click(&mut tab, "[data-own]");
    viewer.wait_for(|state| state["camera"]["is_own"] == true);
    let expected = Expected::of_scene("checkered-teapot", uvec2(96, 72));
    for pixel in [uvec2(48, 36), uvec2(40, 40), uvec2(3, 70)] {
        explain(&mut tab, &viewer, pixel);
        assert_eq!(table(&mut tab), expected.tests(pixel), "{pixel}");
    }
    let row = text(&mut tab, "#explanation tbody tr");
    assert!(row.contains("node 0\t0\t"), "{row}");
    // Go forward and backward, step by step.
    let steps = "document.querySelector('[aria-current=step] button').innerText";
    click(&mut tab, "[aria-label=\"First step\"]");
    click(&mut tab, "[aria-label=\"Step forward\"]");
    assert_eq!(tab.eval(steps), "2");
    click(&mut tab, "[aria-label=\"Step back\"]");
    assert_eq!(tab.eval(steps), "1");

    let before = viewer.wait_for_picture();
    let correct = submission.read("bvh.rs");
    submission.replace("bvh.rs", "pub fn hit(&self", "pub fn hit(&self,");
    submission.write("bvh.rs", &format!("{correct}\nlet oops\n"));
    // The error from the first save may be shown before the error from the second one.
    let is_second = "/let oops/.test(document.querySelector('#errors pre')?.innerText)";
    wait(&mut tab, is_second);
    let heading = text(&mut tab, "#errors h3");
    let line = correct.lines().count() + 2;
    assert_eq!(heading, format!("bvh.rs:{line}"));
    assert!(text(&mut tab, "#errors pre").contains("let oops"));
    assert_eq!(property(&mut tab, "stage", "className"), "stale");

    submission.write("bvh.rs", &correct);
    wait(&mut tab, "document.getElementById('errors').hidden");
    wait(&mut tab, IS_COMPLETE);
    let is_fresh = "document.getElementById('stage').className === ''";
    wait(&mut tab, is_fresh);
    let after = viewer.wait_for_picture();
    assert_eq!(after["camera"], before["camera"]);
    assert_eq!(tab.errors(), [""; 0]);
    let here = format!("http://127.0.0.1:{}/", viewer.port);
    let requests = tab.requests();
    let are_here = requests.iter().all(|url| url.starts_with(&here));
    assert!(are_here, "{requests:?}");
}

#[test]
fn a_primitive_that_is_tested_twice_is_noted() {
    let submission = Submission::reference();
    submission.replace_traversal(
        "    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let all = || self.primitives.iter().map(|primitive| primitive.hit(ray));
        all().chain(all()).fold(None, Trace::nearer)
    }
",
    );
    let viewer = Viewer::start(&submission, "flat --size 16x16 --samples 1");
    let explanation = viewer.explain([8, 8], None);
    let ray = &explanation["rays"][0];
    let rows = ray["rows"].as_array().unwrap();
    assert!(rows.len() > 2 && rows.len().is_multiple_of(2), "{rows:?}");
    let (first, second) = rows.split_at(rows.len() / 2);
    assert!(first.iter().all(|row| row["again"] == false), "{first:?}");
    assert!(second.iter().all(|row| row["again"] == true), "{second:?}");
    let note = format!("{} tests repeat earlier ones", second.len());
    let notes = ray["notes"].to_string();
    assert!(notes.contains(&note), "{notes}");
    assert!(notes.contains("never called"), "{notes}");

    let Some(chromium) = Chromium::start() else {
        return;
    };
    let mut tab = open(&viewer, &chromium, DESKTOP);
    wait(&mut tab, HAS_TABLE);
    let noted = tab.eval(
        "[...document.querySelectorAll('#explanation tbody tr')]\
         .map((row) => row.innerText.includes('(again)'))",
    );
    let again: Vec<bool> = rows.iter().map(|row| row["again"] == true).collect();
    assert_eq!(noted, json!(again));
}

#[test]
fn the_mouse_names_nodes_and_the_picture_can_be_saved() {
    let arguments = "flat --size 64x48 --samples 1";
    let Some((_chromium, viewer, mut tab)) = start(&Submission::reference(), arguments) else {
        return;
    };
    wait_until_shown(&mut tab, "tree-content");
    // The highest row of the strip is the root.
    let names = "document.getElementById('node').innerText";
    let root = point_at("strip", 0.5, 0.01);
    let is_root = format!("{names}.startsWith('Node 0, level 0')");
    wait(&mut tab, &format!("{root} && {is_root}"));
    // The boxes of level 1 are drawn over the picture.
    let level = "document.getElementById('level')";
    run(
        &mut tab,
        &format!("{level}.value = 1; {level}.dispatchEvent(new Event('input'))"),
    );
    wait_for_text(&mut tab, "boxes-count", "box");
    let middle = point_at("lines", 0.5, 0.5);
    let is_below = format!("{names}.includes(', level 1: ')");
    wait(&mut tab, &format!("{middle} && {is_below}"));

    let saved = tab.eval(
        "(async () => { const image = new Image(); image.src = document.getElementById('save').href; \
         await image.decode(); const canvas = document.createElement('canvas'); \
         [canvas.width, canvas.height] = [image.width, image.height]; \
         const context = canvas.getContext('2d'); context.drawImage(image, 0, 0); \
         return [...context.getImageData(0, 0, image.width, image.height).data]; })()",
    );
    let saved: Vec<u8> = serde_json::from_value(saved).unwrap();
    let (pixels, _) = saved.as_chunks();
    let pixels = pixels.iter().map(|[r, g, b, _]| [*r, *g, *b]);
    assert!(pixels.eq(viewer.picture()), "another picture is saved");
    assert_eq!(property(&mut tab, "save", "download"), "flat.png");
    // If a command is refused, the page says why.
    let exposure = "document.getElementById('exposure')";
    let change = format!("{exposure}.dispatchEvent(new Event('change'))");
    run(&mut tab, &format!("{exposure}.value = 99; {change}"));
    wait_for_text(&mut tab, "refused", "out of range");
}

#[test]
fn two_windows_show_the_same_camera_and_pixel() {
    let arguments = "flat --size 32x24 --samples 1";
    let Some((chromium, viewer, mut first)) = start(&Submission::reference(), arguments) else {
        return;
    };
    click(&mut first, "[data-side=top]");
    run(
        &mut first,
        "document.getElementById('pick-sample').value = '1'",
    );
    explain(&mut first, &viewer, uvec2(20, 10));
    let mut second = open(&viewer, &chromium, DESKTOP);
    wait(&mut second, HAS_TABLE);
    for tab in [&mut first, &mut second] {
        assert!(text(tab, "#explanation h3").starts_with("Pixel (20, 10), path 2"));
        assert_eq!(property(tab, "pick-sample", "value"), "1");
    }
    focus(&mut second, "#stage");
    second.press("Enter", 13);
    first.bring_to_front();
    let title = "document.querySelector('#explanation h3').innerText";
    wait(&mut first, &format!("{title}.startsWith('Pixel (16, 1')"));
}

#[test]
fn ten_tabs_show_the_picture_and_notice_that_the_viewer_has_ended() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let viewer = Viewer::start(&Submission::reference(), "flat --size 16x12 --samples 1");
    let mut tabs: Vec<Tab> = (0..10).map(|_| open(&viewer, &chromium, DESKTOP)).collect();
    // A hidden tab waits until it is visible.
    for tab in &mut tabs {
        tab.bring_to_front();
        wait(tab, IS_COMPLETE);
        wait(tab, "document.getElementById('pixels').width === 16");
    }
    viewer.command(&json!({ "view": "depth" }));
    for tab in &mut tabs {
        tab.bring_to_front();
        wait(tab, "document.querySelector('[value=depth]').checked");
    }
    drop(viewer);
    for tab in &mut tabs {
        tab.bring_to_front();
        wait_until_shown(tab, "offline");
    }
}

#[test]
fn the_secret_leaves_the_address_and_stays_in_this_browser() {
    let arguments = "flat --size 16x12 --samples 1";
    let Some((chromium, viewer, mut tab)) = start(&Submission::reference(), arguments) else {
        return;
    };
    let address = format!("http://127.0.0.1:{}/", viewer.port);
    assert_eq!(tab.eval("location.href"), address);
    let other = Chromium::start().unwrap();
    let [mut again, mut tab] = [chromium.tab(), other.tab()];
    again.open_url(&address, DESKTOP);
    wait(&mut again, IS_COMPLETE);
    tab.open_url(&address, DESKTOP);
    let is_refused = format!("{TEXT}.includes('printed in the terminal')");
    wait(&mut tab, &is_refused);
}

#[test]
fn a_sample_in_the_history_of_a_pixel_leads_to_its_path() {
    let submission = Submission::reference();
    let arguments = "--size 32x32 --samples 5";
    let Some((_chromium, viewer, mut tab)) = start(&submission, arguments) else {
        return;
    };
    explain(&mut tab, &viewer, uvec2(16, 8));
    wait_until_shown(&mut tab, "history");
    let summary = text(&mut tab, "#history summary");
    let start = "Samples: mean of the first 5 samples 0.";
    assert!(summary.starts_with(start), "{summary}");
    click(&mut tab, "#history summary");
    let dots = tab.eval("document.querySelectorAll('#history svg circle').length");
    assert_eq!(dots, 5);
    focus(&mut tab, "[aria-label=\"Show path 3\"]");
    run(&mut tab, "document.activeElement.click()");
    let is_shown =
        "document.querySelector('#explanation h3')?.innerText === 'Pixel (16, 8), path 3'";
    wait(&mut tab, is_shown);
    let explanation = viewer.explanation();
    assert_eq!(explanation["sample"], 2);
    let marked = tab.eval("document.querySelector('#history [aria-current]').dataset.sample");
    assert_eq!(marked, "2");
    let focused = tab.eval("document.activeElement.ariaLabel");
    assert_eq!(focused, "Show path 3", "the focus has moved");
    let bounces = "[aria-label=\"The bounces of the path\"] tbody tr";
    let count = tab.eval(&format!("document.querySelectorAll('{bounces}').length"));
    assert_eq!(count, explanation["bounces"].as_array().unwrap().len());
    let first = text(&mut tab, bounces);
    assert!(first.starts_with("0\ta matte surface\t1\t"), "{first}");
}
