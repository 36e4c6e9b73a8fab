//! Corrected hand-ins. Their files replace the files of submissions that could not be graded, while
//! the students and the submission times stay the same.

use std::collections::BTreeMap;
use std::path::Path;

use grader::handed_out::HandedOut;
use grader::submission::{copied_names, strip_archive_extension};
use judging::sanitize::sanitize_line;

use crate::entry::{Entry, EntryInfo, Person};
use crate::error::Error;
use crate::file_tree::list_folder;
use crate::identity::{CORRECTED, find_submission, matching_submissions};
use crate::layout::{Layout, LayoutChoice, RecognisedClass, hidden_paths, recognise};
use crate::names::joined;
use crate::paths::contains;
use crate::store::Store;

/// The maximum length of a name in a message, in characters.
const MAX_CHARS: usize = 200;

/// Replaces the files of each submission that has a corrected hand-in in `folder`. A corrected
/// hand-in is named after the submission or after one of its students. `counts` returns whether a
/// submission counts for a student. `input` is the path of the class.
pub fn replace_files(
    class: &mut RecognisedClass,
    folder: &Path,
    input: &Path,
    handed_out: &HandedOut,
    counts: impl Fn(&str, &Person) -> bool,
) -> Result<(), Error> {
    let shown = folder.display();
    if contains(input, folder) {
        return Err(Error::user(format!(
            "{shown} is inside {}, so the corrected submissions would be graded as separate ones: \
             move the folder elsewhere",
            input.display()
        )));
    }
    let listed = list_folder(folder).map_err(Error::user)?;
    let choice = LayoutChoice {
        layout: Some(Layout::Plain),
        title: None,
    };
    let corrected = recognise(&choice, &listed, None, handed_out, &[])?;
    let mut used: BTreeMap<usize, String> = BTreeMap::new();
    for Entry { info, source, .. } in corrected.entries {
        let path = sanitize_line(&info.from, MAX_CHARS);
        let refused = |why| Error::user(format!("{shown}: {path}: {why}"));
        let index = find_original(&class.entries, &info, &counts).map_err(refused)?;
        let entry = &mut class.entries[index];
        if let Some(other) = used.insert(index, path.clone()) {
            return Err(Error::user(format!(
                "{shown}: {other} and {path} both contain corrections for {}: remove one",
                entry.id
            )));
        }
        entry.source = source;
        entry.info.from = format!("{}{CORRECTED}{})", entry.info.from, info.from);
        entry.info.is_corrected = true;
        entry.info.needs_staff = false;
    }
    let hidden = hidden_paths(folder).map_err(Error::user)?;
    for mut file in corrected.unmatched.into_iter().chain(hidden) {
        file.name = format!("{shown}/{}", file.name);
        class.unmatched.push(file);
    }
    Ok(())
}

/// Returns the index of the submission that a corrected hand-in is for. Its name may also be that of
/// a second download.
fn find_original(
    entries: &[Entry],
    corrected: &EntryInfo,
    counts: impl Fn(&str, &Person) -> bool,
) -> Result<usize, String> {
    let who = corrected.display_names();
    // The original may be an archive that has been unpacked, or one of several files.
    let by_file = |who: &str| {
        let is_named = |name: &str| name == corrected.from || strip_archive_extension(name) == who;
        let is_named_path = |path: &Path| path.file_name()?.to_str().map(is_named);
        entries.iter().position(|Entry { info, source, .. }| {
            let mut paths = source.paths().into_iter();
            is_named(&info.from) || paths.any(|path| is_named_path(path) == Some(true))
        })
    };
    if let Some(index) = by_file(&who) {
        return Ok(index);
    }
    let all = entries.iter().map(|entry| (entry.id.as_str(), &entry.info));
    let all = Vec::from_iter(all);
    let mut names = copied_names(&who).into_iter().map(strip_archive_extension);
    let of_name = |name: &str| match by_file(name) {
        Some(index) => vec![index],
        None => matching_submissions(name, &all, &counts),
    };
    let own = matching_submissions(&who, &all, &counts);
    match names.find_map(|name| Some((name, of_name(name))).filter(|(_, of)| !of.is_empty())) {
        Some((_, copied)) if !own.is_empty() && own != copied => {
            let readings = own.iter().chain(&copied).map(|index| &all[*index].1.from);
            Err(format!(
                "it could be for {}, since {who:?} is also the name that browsers give to a second \
                 download: rename the file to one of these names, or to the student's email address \
                 or account",
                joined(readings, " or ")
            ))
        }
        Some((_, copied)) if copied.len() == 1 => Ok(copied[0]),
        Some((name, _)) if own.is_empty() => find_submission(name, &all, &counts),
        _ => find_submission(&who, &all, &counts),
    }
}

/// Rejects a run without corrected hand-ins if the last run had some. Otherwise, those submissions
/// would be graded from their original files again.
pub fn check_none_lost(store: &Store) -> Result<(), Error> {
    let is_corrected =
        |id: &String| matches!(store.result(id), Ok(Some(result)) if result.info.is_corrected);
    match store.ids()?.into_iter().find(is_corrected) {
        Some(id) => Err(Error::user(format!(
            "{} contains points for corrected submissions, such as {id}: pass the folder of \
             corrected submissions with --corrected again, or pass an empty folder to go back to \
             the original files",
            store.folder().display()
        ))),
        None => Ok(()),
    }
}
