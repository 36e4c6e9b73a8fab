//! Puts the points that a score counts towards the grade into a page. A course's policy can change
//! after grading, so they are put into a finished page, at a mark that the page has for them.

use maud::{Markup, PreEscaped, html};

use super::elements::plain_text;

/// The marks around the text. No text of a submission can contain them, since `<` is escaped.
const START: &str = "<!--counted-->";
const END: &str = "<!--/counted-->";

/// Renders the marks, with nothing between them.
pub(super) fn marks() -> Markup {
    PreEscaped(format!("{START}{END}"))
}

/// Returns a page with this text below its points, in place of an earlier one. A page without the
/// marks is returned unchanged.
pub fn with_counted(page: &str, text: Option<&str>) -> String {
    let parts = page.split_once(START).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(END)?;
        Some((before, after))
    });
    let Some((before, after)) = parts else {
        return page.to_owned();
    };
    let paragraph = html! {
        @if let Some(text) = text { p .total { strong { (plain_text(text)) } } }
    };
    format!("{before}{START}{}{END}{after}", paragraph.into_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_replaces_the_one_before_and_is_escaped() {
        let page = format!("<h1>ann</h1>{}<p>", marks().into_string());
        let late = with_counted(&page, Some("45 of 50"));
        assert!(late.contains("45 of 50"));
        let again = with_counted(&late, Some("<b>40</b> <!--/counted-->"));
        assert!(
            !again.contains("45 of 50") && !again.contains("<b>"),
            "{again}"
        );
        assert_eq!(with_counted(&again, None), page);
        assert_eq!(with_counted("no marks", Some("1")), "no marks");
    }
}
