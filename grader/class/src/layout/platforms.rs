//! The layouts of all platforms, which are described in `platforms.toml`. [`super::reader`] uses
//! them to read classes.

use std::sync::LazyLock;

use serde::Deserialize;

use super::Layout;
use crate::file_tree::Node;

/// The name of the file that classroom50's tool writes next to the repositories. It contains a row
/// for each attempt by each student.
pub const CLASSROOM50_SCORES: &str = "scores.csv";
/// The name of a file that every classroom50 repository contains.
pub const CLASSROOM50_RESULT: &str = "result.json";
/// The suffix of the folder that GitHub Classroom's tool creates.
pub const SUBMISSIONS_SUFFIX: &str = "-submissions";
/// The folder in a Teams library that contains the submissions.
pub const TEAMS_SUBMITTED: &str = "Submitted files";
/// The folder next to [`TEAMS_SUBMITTED`], which contains drafts.
pub const TEAMS_DRAFTS: &str = "Working files";
/// The name of the archive that Sakai puts the assignment's folder in.
pub const SAKAI_ARCHIVE: &str = "bulk_download";

/// A platform's layout: how the names of files and folders identify a submission, its people and
/// its time. Names are described by [templates](super::template).
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Platform {
    /// The layout that this describes.
    pub layout: Layout,
    /// The name used in messages.
    pub description: String,
    /// Whether the names alone show that a folder has this layout.
    pub is_known_by_names: bool,
    /// Templates for the names of the folders between the class's folder and the submissions, one
    /// list for each level.
    pub outer_folders: Vec<Vec<String>>,
    /// Templates for the names of submitted files and folders. Names that differ only in the `file`
    /// field belong to the same submission. The first matching template is used.
    pub files: Vec<String>,
    /// The kind of file or folder that a submission consists of.
    pub submissions: NodeKind,
    /// Templates for the names of text files: either submitted texts or receipts that the platform
    /// writes.
    pub texts: Vec<String>,
    /// The reason for not grading a submission that contains texts but no files.
    pub text_only: String,
    /// The reason for not grading texts in addition to files, or `None` if every submission has a
    /// text.
    pub text_beside_files: Option<String>,
    /// The reason for listing a name as unmatched if it doesn't match any template.
    pub unmatched: String,
    /// Files that the platform writes in addition to the submissions.
    pub own_files: Vec<String>,
    /// The name of the platform's file that lists people, if there is one.
    pub list: Option<String>,
    /// Templates for the submission's id.
    pub ids: Vec<String>,
    /// Templates for the person's name.
    pub names: Vec<String>,
    /// Whether people's names come from file names. If so, names in lists are preferred.
    pub is_named_by_file: bool,
    /// Where the people and the time are taken from, if not from the name.
    pub record: Record,
    /// The field whose texts share a prefix, such as the assignment's title, and the separator that
    /// ends the prefix.
    pub prefixed: Option<(String, char)>,
    /// Whether file names contain attachment IDs, as in Canvas, where a page must be named after
    /// the last attachment.
    pub has_attachments: bool,
    /// The file name that the platform requires for a page, with the placeholders
    /// [`WHO`](crate::entry::WHO) and [`NUMBER`](crate::entry::NUMBER). `None` if any name is
    /// accepted.
    pub hand_back: Option<String>,
}

/// A kind of file or folder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NodeKind {
    /// Files and folders.
    #[default]
    Any,
    /// Only files.
    Files,
    /// Only folders.
    Folders,
    /// Folders, and files that are archives.
    FoldersAndArchives,
}

/// A source of people and times, written by the platform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Record {
    /// No source is needed, since the names contain everything.
    #[default]
    None,
    /// Gradescope's metadata file, which describes each folder.
    Metadata,
    /// Blackboard's text file for each attempt.
    Receipt,
    /// The files that Sakai writes into each folder, which contain the time and the members of a
    /// group.
    FilesInFolder,
}

impl NodeKind {
    /// Returns whether a file or folder is of this kind.
    pub fn includes(self, node: &Node) -> bool {
        match self {
            NodeKind::Any => true,
            NodeKind::Files => !node.is_folder(),
            NodeKind::Folders => node.is_folder(),
            NodeKind::FoldersAndArchives => node.is_folder() || node.is_archive(),
        }
    }
}

impl Platform {
    /// Returns the description of a layout.
    pub fn of(layout: Layout) -> &'static Platform {
        let mut all = Platform::all().iter();
        let platform = all.find(|platform| platform.layout == layout);
        platform.expect("every layout is described")
    }

    /// Returns the descriptions of all layouts.
    pub fn all() -> &'static [Platform] {
        &PLATFORMS.platform
    }
}

/// The contents of `platforms.toml`.
#[derive(Deserialize)]
struct Platforms {
    platform: Vec<Platform>,
}

static PLATFORMS: LazyLock<Platforms> =
    LazyLock::new(|| toml::from_str(include_str!("platforms.toml")).expect("the file is valid"));

#[cfg(test)]
mod tests {
    use clap::ValueEnum;

    use super::*;

    #[test]
    fn every_layout_is_described_once() {
        let described = Platform::all().iter().map(|platform| platform.layout);
        let mut described: Vec<String> = described.map(Layout::name).collect();
        let mut all: Vec<String> = Layout::value_variants().iter().map(|l| l.name()).collect();
        described.sort();
        all.sort();
        assert_eq!(described, all);
    }
}
