//! Accessibility, checked with axe-core: the rules of WCAG 2.2 AA that a program can check, and
//! best practices.

use test_support::{Chromium, DESKTOP, Viewer, violations};

use crate::pages;

#[test]
fn axe_finds_nothing_in_light_and_dark_mode() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    for page in pages::all() {
        for dark in [false, true] {
            let mut tab = chromium.tab();
            tab.load(page, Viewer { dark, ..DESKTOP });
            assert_eq!(violations(&mut tab), [""; 0], "dark: {dark}");
        }
    }
}

#[test]
fn axe_finds_the_problems_of_a_broken_page() {
    let Some(chromium) = Chromium::start() else {
        return;
    };
    let page = std::fs::read_to_string(&*pages::STARTER).unwrap();
    let broken = page
        .replace("<html lang=\"en\">", "<html>")
        .replace("<body>", "<body><img src=\"data:,\"><a href=\"#next\"></a>");
    let path = pages::STARTER.with_file_name("broken.html");
    std::fs::write(&path, broken).unwrap();
    let mut tab = chromium.tab();
    tab.load(&path, DESKTOP);
    let found = violations(&mut tab);
    for rule in ["html-has-lang", "image-alt", "link-name"] {
        assert!(found.iter().any(|text| text.starts_with(rule)), "{found:?}");
    }
}
