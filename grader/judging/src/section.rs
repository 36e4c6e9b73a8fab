//! Places in the handout, such as `boxes.md#zero-and-minus-zero`: the chapter's file and the
//! anchor of a heading in it, as GitHub and mdBook both name it.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Where the chapters stand, from the workspace's root.
pub const CHAPTERS: &str = "handout/src";

/// A section of the handout.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Section(String);

impl Section {
    /// The section that `place` names: `boxes.md#zero-and-minus-zero`.
    pub fn new(place: impl Into<String>) -> Self {
        Section(place.into())
    }

    /// The whole chapter.
    pub fn whole_chapter(&self) -> Section {
        Section::new(self.chapter())
    }

    /// The chapter's file: `boxes.md`.
    pub fn chapter(&self) -> &str {
        self.0.split_once('#').map_or(&self.0, |(file, _)| file)
    }

    /// The heading's anchor: `zero-and-minus-zero`. Empty for a whole chapter.
    pub fn anchor(&self) -> &str {
        self.0.split_once('#').map_or("", |(_, anchor)| anchor)
    }

    /// The heading as it reads: `Zero and minus zero`. An anchor has lost punctuation and capitals,
    /// so only headings of plain words with one capital are sections; a test sees to it.
    pub fn heading(&self) -> String {
        let mut words = self.anchor().replace('-', " ");
        if let Some(first) = words.get_mut(..1) {
            first.make_ascii_uppercase();
        }
        words
    }

    /// What to open and what to look for: `handout/src/boxes.md, "Zero and minus zero"`.
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
    }

    #[test]
    fn location_of_a_whole_chapter_is_its_file() {
        assert_eq!(Section::new("start.md").location(), "handout/src/start.md");
    }
}
