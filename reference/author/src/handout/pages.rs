//! Reads chapters: their headings, links, formulas, code and commands.

use std::ops::Range;
use std::path::Path;

use grader::files::{self, PathError};
use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};

use super::files_below;

/// A piece of text from a chapter and its line number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snippet {
    /// The text of the snippet.
    pub text: String,
    /// The number of the text's first line, counted from 1.
    pub line: usize,
}

/// A chapter of the handout.
#[derive(Clone, Debug, Default)]
pub struct Page {
    /// The path relative to the chapters' folder, such as `boxes.md` or `light/glass.md`.
    pub name: String,
    /// The text of each heading.
    pub headings: Vec<Snippet>,
    /// The targets of links and pictures, relative to the chapter's folder.
    pub links: Vec<Snippet>,
    /// The inline code.
    pub inline_code: Vec<Snippet>,
    /// The commands in `sh` blocks, without their comments.
    pub commands: Vec<Snippet>,
    /// All other code blocks: pseudocode and program output.
    pub blocks: Vec<Snippet>,
    /// The formulas, each with its byte range, its LaTeX source, and whether it is a display
    /// formula.
    pub formulas: Vec<(Range<usize>, String, bool)>,
}

/// Returns the Markdown extensions that the handout uses. GitHub and mdBook also support them.
pub fn options() -> Options {
    Options::ENABLE_TABLES | Options::ENABLE_MATH
}

impl Page {
    /// Parses a chapter's Markdown.
    pub fn new(name: impl Into<String>, markdown: &str) -> Self {
        let mut page = Page {
            name: name.into(),
            ..Page::default()
        };
        let mut reader = Reader::default();
        for (event, range) in Parser::new_ext(markdown, options()).into_offset_iter() {
            let line = 1 + markdown[..range.start].matches('\n').count();
            reader.handle(event, range, line, &mut page);
        }
        page
    }

    /// Returns the anchors of the headings, as GitHub and mdBook generate them.
    pub fn anchors(&self) -> impl Iterator<Item = String> {
        self.headings.iter().map(|heading| anchor(&heading.text))
    }

    /// Returns the path of the file that a link in this chapter leads to, relative to the chapters'
    /// folder. A link that consists only of an anchor leads to the chapter itself.
    pub fn linked_file(&self, link: &str) -> String {
        let file = link.split('#').next().unwrap_or_default();
        if file.is_empty() {
            return self.name.clone();
        }
        let mut parts: Vec<&str> = self.name.split('/').collect();
        parts.pop();
        for part in file.split('/') {
            match (part, parts.last()) {
                // A link that leaves the chapters' folder keeps its dots, so that it matches no file.
                ("..", Some(last)) if *last != ".." => drop(parts.pop()),
                _ => parts.push(part),
            }
        }
        parts.join("/")
    }

    /// Returns a message about a snippet of this chapter. It begins with the file name and the line
    /// number.
    pub fn problem(&self, snippet: &Snippet, message: &str) -> String {
        format!("{}:{}: {message}", self.name, snippet.line)
    }
}

/// The parser's state: the currently open heading and code block, if any.
#[derive(Default)]
struct Reader {
    heading: Option<Snippet>,
    block: Option<(String, Snippet)>,
}

impl Reader {
    #[expect(
        clippy::wildcard_enum_match_arm,
        reason = "the enum belongs to the parser, and all other events are ignored"
    )]
    fn handle(&mut self, event: Event, range: Range<usize>, line: usize, page: &mut Page) {
        let snippet = |text: &str| Snippet {
            text: text.to_owned(),
            line,
        };
        match event {
            Event::Start(Tag::Heading { .. }) => self.heading = Some(snippet("")),
            Event::End(TagEnd::Heading(_)) => page.headings.extend(self.heading.take()),
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                page.links.push(snippet(&dest_url));
            }
            Event::Start(Tag::CodeBlock(kind)) => {
                let language = match kind {
                    CodeBlockKind::Fenced(language) => language.to_string(),
                    CodeBlockKind::Indented => String::new(),
                };
                // The text starts on the line after the fence.
                self.block = Some((language, snippet("")));
            }
            Event::End(TagEnd::CodeBlock) => {
                if let Some((language, block)) = self.block.take() {
                    page.end_block(&language, block, range);
                }
            }
            Event::InlineMath(text) => page.formulas.push((range, text.to_string(), false)),
            Event::DisplayMath(text) => page.formulas.push((range, text.to_string(), true)),
            Event::Code(text) => {
                page.inline_code.push(snippet(&text));
                if let Some(heading) = &mut self.heading {
                    heading.text.push_str(&text);
                }
            }
            Event::Text(text) => match (&mut self.heading, &mut self.block) {
                (Some(heading), _) => heading.text.push_str(&text),
                (None, Some((_, block))) => block.text.push_str(&text),
                (None, None) => {}
            },
            _ => {}
        }
    }
}

impl Page {
    fn end_block(&mut self, language: &str, block: Snippet, range: Range<usize>) {
        match language {
            "sh" => {
                let lines = (block.line + 1..).zip(block.text.lines());
                let commands = lines.map(|(line, text)| {
                    let text = text.split(" #").next().unwrap_or_default();
                    let text = text.trim().to_owned();
                    Snippet { text, line }
                });
                let commands = commands.filter(|command| !command.text.is_empty());
                self.commands.extend(commands);
            }
            "math" => self.formulas.push((range, block.text, true)),
            _ => self.blocks.push(block),
        }
    }
}

/// Returns a heading's anchor: lower case, with dashes for spaces, and without punctuation.
pub fn anchor(heading: &str) -> String {
    let letters = heading.trim().chars().filter_map(|letter| match letter {
        ' ' => Some('-'),
        '-' | '_' => Some(letter),
        _ if letter.is_alphanumeric() => Some(letter),
        _ => None,
    });
    letters.flat_map(char::to_lowercase).collect()
}

/// Reads all chapters in a folder and its subfolders, sorted by name.
pub fn pages(folder: &Path) -> Result<Vec<Page>, PathError> {
    let mut names = files_below(folder, folder)?;
    names.retain(|name| name.ends_with(".md"));
    names.sort();
    let pages = names.into_iter().map(|name| {
        let markdown = files::read_to_string(folder.join(&name))?;
        Ok(Page::new(name, &markdown))
    });
    pages.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHAPTER: &str = "# A chapter\n\nSee [there](b.md#zero), `Bvh::hit`.\n\n### Zero & minus zero\n\n```sh\ncargo grade   # all of it\n```\n\n$a_1$ and\n\n```math\nb \\\\ c\n```\n";

    #[test]
    fn reads_a_chapter_with_the_line_of_each_snippet() {
        let page = Page::new("a.md", CHAPTER);
        let snippet = |text: &str, line| Snippet {
            text: text.to_owned(),
            line,
        };
        assert_eq!(page.links, [snippet("b.md#zero", 3)]);
        assert_eq!(page.inline_code, [snippet("Bvh::hit", 3)]);
        assert_eq!(page.commands, [snippet("cargo grade", 8)]);
        let anchors: Vec<String> = page.anchors().collect();
        assert_eq!(anchors, ["a-chapter", "zero--minus-zero"]);
    }

    #[test]
    fn finds_inline_and_display_formulas() {
        let page = Page::new("a.md", CHAPTER);
        let found: Vec<(&str, bool)> = page
            .formulas
            .iter()
            .map(|(_, text, is_display)| (text.as_str(), *is_display))
            .collect();
        assert_eq!(found, [("a_1", false), ("b \\\\ c\n", true)]);
    }

    #[test]
    fn links_are_relative_to_the_chapters_folder() {
        let page = Page::new("light/a.md", "");
        for (link, file) in [
            ("b.md#zero", "light/b.md"),
            ("../b.md", "b.md"),
            ("../figures/a.svg", "figures/a.svg"),
            ("#zero", "light/a.md"),
            ("../../b.md", "../b.md"),
        ] {
            assert_eq!(page.linked_file(link), file);
        }
    }

    #[test]
    fn finds_chapters_in_subfolders() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("light")).unwrap();
        for name in ["b.md", "a.svg", "light/a.md"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let pages = pages(folder.path()).unwrap();
        let names: Vec<&str> = pages.iter().map(|page| page.name.as_str()).collect();
        assert_eq!(names, ["b.md", "light/a.md"]);
    }
}
