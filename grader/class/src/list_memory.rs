//! Remembers the lists that the results in an output folder depend on. The folder contains a copy
//! of each. If a list isn't given to a later run, the run uses the copy, so that the points,
//! extensions and names in it aren't lost.

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
use crate::list_kind::{KeptList, KeptLists, ListKind};
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
    pub kept: KeptLists,
    /// Sentences for staff.
    notes: Vec<String>,
    copies: BTreeMap<ListKind, Vec<u8>>,
}

/// An output folder and the lists it contains copies of.
pub type KeptIn<'a> = (&'a Path, &'a KeptLists);

impl UsedLists {
    /// Chooses each list: the one on the command line or else, unless it is dropped, the copy in
    /// the output folder `out`, or else the one that all merged shards were graded with. Prints
    /// where the lists come from and which ones changed.
    pub fn choose(given: Lists, out: Option<&Path>, parts: &[KeptIn]) -> Result<Self, Error> {
        let mut used = UsedLists {
            lists: given,
            ..UsedLists::default()
        };
        let run = out
            .map(|out| Store::new(out).read_run())
            .transpose()?
            .flatten();
        let last = out.zip(run.as_ref().map(|run| &run.lists));
        for kind in ListKind::value_variants() {
            used.choose_list(*kind, last, parts)?;
        }
        for note in &used.notes {
            print_error_line(sanitize_line(note, 300));
        }
        Ok(used)
    }

    fn choose_list(
        &mut self,
        kind: ListKind,
        out: Option<KeptIn>,
        parts: &[KeptIn],
    ) -> Result<(), Error> {
        let (name, title) = (kind.name(), kind.title());
        let last = out.and_then(|(folder, lists)| Some((folder, lists.get(&kind)?)));
        let (list, bytes) = if let Some(path) = self.lists.path(kind).clone() {
            let bytes = read(kind, &path)?;
            let column = self.lists.column.clone();
            let list = KeptList {
                hash: file_hash(&bytes),
                given_as: path.display().to_string(),
                column: column.filter(|_| kind == ListKind::Canvas),
                is_of_parts: false,
            };
            if last.is_some_and(|(_, last)| !last.is_same(&list)) {
                self.notes.push(format!(
                    "{title} differs from the last run's, so final points may change"
                ));
            }
            (list, bytes)
        } else if self.lists.drop_list.contains(&kind) {
            let dropped = last.map(|_| format!("{title} of the last run no longer counts"));
            self.notes.extend(dropped);
            return Ok(());
        } else {
            let own = last.filter(|(_, list)| !list.is_of_parts || parts.is_empty());
            let of_parts = match own {
                Some(_) => None,
                None => one_of_parts(kind, parts)?,
            };
            let Some((folder, list)) = own.or(of_parts) else {
                return Ok(());
            };
            let is_of_parts = list.is_of_parts || of_parts.is_some();
            let path = copy_path(folder, kind, list);
            let bytes = read_copy(kind, &path, list)?;
            self.notes.push(format!(
                "using {title} of the {}, {}; --drop-list {name} drops it",
                if is_of_parts { "parts" } else { "last run" },
                list.given_as
            ));
            if kind == ListKind::Canvas && self.lists.column.is_none() {
                self.lists.column.clone_from(&list.column);
            }
            *self.lists.path(kind) = Some(path);
            let list = KeptList {
                is_of_parts,
                ..list.clone()
            };
            (list, bytes)
        };
        self.copies.insert(kind, bytes);
        self.kept.insert(kind, list);
        Ok(())
    }

    /// Writes the copies and `run.json` into an output folder, and removes copies that it doesn't
    /// name. File names contain the hash, so that the copies of the last run are kept until
    /// `run.json` is written.
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

/// Returns the list that all shards were graded with, and the folder of one of them.
fn one_of_parts<'a>(
    kind: ListKind,
    parts: &[KeptIn<'a>],
) -> Result<Option<(&'a Path, &'a KeptList)>, Error> {
    let Some((first, lists)) = parts.first() else {
        return Ok(None);
    };
    let list = lists.get(&kind);
    let is_other = |(_, lists): &&KeptIn| match (list, lists.get(&kind)) {
        (Some(one), Some(other)) => !one.is_same(other),
        (one, other) => one.is_some() != other.is_some(),
    };
    match parts.iter().find(is_other) {
        Some((other, _)) => {
            let (one, other) = (first.display(), other.display());
            let (name, title) = (kind.name(), kind.title());
            Err(Error::user(format!(
                "{one} and {other} were not graded with the same list: {title} differs, or only \
                 one has it; choose one with --{name}, or none with --drop-list {name}"
            )))
        }
        None => Ok(list.map(|list| (*first, list))),
    }
}

fn copy_path(folder: &Path, kind: ListKind, list: &KeptList) -> PathBuf {
    let is_policy = kind == ListKind::Policy;
    let extension = if is_policy { "toml" } else { "csv" };
    let hash = list.hash.get(..12).unwrap_or_default();
    folder
        .join(FOLDER)
        .join(format!("{}-{hash}.{extension}", kind.name()))
}

/// Reads a copy, which must not have changed since it was written.
fn read_copy(kind: ListKind, path: &Path, list: &KeptList) -> Result<Vec<u8>, Error> {
    match files::read(path) {
        Ok(bytes) if file_hash(&bytes) == list.hash => Ok(bytes),
        Err(error) if error.source.kind() != ErrorKind::NotFound => Err(Error::user(error)),
        Ok(_) | Err(_) => {
            let (path, name, title) = (path.display(), kind.name(), kind.title());
            Err(Error::user(format!(
                "{path} is missing or has changed, and {title} of the last run is still needed: \
                 pass it again with --{name}, or drop it with --drop-list {name}"
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
