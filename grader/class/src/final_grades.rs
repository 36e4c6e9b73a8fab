//! The final grades of the last run (after applying lateness, manual points and the policy), and
//! the changes since the previous run.

use std::collections::{BTreeMap, BTreeSet};

use clap::ValueEnum;
use grader::policy::Policy;
use serde::{Deserialize, Serialize};
use toml::Table;

use crate::entry::Person;
use crate::graded_class::{ClassRow, GradedClass, PersonGrade};
use crate::list_kind::ListKind;
use crate::names::with_detail;
use crate::outcome::{EntryOutcome, id_and_names};
use crate::run::{Run, Settings};

/// The name of the file with the final grades in the output folder.
pub const FILE: &str = "final-grades.json";

/// The final grades of the last run, and the grades they are compared with. A run that changes
/// nothing keeps both, so repeating a killed run lists the same changes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct GradeHistory {
    /// The final grades to compare with, or `None` in a new folder.
    before: Option<FinalGrades>,
    /// The final grades of the last run.
    now: FinalGrades,
}

/// The final grades of a run and everything they depend on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FinalGrades {
    /// The grading round. A regrade is compared with the grades from the round before it.
    round: u32,
    settings: Settings,
    lists: BTreeMap<ListKind, String>,
    /// The text of the policy. Empty if there is none.
    policy: String,
    /// Whether some submissions were not graded because of a fault. Their earlier grades are kept.
    is_incomplete: bool,
    grades: Vec<FinalGrade>,
}

/// One person's final grade for a submission.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct FinalGrade {
    submission: String,
    person: Person,
    status: String,
    /// The final points and their maximum, or `None` for a submission without final points.
    counts: Option<[u32; 2]>,
    /// The graded points, or `None` if the submission wasn't graded.
    graded: Option<u32>,
    /// The manual points, even if there are no final points.
    manual: i32,
    late_days: u32,
    is_corrected: bool,
}

/// The final grades that changed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GradeChanges {
    /// The settings and lists that changed.
    pub causes: Vec<&'static str>,
    /// Sentences about the changes. Each names the submission, the person and the cause.
    pub changes: Vec<String>,
}

impl GradeChanges {
    /// Returns whether nothing changed: no final grade, and nothing that final grades depend on.
    pub fn is_empty(&self) -> bool {
        self.causes.is_empty() && self.changes.is_empty()
    }
}

impl GradeHistory {
    /// Returns whether a submission counts for a person, unless the person hasn't been graded.
    pub fn counts(&self, submission: &str, person: &Person) -> bool {
        let mut grades = self.now.of(submission);
        grades.any(|grade| grade.person.is_same(person))
    }

    /// Returns the history after a run with this policy, which is given as text.
    pub fn after(earlier: Option<Self>, run: &Run, class: &GradedClass, policy: String) -> Self {
        let last = earlier.as_ref().map(|earlier| &earlier.now);
        let lists = run.lists.iter();
        let lists = lists.map(|(kind, list)| (*kind, list.hash.clone()));
        let now = FinalGrades {
            round: run.round,
            settings: run.settings.clone(),
            lists: lists.collect(),
            policy,
            is_incomplete: class.fault_count() > 0,
            grades: final_grades(&class.rows, last),
        };
        let before = match earlier {
            Some(earlier) if earlier.now == now => return earlier,
            // Compare with the same grades until all submissions are graded.
            Some(earlier) if earlier.now.is_incomplete && earlier.before.is_some() => {
                earlier.before
            }
            earlier => earlier.map(|earlier| earlier.now),
        };
        GradeHistory { before, now }
    }

    /// Returns whether the grades haven't changed since the last regrade.
    pub fn is_of_regrade(&self) -> bool {
        let before = self.before.as_ref();
        before.is_none_or(|before| before.round != self.now.round)
    }

    /// Returns whether the grades to compare with include no other score for this submission.
    pub fn is_since(&self, submission: &str, points: u32) -> bool {
        let before = self.before.iter();
        let mut grades = before.flat_map(|before| before.of(submission));
        grades.all(|own| own.graded == Some(points))
    }

    /// Returns the changes, or `None` if there is nothing to compare with. `recount` applies a
    /// different policy to the class. A setting is the cause of a change if the grade would be
    /// different with the setting's earlier value.
    pub fn changes(&self, recount: impl Fn(&Policy) -> Vec<ClassRow>) -> Option<GradeChanges> {
        let before = self.before.as_ref()?;
        let mut causes = before.settings.differences(&self.now.settings);
        let differs = |kind: &&ListKind| before.lists.get(kind) != self.now.lists.get(kind);
        let kinds = ListKind::value_variants().iter().filter(differs);
        causes.extend(kinds.map(|kind| kind.title()));
        let policy = ListKind::Policy.title();
        let others = causes.iter().filter(|cause| **cause != policy);
        let others = others.map(|cause| ((*cause).to_owned(), None));
        let settings = changed_settings(&before.policy, &self.now.policy).into_iter();
        let settings = settings.map(|(setting, policy)| {
            let grades = final_grades(&recount(&policy), Some(&self.now));
            let now = self.now.clone();
            (setting, Some(FinalGrades { grades, ..now }))
        });
        let all = Vec::from_iter(settings.chain(others));
        let changes = self.now.grades.iter();
        let changes = changes.filter_map(|now| before.change_to(now, &self.now, &all));
        let gone = before.grades.iter().filter_map(|was| self.now.loss(was));
        let changes = changes.chain(gone).collect();
        Some(GradeChanges { causes, changes })
    }
}

/// The name of a setting or list that changed. If it is a setting of the policy, the grades without
/// its change.
type Cause = (String, Option<FinalGrades>);

/// Returns everybody's final grades. If a submission was not graded because of a fault, its grades
/// in `last` are kept.
fn final_grades(rows: &[ClassRow], last: Option<&FinalGrades>) -> Vec<FinalGrade> {
    let mut grades = Vec::new();
    for row in rows {
        if let EntryOutcome::Fault(_) = row.result.outcome {
            let earlier = last.iter().flat_map(|last| last.of(&row.result.id));
            grades.extend(earlier.cloned());
        } else {
            // The attempt that counts instead has a grade of its own.
            let people = row.people().filter(|(_, grade)| !grade.is_superseded());
            grades.extend(people.map(|(person, grade)| FinalGrade::new(row, person, grade)));
        }
    }
    grades
}

/// Returns the settings that differ between two policies, which are given as text. Each comes with
/// the policy `now`, but with the setting's value from `before`. The first item is the whole policy
/// `before`.
fn changed_settings(before: &str, now: &str) -> Vec<(String, Policy)> {
    let [before, now] = [before, now].map(|text| text.parse::<Table>().unwrap_or_default());
    let mut changed = vec![(ListKind::Policy.title().to_owned(), before.clone())];
    let mut keys = BTreeSet::new();
    for (section, settings) in before.iter().chain(&now) {
        let settings = settings.as_table().into_iter().flatten();
        keys.extend(settings.map(|(key, _)| (section, key)));
    }
    for (section, key) in keys {
        let [was, is] = [&before, &now].map(|all| all.get(section)?.get(key));
        let mut mixed = now.clone();
        let settings = mixed.entry(section).or_insert(Table::new().into());
        if let Some(settings) = settings.as_table_mut().filter(|_| was != is) {
            settings.remove(key);
            settings.extend(was.map(|was| (key.clone(), was.clone())));
            changed.push((format!("`{key}` in the policy"), mixed));
        }
    }
    let changed = changed.into_iter();
    let changed = changed.filter_map(|(setting, all)| Some((setting, all.try_into().ok()?)));
    changed.collect()
}

impl FinalGrades {
    fn of<'a>(&'a self, submission: &'a str) -> impl Iterator<Item = &'a FinalGrade> {
        let grades = self.grades.iter();
        grades.filter(move |grade| grade.submission == submission)
    }

    /// Returns a sentence about how a grade changed. `now` is a grade in `after`. It is compared
    /// with this run's grade for the same person and submission or, if there is none, with the
    /// person's grade for a submission that no longer has one in `after`. If a person hands in an
    /// additional submission, that doesn't count as a change.
    fn change_to(&self, now: &FinalGrade, after: &Self, causes: &[Cause]) -> Option<String> {
        let is_gone = |was: &&FinalGrade| after.find(was).is_none();
        let own = || self.of_person(&now.person).filter(is_gone);
        let other = || own().max_by_key(|was| was.counts.is_some());
        if let Some(was) = self.find(now).or_else(other) {
            return (was.counts != now.counts).then(|| now.change(was, causes));
        }
        self.of(&now.submission).next()?;
        now.counts.map(|_| {
            let why = "the submission now counts for this person as well";
            now.changed("–", &now.value(false), why)
        })
    }

    fn of_person(&self, person: &Person) -> impl Iterator<Item = &FinalGrade> {
        let grades = self.grades.iter();
        grades.filter(|own| own.person.is_same(person))
    }

    /// Returns a sentence about an earlier grade that is missing from this run although its
    /// submission is still present.
    fn loss(&self, was: &FinalGrade) -> Option<String> {
        self.of(&was.submission).next()?;
        let is_lost = self.find(was).is_none() && self.of_person(&was.person).next().is_none();
        (was.counts.is_some() && is_lost).then(|| {
            let why = "the submission no longer counts for this person";
            was.changed(&was.value(false), "–", why)
        })
    }

    /// Returns this run's grade for the same person and submission.
    fn find(&self, grade: &FinalGrade) -> Option<&FinalGrade> {
        let is_same = |own: &&FinalGrade| {
            let mut names = own.person.identifiers();
            own.person.is_same(&grade.person)
                || names.any(|name| grade.person.identifiers().any(|other| other == name))
        };
        let grades = self.grades.iter();
        let mut own = grades.filter(|own| own.submission == grade.submission);
        own.find(is_same)
    }
}

impl FinalGrade {
    fn new(row: &ClassRow, person: &Person, grade: &PersonGrade) -> Self {
        let counted = grade.counted.as_ref();
        FinalGrade {
            submission: row.result.id.clone(),
            person: person.clone(),
            status: row.status(grade).to_owned(),
            counts: counted.map(|counted| [counted.points, counted.max_points]),
            graded: row.result.score().map(|score| score.points),
            manual: grade.manual.iter().map(|points| points.delta).sum(),
            late_days: counted.map_or(0, |counted| counted.late_days),
            is_corrected: row.result.info.is_corrected,
        }
    }

    /// Returns the points as text, or the reason there are none.
    fn value(&self, with_maximum: bool) -> String {
        match self.counts {
            Some([points, of]) if with_maximum => format!("{points} of {of}"),
            Some([points, _]) => points.to_string(),
            None => format!("no points ({})", self.status),
        }
    }

    fn change(&self, was: &FinalGrade, causes: &[Cause]) -> String {
        let maxima = [was, self].map(|grade| grade.counts.map(|[_, of]| of));
        let with_maximum = maxima[0] != maxima[1] && maxima.iter().all(Option::is_some);
        let mut why = Vec::new();
        let is_same = was.submission == self.submission;
        if !is_same && self.counts.is_some() {
            why.push(format!("this attempt counts instead of {}", was.submission));
        } else if !is_same {
            why.push(format!("this attempt replaces {}", was.submission));
        }
        match (was.graded, self.graded) {
            (Some(was), Some(now)) if was != now => why.push(format!("graded {was} → {now}")),
            (None, Some(now)) if is_same => why.push(format!("now graded {now}")),
            (Some(was), None) if is_same => why.push(format!("previously graded {was}")),
            _ => {}
        }
        if !was.is_corrected && self.is_corrected {
            why.push("the files were handed in again".to_owned());
        } else if was.is_corrected && !self.is_corrected {
            why.push("the corrected files are no longer used".to_owned());
        }
        let (before, now) = (was.manual, self.manual);
        if before != now {
            why.push(format!("manual points {before:+} → {now:+}"));
        }
        let (before, now) = (was.late_days, self.late_days);
        if before != now && was.counts.is_some() && self.counts.is_some() {
            why.push(format!("days late {before} → {now}"));
        }
        let counts = |grades: &FinalGrades| grades.find(self).map(|grade| grade.counts);
        let is_cause = |(_, without): &&Cause| {
            let mut without = without.iter().map(counts);
            without.any(|counts| counts != Some(self.counts))
        };
        let settings = causes.iter().filter(is_cause).map(|(name, _)| name.clone());
        let settings = Vec::from_iter(settings);
        // The whole policy comes first, and is only named if no single setting makes a difference.
        let first = usize::from(settings.len() > 1);
        why.extend_from_slice(&settings[first..]);
        if why.is_empty() {
            let others = causes.iter().filter(|(_, without)| without.is_none());
            why.extend(others.map(|(name, _)| name.clone()));
        }
        let (was, now) = (was.value(with_maximum), self.value(with_maximum));
        self.changed(&was, &now, &why.join(", "))
    }

    /// Returns a sentence about a change. It contains the points before and after the change (or
    /// the reason there are none) and the cause.
    fn changed(&self, was: &str, now: &str, why: &str) -> String {
        let who = id_and_names(&self.submission, self.person.display_name());
        with_detail(&format!("{who}: {was} → {now}"), why)
    }
}
