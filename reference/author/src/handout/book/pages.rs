//! The pages that mdBook builds. Figures are inlined, so that they follow the light or dark theme.
//! A page must have every anchor of its Markdown chapter, and must not load anything from the
//! network.

use std::path::Path;

use grader::files::{self, PathError};
use judging::section::CHAPTERS;
use pulldown_cmark::{Event, Parser, Tag};

use crate::handout::links::SUMMARY;
use crate::handout::pages::{Page, options, pages};

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
        .map(|anchor| format!("{}: the page has no anchor #{anchor}", chapter.name));
    // Links to other sites are allowed, but nothing may be loaded from them.
    let fetched = ["src=\"http", "src=\"//", "url(http", "@import"]
        .into_iter()
        .chain(["rel=\"stylesheet\" href=\"http", "mathjax"])
        .filter(|fetch| html.contains(fetch))
        .map(|fetch| {
            format!(
                "{}: the page loads a resource from the network: {fetch}",
                chapter.name
            )
        });
    missing.chain(fetched).collect()
}

/// Returns the chapter with its SVG figures inlined. Their paths are relative to the folder of the
/// chapter's file.
pub fn inline_figures(markdown: &str, chapter: &Path) -> Result<String, PathError> {
    let mut pictures = Vec::new();
    for (event, range) in Parser::new_ext(markdown, options()).into_offset_iter() {
        if let Event::Start(Tag::Image { dest_url, .. }) = event {
            pictures.push((range, dest_url.to_string()));
        }
    }
    let mut text = markdown.to_owned();
    for (range, file) in pictures.into_iter().rev() {
        if file.ends_with(".svg") {
            let svg = files::read_to_string(chapter.with_file_name(file))?;
            // Put the figure on one line, since an empty line would end the HTML block.
            let lines: Vec<&str> = svg.lines().map(str::trim).collect();
            text.replace_range(range, &format!("<figure>{}</figure>", lines.concat()));
        }
    }
    Ok(text)
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
                "a.md: the page has no anchor #two",
                "a.md: the page loads a resource from the network: src=\"http"
            ]
        );
    }

    #[test]
    fn replaces_figures_by_their_drawings_and_keeps_other_pictures() {
        let chapters = tempfile::tempdir().unwrap();
        std::fs::create_dir(chapters.path().join("light")).unwrap();
        let svg = "<svg viewBox=\"0 0 1 1\">\n\n  <rect/>\n</svg>\n";
        std::fs::write(chapters.path().join("a.svg"), svg).unwrap();
        for (chapter, file) in [("c.md", "a.svg"), ("light/c.md", "../a.svg")] {
            let markdown = format!("![a]({file})\n\n![b](b.png)\n");
            let text = inline_figures(&markdown, &chapters.path().join(chapter)).unwrap();
            assert_eq!(
                text,
                "<figure><svg viewBox=\"0 0 1 1\"><rect/></svg></figure>\n\n![b](b.png)\n"
            );
        }
    }
}
