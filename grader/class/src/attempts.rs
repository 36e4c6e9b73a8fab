//! Several submissions of one person: which of them counts, by the policy's rule.

use std::collections::BTreeSet;

use grader::policy::{AttemptRule, Policy, are_far_apart};

use crate::graded_class::{ClassRow, GradeProblem};
use crate::identity::{Attempt, attempts_by_person};
use crate::late::submission_time;
use crate::outcome::EntryOutcome;

/// Applies the policy's rule: of several attempts, only one keeps its points.
pub fn apply_rule(policy: &Policy, rows: &mut [ClassRow]) {
    let people = rows.iter().map(|row| row.result.info.people.as_slice());
    for attempts in attempts_by_person(people) {
        // A submission may list a person twice, or several people with one email address.
        let submissions: BTreeSet<usize> = attempts.iter().map(|(row, _)| *row).collect();
        if submissions.len() < 2 {
            continue;
        }
        let id = |row: &usize| rows[*row].result.id.clone();
        let chosen = choose(policy, rows, &attempts, &submissions);
        let problem = |row: &usize| match chosen {
            Some(chosen) => GradeProblem::OtherAttempt(id(&chosen)),
            None => {
                let others = submissions.iter().filter(|other| *other != row);
                GradeProblem::SeveralAttempts(others.map(id).collect())
            }
        };
        let set_aside = attempts.iter().filter(|(row, _)| chosen != Some(*row));
        let problems: Vec<(Attempt, GradeProblem)> = set_aside
            .map(|attempt| (*attempt, problem(&attempt.0)))
            .collect();
        for ((row, person), problem) in problems {
            let grade = &mut rows[row].grades[person];
            grade.counted = None;
            grade.problem = Some(problem);
        }
    }
}

/// Returns the submission that counts, or `None` if a person has to choose.
fn choose(
    policy: &Policy,
    rows: &[ClassRow],
    attempts: &[Attempt],
    submissions: &BTreeSet<usize>,
) -> Option<usize> {
    let mut candidates = Vec::new();
    for row in submissions {
        match &rows[*row].result.outcome {
            EntryOutcome::Graded(_) => candidates.push(*row),
            EntryOutcome::NothingToGrade(_) => {}
            // It is graded in the next run, and may then be the one that counts.
            EntryOutcome::Fault(_) => return None,
        }
    }
    if let [only] = candidates.as_slice() {
        return Some(*only).filter(|_| policy.attempts.counts != AttemptRule::Ask);
    }
    match policy.attempts.counts {
        AttemptRule::Ask => None,
        AttemptRule::Latest => {
            let time = |row: &usize| submission_time(policy, &rows[*row].result.info).ok()?;
            let times: Option<Vec<_>> = candidates.iter().map(time).collect();
            let times = times?;
            let (earliest, latest) = (times.iter().min()?, times.iter().max()?);
            if are_far_apart(*earliest, *latest) {
                return None;
            }
            let dated = candidates.iter().zip(&times);
            let mut last = dated.filter(|(_, time)| *time == latest);
            let (chosen, _) = last.next()?;
            // Of two at the same time, neither is the latest.
            last.next().is_none().then_some(*chosen)
        }
        AttemptRule::Best => {
            let points = |row: &usize| {
                let own = attempts.iter().filter(|attempt| attempt.0 == *row);
                let points = own.map(|(row, person)| rows[*row].grades[*person].counted);
                let points: Option<Vec<u32>> = points.map(|c| Some(c?.points)).collect();
                points?.into_iter().max()
            };
            let points: Option<Vec<u32>> = candidates.iter().map(points).collect();
            let points = points?;
            let most = points.iter().max()?;
            let best = points.iter().position(|points| points == most)?;
            Some(candidates[best])
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::entry::Person;
    use crate::graded_class::tests::{graded, person, policy, result};

    /// Returns a row for each submission: its id, its outcome and its time.
    fn rows(policy: &Policy, submissions: &[(&str, EntryOutcome, Option<&str>)]) -> Vec<ClassRow> {
        let row = |(id, outcome, time): &(&str, EntryOutcome, Option<&str>)| {
            let mut result = result(id, &["Ann"], outcome.clone());
            result.info.submitted = time.map(str::to_owned);
            ClassRow::new(result, policy, vec![Vec::new()], 100)
        };
        submissions.iter().map(row).collect()
    }

    /// Returns the points that count for each submission of one person, or why none count.
    fn counted(rule: &str, submissions: &[(&str, EntryOutcome, Option<&str>)]) -> Vec<String> {
        let policy = policy(&format!("[attempts]\ncounts = {rule:?}"));
        let mut rows = rows(&policy, submissions);
        apply_rule(&policy, &mut rows);
        let text = |row: &ClassRow| match (&row.grades[0].counted, &row.grades[0].problem) {
            (Some(counted), None) => counted.points.to_string(),
            (None, Some(GradeProblem::OtherAttempt(id))) => format!("see {id}"),
            (None, Some(GradeProblem::SeveralAttempts(ids))) => format!("or {}", ids.join(", ")),
            other => format!("{other:?}"),
        };
        rows.iter().map(text).collect()
    }

    fn nothing() -> EntryOutcome {
        EntryOutcome::NothingToGrade("empty".to_owned())
    }

    /// Three submissions: the first has the most points, and the second is the last.
    fn three() -> [(&'static str, EntryOutcome, Option<&'static str>); 3] {
        [
            ("a", graded(80), Some("2026-11-20T10:00:00Z")),
            ("b", graded(60), Some("2026-11-22T10:00:00Z")),
            ("c", graded(80), Some("2026-11-21T10:00:00Z")),
        ]
    }

    #[test]
    fn without_a_rule_a_person_chooses_among_all_attempts() {
        assert_eq!(counted("ask", &three()), ["or b, c", "or a, c", "or a, b"]);
        let with_nothing = [("a", graded(80), None), ("b", nothing(), None)];
        assert_eq!(counted("ask", &with_nothing), ["or b", "or a"]);
        assert_eq!(counted("ask", &three()[..1]), ["80"]);
    }

    #[test]
    fn the_latest_attempt_counts_if_all_times_are_known() {
        assert_eq!(counted("latest", &three()), ["see b", "60", "see b"]);
        let [a, b, _] = three();
        let undated = [a, b, ("c", graded(80), None)];
        assert_eq!(
            counted("latest", &undated),
            ["or b, c", "or a, c", "or a, b"]
        );
    }

    #[test]
    fn of_two_attempts_at_the_latest_time_a_person_chooses() {
        let [a, b, c] = three();
        let at = |attempt: &(&'static str, EntryOutcome, _), time| {
            (attempt.0, attempt.1.clone(), Some(time))
        };
        let latest = [a.clone(), b.clone(), at(&c, "2026-11-22T11:00:00+01:00")];
        assert_eq!(
            counted("latest", &latest),
            ["or b, c", "or a, c", "or a, b"]
        );
        let earliest = [a, b, at(&c, "2026-11-20T10:00:00Z")];
        assert_eq!(counted("latest", &earliest), ["see b", "60", "see b"]);
    }

    #[test]
    fn the_first_of_the_best_attempts_counts() {
        assert_eq!(counted("best", &three()), ["80", "see a", "see a"]);
        let [a, b, c] = three();
        assert_eq!(counted("best", &[b, c, a]), ["see c", "80", "see c"]);
    }

    #[test]
    fn an_attempt_that_was_not_graded_keeps_the_others_waiting() {
        let fault = EntryOutcome::Fault("disk".to_owned());
        let [a, b, _] = three();
        let attempts = [a, b, ("c", fault, Some("2026-11-19T10:00:00Z"))];
        for rule in ["best", "latest"] {
            assert_eq!(counted(rule, &attempts), ["or b, c", "or a, c", "or a, b"]);
        }
    }

    #[test]
    fn with_a_rule_an_attempt_without_files_does_not_count() {
        let attempts = [
            ("a", nothing(), Some("2026-11-23T10:00:00Z")),
            ("b", graded(60), None),
        ];
        for rule in ["best", "latest"] {
            assert_eq!(counted(rule, &attempts), ["see b", "60"]);
        }
        let nothing_at_all = [("a", nothing(), None), ("b", nothing(), None)];
        assert_eq!(counted("best", &nothing_at_all), ["or b", "or a"]);
    }

    #[test]
    fn points_whose_time_is_unclear_are_not_compared() {
        let attempts = [
            ("a", graded(80), Some("yesterday")),
            ("b", graded(60), None),
        ];
        assert_eq!(counted("best", &attempts), ["or b", "or a"]);
    }

    /// One of the years must be wrong.
    #[test]
    fn none_is_the_latest_of_times_that_are_far_apart() {
        let attempts = [
            ("a", graded(80), Some("2026-11-20T10:00:00Z")),
            ("b", graded(60), Some("2062-11-20T10:00:00Z")),
        ];
        assert_eq!(counted("latest", &attempts), ["or b", "or a"]);
    }

    #[test]
    fn attempts_of_different_people_do_not_compete() {
        let policy = Policy::default();
        let mut rows = rows(&policy, &three()[..2]);
        rows[1].result.info.people = vec![Person::named("Bob")];
        let before = rows.clone();
        apply_rule(&policy, &mut rows);
        assert_eq!(rows, before);
    }

    #[test]
    fn a_submission_that_lists_a_person_twice_is_one_attempt() {
        let twice = |mut row: ClassRow| {
            let person = person(json!({ "name": "Ann", "email": "a@x.edu" }));
            let partner = Person {
                name: "Bob".to_owned(),
                ..person.clone()
            };
            row.result.info.people = vec![person, partner];
            row.grades.push(row.grades[0].clone());
            row
        };
        let policy = Policy::default();
        let rows = rows(&policy, &three()[..2]);
        let mut rows: Vec<ClassRow> = rows.into_iter().map(twice).collect();
        let before = rows[0].clone();
        apply_rule(&policy, &mut rows[..1]);
        assert_eq!(rows[0], before);
        // Another submission is named, and not the same one.
        apply_rule(&policy, &mut rows);
        let others = |ids: &[&str]| {
            let ids = ids.iter().map(|id| (*id).to_owned());
            Some(GradeProblem::SeveralAttempts(ids.collect()))
        };
        for grade in &rows[0].grades {
            assert_eq!(grade.problem, others(&["b"]));
        }
    }
}
