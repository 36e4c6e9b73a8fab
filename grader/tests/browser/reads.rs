//! The page as it is read: at any width, by day and night, on paper, whoever wrote it.

use crate::chromium::Chromium;
use crate::devtools::{DESK, Reader};
use crate::pages;

const PHONE: Reader = Reader { width: 360, ..DESK };
const UNFOLD: &str =
    "for (const details of document.querySelectorAll('details')) details.open = true; 0";

#[test]
fn no_page_complains_asks_for_anything_or_is_taken_over() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    for page in pages::all() {
        let mut tab = chromium.tab();
        tab.load(page, DESK);
        tab.eval(UNFOLD);
        assert_eq!(tab.errors(), [""; 0]);
        assert_eq!(tab.requests(), [""; 0]);
        let title = tab.eval("document.title");
        assert!(title.as_str().unwrap().starts_with("alice: "), "{title}");
    }
}

#[test]
fn a_page_that_runs_what_it_should_not_is_noticed() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let page = std::fs::read_to_string(&*pages::STARTER).unwrap();
    let script =
        "<script>document.title = 'taken'</script><img src=\"https://example.org/x.png\"></main>";
    let place = pages::STARTER.with_file_name("taken.html");
    std::fs::write(&place, page.replace("</main>", script)).unwrap();
    let mut tab = chromium.tab();
    tab.load(&place, DESK);
    // The policy lets neither through, and says so.
    let errors = tab.errors().join("\n");
    assert!(
        errors.contains("script-src") && errors.contains("img-src"),
        "{errors}"
    );
    assert_ne!(tab.eval("document.title"), "taken");
    // Without the policy it would be.
    let open = page
        .replace("Content-Security-Policy", "x")
        .replace("</main>", script);
    std::fs::write(&place, open).unwrap();
    tab.load(&place, DESK);
    assert_eq!(tab.eval("document.title"), "taken");
    assert_eq!(tab.requests(), ["https://example.org/x.png"]);
}

#[test]
fn nothing_sticks_out_sideways_on_a_phone() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    for page in pages::all() {
        let mut tab = chromium.tab();
        tab.load(page, PHONE);
        tab.eval(UNFOLD);
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

#[test]
fn by_night_the_paper_is_dark_and_the_ink_is_light() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let mut tab = chromium.tab();
    let mut brightness = |dark| {
        tab.load(&pages::STARTER, Reader { dark, ..DESK });
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

#[test]
fn on_paper_all_is_unfolded_and_there_is_nothing_to_press() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let mut tab = chromium.tab();
    tab.load(&pages::NOISY, DESK);
    let shown = |what| {
        format!(
            "[...document.querySelectorAll('{what}')].filter((one) => one.checkVisibility()).length"
        )
    };
    let folded = shown("details:not([open])");
    assert_ne!(tab.eval(&shown("button")), 0);
    assert_ne!(tab.eval(&folded), 0);
    tab.print();
    tab.eval("dispatchEvent(new Event('beforeprint')); 0");
    assert_eq!(tab.eval(&shown("button")), 0);
    assert_eq!(tab.eval(&folded), 0);
    tab.eval("dispatchEvent(new Event('afterprint')); 0");
    assert_ne!(tab.eval(&folded), 0);
}

#[test]
fn the_largest_page_is_below_two_megabytes() {
    for page in pages::all() {
        let size = std::fs::metadata(page).unwrap().len();
        assert!(size < 2_000_000, "{size} bytes");
    }
}
