//! One archive with the pages to hand back. Its files are named as Canvas and Moodle expect for an
//! upload. For other platforms, they are named after the people.
//!
//! Canvas reads the first two numbers between underscores as the IDs of the user and the
//! attachment, and shows the page under the attachment's name. The page for a submitted zip is
//! therefore put into a zip as well. Moodle splits a name at its underscores into full name,
//! participant, plug-in type, plug-in and file name, so the full name must not contain any.

use std::collections::BTreeSet;
use std::io::{self, Cursor, Write};

use grader::report::html::with_counted;
use judging::sanitize::safe_folder_name;
use zip::write::SimpleFileOptions;
use zip::{DateTime, ZipWriter};

use crate::entry::{NUMBER, Person, WHO};
use crate::error::Error;
use crate::graded_class::{ClassRow, GradedClass, PersonGrade};
use crate::names::{joined, unique_name};
use crate::store::{FEEDBACK, Store};

/// The name of the archive in the output folder.
pub const ARCHIVE: &str = "hand-back.zip";
/// The subfolder of the output folder for pages that can't be in the archive.
const FOLDER: &str = "hand-back";
/// The suffix of a page's file name, after the person's name.
const PAGE: &str = "feedback.html";

/// The reason for leaving out a page for Moodle. If the number in the file name belonged to a
/// group, the wrong person would get the page.
const NO_NUMBER: &str = "the number in the file name could be a person's or a group's, and no list \
                         says which: pass Moodle's worksheet with --moodle";

/// The reason for leaving out a page for Canvas if only text was handed in there, and the files
/// arrived later in another way.
const NO_FILE: &str = "Canvas can only show a page next to a file that was handed in there: send \
                       the student the page from the folder hand-back";

/// The warning about a group that gets a single page.
const ONE_PAGE: &str = "Canvas shows all members of a group the same page, so it leaves out points \
                        and comments that differ between them: send each member their own page \
                        from the folder hand-back";

/// An archive to hand back to students.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HandBack {
    /// The bytes of the archive.
    pub archive: Vec<u8>,
    /// The number of pages in the archive.
    pub pages: usize,
    /// The people whose pages aren't in the archive, and the reasons.
    pub left_out: Vec<String>,
}

/// Makes the archive. Pages of people without final points are left out.
pub fn hand_back(class: &GradedClass, store: &Store) -> Result<HandBack, Error> {
    let mut archive = ArchiveWriter::default();
    let mut left_out = Vec::new();
    let mut used = BTreeSet::new();
    store.clear(FOLDER, PAGE)?;
    let mut rows = class.rows.iter();
    let needs_names = rows.any(|row| row.result.info.hand_back_as.is_some());
    for row in &class.rows {
        // Without a score, there is no page.
        let has_page = row.result.score().is_some();
        let ready = |(_, grade): &(&Person, &PersonGrade)| has_page && grade.counted.is_some();
        let (ready, others): (Vec<_>, Vec<_>) = row.people().partition(ready);
        // The page for the attempt that counts says everything.
        for (person, grade) in others.into_iter().filter(|(_, own)| !own.is_superseded()) {
            let (name, status) = (class.distinct_name(person), row.status(grade));
            left_out.push(format!("{name}: {status}: {}", row.why(grade)));
        }
        if ready.is_empty() {
            continue;
        }
        let page = store.read_of_entry(&row.result.id, FEEDBACK)?;
        let name = row.result.info.hand_back_as.as_deref();
        if let Some(name) = name.filter(|name| !name.contains(NUMBER)) {
            // The platform forwards the page to the members of a group.
            let names = joined(ready.iter().map(|(person, _)| person.display_name()), " + ");
            let who = safe_folder_name(&names);
            add_as(&mut archive, name, &who, &page).map_err(cannot_write)?;
            if row.has_private_texts() {
                left_out.push(format!("{names}: {ONE_PAGE}"));
                for (person, grade) in ready {
                    let who = unique_name(&class.file_name(person), "", &mut used);
                    let own = with_counted(&page, &own_texts(row, person, grade));
                    store.write(format!("{FOLDER}/{who}_{PAGE}"), own)?;
                }
            }
            continue;
        }
        for (person, grade) in ready {
            let who = class.file_name(person);
            let own = with_counted(&page, &own_texts(row, person, grade));
            let added = match name {
                Some(_) if person.own_number().is_empty() => {
                    left_out.push(format!("{}: {NO_NUMBER}", class.distinct_name(person)));
                    continue;
                }
                Some(name) => {
                    let name = name.replace(NUMBER, person.own_number());
                    add_as(&mut archive, &name, &who, &own)
                }
                None if needs_names => {
                    left_out.push(format!("{}: {NO_FILE}", class.distinct_name(person)));
                    let who = unique_name(&who, "", &mut used);
                    store.write(format!("{FOLDER}/{who}_{PAGE}"), own)?;
                    continue;
                }
                None => archive.add(&format!("{who}_{PAGE}"), own.as_bytes()),
            };
            added.map_err(cannot_write)?;
        }
    }
    Ok(HandBack {
        pages: archive.count(),
        archive: archive.finish().map_err(cannot_write)?,
        left_out,
    })
}

/// Returns the error to report if the archive cannot be written, e.g. because it is too large.
fn cannot_write(error: io::Error) -> Error {
    Error::machine(format!("cannot write {ARCHIVE}: {error}"))
}

/// Returns the sentences for a page that only one person gets. They don't mention the rest of the
/// group.
fn own_texts(row: &ClassRow, person: &Person, grade: &PersonGrade) -> Vec<String> {
    let name = person.display_name();
    let name = (name != row.result.id).then(|| name.to_owned());
    let texts = name.into_iter().chain(grade.explanation());
    texts.chain(row.correction().map(str::to_owned)).collect()
}

/// Adds a page under the name the platform expects. `who` lists the people's names, for use in a
/// file name.
fn add_as(archive: &mut ArchiveWriter, name: &str, who: &str, page: &str) -> io::Result<()> {
    let name = name.replace(WHO, &who.replace('_', " "));
    if !name.to_lowercase().ends_with(".zip") {
        return archive.add(&name, page.as_bytes());
    }
    let mut inner = ArchiveWriter::default();
    inner.add(&format!("{who}_{PAGE}"), page.as_bytes())?;
    archive.add(&name, &inner.finish()?)
}

/// An archive that is being written in memory.
struct ArchiveWriter {
    writer: ZipWriter<Cursor<Vec<u8>>>,
    /// The names already used in the archive, in lower case.
    used: BTreeSet<String>,
}

impl Default for ArchiveWriter {
    /// Returns an empty archive.
    fn default() -> Self {
        ArchiveWriter {
            writer: ZipWriter::new(Cursor::new(Vec::new())),
            used: BTreeSet::new(),
        }
    }
}

impl ArchiveWriter {
    /// Adds a file. If the name is taken, a number is appended to its stem. The file gets no
    /// modification time, so that the archive depends only on the files' contents.
    fn add(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let (stem, end) = name.split_at(name.rfind('.').unwrap_or(name.len()));
        let free = unique_name(stem, end, &mut self.used);
        let options = SimpleFileOptions::default().last_modified_time(DateTime::default());
        self.writer.start_file(free, options)?;
        self.writer.write_all(bytes)
    }

    /// Returns the number of files.
    fn count(&self) -> usize {
        self.used.len()
    }

    /// Returns the bytes of the archive.
    fn finish(self) -> io::Result<Vec<u8>> {
        Ok(self.writer.finish()?.into_inner())
    }
}
