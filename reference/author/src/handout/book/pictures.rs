//! Inlines the figures into the pages, so that they follow the book's light or dark theme.

use std::path::Path;

use grader::files::{self, PathError};
use pulldown_cmark::{Event, Parser, Tag};

use crate::handout::pages::options;

/// Returns the chapter with its SVG figures inlined. Their files are in the folder `chapters`.
pub fn inline_figures(markdown: &str, chapters: &Path) -> Result<String, PathError> {
    let mut pictures = Vec::new();
    for (event, range) in Parser::new_ext(markdown, options()).into_offset_iter() {
        if let Event::Start(Tag::Image { dest_url, .. }) = event {
            pictures.push((range, dest_url.to_string()));
        }
    }
    let mut text = markdown.to_owned();
    for (range, file) in pictures.into_iter().rev() {
        if file.ends_with(".svg") {
            let svg = files::read_to_string(chapters.join(file))?;
            // Put the figure on one line, since an empty line would end the HTML block.
            let lines: Vec<&str> = svg.lines().map(str::trim).collect();
            text.replace_range(range, &format!("<figure>{}</figure>", lines.concat()));
        }
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::inline_figures;

    #[test]
    fn replaces_figures_by_their_drawings_and_keeps_other_pictures() {
        let chapters = tempfile::tempdir().unwrap();
        let svg = "<svg viewBox=\"0 0 1 1\">\n\n  <rect/>\n</svg>\n";
        std::fs::write(chapters.path().join("a.svg"), svg).unwrap();
        let text = inline_figures("![a](a.svg)\n\n![b](b.png)\n", chapters.path()).unwrap();
        assert_eq!(
            text,
            "<figure><svg viewBox=\"0 0 1 1\"><rect/></svg></figure>\n\n![b](b.png)\n"
        );
    }
}
