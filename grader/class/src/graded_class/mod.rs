//! The data of a graded class. All files of the class are written from it.

use std::iter;

use grader::policy::{Extension, FinalPoints, Policy, TaskPoints};
use judging::sanitize::safe_folder_name;

use crate::entry::Person;
use crate::identity::distinct_name;
use crate::late::{UnclearTime, lateness};
use crate::manual_points::ManualPoints;
use crate::outcome::{EntryOutcome, EntryResult, ScoreSummary, TaskScore};
use crate::run::Settings;

/// The results of a class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GradedClass {
    /// The settings that the scores depend on.
    pub settings: Settings,
    /// The submissions, sorted by id.
    pub rows: Vec<ClassRow>,
    /// The people on the rosters who submitted nothing.
    pub missing: Vec<Person>,
}

/// A submission's result and the grades of the people who handed it in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassRow {
    /// The result of grading the submission.
    pub result: EntryResult,
    /// The grade of each person, in the order of `result.info.people`. Members of a group may have
    /// different extensions and manual points.
    pub grades: Vec<PersonGrade>,
}

/// One person's grade for a submission.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PersonGrade {
    /// The final points after applying the policy. `None` if there is no score or it isn't used.
    pub counted: Option<FinalPoints>,
    /// The reason there are no final points.
    pub problem: Option<GradeProblem>,
    /// The manual points that staff gave.
    pub manual: Vec<ManualPoints>,
}

/// The points and extensions that staff gave one person.
#[derive(Clone, Debug, Default)]
pub struct Adjustments {
    /// The manual points.
    pub manual: Vec<ManualPoints>,
    /// The extensions in the policy.
    pub extensions: Vec<Extension>,
}

/// The reason there are no final points.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GradeProblem {
    /// It is unclear how late the submission is.
    #[error(transparent)]
    UnclearTime(UnclearTime),
    /// It is unclear who handed in the submission.
    #[error("{0}")]
    UnclearPerson(String),
    /// Another submission by the same person is used.
    #[error("submission {0} from the same person counts instead")]
    OtherAttempt(String),
    /// The policy and the teacher haven't chosen between several submissions by the same
    /// person: the ids of the other submissions, and what to do.
    #[error("the same person also submitted {ids}: {1}", ids = .0.join(" and "))]
    SeveralAttempts(Vec<String>, String),
}

impl GradedClass {
    /// Returns the results that have a score, except for superseded attempts and submissions by
    /// Canvas's test student.
    pub fn scores(&self) -> impl Iterator<Item = (&EntryResult, &ScoreSummary)> {
        let counts = |row: &&ClassRow| !row.is_superseded() && !row.is_of_test_student();
        let rows = self.rows.iter().filter(counts);
        let results = rows.map(|row| &row.result);
        results.filter_map(|result| Some((result, result.score()?)))
    }

    /// Returns a person's name, with an identifier in brackets if others in the class share the name.
    pub fn distinct_name(&self, person: &Person) -> String {
        let people = self.rows.iter().flat_map(|row| &row.result.info.people);
        distinct_name(person, people.chain(&self.missing))
    }

    /// Returns this name in a form that is safe in file names.
    pub fn file_name(&self, person: &Person) -> String {
        safe_folder_name(&self.distinct_name(person).replace(['(', ')'], ""))
    }

    /// Returns the exam's tasks, including the points from the first score. The slice is empty if
    /// there are no scores.
    pub fn tasks(&self) -> &[TaskScore] {
        let first = self.rows.iter().find_map(|row| row.result.score());
        first.map_or(&[], |score| score.tasks.as_slice())
    }

    /// Returns the maximum of the final points. It is `None` if nobody has any.
    pub fn counts_max(&self) -> Option<u32> {
        let grades = self.rows.iter().flat_map(|row| &row.grades);
        let counted = grades.filter_map(|grade| grade.counted.as_ref());
        counted.map(|counted| counted.max_points).max()
    }

    /// Returns the number of submissions that could not be graded because of a fault and have to be
    /// graded again.
    pub fn fault_count(&self) -> usize {
        let is_fault = |row: &&ClassRow| matches!(row.result.outcome, EntryOutcome::Fault(_));
        self.rows.iter().filter(is_fault).count()
    }
}

impl ClassRow {
    /// Creates the row for a result and applies the policy to its points. `adjustments` are those of
    /// each person. `exam` contains the exam's tasks with their maximum points.
    pub fn new(
        result: EntryResult,
        policy: &Policy,
        adjustments: Vec<Adjustments>,
        exam: &[TaskScore],
    ) -> Self {
        let grade = |(person, own): (&Person, Adjustments)| {
            let Adjustments { manual, extensions } = own;
            let earned = match &result.outcome {
                EntryOutcome::Graded(score) => Some(score.tasks.as_slice()),
                // Staff have looked at the submission, so the points that they gave count even
                // without a score.
                EntryOutcome::NothingToGrade(_) if manual.iter().any(|own| own.delta != 0) => {
                    Some(exam)
                }
                EntryOutcome::NothingToGrade(_) | EntryOutcome::Fault(_) => None,
            };
            let counted = earned.map(|tasks| {
                let lateness = lateness(policy, &result.info, person, &extensions)?;
                let tasks = tasks.iter().map(|task| {
                    let own = manual.iter().filter(|points| points.task == task.id);
                    task.for_policy(own.map(|points| points.delta).sum())
                });
                Ok(policy.count(&tasks.collect::<Vec<TaskPoints>>(), lateness))
            });
            let (counted, problem) = match (counted.transpose(), &result.info.unclear_person) {
                (Ok(Some(_)), Some(why)) => (None, Some(GradeProblem::UnclearPerson(why.clone()))),
                (Ok(counted), _) => (counted, None),
                (Err(unclear), _) => (None, Some(GradeProblem::UnclearTime(unclear))),
            };
            PersonGrade {
                counted,
                problem,
                manual,
            }
        };
        let people = result.info.people.iter();
        let grades = people.zip(adjustments).map(grade).collect();
        ClassRow { result, grades }
    }

    /// Returns each person together with their grade.
    pub fn people(&self) -> impl Iterator<Item = (&Person, &PersonGrade)> {
        self.result.info.people.iter().zip(&self.grades)
    }

    /// Returns sentences that explain how the score contributes to each person's grade, for staff.
    /// A sentence that applies to everyone doesn't contain names.
    pub fn counted_texts(&self) -> Vec<String> {
        let mut texts = self.merge(PersonGrade::explanation);
        texts.extend(self.correction().map(str::to_owned));
        texts
    }

    /// Returns these sentences for a page that all members of a group can see. If they differ, the
    /// page must not show one member's points to another.
    pub fn texts_for_everyone(&self) -> Vec<String> {
        if !self.has_private_texts() {
            return self.counted_texts();
        }
        let note = "The members of this group have different final points, so this page doesn't show \
            them.";
        let texts = iter::once(note).chain(self.correction());
        texts.map(str::to_owned).collect()
    }

    /// Returns whether the members of the group have different grades or comments.
    pub fn has_private_texts(&self) -> bool {
        let mut all = self.grades.iter().map(PersonGrade::explanation);
        let first = all.next();
        !all.all(|texts| Some(texts) == first)
    }

    /// Returns a sentence about the files of a submission that was handed in again.
    pub fn correction(&self) -> Option<&'static str> {
        let sentence = "The files were handed in again, but the original submission time counts.";
        self.result.info.is_corrected.then_some(sentence)
    }

    /// Returns notes for staff: how the final points were computed (or why there are none), the
    /// manual points, and any files that look like task files but were not graded.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = self.merge(|grade| {
            let why = self.why(grade);
            let problem = (!why.is_empty()).then(|| format!("{}: {why}", self.status(grade)));
            let counted = grade.counted.iter().filter(|counted| {
                // Without late days or manual points, the table's columns are enough.
                (counted.late_days > 0 || counted.manual != 0) && grade.problem.is_none()
            });
            let counted = counted.map(FinalPoints::explanation);
            let manual = grade.manual.iter().map(ToString::to_string);
            problem.into_iter().chain(counted).chain(manual).collect()
        });
        notes.extend(self.correction().map(str::to_owned));
        notes.extend_from_slice(self.result.ignored_copies());
        notes
    }

    /// Returns the sentences about all grades. They are prefixed with names unless they are the
    /// same for everyone.
    fn merge(&self, texts: impl Fn(&PersonGrade) -> Vec<String>) -> Vec<String> {
        let all: Vec<Vec<String>> = self.grades.iter().map(texts).collect();
        if all.windows(2).all(|pair| pair[0] == pair[1]) {
            return all.into_iter().next().unwrap_or_default();
        }
        let own = self.people().zip(&all).flat_map(|((person, _), texts)| {
            let name = person.display_name();
            texts.iter().map(move |text| format!("{name}: {text}"))
        });
        own.collect()
    }

    /// Returns whether everyone in this row has another submission that is used instead.
    pub fn is_superseded(&self) -> bool {
        !self.grades.is_empty() && self.grades.iter().all(PersonGrade::is_superseded)
    }

    /// Returns whether only the test student handed in this submission.
    pub fn is_of_test_student(&self) -> bool {
        let people = &self.result.info.people;
        !people.is_empty() && people.iter().all(Person::is_test_student)
    }

    /// Returns the first problem with a person's grade, if any.
    pub fn problem(&self) -> Option<&GradeProblem> {
        self.grades.iter().find_map(|grade| grade.problem.as_ref())
    }

    /// Returns the status of one person's grade, as shown in tables.
    pub fn status(&self, grade: &PersonGrade) -> &'static str {
        match (&self.result.outcome, &grade.problem) {
            (EntryOutcome::Graded(_), None) => "graded",
            (EntryOutcome::Fault(_), None | Some(GradeProblem::UnclearTime(_))) => "not graded",
            (_, Some(GradeProblem::UnclearTime(unclear))) if unclear.is_draft => "draft",
            (_, Some(GradeProblem::UnclearTime(_))) => "time unclear",
            (_, Some(GradeProblem::UnclearPerson(_))) => "person unclear",
            (_, Some(GradeProblem::OtherAttempt(_))) => "another attempt counts",
            (_, Some(GradeProblem::SeveralAttempts(..))) => "several attempts",
            (EntryOutcome::NothingToGrade(_), None) if grade.counted.is_some() => "points by hand",
            (EntryOutcome::NothingToGrade(_), None) => "nothing to grade",
        }
    }

    /// Returns the reason that the score or the final points are missing, or an empty string if
    /// neither is missing.
    pub fn why(&self, grade: &PersonGrade) -> String {
        match (&self.result.outcome, &grade.problem) {
            (EntryOutcome::Graded(_), Some(problem))
            | (
                EntryOutcome::NothingToGrade(_),
                Some(problem @ (GradeProblem::UnclearTime(_) | GradeProblem::OtherAttempt(_))),
            ) => problem.to_string(),
            (outcome, _) => outcome.why().to_owned(),
        }
    }
}

impl PersonGrade {
    /// Returns whether another attempt by the person is used.
    pub fn is_superseded(&self) -> bool {
        matches!(self.problem, Some(GradeProblem::OtherAttempt(_)))
    }

    /// Returns whether the lateness is assumed, because the time isn't known.
    pub fn is_undated(&self) -> bool {
        self.counted.iter().any(|counted| counted.is_assumed)
    }

    /// Returns sentences that explain how the score contributes to the grade, followed by the
    /// staff's comments. No explanation is needed if the score is used unchanged.
    pub fn explanation(&self) -> Vec<String> {
        let counts = match (&self.problem, &self.counted) {
            (Some(problem @ GradeProblem::OtherAttempt(_)), _) => Some(format!(
                "None of the points count towards the grade: {problem}."
            )),
            // The other problems are for staff, and may name other people.
            (Some(_), _) => Some(
                "None of the points count yet: the course staff still have to review this submission."
                    .to_owned(),
            ),
            (None, Some(counted)) => counted.explanation_if_changed(),
            (None, None) => None,
        };
        let manual = self.manual.iter().map(ToString::to_string);
        counts.into_iter().chain(manual).collect()
    }
}

#[cfg(test)]
pub(crate) mod tests;
