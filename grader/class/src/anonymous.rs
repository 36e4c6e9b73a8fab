//! Pseudonyms, with which graders see a class without names. They are random, so only the key in the
//! output folder tells whose they are, and every later run has the same.

use std::collections::BTreeMap;
use std::hash::{BuildHasher, RandomState};
use std::path::Path;

use crate::cli::Lists;
use crate::entry::{EntryInfo, Person};
use crate::error::Error;
use crate::graded_class::{ClassRow, GradeProblem, GradedClass};
use crate::outcome::EntryOutcome;
use crate::paths::contains;
use crate::store::{Store, json};

/// The name of the key in the output folder.
const KEY: &str = "anonymous-key.json";

/// The pseudonyms of a class, by the ids of its entries.
#[derive(Clone, Debug, Default)]
pub struct Pseudonyms(BTreeMap<String, String>);

impl Pseudonyms {
    /// Reads the key; there are no pseudonyms without one.
    pub fn read(store: &Store) -> Result<Self, Error> {
        Ok(Pseudonyms(store.read(KEY)?.unwrap_or_default()))
    }

    /// Returns the pseudonym of an entry, or an empty text if it has none yet.
    pub fn known(&self, id: &str) -> String {
        self.0.get(id).cloned().unwrap_or_default()
    }

    /// Returns the class with pseudonyms, without names of people and files, and without times. Adds
    /// the pseudonyms that are missing to the key.
    pub fn hide(&mut self, class: &GradedClass, store: &Store) -> Result<GradedClass, Error> {
        for row in &class.rows {
            // Each state has random keys from the operating system.
            let random = || format!("anon-{:010x}", RandomState::new().hash_one(()) >> 24);
            self.0.entry(row.result.id.clone()).or_insert_with(random);
        }
        store.write(KEY, json(&self.0))?;
        let mut hidden = GradedClass {
            missing: Vec::new(),
            ..class.clone()
        };
        for row in &mut hidden.rows {
            self.hide_row(row);
        }
        // The order of the names would give them away.
        hidden
            .rows
            .sort_by(|one, other| one.result.id.cmp(&other.result.id));
        Ok(hidden)
    }

    fn hide_row(&self, row: &mut ClassRow) {
        let pseudonym = self.known(&row.result.id);
        let person = |number: usize| match row.grades.len() {
            1 => Person::named(&pseudonym),
            _ => Person::named(format!("{pseudonym}, member {number}")),
        };
        row.result.info = EntryInfo {
            people: (1..=row.grades.len()).map(person).collect(),
            late: row.result.info.is_late(),
            from: pseudonym.clone(),
            ..EntryInfo::default()
        };
        for grade in &mut row.grades {
            match &mut grade.problem {
                Some(GradeProblem::OtherAttempt(id)) => *id = self.known(id),
                Some(GradeProblem::SeveralAttempts(ids)) => {
                    ids.iter_mut().for_each(|id| *id = self.known(id));
                }
                Some(GradeProblem::UnclearTime(_)) | None => {}
            }
        }
        if let EntryOutcome::NothingToGrade(why) | EntryOutcome::Fault(why) =
            &mut row.result.outcome
        {
            // It may have the names of files.
            *why = "see class.html in the output folder".to_owned();
        }
        row.result.id = pseudonym;
    }
}

/// Checks that the folder for graders, if there is one, is apart from the output folder `out`, and new
/// or from an earlier run.
pub fn check_folder(lists: &Lists, out: &Path) -> Result<(), Error> {
    let Some(folder) = &lists.anonymous else {
        return Ok(());
    };
    let is_apart = !contains(folder, out) && !contains(out, folder);
    let is_usable = !folder.exists() || Store::new(folder).read_run()?.is_some();
    if is_apart && is_usable {
        return Ok(());
    }
    Err(Error::user(format!(
        "{} has other files, or is in or around the output folder: name a new folder for --anonymous",
        folder.display()
    )))
}
