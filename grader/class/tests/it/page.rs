//! The class's page in a browser: hints, sorting, and a narrow window.

use test_support::{Chromium, DESKTOP, Viewer};

use crate::harness::{TestClass, assert_contains};

#[test]
fn the_page_renders_hints_sorts_submissions_and_fits_a_phone() {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_starter("bob")
        .with_reference("carl")
        .with_replaced(
            "carl/camera.rs",
            "pixel.as_vec2() + offset",
            "pixel.as_vec2() + 0.5",
        )
        .with_folder("dora");
    let long = "Maximiliane-Anastasia von und zu Hohenlohe-Waldenburg-Schillingsfürst";
    let roster =
        format!("name,username,datetime\n{long},ann,2026-11-22T12:00:00Z\nBob,bob,yesterday\n");
    let late = "[late]\ndue = 2026-11-20T23:59:59Z\npercent_per_day = 10\n";
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    class.graded_with(&exam, &[("roster", &roster), ("policy", late)], &[]);
    let page = class.read("class.html");
    let texts = [
        "whatever <code>offset</code> is",
        "<th scope=\"row\">2 days late</th><td class=\"number\">1</td>",
        "Counted as on time, since the time is unknown: carl.",
    ];
    assert_contains(&page, &texts);

    let Some(chromium) = Chromium::start() else {
        return;
    };
    let path = class.out().join("class.html");
    let mut tab = chromium.tab();
    for width in [390, 1200] {
        tab.load(&path, Viewer { width, ..DESKTOP });
        let overflow = tab.eval("document.documentElement.scrollWidth - innerWidth");
        assert!(overflow.as_f64() <= Some(0.0), "{width}: {overflow}");
    }
    let who =
        "[...document.querySelectorAll('.sortable tbody th')].map((cell) => cell.textContent)";
    let mut by = |columns: &[u32]| {
        tab.load(&path, DESKTOP);
        for column in columns {
            let button = format!("document.querySelectorAll('.sortable button')[{column}]");
            tab.eval(&format!("{button}.click()"));
        }
        tab.eval(&format!("{who}.join('|')"))
    };
    // Dora has no points, so she is last in either order.
    assert_eq!(by(&[2]), format!("{long}|carl|Bob|dora"));
    assert_eq!(by(&[2, 2]), format!("Bob|carl|{long}|dora"));
    assert_eq!(by(&[0]), format!("Bob|carl|dora|{long}"));
    assert_eq!(tab.errors(), Vec::<String>::new());
}
