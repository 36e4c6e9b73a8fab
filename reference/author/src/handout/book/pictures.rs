//! Inlines the figures into the pages, so that they follow the book's light or dark theme.

use std::collections::BTreeMap;

use pulldown_cmark::{Event, Parser, Tag};

use crate::handout::figures;
use crate::handout::pages::options;

/// Returns the chapter with its figures as inline SVG.
pub fn inline_figures(markdown: &str) -> String {
    let drawn: BTreeMap<String, String> = figures::all()
        .map(|(name, svg)| (format!("figures/{name}"), svg))
        .collect();
    let mut pictures = Vec::new();
    for (event, range) in Parser::new_ext(markdown, options()).into_offset_iter() {
        if let Event::Start(Tag::Image { dest_url, .. }) = event {
            pictures.push((range, dest_url.to_string()));
        }
    }
    let mut text = markdown.to_owned();
    for (range, file) in pictures.into_iter().rev() {
        if let Some(svg) = drawn.get(&file) {
            // On one line, since an empty line would end the HTML block.
            let svg = svg.replace('\n', "");
            text.replace_range(range, &format!("<figure>{svg}</figure>"));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::inline_figures;

    #[test]
    fn replaces_figures_by_their_drawings_and_keeps_other_pictures() {
        let text = inline_figures("![a](figures/camera-side.svg)\n\n![b](b.png)\n");
        assert!(text.starts_with("<figure><svg "), "{text}");
        assert!(text.ends_with("</svg></figure>\n\n![b](b.png)\n"), "{text}");
    }
}
