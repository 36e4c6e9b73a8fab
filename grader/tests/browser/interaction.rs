//! Interaction with the page: by mouse, by keyboard and with reduced motion.

use test_support::{Chromium, DESKTOP, Tab, Viewer};

use crate::pages;

const SLIDER: &str = "document.querySelector('#triangle\\\\.picture input[type=range]')";
const FLICKER: &str = "document.querySelector('#triangle\\\\.picture .flicker')";
const CLIP_PATH: &str =
    "document.querySelector('#triangle\\\\.picture .stage .got').style.clipPath";

/// Opens the page where all pictures are wrong, and unfolds all pictures.
fn open_noisy_page(chromium: &Chromium, reader: Viewer) -> Tab {
    let mut tab = chromium.tab();
    tab.load(&pages::NOISY, reader);
    tab.eval(
        "for (const picture of document.querySelectorAll('.picture')) {
            for (let up = picture.closest('details'); up; up = up.parentElement.closest('details')) {
                up.open = true;
            }
        } 0",
    );
    tab
}

/// Runs all checks in one browser.
#[test]
fn every_control_works_by_mouse_and_keyboard() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    for check in [
        the_keyboard_moves_the_slider_between_expected_and_submitted_picture,
        flicker_is_off_until_started_and_can_be_stopped,
        reduced_motion_swaps_by_click,
        a_wrong_pixel_is_marked_in_every_picture_with_a_replay_command,
        another_view_can_be_chosen,
        the_keyboard_reaches_and_opens_everything,
        a_watched_page_reloads_and_keeps_open_sections,
    ] {
        check(&chromium);
    }
}

fn the_keyboard_moves_the_slider_between_expected_and_submitted_picture(chromium: &Chromium) {
    let mut tab = open_noisy_page(chromium, DESKTOP);
    assert_eq!(tab.eval(CLIP_PATH), "inset(0px 50% 0px 0px)");
    tab.eval(&format!("{SLIDER}.focus()"));
    tab.press("ArrowRight", 39);
    assert_eq!(tab.eval(CLIP_PATH), "inset(0px 49% 0px 0px)");
    tab.press("End", 35);
    assert_eq!(tab.eval(CLIP_PATH), "inset(0px 0% 0px 0px)");
    tab.press("Home", 36);
    assert_eq!(tab.eval(CLIP_PATH), "inset(0px 100% 0px 0px)");
    assert_eq!(
        tab.eval(&format!("{SLIDER}.getAttribute('aria-valuetext')")),
        "0% yours"
    );
    assert_eq!(tab.errors(), [""; 0]);
}

fn flicker_is_off_until_started_and_can_be_stopped(chromium: &Chromium) {
    let mut tab = open_noisy_page(chromium, DESKTOP);
    let pressed = format!("{FLICKER}.getAttribute('aria-pressed')");
    assert_eq!(tab.eval(&pressed), "false");
    tab.eval(&format!("{FLICKER}.click()"));
    assert_eq!(tab.eval(&pressed), "true");
    // The picture changes twice without a click.
    let change = "new Promise((done) => {
        let left = 2;
        const seen = new MutationObserver(() => { left -= 1; if (!left) { seen.disconnect(); done(true); } });
        seen.observe(document.querySelector('#triangle\\\\.picture .stage .got'), { attributeFilter: ['style'] });
    })";
    assert_eq!(tab.eval(change), true);
    tab.eval(&format!("{FLICKER}.click()"));
    assert_eq!(tab.eval(&pressed), "false");
}

fn reduced_motion_swaps_by_click(chromium: &Chromium) {
    let reader = Viewer {
        reduced_motion: true,
        ..DESKTOP
    };
    let mut tab = open_noisy_page(chromium, reader);
    assert_eq!(tab.eval(&format!("{FLICKER}.textContent")), "Swap");
    tab.eval(&format!("{FLICKER}.click()"));
    assert_eq!(tab.eval(CLIP_PATH), "inset(0px 100% 0px 0px)");
    tab.eval(&format!("{FLICKER}.click()"));
    assert_eq!(tab.eval(CLIP_PATH), "inset(0px 0% 0px 0px)");
    assert_eq!(
        tab.eval(&format!("{FLICKER}.getAttribute('aria-pressed')")),
        "false"
    );
}

fn a_wrong_pixel_is_marked_in_every_picture_with_a_replay_command(chromium: &Chromium) {
    let mut tab = open_noisy_page(chromium, DESKTOP);
    let picture = "document.querySelector('#triangle\\\\.picture .picture')";
    assert_eq!(
        tab.eval(&format!("{picture}.querySelectorAll('.marks a').length")),
        5
    );
    // A click on a mark opens the details of the pixel, and rings appear in all pictures.
    let click = format!(
        "new Promise((done) => {{
            const spot = {picture}.querySelector('.spot');
            spot.addEventListener('toggle', () => setTimeout(() => done(spot.open)));
            {picture}.querySelector('.marks a').dispatchEvent(new MouseEvent('click', {{ bubbles: true, cancelable: true }}));
        }})"
    );
    assert_eq!(tab.eval(&click), true);
    let frames = tab.eval(&format!("{picture}.querySelectorAll('.frame').length"));
    assert_eq!(
        tab.eval(&format!("{picture}.querySelectorAll('.ring').length")),
        frames
    );
    let details = tab.eval(&format!("{picture}.querySelector('.spot').textContent"));
    let details = details.as_str().unwrap();
    for part in [
        "ray from (0, 0, 0) toward",
        "got",
        "wanted",
        "Run it again: cargo grade",
        "--replay triangle.picture#",
    ] {
        assert!(details.contains(part), "{details}");
    }
}

fn another_view_can_be_chosen(chromium: &Chromium) {
    let mut tab = open_noisy_page(chromium, DESKTOP);
    let alt = "document.querySelector('#triangle\\\\.picture .stage .wanted').alt";
    let first = tab.eval(alt);
    tab.eval("document.querySelector('#triangle\\\\.picture input[value=uv]').click()");
    assert_eq!(tab.eval(alt), "uv, expected");
    assert_ne!(first, "uv, expected");
    let rows = "[...document.querySelectorAll('#triangle\\\\.picture .row')].filter((row) => !row.hidden).length";
    assert_eq!(tab.eval(rows), 1);
}

fn the_keyboard_reaches_and_opens_everything(chromium: &Chromium) {
    let mut tab = open_noisy_page(chromium, DESKTOP);
    tab.press("Tab", 9);
    assert_eq!(tab.eval("document.activeElement.className"), "skip");
    tab.press("Enter", 13);
    assert_eq!(tab.eval("location.hash"), "#next");
    // The next Tab stop is the link to the item to fix. Following it opens that item.
    tab.press("Tab", 9);
    let href = tab.eval("document.activeElement.getAttribute('href')");
    let fold = format!(
        "document.getElementById({}.slice(1))",
        serde_json::to_string(&href).unwrap()
    );
    tab.eval(&format!("{fold}.open = false; 0"));
    tab.eval("globalThis.changed = new Promise((done) => addEventListener('hashchange', () => setTimeout(done))); 0");
    tab.press("Enter", 13);
    tab.eval("changed");
    assert_eq!(tab.eval(&format!("{fold}.open")), true);
    tab.eval(&format!("{fold}.querySelector('summary').focus()"));
    tab.press("Enter", 13);
    assert_eq!(tab.eval(&format!("{fold}.open")), false);
    let outline = "getComputedStyle(document.activeElement).outlineStyle";
    assert_eq!(tab.eval(outline), "solid");
}

fn a_watched_page_reloads_and_keeps_open_sections(chromium: &Chromium) {
    let text = std::fs::read_to_string(&*pages::NOISY).unwrap();
    let watched = text.replace("<body>", "<body data-reload>");
    let path = pages::NOISY.with_file_name("watched.html");
    std::fs::write(&path, &watched).unwrap();
    let mut tab = chromium.tab();
    tab.load(&path, DESKTOP);
    let [opened, folded] = ["bbox-passed", "triangle.inside"]
        .map(|id| format!("document.getElementById('{id}').open"));
    tab.eval(&format!("{opened} = true; {folded} = false; 0"));
    std::fs::write(&path, watched.replace("<h1>", "<h1>newer ")).unwrap();
    // Simulate a reader who is using the editor, so that the page doesn't have the focus.
    tab.eval("document.hasFocus = () => false; 0");
    tab.wait_until_loaded();
    let title = tab.eval("document.querySelector('h1').textContent");
    assert_eq!(title, "newer alice");
    assert_eq!(tab.eval(&opened), true);
    assert_eq!(tab.eval(&folded), false);
}
