//! Collects a submission: the task files of an assignment from a folder or an archive, and nothing else.
//!
//! An archive is read in memory and never unpacked. Files are selected by their exact names.

mod archive;
mod choice;
mod error;
mod folder;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use judging::sanitize::sanitize_line;

use crate::handed_out::{HandedOut, TaskFile};

use error::{ambiguous, no_task_files};
use folder::Search;

pub use archive::{Archive, ArchiveError, Listing, Member, is_archive_name};
pub use error::{SubmissionError, TaskFileError, listed, places};

/// The maximum length of a file that is read, in bytes. The reference's files are about 10,000
/// bytes long.
const MAX_FILE_BYTES: u64 = 1 << 20;
/// The maximum number of notes about other files in a report.
const MAX_NOTES: usize = 20;
/// The maximum length of a printed name, in characters.
const MAX_NAME_CHARS: usize = 200;

/// The task files as they were submitted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// The assignment.
    pub handed_out: &'static HandedOut,
    /// The name of the folder or archive, for reports.
    pub name: String,
    /// The text of each task file, or the reason why it has none, in lecture order.
    pub files: Vec<(TaskFile, Result<String, TaskFileError>)>,
    /// Notes about copies of the task files that differ from the graded ones.
    pub ignored_copies: Vec<String>,
    /// Notes about other files that were found, which are not graded.
    pub notes: Vec<String>,
}

impl Submission {
    /// Reads the task files of a folder or archive, at any depth. The folder in it with most of the
    /// task files counts; copies that are ignored are named in a note.
    pub fn collect(path: &Path, handed_out: &'static HandedOut) -> Result<Self, SubmissionError> {
        if path.is_dir() {
            let search = folder::search(path, handed_out)?;
            return Submission::choose(&folder_name(path), path, search, handed_out);
        }
        if path.is_file() {
            let search = Search::in_archive(path, handed_out)?;
            let name = archive::without_extension(&folder_name(path));
            return Submission::choose(&name, path, search, handed_out);
        }
        Err(match path.symlink_metadata() {
            Ok(_) => SubmissionError::NotFileOrFolder(path.to_owned()),
            Err(_) => SubmissionError::NotFound(path.to_owned()),
        })
    }

    /// Reads the task files in the folder `src` of the package that students work in: the files that
    /// Cargo compiles, whatever copies are in other folders. Without such a folder, looks for the
    /// files like [`Submission::collect`].
    pub fn collect_package(
        path: &Path,
        handed_out: &'static HandedOut,
    ) -> Result<Self, SubmissionError> {
        let source = path.join("src");
        let mut files = handed_out.file_names().map(|file| source.join(file));
        if files.any(|file| file.is_file()) {
            let search = folder::search_one(&source, handed_out)?;
            return Submission::choose(&folder_name(path), path, search, handed_out);
        }
        Submission::collect(path, handed_out)
    }

    /// Reads the task files of a folder that a platform has made, like [`Submission::collect`], but
    /// also from the archives in it.
    pub fn collect_with_archives(
        path: &Path,
        handed_out: &'static HandedOut,
    ) -> Result<Self, SubmissionError> {
        let mut search = folder::search(path, handed_out)?;
        search.add_archives(path, handed_out);
        Submission::choose(&folder_name(path), path, search, handed_out)
    }

    /// Reads the task files among these files, each given by its submitted name and its path on
    /// disk, and in the archives among them.
    pub fn from_files(
        name: &str,
        files: &[(String, PathBuf)],
        handed_out: &'static HandedOut,
    ) -> Result<Self, SubmissionError> {
        let path = Path::new(name);
        let search = folder::search_files(path, files, handed_out)?;
        Submission::choose(name, path, search, handed_out)
    }

    /// Chooses the folder that is graded.
    fn choose(
        name: &str,
        path: &Path,
        search: Search,
        handed_out: &'static HandedOut,
    ) -> Result<Self, SubmissionError> {
        let link = |link: &String| SubmissionError::Link {
            path: path.to_owned(),
            link: display_name(link),
        };
        let (faults, errors): (Vec<_>, Vec<_>) = search
            .errors
            .into_iter()
            .partition(SubmissionError::is_machine_fault);
        // What the machine did not read could be what counts.
        if let Some(fault) = faults.into_iter().next() {
            return Err(fault);
        }
        let choice = choice::choose(search.candidates, handed_out);
        let choice = choice.map_err(|error| ambiguous(path, error))?;
        let mut errors = errors.into_iter();
        let Some(choice) = choice else {
            let error = errors.next().or_else(|| search.links.first().map(link));
            return Err(error.unwrap_or_else(|| no_task_files(path, &search.names, handed_out)));
        };
        // A link could lead to another person's files.
        let files = handed_out.file_names();
        let mut paths = files.map(|file| choice::join(&choice.chosen.folder, file));
        if let Some(path) = paths.find(|path| search.links.contains(path)) {
            return Err(link(&path));
        }
        // What cannot be read could have the files that are missing.
        if !choice.is_complete {
            let mut links = search.links.iter();
            let leads_to_files = |path: &&String| may_lead_to_files(path, handed_out);
            let error = errors
                .next()
                .or_else(|| links.find(leads_to_files).map(link));
            if let Some(error) = error {
                return Err(error);
            }
        }
        Ok(Submission::from_contents(
            name.to_owned(),
            choice.chosen.files,
            choice.notes,
            handed_out,
        ))
    }

    /// Returns whether the assignment has not been started: every task file is the starter's, token
    /// for token.
    pub fn is_as_handed_out(&self) -> bool {
        let mut files = self.files.iter();
        files.all(|(file, text)| text.as_ref().is_ok_and(|text| file.is_starter(text)))
    }

    fn from_contents(
        name: String,
        mut contents: SubmissionFiles,
        ignored_copies: Vec<String>,
        handed_out: &'static HandedOut,
    ) -> Self {
        let mut text = |file: TaskFile| {
            let missing = || Err(TaskFileError::Missing(file.name));
            let bytes = contents
                .task_files
                .remove(file.name)
                .unwrap_or_else(missing)?;
            decode(file.name, bytes)
        };
        let files = handed_out.files.iter().map(|file| (*file, text(*file)));
        Submission {
            handed_out,
            name,
            files: files.collect(),
            ignored_copies,
            notes: notes(&contents.other_files, handed_out),
        }
    }
}

/// The files found in the folder that has the task files.
#[derive(Debug, Default)]
struct SubmissionFiles {
    /// The task files found, by name.
    task_files: BTreeMap<&'static str, Result<Vec<u8>, TaskFileError>>,
    /// Other Rust files by name, with their bytes if they are to be compared with given files.
    other_files: BTreeMap<String, Vec<u8>>,
}

/// Returns whether a link has the name of a task file, or of a folder that people hand in.
fn may_lead_to_files(link: &str, handed_out: &HandedOut) -> bool {
    let name = link.rsplit('/').next().unwrap_or(link);
    let mut folders = handed_out.assignment.folders.iter();
    handed_out.task_file(name).is_some()
        || folders.any(|folder| folder.split('/').any(|part| part == name))
}

/// Returns a name that is safe to print: shortened, and with control characters escaped.
fn display_name(name: &str) -> String {
    sanitize_line(name, MAX_NAME_CHARS)
}

/// Returns the name of a folder or file, after resolving paths such as `student/.`.
fn folder_name(path: &Path) -> String {
    let resolved = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let name = resolved.file_name().unwrap_or(resolved.as_os_str());
    name.to_string_lossy().into_owned()
}

fn decode(name: &'static str, bytes: Vec<u8>) -> Result<String, TaskFileError> {
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(TaskFileError::TooLong(name));
    }
    String::from_utf8(bytes).map_err(|error| TaskFileError::NotText {
        name,
        byte: error.utf8_error().valid_up_to() + 1,
    })
}

/// Returns notes that list the other files found, and say that they are not used.
fn notes(other_files: &BTreeMap<String, Vec<u8>>, handed_out: &HandedOut) -> Vec<String> {
    let note = |(name, bytes): (&String, &Vec<u8>)| match handed_out.given_file(name) {
        // `main.rs` only renders pictures, and the reference's may differ because it imports
        // another crate.
        Some(given) if *given == handed_out.main => None,
        Some(given) => {
            let theirs = String::from_utf8_lossy(bytes);
            // Compares by line: git and editors may change line endings.
            let same = theirs.lines().eq(given.text.lines());
            (!same).then(|| format!("{name} differs from the given one, which is used"))
        }
        None => Some(format!(
            "{} is not one of the task files: ignored",
            display_name(name)
        )),
    };
    other_files
        .iter()
        .filter_map(note)
        .take(MAX_NOTES)
        .collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::handed_out::RAYS;

    fn write_files(folder: &Path, text: &str) {
        fs::create_dir_all(folder).unwrap();
        for file in RAYS.file_names() {
            fs::write(folder.join(file), text).unwrap();
        }
    }

    #[test]
    fn copies_in_other_folders_do_not_stop_students_at_their_own_work() {
        let package = tempfile::tempdir().unwrap();
        write_files(&package.path().join("src"), "new");
        write_files(&package.path().join("src/yesterday"), "old");
        let own = Submission::collect_package(package.path(), &RAYS).unwrap();
        assert!(
            own.files
                .iter()
                .all(|(_, text)| text.as_deref() == Ok("new"))
        );
        // Of what is handed in, nobody knows which copy is meant.
        let handed_in = Submission::collect(package.path(), &RAYS);
        assert!(matches!(
            handed_in,
            Err(SubmissionError::Ambiguous { copies, .. }) if copies == ["src", "src/yesterday"]
        ));
    }

    #[test]
    fn the_files_of_a_workspace_without_a_package_are_found_as_well() {
        let folder = tempfile::tempdir().unwrap();
        write_files(&folder.path().join("my/work"), "new");
        let found = Submission::collect_package(folder.path(), &RAYS).unwrap();
        assert!(found.files.iter().all(|(_, text)| text.is_ok()));
    }

    #[test]
    fn folders_without_end_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join("a/".repeat(40))).unwrap();
        let refused = Submission::collect(folder.path(), &RAYS);
        assert!(matches!(refused, Err(SubmissionError::TooManyFiles(_))));
    }

    /// Returns the files of a submission that have a text.
    fn texts(submission: &Submission) -> Vec<(&str, &str)> {
        let files = submission.files.iter();
        let texts = files.filter_map(|(file, text)| Some((file.name, text.as_deref().ok()?)));
        texts.collect()
    }

    #[test]
    fn only_the_starters_files_are_as_handed_out() {
        let folder = tempfile::tempdir().unwrap();
        for file in RAYS.files {
            fs::write(folder.path().join(file.name), file.starter).unwrap();
        }
        let is_as_handed_out = || {
            let submission = Submission::collect(folder.path(), &RAYS).unwrap();
            submission.is_as_handed_out()
        };
        assert!(is_as_handed_out());
        fs::write(folder.path().join("bvh.rs"), "new").unwrap();
        assert!(!is_as_handed_out());
        fs::remove_file(folder.path().join("bvh.rs")).unwrap();
        assert!(!is_as_handed_out(), "a file is missing");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_matters_only_if_files_are_missing_that_it_may_lead_to() {
        let folder = tempfile::tempdir().unwrap();
        let source = folder.path().join("work");
        fs::create_dir(&source).unwrap();
        fs::write(source.join("bvh.rs"), "new").unwrap();
        let link = |name: &str| {
            crate::system::symlink("elsewhere".as_ref(), &folder.path().join(name)).unwrap();
        };
        link("notes");
        let found = Submission::collect(folder.path(), &RAYS).unwrap();
        assert_eq!(texts(&found), [("bvh.rs", "new")]);
        link("src");
        let refused = Submission::collect(folder.path(), &RAYS);
        assert!(matches!(refused, Err(SubmissionError::Link { link, .. }) if link == "src"));
        write_files(&source, "new");
        assert!(Submission::collect(folder.path(), &RAYS).is_ok());
        // But not one in the place of a file that is graded.
        fs::remove_file(source.join("bvh.rs")).unwrap();
        link("work/bvh.rs");
        let refused = Submission::collect(folder.path(), &RAYS);
        assert!(
            matches!(refused, Err(SubmissionError::Link { link, .. }) if link == "work/bvh.rs")
        );
    }

    #[test]
    fn names_of_task_files_and_of_their_folders_may_lead_to_files() {
        for link in ["bvh.rs", "a/bvh.rs", "src", "a/student"] {
            assert!(may_lead_to_files(link, &RAYS), "{link}");
        }
        for link in ["notes", "src/notes", "bvh", "lib.rs"] {
            assert!(!may_lead_to_files(link, &RAYS), "{link}");
        }
    }

    #[test]
    fn a_file_may_be_as_long_as_the_limit() {
        let longest = vec![b' '; 1 << 20];
        assert!(decode("bvh.rs", longest.clone()).is_ok());
        let longer = [longest, vec![b' ']].concat();
        assert_eq!(
            decode("bvh.rs", longer),
            Err(TaskFileError::TooLong("bvh.rs"))
        );
    }

    #[test]
    fn bytes_that_are_not_text_are_counted_from_one() {
        let error = decode("bvh.rs", b"ab\xffc".to_vec()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "bvh.rs is not UTF-8 text: byte 3 is invalid"
        );
    }

    #[test]
    fn only_given_files_that_were_changed_are_noted() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        write("bvh (1).rs", "new");
        write("README.md", "read me");
        write("helper.rs", "");
        write("main.rs", "fn main() {}");
        write("world.rs", "mine");
        // Git may have changed the line endings.
        let library = RAYS.given_file("lib.rs").unwrap();
        write("lib.rs", &library.text.replace('\n', "\r\n"));
        let submission = Submission::collect(folder.path(), &RAYS).unwrap();
        assert_eq!(texts(&submission), [("bvh.rs", "new")]);
        let notes = [
            "helper.rs is not one of the task files: ignored",
            "world.rs differs from the given one, which is used",
        ];
        assert_eq!(submission.notes, notes);
    }

    #[test]
    fn the_number_of_notes_is_limited() {
        let other = |n: u32| (format!("{n}.rs"), Vec::new());
        assert_eq!(notes(&(0..30).map(other).collect(), &RAYS).len(), MAX_NOTES);
    }

    #[test]
    fn names_are_printed_shortened_and_without_control_characters() {
        assert_eq!(display_name("a\u{7}\n.rs"), "a\\u{7}\\n.rs");
        let long = "é".repeat(MAX_NAME_CHARS);
        assert_eq!(display_name(&long), long);
        assert_eq!(
            display_name(&"é".repeat(MAX_NAME_CHARS + 1)),
            format!("{long}…")
        );
    }

    #[test]
    fn a_submission_is_named_after_the_folder_that_the_path_leads_to() {
        let folder = tempfile::tempdir().unwrap();
        write_files(&folder.path().join("ann"), "new");
        let name = |path: &str| {
            let found = Submission::collect(&folder.path().join(path), &RAYS);
            found.unwrap().name
        };
        assert_eq!([name("ann"), name("ann/.")], ["ann", "ann"]);
    }

    #[test]
    fn of_uploads_with_the_same_name_the_last_one_counts() {
        let folder = tempfile::tempdir().unwrap();
        let upload = |name: &str, file: &str, text: &str| {
            let path = folder.path().join(file);
            fs::write(&path, text).unwrap();
            (name.to_owned(), path)
        };
        let files = [
            upload("bvh.rs", "1", "old"),
            upload("bvh.rs", "2", "new"),
            upload("notes.txt", "3", "not code"),
        ];
        let found = Submission::from_files("ann", &files, &RAYS).unwrap();
        assert_eq!(
            (found.name.as_str(), texts(&found)),
            ("ann", vec![("bvh.rs", "new")])
        );
        let error = Submission::from_files("ann", &files[2..], &RAYS).unwrap_err();
        assert!(error.to_string().ends_with("it has notes.txt"), "{error}");
    }

    #[test]
    fn a_path_without_a_submission_is_explained() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("b.txt"), "").unwrap();
        fs::create_dir(folder.path().join("a")).unwrap();
        let error = |path: &Path| Submission::collect(path, &RAYS).unwrap_err().to_string();
        let none = error(folder.path());
        assert!(
            none.ends_with("in any of its folders; it has a, b.txt"),
            "{none}"
        );
        let absent = error(&folder.path().join("absent"));
        assert!(absent.starts_with("there is no "), "{absent}");
        let text = error(&folder.path().join("b.txt"));
        assert!(text.contains("it is empty"), "{text}");
    }
}
