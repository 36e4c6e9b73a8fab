//! References to sections of the handout, such as `boxes.md#zero-and-minus-zero`: a chapter's file
//! and the anchor of a heading, as both GitHub and mdBook generate it.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Folder of the chapters, relative to the workspace root.
pub const CHAPTERS: &str = "handout/src";

/// A section of the handout.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Section(String);

impl Section {
    /// Creates a reference from text such as `boxes.md#zero-and-minus-zero`.
    pub fn new(section: impl Into<String>) -> Self {
        Section(section.into())
    }

    /// Returns a reference to the whole chapter.
    pub fn whole_chapter(&self) -> Section {
        Section::new(self.chapter())
    }

    /// Returns the chapter's file, such as `boxes.md`.
    pub fn chapter(&self) -> &str {
        self.0.split_once('#').map_or(&self.0, |(file, _)| file)
    }

    /// Returns the heading's anchor, such as `zero-and-minus-zero`. It is empty for a whole
    /// chapter.
    pub fn anchor(&self) -> &str {
        self.0.split_once('#').map_or("", |(_, anchor)| anchor)
    }

    /// Returns the heading's text, such as `Zero and minus zero`. Anchors don't preserve
    /// punctuation or capitals, so this only works for headings that consist of plain words and
    /// capitalise only the first letter. A test ensures that only such headings are referenced.
    pub fn heading(&self) -> String {
        let mut heading = self.anchor().replace('-', " ");
        if let Some(first) = heading.get_mut(..1) {
            first.make_ascii_uppercase();
        }
        heading
    }

    /// Returns the file to open and the heading to find, such as `handout/src/boxes.md, "Zero and
    /// minus zero"`.
    pub fn location(&self) -> String {
        let chapter = self.chapter();
        match self.anchor() {
            "" => format!("{CHAPTERS}/{chapter}"),
            _ => format!("{CHAPTERS}/{chapter}, \"{}\"", self.heading()),
        }
    }
}

impl fmt::Display for Section {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::Section;

    #[test]
    fn location_names_file_and_heading() {
        let section = Section::new("boxes.md#zero-and-minus-zero");
        assert_eq!(
            section.location(),
            "handout/src/boxes.md, \"Zero and minus zero\""
        );
        assert_eq!(section.to_string(), "boxes.md#zero-and-minus-zero");
    }

    #[test]
    fn location_of_a_whole_chapter_is_its_file() {
        assert_eq!(Section::new("start.md").location(), "handout/src/start.md");
    }
}
