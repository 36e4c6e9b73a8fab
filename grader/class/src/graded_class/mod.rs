//! The data of a graded class. All files of the class are written from it.

use grader::policy::{CountedPoints, Policy, TaskPoints};

use crate::entry::Person;
use crate::late::{UnclearTime, is_undated, lateness};
use crate::manual_points::ManualPoints;
use crate::outcome::{EntryOutcome, EntryResult, ScoreSummary, TaskScore};

/// The results of a class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GradedClass {
    /// The exam's name.
    pub exam: String,
    /// The hash of the exam file.
    pub exam_hash: String,
    /// The isolation level used to grade the submissions.
    pub isolation: String,
    /// The submissions, in the order of their ids.
    pub rows: Vec<ClassRow>,
    /// The people on the rosters who submitted nothing.
    pub missing: Vec<Person>,
}

/// A submission's result and the grades of its people.
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
    pub counted: Option<CountedPoints>,
    /// Why a score has no final points.
    pub problem: Option<GradeProblem>,
    /// Whether the submission is treated as on time because its submission time is unknown.
    pub is_undated: bool,
    /// The manual points that staff gave.
    pub manual: Vec<ManualPoints>,
}

/// Why a score has no final points.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GradeProblem {
    /// It is unclear how late the submission is.
    #[error(transparent)]
    UnclearTime(UnclearTime),
    /// Another submission by the same person is used.
    #[error("the submission {0} of the same person counts")]
    OtherAttempt(String),
    /// The teacher hasn't chosen between several submissions by the same person.
    #[error(
        "{} of the same person could count as well: remove one, or set `counts` under [attempts] \
         in the policy",
        .0.join(" and ")
    )]
    SeveralAttempts(Vec<String>),
}

impl GradedClass {
    /// Returns the results with a score, except superseded attempts and Canvas's test student.
    pub fn scores(&self) -> impl Iterator<Item = (&EntryResult, &ScoreSummary)> {
        let counts = |row: &&ClassRow| !row.is_superseded() && !row.is_of_test_student();
        let rows = self.rows.iter().filter(counts);
        let results = rows.map(|row| &row.result);
        results.filter_map(|result| Some((result, result.score()?)))
    }

    /// Returns the exam's tasks, with the points of the first score. Empty if there are no scores.
    pub fn tasks(&self) -> &[TaskScore] {
        let first = self.rows.iter().find_map(|row| row.result.score());
        first.map_or(&[], |score| score.tasks.as_slice())
    }

    /// Returns the number of submissions that could not be graded because of a fault and have to be
    /// graded again.
    pub fn fault_count(&self) -> usize {
        let is_fault = |row: &&ClassRow| matches!(row.result.outcome, EntryOutcome::Fault(_));
        self.rows.iter().filter(is_fault).count()
    }
}

impl ClassRow {
    /// Creates the row of a result and applies the policy to its points. `manual` lists the manual
    /// points of each person. `max_points` is the exam's maximum.
    pub fn new(
        result: EntryResult,
        policy: &Policy,
        manual: Vec<Vec<ManualPoints>>,
        exam: &[TaskScore],
    ) -> Self {
        let grade = |(person, manual): (&Person, Vec<ManualPoints>)| {
            let earned = match &result.outcome {
                EntryOutcome::Graded(score) => Some(score.tasks.as_slice()),
                // Staff have looked at it, and their points count without any others.
                EntryOutcome::NothingToGrade(_) if manual.iter().any(|own| own.delta != 0) => {
                    Some(exam)
                }
                EntryOutcome::NothingToGrade(_) | EntryOutcome::Fault(_) => None,
            };
            let counted = earned.map(|tasks| {
                let lateness = lateness(policy, &result.info, person)?;
                let tasks = tasks.iter().map(|task| {
                    let own = manual.iter().filter(|points| points.task == task.id);
                    task.for_policy(own.map(|points| points.delta).sum())
                });
                Ok(policy.count(&tasks.collect::<Vec<TaskPoints>>(), lateness))
            });
            let (counted, problem) = match counted.transpose() {
                Ok(counted) => (counted, None),
                Err(unclear) => (None, Some(GradeProblem::UnclearTime(unclear))),
            };
            PersonGrade {
                is_undated: counted.is_some() && is_undated(policy, &result.info),
                counted,
                problem,
                manual,
            }
        };
        let grades = result.info.people.iter().zip(manual).map(grade).collect();
        ClassRow { result, grades }
    }

    /// Returns the people, each with their grade.
    pub fn people(&self) -> impl Iterator<Item = (&Person, &PersonGrade)> {
        self.result.info.people.iter().zip(&self.grades)
    }

    /// Returns sentences that explain how the score contributes to each person's grade. A sentence
    /// that applies to everyone doesn't contain names.
    pub fn counted_texts(&self) -> Vec<String> {
        let mut texts = self.merge(PersonGrade::explanation);
        texts.extend(self.correction().map(str::to_owned));
        texts
    }

    /// Returns a sentence about the files of a submission that was handed in again.
    pub fn correction(&self) -> Option<&'static str> {
        let sentence = "The files are those that were handed in again; the time is that of the first \
            submission.";
        self.result.info.is_corrected.then_some(sentence)
    }

    /// Returns notes for staff: why there are no final points or else how they were computed, the
    /// manual points, and the files that look like task files but were not graded.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = self.merge(|grade| {
            let problem = match self.why(grade) {
                why if why.is_empty() => None,
                why => Some(format!("{}: {why}", self.status(grade))),
            };
            // Without either, the table's columns are enough.
            let needs_words =
                |counted: &CountedPoints| counted.late_days > 0 || counted.manual != 0;
            let counted = grade
                .counted
                .as_ref()
                .filter(|counted| needs_words(counted));
            let counted = counted.filter(|_| grade.problem.is_none());
            let counted = counted.map(|counted| counted.explanation());
            let manual = grade.manual.iter().map(ToString::to_string);
            problem.into_iter().chain(counted).chain(manual).collect()
        });
        notes.extend(self.correction().map(str::to_owned));
        notes.extend_from_slice(self.result.ignored_copies());
        notes
    }

    /// Returns the texts about all grades, prefixed with names if they differ.
    fn merge(&self, texts: impl Fn(&PersonGrade) -> Vec<String>) -> Vec<String> {
        let all: Vec<Vec<String>> = self.grades.iter().map(texts).collect();
        let Some(first) = all.first() else {
            return Vec::new();
        };
        if all.iter().all(|texts| texts == first) {
            return first.clone();
        }
        let own = self.people().zip(&all).flat_map(|((person, _), texts)| {
            let name = person.display_name();
            texts.iter().map(move |text| format!("{name}: {text}"))
        });
        own.collect()
    }

    /// Returns whether other submissions are used for all of its people.
    pub fn is_superseded(&self) -> bool {
        let mut grades = self.grades.iter();
        let is_superseded =
            |grade: &PersonGrade| matches!(grade.problem, Some(GradeProblem::OtherAttempt(_)));
        !self.grades.is_empty() && grades.all(is_superseded)
    }

    /// Returns whether only the test student handed it in.
    fn is_of_test_student(&self) -> bool {
        let people = &self.result.info.people;
        !people.is_empty() && people.iter().all(Person::is_test_student)
    }

    /// Returns the first of its people's problems.
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
            (_, Some(GradeProblem::OtherAttempt(_))) => "another attempt counts",
            (_, Some(GradeProblem::SeveralAttempts(_))) => "several attempts",
            (EntryOutcome::NothingToGrade(_), None) if grade.counted.is_some() => "points by hand",
            (EntryOutcome::NothingToGrade(_), None) => "nothing to grade",
        }
    }

    /// Returns why the score or the final points are missing, or an empty string if neither is.
    pub fn why(&self, grade: &PersonGrade) -> String {
        match (&self.result.outcome, &grade.problem) {
            (EntryOutcome::Graded(_), None) => String::new(),
            (EntryOutcome::Graded(_), Some(problem)) => problem.to_string(),
            (EntryOutcome::NothingToGrade(_), Some(GradeProblem::UnclearTime(unclear))) => {
                unclear.to_string()
            }
            (EntryOutcome::NothingToGrade(why) | EntryOutcome::Fault(why), _) => why.clone(),
        }
    }
}

impl PersonGrade {
    /// Returns whether another attempt by the person is used or may still be chosen.
    pub fn is_set_aside(&self) -> bool {
        match &self.problem {
            Some(GradeProblem::OtherAttempt(_) | GradeProblem::SeveralAttempts(_)) => true,
            Some(GradeProblem::UnclearTime(_)) | None => false,
        }
    }

    /// Returns sentences that explain how the score contributes to the grade, and staff comments.
    /// Empty if the score is used unchanged.
    pub fn explanation(&self) -> Vec<String> {
        let counts = match (&self.problem, &self.counted) {
            (Some(problem), _) => Some(format!("No points count: {problem}.")),
            (None, Some(counted)) => counted.explanation_if_changed(),
            (None, None) => None,
        };
        let manual = self.manual.iter().map(ToString::to_string);
        counts.into_iter().chain(manual).collect()
    }
}

#[cfg(test)]
pub(crate) mod tests;
