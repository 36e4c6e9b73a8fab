//! The handout as a built book, and links to its pages.

use std::path::{Component, Path, PathBuf};

use judging::section::{CHAPTERS, Section};

use crate::workspace::Workspace;

/// The folders that may contain a book, whether handed out or built by `cargo book`. The paths are
/// relative to the workspace.
const FOLDERS: [&str; 3] = ["handout/book", "target/handout", "target/students-handout"];

/// A folder with the pages of the built handout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Book {
    folder: PathBuf,
}

impl Book {
    /// Returns the book of a workspace, if any.
    pub fn find(workspace: &Workspace) -> Option<Self> {
        let folders = FOLDERS.map(|folder| workspace.root().join(folder));
        let mut folders = folders.into_iter();
        let folder = folders.find(|folder| folder.join("index.html").is_file())?;
        let folder = std::path::absolute(folder).ok()?;
        Some(Book { folder })
    }

    /// Returns the `file:` URL of a section, or `None` if the book doesn't contain its page.
    pub fn url(&self, section: &Section) -> Option<String> {
        let name = section.chapter().strip_suffix(".md")?;
        let page = self.folder.join(format!("{name}.html"));
        if !is_plain(name) || !page.is_file() {
            return None;
        }
        let url = file_url(&page);
        Some(match section.anchor() {
            "" => url,
            anchor => format!("{url}#{}", percent_encoded(anchor)),
        })
    }

    /// Returns the text with each mention of a section, such as `handout/src/boxes.md, "Flat
    /// boxes"`, turned into a hyperlink for terminals (the escape sequence OSC 8).
    pub fn with_links(&self, text: &str) -> String {
        let mut linked = String::new();
        let mut rest = text;
        let chapters = format!("{CHAPTERS}/");
        while let Some(start) = rest.find(&chapters) {
            let (before, mention) = rest.split_at(start);
            linked.push_str(before);
            let length = mention_length(mention, chapters.len());
            let (mention, after) = mention.split_at(length);
            match self.url(&mentioned_section(&mention[chapters.len()..])) {
                // The indentation of a second line isn't part of the link.
                Some(url) => {
                    let lines = mention.split('\n').map(|line| {
                        let words = line.trim_start();
                        let indentation = " ".repeat(line.len() - words.len());
                        format!("{indentation}\x1b]8;;{url}\x1b\\{words}\x1b]8;;\x1b\\")
                    });
                    linked.push_str(&lines.collect::<Vec<_>>().join("\n"));
                }
                None => linked.push_str(mention),
            }
            rest = after;
        }
        linked + rest
    }
}

/// Returns the length of the mention at the start of `text`. A mention of a section is a path,
/// optionally followed by a heading in quotation marks. There may be a line break before the
/// heading or in it.
fn mention_length(text: &str, path_start: usize) -> usize {
    let is_end = |c: char| !(c.is_ascii_alphanumeric() || "_-./".contains(c));
    let name = &text[path_start..];
    let name = &name[..name.find(is_end).unwrap_or(name.len())];
    let path_end = path_start + name.trim_end_matches('.').len();
    let after = &text[path_end..];
    let heading = after.strip_prefix(',').and_then(|heading| {
        let heading = heading.trim_start().strip_prefix('"')?;
        let end = after.len() - heading.len() + heading.find('"')? + 1;
        (after[..end].matches('\n').count() <= 1).then_some(end)
    });
    path_end + heading.unwrap_or(0)
}

/// Returns the section that a mention refers to, without the folder. This is the inverse of
/// [`Section::location`].
fn mentioned_section(mention: &str) -> Section {
    match mention.split_once(',') {
        Some((chapter, heading)) => {
            let heading = heading.trim().trim_matches('"').to_lowercase();
            let words: Vec<&str> = heading.split_whitespace().collect();
            Section::new(format!("{chapter}#{}", words.join("-")))
        }
        None => Section::new(mention),
    }
}

/// Returns whether a page's name cannot lead to a folder outside the book.
fn is_plain(name: &str) -> bool {
    let is_allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let mut parts = name.split('/');
    parts.all(|part| !part.is_empty() && part.chars().all(is_allowed))
}

/// Returns the URL of an absolute path. On Windows, a slash precedes the drive, as in
/// `file:///C:/`.
fn file_url(path: &Path) -> String {
    let mut url = "file://".to_owned();
    for part in path.components() {
        match part {
            Component::Prefix(prefix) => {
                let prefix = prefix.as_os_str().to_string_lossy();
                url.push('/');
                url.push_str(prefix.trim_start_matches(r"\\?\"));
            }
            Component::Normal(name) => {
                url.push('/');
                url.push_str(&percent_encoded(&name.to_string_lossy()));
            }
            Component::RootDir | Component::CurDir | Component::ParentDir => {}
        }
    }
    url
}

/// Percent-encodes all bytes except those that are unreserved in every part of a URL (RFC 3986,
/// 2.3).
pub fn percent_encoded(text: &str) -> String {
    let encoded = text.bytes().map(|byte| {
        let is_unreserved = byte.is_ascii_alphanumeric() || b"-._~".contains(&byte);
        if is_unreserved {
            char::from(byte).to_string()
        } else {
            format!("%{byte:02X}")
        }
    });
    encoded.collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn links_each_mention_of_a_page_that_exists_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let book = Book {
            folder: folder.path().join("my book"),
        };
        fs::create_dir_all(book.folder.join("light")).unwrap();
        fs::write(book.folder.join("light/glass.html"), "").unwrap();
        fs::write(book.folder.join("boxes.html"), "").unwrap();
        let url = file_url(&book.folder.join("boxes.html"));
        let is_encoded = url.starts_with("file:///") && url.ends_with("/my%20book/boxes.html");
        assert!(is_encoded, "{url}");
        let link = |url: &str, text: &str| format!("\x1b]8;;{url}\x1b\\{text}\x1b]8;;\x1b\\");

        let whole = "handout/src/boxes.md";
        let section = "handout/src/boxes.md, \"Zero and minus zero\"";
        let text = format!("read {section}\nsee {whole}.\n{whole}, \"cut\n");
        let expected = format!(
            "read {}\nsee {}.\n{}, \"cut\n",
            link(&format!("{url}#zero-and-minus-zero"), section),
            link(&url, whole),
            link(&url, whole),
        );
        assert_eq!(book.with_links(&text), expected);
        let wrapped =
            format!("read  {whole}, \"Zero and\n        minus zero\"\n{whole},\n  \"Zero\"");
        let anchor = format!("{url}#zero-and-minus-zero");
        let expected_wrapped = format!(
            "read  {}\n        {}\n{}\n  {}",
            link(&anchor, &format!("{whole}, \"Zero and")),
            link(&anchor, "minus zero\""),
            link(&format!("{url}#zero"), &format!("{whole},")),
            link(&format!("{url}#zero"), "\"Zero\""),
        );
        assert_eq!(book.with_links(&wrapped), expected_wrapped);
        let in_a_folder = "handout/src/light/glass.md";
        let glass = url.replace("boxes.html", "light/glass.html");
        assert_eq!(book.with_links(in_a_folder), link(&glass, in_a_folder));
        let others = "handout/src/none.md handout/src/../boxes.md handout/src/ boxes.md";
        assert_eq!(book.with_links(others), others);
        // Links aren't part of the text, so only the text is left if there is no terminal.
        let plain = anstream::adapter::strip_str(&expected).to_string();
        assert_eq!(plain, text);
    }
}
