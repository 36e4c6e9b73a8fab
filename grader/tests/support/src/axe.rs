//! Accessibility, checked with axe-core: the rules of WCAG 2.2 AA that a program can check, and
//! best practices.

use crate::devtools::Tab;

/// axe-core 4.14.1 by Deque Systems (MPL-2.0), unchanged from its npm package.
const AXE: &str = include_str!("../../browser/axe/axe.min.js");

/// Opens all collapsed sections of the loaded page. Returns the violations found by axe-core.
pub fn violations(tab: &mut Tab) -> Vec<String> {
    tab.eval("for (const details of document.querySelectorAll('details')) details.open = true; 0");
    tab.eval(&format!("{AXE}; 0"));
    let violations = tab.eval(
        "axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] })
            .then((found) => found.violations.map((rule) =>
                `${rule.id}: ${rule.help}: ${rule.nodes.slice(0, 3).map((node) => node.html).join(' ')}`))",
    );
    serde_json::from_value(violations).unwrap()
}
