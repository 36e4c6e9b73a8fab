//! Rendering of the page: at any width, in light and dark mode, in print and with hostile content.

use test_support::{Chromium, DESKTOP, Viewer};

use crate::pages::{self, OPEN_ALL};

const PHONE: Viewer = Viewer {
    width: 360,
    ..DESKTOP
};

/// Runs all checks in one browser.
#[test]
fn every_page_is_shown_as_it_should_be() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    for check in [
        no_page_logs_errors_sends_requests_or_runs_injected_scripts,
        detects_a_page_that_runs_an_injected_script,
        nothing_overflows_horizontally_on_a_phone,
        dark_mode_has_light_text_on_a_dark_background,
        printing_opens_everything_and_hides_buttons,
    ] {
        check(&chromium);
    }
}

fn no_page_logs_errors_sends_requests_or_runs_injected_scripts(chromium: &Chromium) {
    for page in pages::all() {
        let mut tab = chromium.tab();
        tab.load(page, DESKTOP);
        tab.eval(OPEN_ALL);
        assert_eq!(tab.errors(), [""; 0]);
        assert_eq!(tab.requests(), [""; 0]);
        let title = tab.eval("document.title");
        let title = title.as_str().unwrap();
        let parts = ["Path tracing: ", " of 100 points, alice"];
        assert!(
            title.starts_with(parts[0]) && title.ends_with(parts[1]),
            "{title}"
        );
    }
}

fn detects_a_page_that_runs_an_injected_script(chromium: &Chromium) {
    let page = std::fs::read_to_string(&*pages::STARTER).unwrap();
    let script =
        "<script>document.title = 'taken'</script><img src=\"https://example.org/x.png\"></main>";
    let path = pages::STARTER.with_file_name("taken.html");
    std::fs::write(&path, page.replace("</main>", script)).unwrap();
    let mut tab = chromium.tab();
    tab.load(&path, DESKTOP);
    // The content security policy blocks both the script and the image, and the console shows this.
    let errors = tab.errors().join("\n");
    assert!(
        errors.contains("script-src") && errors.contains("img-src"),
        "{errors}"
    );
    assert_ne!(tab.eval("document.title"), "taken");
    // If the policy is removed, the script runs.
    let open = page
        .replace("Content-Security-Policy", "x")
        .replace("</main>", script);
    std::fs::write(&path, open).unwrap();
    tab.load(&path, DESKTOP);
    assert_eq!(tab.eval("document.title"), "taken");
    assert_eq!(tab.requests(), ["https://example.org/x.png"]);
}

fn nothing_overflows_horizontally_on_a_phone(chromium: &Chromium) {
    for page in pages::all() {
        let mut tab = chromium.tab();
        tab.load(page, PHONE);
        tab.eval(OPEN_ALL);
        let wide = "[...document.querySelectorAll('body *')]
            .filter((element) => element.getBoundingClientRect().right > 361 && !element.closest('svg'))
            .map((element) => element.outerHTML.slice(0, 200))";
        assert_eq!(
            tab.eval("document.documentElement.scrollWidth"),
            360,
            "{}",
            tab.eval(wide)
        );
    }
}

fn dark_mode_has_light_text_on_a_dark_background(chromium: &Chromium) {
    let mut tab = chromium.tab();
    let mut brightness = |dark| {
        tab.load(&pages::STARTER, Viewer { dark, ..DESKTOP });
        ["backgroundColor", "color"].map(|what| {
            let colour =
                format!("getComputedStyle(document.body).{what}.match(/\\d+/g).map(Number)");
            tab.eval(&format!("{colour}.reduce((a, b) => a + b) / 3"))
                .as_f64()
                .unwrap()
        })
    };
    let [paper, ink] = brightness(false);
    assert!(paper > 200.0 && ink < 60.0, "{paper} {ink}");
    let [paper, ink] = brightness(true);
    assert!(paper < 60.0 && ink > 200.0, "{paper} {ink}");
}

fn printing_opens_everything_and_hides_buttons(chromium: &Chromium) {
    let mut tab = chromium.tab();
    tab.load(&pages::NOISY, DESKTOP);
    let shown = |what| {
        format!(
            "[...document.querySelectorAll('{what}')].filter((one) => one.checkVisibility()).length"
        )
    };
    let folded = shown("details:not([open])");
    assert_ne!(tab.eval(&shown("button")), 0);
    assert_ne!(tab.eval(&folded), 0);
    tab.emulate_print();
    tab.eval("dispatchEvent(new Event('beforeprint')); 0");
    assert_eq!(tab.eval(&shown("button")), 0);
    assert_eq!(tab.eval(&folded), 0);
    tab.eval("dispatchEvent(new Event('afterprint')); 0");
    assert_ne!(tab.eval(&folded), 0);
}

#[test]
fn every_page_is_below_two_megabytes() {
    for page in pages::all() {
        let size = std::fs::metadata(page).unwrap().len();
        assert!(size < 2_000_000, "{size} bytes");
    }
}
