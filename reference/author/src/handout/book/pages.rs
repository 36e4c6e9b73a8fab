//! Checks the pages that mdBook built: every anchor of the Markdown chapters exists, and no page
//! loads anything from the network.

use std::path::Path;

use grader::files::{self, PathError};
use judging::section::CHAPTERS;

use crate::handout::links::SUMMARY;
use crate::handout::pages::{Page, pages};

/// Returns the problems with the pages in the folder `book`, built from the workspace at `root`.
pub fn problems(root: &Path, book: &Path) -> Result<Vec<String>, PathError> {
    let mut problems = Vec::new();
    let chapters = pages(&root.join(CHAPTERS))?;
    for chapter in chapters.iter().filter(|chapter| chapter.name != SUMMARY) {
        let html = files::read_to_string(book.join(chapter.name.replace(".md", ".html")))?;
        problems.extend(page_problems(chapter, &html));
    }
    Ok(problems)
}

fn page_problems(chapter: &Page, html: &str) -> Vec<String> {
    let missing = chapter
        .anchors()
        .filter(|anchor| !html.contains(&format!("id=\"{anchor}\"")))
        .map(|anchor| format!("{}: the page has no #{anchor}", chapter.name));
    // Links to other sites are allowed, but nothing may be loaded from them.
    let fetched = ["src=\"http", "src=\"//", "url(http", "@import"]
        .into_iter()
        .chain(["rel=\"stylesheet\" href=\"http", "mathjax"])
        .filter(|fetch| html.contains(fetch))
        .map(|fetch| {
            format!(
                "{}: the page loads something from the network: {fetch}",
                chapter.name
            )
        });
    missing.chain(fetched).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_missing_headings_and_fetched_scripts() {
        let chapter = Page::new("a.md", "# One\n## Two\n");
        let good = "<h1 id=\"one\">One</h1><h2 id=\"two\">Two</h2><a href=\"https://x.org\">x</a>";
        assert_eq!(page_problems(&chapter, good), [""; 0]);
        let bad = "<h1 id=\"one\">One</h1><script src=\"https://x.org/x.js\"></script>";
        assert_eq!(
            page_problems(&chapter, bad),
            [
                "a.md: the page has no #two",
                "a.md: the page loads something from the network: src=\"http"
            ]
        );
    }
}
