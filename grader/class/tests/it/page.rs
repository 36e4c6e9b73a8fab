//! Tests of the class's page: root causes, failure rates and what needs attention. One test also
//! checks hints, sorting and a narrow window in a browser.

use test_support::{Chromium, DESKTOP, Viewer};

use crate::harness::{TestClass, assert_contains};

#[test]
fn the_page_renders_hints_sorts_submissions_and_fits_a_phone() {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_starter("bob")
        .with_offset_mistake("carl")
        .with_folder("dora");
    let long = "Maximiliane-Anastasia von und zu Hohenlohe-Waldenburg-Schillingsfürst";
    let roster =
        format!("name,username,datetime\n{long},ann,2026-11-22T12:00:00Z\nBob,bob,yesterday\n");
    let late = "[late]\ndue = 2026-11-20T23:59:59Z\npercent_per_day = 10\n";
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    class.graded_with(&exam, &[("roster", &roster), ("policy", late)], &[]);
    let page = class.read("class.html");
    let texts = [
        "no matter what <code>offset</code> is",
        "<th scope=\"row\">2 days late</th><td class=\"number\">1</td>",
        "or as 1 day late if the platform marks them as late: carl.",
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
    assert_eq!(by(&[2]), format!("{long} ann|carl|Bob bob|dora"));
    assert_eq!(by(&[2, 2]), format!("Bob bob|carl|{long} ann|dora"));
    assert_eq!(by(&[0]), format!("Bob bob|carl|dora|{long} ann"));
    assert_eq!(tab.errors(), Vec::<String>::new());
}

/// Returns the text of one section. Each row, item and heading is on a separate line.
pub fn section(page: &str, id: &str) -> String {
    let start = page
        .find(&format!("<section aria-labelledby=\"{id}\""))
        .unwrap();
    let (section, _) = page[start..].split_once("</section>").unwrap();
    let ends = ["tr", "li", "h2", "h3", "caption", "summary"];
    let lines = ends.iter().fold(section.to_owned(), |text, tag| {
        text.replace(&format!("</{tag}>"), "\n")
    });
    let cells = lines.replace("</th>", " | ").replace("</td>", " | ");
    let mut parts = cells.split('<');
    let first = parts.next().unwrap_or_default().to_owned();
    let text = parts.fold(first, |text, part| {
        text + part.split_once('>').map_or("", |(_, rest)| rest)
    });
    let lines = text.lines().map(|line| line.trim().trim_end_matches(" |"));
    lines
        .filter(|line| !line.is_empty())
        .collect::<Vec<_>>()
        .join("\n")
}

/// There are two mistakes, and one of them hides the other in Finn's submission. Neither is visible
/// in a picture, and Eve hasn't built a tree. One file doesn't compile, one submission can't be
/// graded, two people's names look alike, and Hana didn't hand in a file.
#[test]
fn the_page_shows_what_needs_attention_root_causes_and_failure_rates_by_section() {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_starter("eve")
        .with_replaced(
            "eve/bvh.rs",
            "let _ = max_leaf_size;",
            "let _ = 2 * max_leaf_size;",
        )
        .with_offset_mistake("bob")
        .with_offset_mistake("carl")
        .with_offset_mistake("finn")
        .with_replaced(
            "finn/sphere.rs",
            "uv: Sphere::uv(normal)",
            "uv: Sphere::uv(-normal)",
        )
        .with_replaced("carl/sphere.rs", "fn hit", "fn hit(")
        .with_folder("dora")
        .with_folder("gina")
        .with_reference("hana");
    std::fs::remove_file(class.input().join("hana/sphere.rs")).unwrap();
    let roster = "name,username,tutor\nAnn Lee,ann,Tess\nBob Kim,bob,Tess\n\
        B\u{43e}b Kim,carl,Uwe\nDora D,dora,Uwe\nEve E,eve,\nFinn F,finn,Uwe\nHana H,hana,Tess\n";
    let items = [
        "camera.offset",
        "camera.unit_length",
        "camera.picture",
        "build.leaf_size",
        "build.stops",
        "sphere.radius",
        "sphere.uv",
    ];
    let exam = class.small_exam(&items);
    // Items that depend on a failed item are not counted again.
    let text = std::fs::read_to_string(&exam).unwrap();
    let mut parsed: serde_json::Value = serde_json::from_str(&text).unwrap();
    let items = parsed["items"].as_array_mut().unwrap();
    let last = items.iter_mut().find(|item| item["id"] == "sphere.uv");
    last.unwrap()["needs"] = vec!["camera.offset"].into();
    std::fs::write(&exam, parsed.to_string()).unwrap();
    let text = class.graded_with(&exam, &[("roster", roster)], &[]);
    let page = class.read("class.html");
    let first = page.find("<section").unwrap();
    assert!(
        page[first..].starts_with("<section aria-labelledby=\"look\""),
        "{page}"
    );
    assert_contains(
        &page,
        &["<a href=\"students/eve/report.html\">eve (Eve E)</a>"],
    );
    let sections = ["look", "spread", "causes", "rates", "students"];
    let sections = sections.map(|id| section(&page, id)).join("\n\n");
    let start = text.find("submissions that need attention").unwrap();
    let (printed, _) = text[start..].split_once("\n\n  /").unwrap();
    insta::assert_snapshot!(format!("{sections}\n\nprinted:\n{printed}"));
}
