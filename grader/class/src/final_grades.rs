//! The final grades of the last run (after applying lateness, manual points and the policy), and
//! the changes since the previous run.

use std::collections::BTreeMap;

use clap::ValueEnum;
use grader::policy::FinalPoints;
use serde::{Deserialize, Serialize};

use crate::entry::{ListedTime, Person};
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
    #[serde(default)]
    is_corrected: bool,
    /// How the policy's items and tasks differ from those in the exam.
    #[serde(default)]
    changes: Vec<String>,
    /// The policy's rules that apply to the submission.
    #[serde(default)]
    rules: Option<String>,
    /// The submission time from a list.
    #[serde(default)]
    listed: Option<ListedTime>,
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

    /// Returns the history after a run.
    pub fn after(earlier: Option<GradeHistory>, run: &Run, class: &GradedClass) -> Self {
        let last = earlier.as_ref().map(|earlier| &earlier.now);
        let now = FinalGrades::new(run, class, last);
        let Some(earlier) = earlier else {
            return GradeHistory { before: None, now };
        };
        if earlier.now == now {
            return earlier;
        }
        let before = match earlier.before {
            // Compare with the same grades until all submissions are graded.
            Some(before) if earlier.now.is_incomplete => before,
            Some(_) | None => earlier.now,
        };
        GradeHistory {
            before: Some(before),
            now,
        }
    }

    /// Returns the changes, or `None` if there is nothing to compare with.
    pub fn changes(&self) -> Option<GradeChanges> {
        let before = self.before.as_ref()?;
        let mut causes = before.settings.differences(&self.now.settings);
        let differs = |kind: &&ListKind| before.lists.get(kind) != self.now.lists.get(kind);
        let kinds = ListKind::value_variants().iter().filter(differs);
        causes.extend(kinds.map(|kind| kind.title()));
        let changes = self.now.grades.iter();
        let changes = changes.filter_map(|now| before.change_to(now, &self.now, &causes));
        let gone = before.grades.iter().filter_map(|was| self.now.loss(was));
        let changes = changes.chain(gone).collect();
        Some(GradeChanges { causes, changes })
    }
}

impl FinalGrades {
    fn new(run: &Run, class: &GradedClass, last: Option<&FinalGrades>) -> Self {
        let mut grades = Vec::new();
        for row in &class.rows {
            if let EntryOutcome::Fault(_) = row.result.outcome {
                let earlier = last.iter().flat_map(|last| last.of(&row.result.id));
                grades.extend(earlier.cloned());
            } else {
                // The attempt that counts instead has a grade of its own.
                let people = row.people().filter(|(_, grade)| !grade.is_superseded());
                grades.extend(people.map(|(person, grade)| FinalGrade::new(row, person, grade)));
            }
        }
        let lists = run.lists.iter();
        let lists = lists.map(|(kind, list)| (*kind, list.hash.clone()));
        FinalGrades {
            round: run.round,
            settings: run.settings.clone(),
            lists: lists.collect(),
            is_incomplete: class.fault_count() > 0,
            grades,
        }
    }

    fn of<'a>(&'a self, submission: &'a str) -> impl Iterator<Item = &'a FinalGrade> {
        let grades = self.grades.iter();
        grades.filter(move |grade| grade.submission == submission)
    }

    /// Returns a sentence about how a grade changed. `now` is a grade in `after`. It is compared
    /// with this run's grade for the same person and submission or, if there is none, with the
    /// person's grade for a submission that no longer has one in `after`. If a person hands in an
    /// additional submission, that doesn't count as a change.
    fn change_to(&self, now: &FinalGrade, after: &Self, causes: &[&str]) -> Option<String> {
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
            own.person == grade.person
                || own.person.matches(&grade.person)
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
            changes: counted.map_or_else(Vec::new, |counted| counted.changes.clone()),
            rules: counted.and_then(FinalPoints::rules),
            listed: row.result.info.listed.clone(),
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

    fn change(&self, was: &FinalGrade, causes: &[&str]) -> String {
        let maximum = |grade: &FinalGrade| grade.counts.map(|[_, of]| of);
        let maxima = [was, self].map(maximum);
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
        }
        if was.manual != self.manual {
            why.push(format!(
                "manual points {:+} → {:+}",
                was.manual, self.manual
            ));
        }
        let both_count = was.counts.is_some() && self.counts.is_some();
        if both_count {
            if was.late_days != self.late_days {
                why.push(format!("days late {} → {}", was.late_days, self.late_days));
            }
            let is_new = |change: &&String| !was.changes.contains(change);
            why.extend(self.changes.iter().filter(is_new).cloned());
            // A sentence about the same item or task replaces the earlier sentence.
            let subject = |change: &String| change.split(' ').next().map(str::to_owned);
            let subjects: Vec<_> = self.changes.iter().map(subject).collect();
            let withdrawn = was.changes.iter();
            let withdrawn = withdrawn.filter(|old| !subjects.contains(&subject(old)));
            why.extend(withdrawn.map(|old| format!("\"{old}\" no longer applies")));
        }
        let policy = ListKind::Policy.title();
        let is_same_case = (was.late_days, &was.changes) == (self.late_days, &self.changes);
        if why.is_empty() {
            // Manual points and lateness are the same, so the lists of people can only decide
            // whether there are any points.
            let has_new_data =
                !both_count && (&was.person, &was.listed) != (&self.person, &self.listed);
            let can_matter = |kind: &&ListKind| {
                **kind == ListKind::Policy || (has_new_data && **kind != ListKind::ManualPoints)
            };
            let lists = ListKind::value_variants().iter().filter(can_matter);
            let mut own: Vec<&str> = lists.map(|kind| kind.title()).collect();
            own.retain(|list| causes.contains(list));
            let own = if own.is_empty() { causes } else { &own };
            why.extend(own.iter().map(|cause| (*cause).to_owned()));
        } else if both_count && is_same_case && was.rules != self.rules && causes.contains(&policy)
        {
            why.push(policy.to_owned());
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
