//! Inserts a score's final points into a page. A course's policy can change after grading, so the
//! points are inserted into the finished page at a placeholder.

use std::collections::BTreeSet;
use std::path::Path;

use maud::{Markup, PreEscaped, html};

use super::elements::plain_text;
use super::steps::with_next_step;
use crate::machine::files::{self, PathError};
use crate::report::atomic_write;

/// The markers that enclose the placeholder for the text. No text from a submission can contain
/// them, since `<` is escaped.
const START: &str = "<!--counted-->";
const END: &str = "<!--/counted-->";

/// Renders the placeholder markers, with nothing between them.
pub(super) fn marks() -> Markup {
    PreEscaped(format!("{START}{END}"))
}

/// Returns a page with these sentences below its points, replacing any earlier sentences. A page
/// without the placeholder markers is returned unchanged.
pub fn with_counted(page: &str, texts: &[String]) -> String {
    let parts = page.split_once(START).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(END)?;
        Some((before, after))
    });
    let Some((before, after)) = parts else {
        return page.to_owned();
    };
    let paragraphs = html! {
        @for text in texts { p .total { strong { (plain_text(text)) } } }
    };
    format!("{before}{START}{}{END}{after}", paragraphs.into_string())
}

/// Returns a page that names the submission `to` instead of `from`.
pub fn with_name(page: &str, from: &str, to: &str) -> String {
    let [from, to] = [from, to].map(|name| html! { (plain_text(name)) }.into_string());
    let ends = [", %</title>", ">%</span></h1>"];
    ends.iter().fold(page.to_owned(), |page, end| {
        page.replacen(&end.replace('%', &from), &end.replace('%', &to), 1)
    })
}

/// Returns a page without the notes on files, which contain the names of folders and other files.
pub fn without_file_notes(page: &str) -> String {
    let notes = page.split_once("<h2 id=\"files\">").and_then(|(_, rest)| {
        let (section, _) = rest.split_once("</section>")?;
        section
            .find("<ul class=\"notes\">")
            .map(|start| &section[start..])
    });
    notes.map_or(page.to_owned(), |notes| {
        page.replacen(notes, "<p>Notes on other files are hidden.</p>", 1)
    })
}

/// Inserts the sentences into the finished page at this path, if the page exists, and [chooses its
/// next step](with_next_step).
pub fn write_counted(
    path: &Path,
    texts: &[String],
    failing: &BTreeSet<String>,
) -> Result<(), PathError> {
    let Some(page) = files::read_if_exists(path)? else {
        return Ok(());
    };
    let updated = with_next_step(&with_counted(&page, texts), failing);
    if updated == page {
        return Ok(());
    }
    atomic_write::write(&updated, path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(path: &Path, texts: &[String]) {
        write_counted(path, texts, &BTreeSet::new()).unwrap();
    }

    #[test]
    fn a_text_replaces_the_one_before_and_is_escaped() {
        let page = format!("<h1>ann</h1>{}<p>", marks().into_string());
        let late = with_counted(&page, &["45 of 50".to_owned()]);
        assert!(late.contains("45 of 50"));
        let again = with_counted(&late, &["<b>40</b> <!--/counted-->".to_owned()]);
        assert!(
            !again.contains("45 of 50") && !again.contains("<b>"),
            "{again}"
        );
        assert_eq!(with_counted(&again, &[]), page);
        assert_eq!(with_counted("no marks", &["1".to_owned()]), "no marks");
    }

    #[test]
    fn a_finished_page_is_updated_in_place() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("feedback.html");
        let page = format!("<h1>ann</h1>{}<p>", marks().into_string());
        std::fs::write(&path, &page).unwrap();
        let text = ["45 of 50".to_owned()];
        write(&path, &text);
        let read = || std::fs::read_to_string(&path).unwrap();
        assert_eq!(read(), with_counted(&page, &text));
        assert_ne!(read(), page);
        // Repeating the call must not change the page again.
        write(&path, &text);
        assert_eq!(read(), with_counted(&page, &text));
    }

    #[test]
    fn a_page_is_neither_created_nor_written_without_need() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("feedback.html");
        write(&path, &["45 of 50".to_owned()]);
        assert!(!path.exists());
        std::fs::write(&path, "no marks").unwrap();
        // Writing the page would replace the link with a file.
        let link = folder.path().join("link.html");
        std::fs::hard_link(&path, &link).unwrap();
        write(&path, &["45 of 50".to_owned()]);
        std::fs::write(&link, "the same file").unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "the same file");
    }
}
