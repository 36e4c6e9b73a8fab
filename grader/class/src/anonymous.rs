//! Pseudonyms, which let graders see a class without names. They are random, so only the key in the
//! output folder reveals whose they are. Later runs reuse them.

use std::collections::BTreeMap;
use std::hash::{BuildHasher, RandomState};

use crate::entry::{EntryInfo, Person};
use crate::error::Error;
use crate::graded_class::{ClassRow, GradeProblem, GradedClass};
use crate::identity::PSEUDONYM_PREFIX;
use crate::outcome::EntryOutcome;
use crate::store::{Store, json};

/// The name of the key in the output folder.
const KEY: &str = "anonymous-key.json";
/// The text that replaces sentences with names.
const HIDDEN: &str = "(hidden)";

/// The pseudonyms for a class, keyed by the ids of its entries.
pub struct Pseudonyms(BTreeMap<String, String>);

impl Pseudonyms {
    /// Reads the key. If it doesn't exist, there are no pseudonyms yet.
    pub fn read(store: &Store) -> Result<Self, Error> {
        Ok(Pseudonyms(store.read(KEY)?.unwrap_or_default()))
    }

    /// Returns the pseudonym of an entry, or an empty string if it doesn't have one yet.
    pub fn of(&self, id: &str) -> String {
        self.0.get(id).cloned().unwrap_or_default()
    }

    /// Returns the graded submissions under pseudonyms, without times or the names of people and
    /// files. Superseded attempts are left out. Adds missing pseudonyms to the key.
    pub fn hide(&mut self, class: &GradedClass, store: &Store) -> Result<GradedClass, Error> {
        let mut hidden = class.clone();
        hidden.missing.clear();
        hidden.rows.retain(is_shown);
        for row in &mut hidden.rows {
            // Each `RandomState` has random keys from the operating system.
            let random = || {
                format!(
                    "{PSEUDONYM_PREFIX}{:010x}",
                    RandomState::new().hash_one(()) >> 24
                )
            };
            let pseudonym = self.0.entry(row.result.id.clone());
            hide_row(row, pseudonym.or_insert_with(random));
        }
        // Sorting by name would give the names away.
        let rows = &mut hidden.rows;
        rows.sort_by(|one, other| one.result.id.cmp(&other.result.id));
        store.write(KEY, json(&self.0))?;
        Ok(hidden)
    }
}

fn hide_row(row: &mut ClassRow, pseudonym: &str) {
    let person = |number: usize| match row.grades.len() {
        1 => Person::named(pseudonym),
        _ => Person::named(format!("{pseudonym}, member {number}")),
    };
    row.result.info = EntryInfo {
        people: (1..=row.grades.len()).map(person).collect(),
        late: row.result.info.is_late(),
        is_corrected: row.result.info.is_corrected,
        from: pseudonym.to_owned(),
        ..EntryInfo::default()
    };
    if let EntryOutcome::Graded(score) = &mut row.result.outcome {
        let notes = score.build.ignored_copies.iter_mut();
        notes.for_each(|note| HIDDEN.clone_into(note));
    }
    pseudonym.clone_into(&mut row.result.id);
    for grade in &mut row.grades {
        grade.problem.iter_mut().for_each(hide_problem);
        for points in &mut grade.manual {
            pseudonym.clone_into(&mut points.student);
        }
    }
}

/// Removes times and the names of people and submissions.
fn hide_problem(problem: &mut GradeProblem) {
    let hidden = HIDDEN.to_owned();
    match problem {
        GradeProblem::UnclearTime(time) => time.why = hidden,
        GradeProblem::UnclearPerson(text) | GradeProblem::OtherAttempt(text) => *text = hidden,
        GradeProblem::SeveralAttempts(ids, remedy) => {
            (*ids, *remedy) = (vec!["another attempt".to_owned()], hidden);
        }
    }
}

/// Returns whether the copy contains this submission.
pub fn is_shown(row: &ClassRow) -> bool {
    row.result.score().is_some() && !row.is_of_test_student() && !row.is_superseded()
}
