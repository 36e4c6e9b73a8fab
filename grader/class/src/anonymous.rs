//! Pseudonyms, which let graders see a class without names. They are random, so only the key in the
//! output folder reveals whose they are. Later runs reuse them.

use std::collections::BTreeMap;
use std::hash::{BuildHasher, RandomState};

use crate::entry::{EntryInfo, Person};
use crate::error::Error;
use crate::graded_class::GradeProblem::{
    self, OtherAttempt, SeveralAttempts, UnclearPerson, UnclearTime,
};
use crate::graded_class::{ClassRow, GradedClass};
use crate::late;
use crate::store::{Store, json};

/// The name of the key in the output folder.
const KEY: &str = "anonymous-key.json";

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
        for row in &hidden.rows {
            // Each `RandomState` has random keys from the operating system.
            let random = || format!("anon-{:010x}", RandomState::new().hash_one(()) >> 24);
            let pseudonym = self.0.entry(row.result.id.clone());
            pseudonym.or_insert_with(random);
        }
        for row in &mut hidden.rows {
            self.hide_row(row);
        }
        // Sorting by name would give the names away.
        let rows = &mut hidden.rows;
        rows.sort_by(|one, other| one.result.id.cmp(&other.result.id));
        store.write(KEY, json(&self.0))?;
        Ok(hidden)
    }

    fn hide_row(&self, row: &mut ClassRow) {
        let pseudonym = self.of(&row.result.id);
        let person = |number: usize| match row.grades.len() {
            1 => Person::named(&pseudonym),
            _ => Person::named(format!("{pseudonym}, member {number}")),
        };
        row.result.info = EntryInfo {
            people: (1..=row.grades.len()).map(person).collect(),
            late: row.result.info.is_late(),
            is_corrected: row.result.info.is_corrected,
            from: pseudonym.clone(),
            ..EntryInfo::default()
        };
        for grade in &mut row.grades {
            grade.problem = grade.problem.take().map(|problem| self.hide_problem(problem));
            for points in &mut grade.manual {
                points.student.clone_from(&pseudonym);
            }
        }
        row.result.id = pseudonym;
    }

    /// Returns the problem without the names of people and submissions, and without times.
    fn hide_problem(&self, problem: GradeProblem) -> GradeProblem {
        let of = |id: String| match self.of(&id) {
            unknown if unknown.is_empty() => "without a score".to_owned(),
            pseudonym => pseudonym,
        };
        let why = "the person with the key can resolve this".to_owned();
        match problem {
            UnclearTime(time) => UnclearTime(late::UnclearTime { why, ..time }),
            UnclearPerson(_) => UnclearPerson(why),
            OtherAttempt(id) => OtherAttempt(of(id)),
            SeveralAttempts(ids, _) => SeveralAttempts(ids.into_iter().map(of).collect(), why),
        }
    }
}

/// Returns whether the copy contains this submission.
pub fn is_shown(row: &ClassRow) -> bool {
    row.result.score().is_some() && !row.is_of_test_student() && !row.is_superseded()
}
