//! The class's page in a browser: hints, sorting, and a narrow window.

use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::harness::{TestClass, assert_contains};

/// Keep these names in sync with `grader/tests/browser/chromium.rs`.
const BROWSERS: [&str; 5] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
];

/// Runs a script in a page that is as wide as a phone or a desktop, and returns the text that it
/// evaluates to. Returns `None` if there is no browser, unless `CI` is set.
fn evaluate(page: &Path, width: u32, script: &str) -> Option<String> {
    let text = fs::read_to_string(page).unwrap();
    // The policy would stop the test's script, and this test is not about the policy.
    let (before, policy) = text.split_once("<meta http-equiv").unwrap();
    let (_, after) = policy.split_once('>').unwrap();
    let result = format!(
        "<script>document.body.replaceChildren('RESULT:' + ({script}) + ':END')</script></body>"
    );
    let text = format!("{before}{after}").replace("</body>", &result);
    let copy = page.with_file_name("tested.html");
    fs::write(&copy, text).unwrap();
    let own = env::var("CHROME").ok();
    for browser in own.iter().map(String::as_str).chain(BROWSERS) {
        let output = Command::new(browser)
            .args([
                "--headless=new",
                "--no-sandbox",
                "--disable-gpu",
                "--dump-dom",
            ])
            .arg(format!("--window-size={width},900"))
            .arg(format!(
                "--user-data-dir={}",
                page.with_file_name("profile").display()
            ))
            .arg(format!("file://{}", copy.display()))
            .output();
        let Ok(output) = output else { continue };
        let dom = String::from_utf8_lossy(&output.stdout).into_owned();
        let (_, result) = dom
            .rsplit_once("RESULT:")
            .unwrap_or_else(|| panic!("{dom}"));
        return Some(result.split_once(":END").unwrap().0.to_owned());
    }
    assert!(
        env::var_os("CI").is_none(),
        "CI is set, but there is no Chromium"
    );
    eprintln!("SKIPPED: there is no Chromium, so the class's page was not tested in a browser");
    None
}

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

    let path = class.out().join("class.html");
    let overflow = "document.documentElement.scrollWidth - innerWidth";
    let who =
        "[...document.querySelectorAll('.sortable tbody th')].map((cell) => cell.textContent)";
    let click =
        |column: u32| format!("document.querySelectorAll('.sortable button')[{column}].click()");
    for width in [390, 1200] {
        let Some(overflow) = evaluate(&path, width, overflow) else {
            return;
        };
        assert_eq!(overflow.parse::<i32>().unwrap().max(0), 0, "{width}");
    }
    let by =
        |script: String| evaluate(&path, 1200, &format!("({script}, {who}.join('|'))")).unwrap();
    // Without points, dora is last in either order.
    assert_eq!(by(click(2)), format!("{long}|carl|Bob|dora"));
    assert_eq!(
        by(format!("{}, {}", click(2), click(2))),
        format!("Bob|carl|{long}|dora")
    );
    assert_eq!(by(click(0)), format!("Bob|carl|dora|{long}"));
}
