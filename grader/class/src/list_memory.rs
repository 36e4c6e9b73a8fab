//! Remembers the lists that the results in an output folder depend on. The folder contains a copy
//! of each. If a list is missing from a later run's command line, the run uses the copy, so that
//! the points, extensions and names in it aren't lost.

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use grader::files;
use grader::policy::Policy;
use grader::printing::print_error_line;
use judging::content_hash::file_hash;
use judging::sanitize::sanitize_line;

use crate::cli::Lists;
use crate::error::Error;
use crate::list_kind::{ListCopies, ListCopy, ListKind};
use crate::run::Run;
use crate::store::Store;

/// The subfolder for the copies.
const FOLDER: &str = "lists";

/// The lists that a command uses: those on its command line, and copies of the others.
#[derive(Debug, Default)]
pub struct UsedLists {
    /// The lists, which may be copies.
    pub lists: Lists,
    /// The lists to record in `run.json`.
    pub kept: ListCopies,
    /// Sentences for staff, which are printed later.
    notes: Vec<String>,
    copies: BTreeMap<ListKind, Vec<u8>>,
    /// Whether the command line specifies manual points.
    has_new_points: bool,
    /// The manual points from the last run, if the command line specifies different ones.
    earlier_points: Option<(ListCopy, Vec<u8>)>,
}

/// An output folder and the lists it contains copies of.
pub type FolderCopies<'a> = (&'a Path, &'a ListCopies);

impl UsedLists {
    /// Decides where each list comes from. A list on the command line takes precedence. Otherwise,
    /// unless the list is dropped, the copy in the output folder `out` is used or, failing that,
    /// the list that all merged shards were graded with. Prints where the lists come from and which
    /// ones changed.
    pub fn choose(given: Lists, out: Option<&Path>, parts: &[FolderCopies]) -> Result<Self, Error> {
        let mut used = UsedLists {
            lists: given,
            ..UsedLists::default()
        };
        let mut kinds = ListKind::value_variants().to_vec();
        kinds.retain(|kind| *kind != ListKind::Downloaded || !parts.is_empty());
        used.choose_kinds(&kinds, out, parts)?;
        Ok(used)
    }

    /// Unless the list of people is dropped, adds the list found in the platform's download or,
    /// failing that, the copy of an earlier list.
    pub fn add_downloaded(
        &mut self,
        found: Option<PathBuf>,
        out: Option<&Path>,
    ) -> Result<(), Error> {
        let is_dropped = self.lists.drop_list.contains(&ListKind::Downloaded);
        self.lists.downloaded = found.filter(|_| !is_dropped);
        self.choose_kinds(&[ListKind::Downloaded], out, &[])
    }

    fn choose_kinds(
        &mut self,
        kinds: &[ListKind],
        out: Option<&Path>,
        parts: &[FolderCopies],
    ) -> Result<(), Error> {
        let run = out.map(|out| Store::new(out).read_run()).transpose()?;
        let run = run.flatten();
        let last = out.zip(run.as_ref().map(|run| &run.lists));
        for kind in kinds {
            if let Some((list, bytes)) = self.choose_list(*kind, last, parts)? {
                self.copies.insert(*kind, bytes);
                self.kept.insert(*kind, list);
            }
        }
        for note in self.notes.drain(..) {
            print_error_line(sanitize_line(&note, 300));
        }
        Ok(())
    }

    fn choose_list(
        &mut self,
        kind: ListKind,
        out: Option<FolderCopies>,
        parts: &[FolderCopies],
    ) -> Result<Option<(ListCopy, Vec<u8>)>, Error> {
        let (name, title) = (kind.name(), kind.title());
        let last = out.and_then(|(folder, lists)| Some((folder, lists.get(&kind)?)));
        if let Some(path) = self.lists.path(kind).clone() {
            let bytes = read(kind, &path)?;
            let column = self.lists.column.clone();
            let list = ListCopy {
                hash: file_hash(&bytes),
                given_as: path.display().to_string(),
                column: column.filter(|_| kind == ListKind::Canvas),
                is_of_parts: false,
            };
            if last.is_some_and(|(_, last)| !last.is_same(&list)) {
                self.notes.push(format!(
                    "{title} has changed since the last run, so final points may change"
                ));
            }
            if kind == ListKind::ManualPoints {
                self.has_new_points = true;
                self.earlier_points = last.and_then(|(folder, last)| {
                    let copy = read_copy(kind, &copy_path(folder, kind, last), last);
                    Some((last.clone(), copy.ok()?))
                });
            }
            return Ok(Some((list, bytes)));
        }
        if self.lists.drop_list.contains(&kind) {
            let dropped = last.map(|_| format!("{title} from the last run is no longer used"));
            self.notes.extend(dropped);
            return Ok(None);
        }
        let own = last.filter(|(_, list)| !list.is_of_parts || parts.is_empty());
        let of_parts = match own {
            Some(_) => None,
            None => one_of_parts(kind, parts)?,
        };
        let Some((folder, list)) = own.or(of_parts) else {
            return Ok(None);
        };
        let mut list = list.clone();
        list.is_of_parts |= of_parts.is_some();
        let path = copy_path(folder, kind, &list);
        let bytes = read_copy(kind, &path, &list)?;
        self.notes.push(format!(
            "using {title} from the {}, {}; to stop using it, pass --drop-list {name}",
            if list.is_of_parts {
                "parts"
            } else {
                "last run"
            },
            list.given_as
        ));
        if kind == ListKind::Canvas && self.lists.column.is_none() {
            self.lists.column.clone_from(&list.column);
        }
        *self.lists.path(kind) = Some(path);
        Ok(Some((list, bytes)))
    }

    /// Writes the copies and `run.json` into an output folder, and removes copies that `run.json`
    /// doesn't name. The copies' file names contain their hashes, so the last run's copies are kept
    /// until `run.json` is written.
    pub fn save(&self, store: &Store, run: &Run) -> Result<(), Error> {
        let mut paths = Vec::new();
        for (kind, list) in &self.kept {
            let path = copy_path(store.folder(), *kind, list);
            let name = Path::new(FOLDER).join(path.file_name().unwrap_or_default());
            if !files::read(&path).is_ok_and(|bytes| bytes == self.copies[kind]) {
                store.write(name, &self.copies[kind])?;
            }
            paths.push(path);
        }
        store.write_run(run)?;
        for path in store.list(FOLDER)? {
            if !paths.contains(&path) {
                files::remove_if_exists(path)?;
            }
        }
        Ok(())
    }
}

impl UsedLists {
    /// Goes back to the last run's manual points if this run's manual points are rejected. Manual
    /// points can only be checked after grading. `finished` is the result of the run.
    pub fn forget_refused<T>(
        mut self,
        finished: Result<T, Error>,
        store: &Store,
        run: &Run,
    ) -> Result<T, Error> {
        let is_refused = finished.as_ref().is_err_and(|error| error.exit_code == 2);
        if self.has_new_points && is_refused {
            let kind = ListKind::ManualPoints;
            self.kept.remove(&kind);
            if let Some((list, copy)) = self.earlier_points.take() {
                self.kept.insert(kind, list);
                self.copies.insert(kind, copy);
            }
            let mut run = run.clone();
            run.lists.clone_from(&self.kept);
            self.save(store, &run)?;
        }
        finished
    }
}

/// Returns the list that all shards were graded with, and the folder of one of the shards.
fn one_of_parts<'a>(
    kind: ListKind,
    parts: &[FolderCopies<'a>],
) -> Result<Option<(&'a Path, &'a ListCopy)>, Error> {
    let Some((first, lists)) = parts.first() else {
        return Ok(None);
    };
    let list = lists.get(&kind);
    let is_other = |(_, lists): &&FolderCopies| match (list, lists.get(&kind)) {
        (Some(one), Some(other)) => !one.is_same(other),
        (one, other) => one.is_some() != other.is_some(),
    };
    match parts.iter().find(is_other) {
        Some((other, _)) => {
            let (one, other) = (first.display(), other.display());
            let (name, title) = (kind.name(), kind.title());
            Err(Error::user(format!(
                "{one} and {other} were graded with different lists: {title} differs, or only one \
                 of them used it; choose one with --{name}, or none with --drop-list {name}"
            )))
        }
        None => Ok(list.map(|list| (*first, list))),
    }
}

fn copy_path(folder: &Path, kind: ListKind, list: &ListCopy) -> PathBuf {
    let is_policy = kind == ListKind::Policy;
    let extension = if is_policy { "toml" } else { "csv" };
    let hash = list.hash.get(..12).unwrap_or_default();
    let name = format!("{}-{hash}.{extension}", kind.name());
    folder.join(FOLDER).join(name)
}

/// Reads a copy, which must not have changed since it was written.
fn read_copy(kind: ListKind, path: &Path, list: &ListCopy) -> Result<Vec<u8>, Error> {
    match files::read(path) {
        Ok(bytes) if file_hash(&bytes) == list.hash => Ok(bytes),
        Err(error) if error.source.kind() != ErrorKind::NotFound => Err(Error::user(error)),
        Ok(_) | Err(_) => {
            let (path, name, title) = (path.display(), kind.name(), kind.title());
            Err(Error::user(format!(
                "{path} is missing or has changed, and {title} from the last run is still needed: \
                 pass it again with --{name}, or stop using it with --drop-list {name}"
            )))
        }
    }
}

fn read(kind: ListKind, path: &Path) -> Result<Vec<u8>, Error> {
    if kind == ListKind::Policy {
        Ok(Policy::read_text(path)?.into_bytes())
    } else {
        files::read(path).map_err(Error::user)
    }
}
