//! The layouts of all platforms, as data. [`super::reader`] reads them.

use super::Layout;
use super::gradescope::METADATA;
use crate::listing::Node;

/// The name of the file that classroom50's tool writes next to the repositories. It contains a row
/// for each attempt of each student.
pub const CLASSROOM50_SCORES: &str = "scores.csv";
/// The name of a file that every repository of classroom50 contains.
pub const CLASSROOM50_RESULT: &str = "result.json";
/// The suffix of the folder that GitHub Classroom's tool creates.
pub const SUBMISSIONS_SUFFIX: &str = "-submissions";
/// The folder of a Teams library with the submissions.
pub const TEAMS_SUBMITTED: &str = "Submitted files";
/// The folder next to it, with drafts.
pub const TEAMS_DRAFTS: &str = "Working files";
/// The name of the archive that Sakai puts the assignment's folder in.
pub const SAKAI_ARCHIVE: &str = "bulk_download";

const TEXT_BESIDE_FILES: &str = "text; the files handed in with it are graded";

/// A platform's layout: how the names of files and folders identify a submission, its people and its
/// time. Names are described by [templates](super::template).
#[derive(Debug)]
pub struct Platform {
    /// The layout that this describes.
    pub layout: Layout,
    /// The name for messages.
    pub description: &'static str,
    /// For each level of folders between the class's folder and the submissions, templates of their
    /// names.
    pub outer_folders: &'static [&'static [&'static str]],
    /// Templates of the names of submitted files and folders. Names that only differ in the file belong to
    /// the same submission. The first template that fits is used.
    pub files: &'static [&'static str],
    /// Whether a file or folder can be a submission or one of its files.
    pub is_submission: fn(&Node) -> bool,
    /// Templates of the names of texts: either submitted ones or receipts that the platform writes.
    pub texts: &'static [&'static str],
    /// The reason for not grading a submission with texts but without files.
    pub text_only: &'static str,
    /// The reason for not grading texts in addition to files, or `None` if every submission has a
    /// text.
    pub text_beside_files: Option<&'static str>,
    /// The reason for listing a name that doesn't follow any template.
    pub unmatched: &'static str,
    /// Files that the platform writes in addition to the submissions.
    pub own_files: &'static [&'static str],
    /// Templates of the submission's id.
    pub ids: &'static [&'static str],
    /// Templates of the person's name.
    pub names: &'static [&'static str],
    /// Whether people's names come from file names. If so, names in lists are preferred.
    pub is_named_by_file: bool,
    /// The source of the people and the time, if not the name.
    pub record: Record,
    /// The field that begins with the same text in all names, such as the assignment's title, and the
    /// separator that ends this text.
    pub prefixed: Option<(&'static str, char)>,
    /// The file name that the platform requires for a page.
    pub hand_back: HandBackName,
}

/// A source of people and times, written by the platform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Record {
    /// Names contain everything.
    None,
    /// Gradescope's metadata file, which describes each folder.
    Metadata,
    /// Blackboard's text file for each attempt.
    Receipt,
    /// Sakai's files in each folder, with the time and the members of a group.
    FilesInFolder,
}

/// The file name that a platform requires for the page of a submission's people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HandBackName {
    /// Any name is accepted.
    None,
    /// A name with the placeholders [`WHO`](crate::entry::WHO) and
    /// [`NUMBER`](crate::entry::NUMBER).
    Marks(&'static str),
    /// The name of the last attachment.
    Attachment,
}

impl Platform {
    /// Returns the description of a layout.
    pub fn of(layout: Layout) -> &'static Platform {
        let mut platforms = PLATFORMS.iter();
        let platform = platforms.find(|platform| platform.layout == layout);
        platform.expect("every layout is described")
    }

    /// Returns whether names contain the numbers of attachments, as in Canvas.
    pub fn has_attachments(&self) -> bool {
        self.hand_back == HandBackName::Attachment
    }
}

/// The layout that others are variations of: a folder for each submission, named after its person.
const FOLDERS: Platform = Platform {
    layout: Layout::Plain,
    description: "folders and archives, one per student",
    outer_folders: &[],
    files: &["{name}"],
    is_submission: |node| node.is_folder() || node.is_archive(),
    texts: &[],
    text_only: "text was handed in, but no file",
    text_beside_files: Some(TEXT_BESIDE_FILES),
    unmatched: "neither a folder nor an archive",
    own_files: &[],
    ids: &["{name}"],
    names: &["{name}"],
    is_named_by_file: true,
    record: Record::None,
    prefixed: None,
    hand_back: HandBackName::None,
};

/// All layouts.
pub static PLATFORMS: [Platform; 10] = [
    // "Export submissions": `submission_123` and `submission_metadata.yml`.
    Platform {
        layout: Layout::Gradescope,
        description: "a Gradescope export",
        files: &["{submission}"],
        is_submission: |_| true,
        unmatched: "it is not in submission_metadata.yml",
        own_files: &[METADATA],
        ids: &["{submission}"],
        names: &["{submission}"],
        record: Record::Metadata,
        ..FOLDERS
    },
    // "Download submissions": `doejane_LATE_7001_9001_camera.rs`, with the student's sortable name without
    // punctuation, the numbers of the user and the attachment, and the student's file name. If the file
    // is handed in again, Canvas appends `-1`, `-2`, … to its name.
    Platform {
        layout: Layout::Canvas,
        description: "a Canvas download",
        files: &[
            "[{late}_]anon_{anonymous}_{attachment}_{file}",
            "{canvas_name}[_{late}]_{number}_{attachment}_{file}",
        ],
        is_submission: |node| !node.is_folder(),
        texts: &[
            "[{late}_]anon_{anonymous}_text.html",
            "[{late}_]anon_{anonymous}_link.html",
            "{canvas_name}[_{late}]_{number}_text.html",
            "{canvas_name}[_{late}]_{number}_link.html",
        ],
        text_only: "text or a link was handed in, but no file",
        text_beside_files: Some("text or a link; the files handed in with it are graded"),
        unmatched: "its name is not in Canvas's format",
        ids: &["anon_{anonymous}", "{canvas_name}_{number}"],
        names: &["anon {anonymous}", "{canvas_name}"],
        hand_back: HandBackName::Attachment,
        ..FOLDERS
    },
    // "Download all submissions": `Jane Doe_123_assignsubmission_file_`, a folder or the beginning of a
    // file's name. The number identifies the participant, as in the grading worksheet, or a group if
    // groups hand in together. Only a list can tell which one it is, by the name. People without a
    // group don't have a number. With blind marking, the name is `Participant`.
    Platform {
        layout: Layout::Moodle,
        description: "a Moodle download",
        files: &[
            "Participant_{participant}_assignsubmission_file[_{file}]",
            "{name}[_{number}]_assignsubmission_file[_{file}]",
        ],
        is_submission: |_| true,
        texts: &[
            "Participant_{participant}_assignsubmission_{kind}[_{file}]",
            "{name}[_{number}]_assignsubmission_{kind}[_{file}]",
        ],
        unmatched: "its name is not in Moodle's format",
        // With the number, the id stays the same even if a namesake hands something in.
        ids: &["Participant_{participant}", "{name}[_{number}]"],
        names: &["Participant {participant}", "{name}"],
        is_named_by_file: false,
        hand_back: HandBackName::Marks("{who}_{number}_assignfeedback_file_feedback.html"),
        ..FOLDERS
    },
    // "Assignment file download": `Path tracer_jdoe_attempt_2026-11-20-23-34-05_camera.rs`, and for each
    // attempt a text file without a student's file name, with the account in its first line.
    Platform {
        layout: Layout::Blackboard,
        description: "a Blackboard download",
        files: &["{account}_attempt_{time}[_{file}]"],
        is_submission: |node| !node.is_folder(),
        texts: &["{account}_attempt_{time}.txt"],
        text_beside_files: None,
        unmatched: "its name is not in Blackboard's format",
        ids: &["{account}_{time}"],
        names: &[],
        is_named_by_file: false,
        record: Record::Receipt,
        prefixed: Some(("account", '_')),
        ..FOLDERS
    },
    // "Download all files": `104840-170649 - Jane Doe - Nov 20, 2026 1134 PM` for each attempt, with the
    // numbers of the user and the assignment.
    Platform {
        layout: Layout::Brightspace,
        description: "a Brightspace download",
        files: &["{number}-{folder} - {name} - {time}[ - {file}]"],
        is_submission: |_| true,
        unmatched: "its name is not in Brightspace's format",
        own_files: &["index.html"],
        ids: &["{name}_{number}_{time}"],
        ..FOLDERS
    },
    // "Download all" (`zipSubmissions` and `zipGroupSubmissions` in Sakai's `AssignmentServiceImpl`):
    // `Doe, Jane(jdoe)`, `Team A (UUID)` or, if names are hidden, a UUID and a word in the site's language.
    // Without folders, these are the beginnings of files' names.
    Platform {
        layout: Layout::Sakai,
        description: "a Sakai download",
        files: &[
            "{members}_Submission attachment(s)_{file}",
            "{members}",
            "{name} ({uuid})",
            "{uuid} {word}",
        ],
        is_submission: |_| true,
        texts: &[
            "{members}_submissionText.html",
            "{members}_feedbackText.html",
            "{members}_comments.txt",
        ],
        unmatched: "its name is not in Sakai's format",
        own_files: &["grades.csv", "grades.xls", "grades.xlsx"],
        ids: &["{members}", "{name}", "{uuid}"],
        names: &["{name}", "{uuid}"],
        record: Record::FilesInFolder,
        ..FOLDERS
    },
    // The library "Student Work" of a team: `Submitted files/Jane Doe/Path tracer/Version 2`.
    Platform {
        layout: Layout::Teams,
        description: "the submitted files of a team in Microsoft Teams",
        outer_folders: &[&["{name}"], &["{title}"]],
        files: &["{version} {attempt}"],
        is_submission: Node::is_folder,
        unmatched: "it is not in the folder of a version",
        ids: &["{name}_{attempt}"],
        ..FOLDERS
    },
    // Clones from GitHub Classroom or classroom50: repositories named after the assignment and the account.
    // GitHub Classroom puts them into a folder `ASSIGNMENT-submissions`. classroom50 writes `scores.csv`
    // next to them.
    Platform {
        layout: Layout::GitHub,
        description: "clones from a GitHub classroom",
        files: &["{account}"],
        is_submission: Node::is_folder,
        unmatched: "it is not a repository",
        own_files: &[CLASSROOM50_SCORES],
        ids: &["{account}"],
        names: &[],
        is_named_by_file: false,
        prefixed: Some(("account", '-')),
        ..FOLDERS
    },
    // Clones of a GitLab group (`glab repo clone --group`), with `--preserve-namespace` in a folder for each
    // subgroup, such as a tutorial. The projects are named after people, accounts or student ids.
    Platform {
        layout: Layout::GitLab,
        description: "clones of a GitLab group",
        is_submission: Node::is_folder,
        unmatched: "it is not a repository",
        prefixed: Some(("name", '-')),
        ..FOLDERS
    },
    FOLDERS,
];
