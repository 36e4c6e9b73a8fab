//! Computes the final points of all submissions according to the policy, including manual points.
//! If a person has several submissions, the policy's rule decides which one is used.

use std::collections::BTreeSet;

use grader::policy::{AttemptRule, Policy, are_far_apart};

use crate::error::Error;
use crate::graded_class::GradeProblem::{self, OtherAttempt, SeveralAttempts};
use crate::graded_class::{Adjustments, ClassRow};
use crate::identity::{Attempt, attempts_by_person};
use crate::late::{policy_extensions, submission_time};
use crate::manual_points::ManualPointsList;
use crate::outcome::{EntryOutcome, EntryResult, TaskScore};

/// Applies the policy and the manual points to all results. `exam` contains the exam's tasks with 0
/// points each.
pub fn count_points(
    results: Vec<EntryResult>,
    policy: &Policy,
    manual: &ManualPointsList,
    exam: &[TaskScore],
) -> Vec<ClassRow> {
    let infos = results.iter();
    let infos = infos.map(|result| (result.id.as_str(), &result.info));
    let mut extensions = policy_extensions(policy, &Vec::from_iter(infos));
    let mut rows = Vec::new();
    for (row, result) in results.into_iter().enumerate() {
        let own = (0..result.info.people.len()).map(|person| Adjustments {
            manual: manual.of(&result.id, person).to_owned(),
            extensions: extensions.remove(&(row, person)).unwrap_or_default(),
        });
        let own = own.collect();
        rows.push(ClassRow::new(result, policy, own, exam));
    }
    apply_rule(policy, &mut rows);
    rows
}

/// Prints a warning for each row of manual points that has no effect. Checks that the others are in
/// the range of their tasks.
pub fn check_manual_points(
    rows: &[ClassRow],
    manual: &ManualPointsList,
    exam: &[TaskScore],
) -> Result<(), Error> {
    for row in rows {
        for (person, grade) in row.grades.iter().enumerate() {
            match grade.problem {
                Some(OtherAttempt(_)) => {
                    manual.warn_about_attempt(manual.of(&row.result.id, person));
                }
                Some(SeveralAttempts(..)) => {}
                None | Some(GradeProblem::UnclearTime(_) | GradeProblem::UnclearPerson(_)) => {
                    manual.check_range(&grade.manual, &row.result.outcome, exam)?;
                }
            }
        }
    }
    Ok(())
}

/// Applies the policy's rule: only one of several attempts keeps its points.
fn apply_rule(policy: &Policy, rows: &mut [ClassRow]) {
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
            Some(chosen) => OtherAttempt(id(&chosen)),
            None => {
                let others = submissions.iter().filter(|other| *other != row);
                SeveralAttempts(others.map(id).collect(), remedy(policy, rows, &submissions))
            }
        };
        let set_aside = attempts.iter().filter(|(row, _)| chosen != Some(*row));
        let problems = set_aside.map(|attempt| (*attempt, problem(&attempt.0)));
        let problems: Vec<(Attempt, GradeProblem)> = problems.collect();
        for ((row, person), problem) in problems {
            let grade = &mut rows[row].grades[person];
            grade.counted = None;
            if chosen.is_some() {
                // Manual points apply to the attempt that counts.
                grade.manual.clear();
            }
            grade.problem = Some(problem);
        }
    }
}

/// Returns the submission to use, or `None` if a person has to choose.
fn choose(
    policy: &Policy,
    rows: &[ClassRow],
    attempts: &[Attempt],
    submissions: &BTreeSet<usize>,
) -> Option<usize> {
    let outcome = |row: &usize| &rows[*row].result.outcome;
    // A submission that could not be graded is graded in the next run and may then be the one to
    // use.
    let mut outcomes = submissions.iter().map(outcome);
    if outcomes.any(|outcome| matches!(outcome, EntryOutcome::Fault(_))) {
        return None;
    }
    let mut candidates = Vec::from_iter(submissions.iter().copied());
    match policy.attempts.counts {
        AttemptRule::Ask => None,
        // If the latest attempt can't be graded, the student is asked for its files. Silently using
        // an older attempt could cost the student points.
        AttemptRule::Latest => {
            let info = |row: &usize| &rows[*row].result.info;
            // Attempt numbers from different groups say nothing about the order.
            let people = &info(candidates.first()?).people;
            let number = |row: &usize| info(row).attempt.filter(|_| info(row).people == *people);
            if let Some(numbers) = candidates.iter().map(number).collect::<Option<Vec<u32>>>() {
                return only_last(&candidates, &numbers);
            }
            let time = |row: &usize| submission_time(policy, info(row)).ok()?;
            let times: Option<Vec<_>> = candidates.iter().map(time).collect();
            let times = times?;
            let (earliest, latest) = (times.iter().min()?, times.iter().max()?);
            if are_far_apart(*earliest, *latest) {
                return None;
            }
            only_last(&candidates, &times)
        }
        AttemptRule::Best => {
            candidates.retain(|row| matches!(outcome(row), EntryOutcome::Graded(_)));
            if let [only] = candidates.as_slice() {
                return Some(*only);
            }
            if share_a_late_time(rows, attempts, &candidates) {
                return None;
            }
            let mut best: Option<(u32, usize)> = None;
            for (row, person) in attempts.iter().filter(|(row, _)| candidates.contains(row)) {
                let points = rows[*row].grades[*person].counted.as_ref()?.points;
                if best.is_none_or(|(most, _)| points > most) {
                    best = Some((points, *row));
                }
            }
            Some(best?.1)
        }
    }
}

/// Returns whether several of the candidates have the same time from a list, and are late according
/// to it. The list then gives the time of the last attempt, and earlier ones may not be late.
fn share_a_late_time(rows: &[ClassRow], attempts: &[Attempt], candidates: &[usize]) -> bool {
    let is_late_by_list = |(row, person): &&Attempt| {
        let row = &rows[*row];
        let counted = row.grades[*person].counted.as_ref();
        let is_late = counted.is_some_and(|counted| counted.late_days > 0);
        is_late && row.result.info.submitted.is_none() && row.result.info.listed.is_some()
    };
    let late = attempts.iter().filter(is_late_by_list);
    let late = late.map(|(row, _)| *row);
    BTreeSet::from_iter(late.filter(|row| candidates.contains(row))).len() > 1
}

/// Returns what to do if the policy cannot choose between these submissions.
fn remedy(policy: &Policy, rows: &[ClassRow], submissions: &BTreeSet<usize>) -> String {
    let rule = policy.attempts.counts;
    let needing_time = submissions.iter().filter(|_| rule != AttemptRule::Ask);
    let mut times = needing_time.map(|row| submission_time(policy, &rows[*row].result.info));
    let remedy = match rule {
        AttemptRule::Ask => "remove all but one, or set `counts` under [attempts] in the policy",
        AttemptRule::Latest => "`latest` cannot tell which attempt is the last: remove all but one",
        AttemptRule::Best => {
            "`best` cannot compare attempts if one of them has no points, or if a list gives the \
             same late time for several: remove all but one"
        }
    };
    let unclear = times.find_map(Result::err);
    unclear.map_or(remedy.to_owned(), |unclear| unclear.why)
}

/// Returns the candidate with the latest time or the highest number. If two candidates are tied,
/// returns `None`.
fn only_last<T: Ord>(candidates: &[usize], keys: &[T]) -> Option<usize> {
    let latest = keys.iter().max()?;
    let all = candidates.iter().zip(keys);
    let mut last = all.filter(|(_, key)| *key == latest);
    let (chosen, _) = last.next()?;
    last.next().is_none().then_some(*chosen)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::entry::{ListedTime, Person};
    use crate::graded_class::tests::{fault, graded, nothing, person, policy, result};

    /// Returns a row for each submission, given its id, outcome and time.
    fn rows(policy: &Policy, submissions: &[(&str, EntryOutcome, Option<&str>)]) -> Vec<ClassRow> {
        let row = |(id, outcome, time): &(&str, EntryOutcome, Option<&str>)| {
            let mut result = result(id, &["Ann"], outcome.clone());
            result.info.submitted = time.map(str::to_owned);
            ClassRow::new(result, policy, vec![Adjustments::default()], &[])
        };
        submissions.iter().map(row).collect()
    }

    /// Returns the final points for each of a person's submissions, or the reason it has none.
    fn counted(rule: &str, submissions: &[(&str, EntryOutcome, Option<&str>)]) -> Vec<String> {
        let policy = policy(&format!("[attempts]\ncounts = {rule:?}"));
        let mut rows = rows(&policy, submissions);
        apply_rule(&policy, &mut rows);
        let text = |row: &ClassRow| match (&row.grades[0].counted, &row.grades[0].problem) {
            (Some(counted), None) => counted.points.to_string(),
            (None, Some(GradeProblem::OtherAttempt(id))) => format!("see {id}"),
            (None, Some(GradeProblem::SeveralAttempts(ids, _))) => format!("or {}", ids.join(", ")),
            other => format!("{other:?}"),
        };
        rows.iter().map(text).collect()
    }

    /// Three submissions: the first earned the most points, and the second is the last.
    fn three() -> [(&'static str, EntryOutcome, Option<&'static str>); 3] {
        [
            ("a", graded(80), Some("2026-11-20T10:00:00Z")),
            ("b", graded(60), Some("2026-11-22T10:00:00Z")),
            ("c", graded(80), Some("2026-11-21T10:00:00Z")),
        ]
    }

    #[test]
    fn the_rule_decides_if_everything_that_it_needs_is_known() {
        let [a, b, c] = three();
        let at = |attempt: &(&'static str, EntryOutcome, _), time| {
            (attempt.0, attempt.1.clone(), Some(time))
        };
        let is_open = ["or b, c", "or a, c", "or a, b"];
        let last_at_once = at(&c, "2026-11-22T11:00:00+01:00");
        let first_at_once = at(&c, "2026-11-20T10:00:00Z");
        let undated = ("c", graded(80), None);
        let failed = ("c", fault(), Some("2026-11-19T10:00:00Z"));
        for (rule, third, expected) in [
            ("ask", &c, is_open),
            ("latest", &c, ["see b", "60", "see b"]),
            ("latest", &undated, is_open),
            // If two attempts share the latest time, a person has to choose.
            ("latest", &last_at_once, is_open),
            ("latest", &first_at_once, ["see b", "60", "see b"]),
            // Of several best attempts, the first is used.
            ("best", &c, ["80", "see a", "see a"]),
            // The failed attempt is graded in the next run.
            ("best", &failed, is_open),
            ("latest", &failed, is_open),
        ] {
            let attempts = [a.clone(), b.clone(), third.clone()];
            assert_eq!(counted(rule, &attempts), expected, "{rule} {third:?}");
        }
        assert_eq!(counted("ask", &three()[..1]), ["80"]);
        assert_eq!(counted("best", &[b, c, a]), ["see c", "80", "see c"]);
    }

    #[test]
    fn one_late_time_on_a_list_is_not_that_of_every_attempt() {
        let policy = policy("[late]\ndue = 2026-11-20T12:00:00Z\n[attempts]\ncounts = \"best\"");
        let chosen = |time: &str, own: Option<&str>| {
            let listed = ListedTime {
                submitted: time.to_owned(),
                late: false,
            };
            let row = |(id, own): (&str, Option<&str>)| {
                let mut result = result(id, &["Ann"], graded(80));
                result.info.submitted = own.map(str::to_owned);
                result.info.listed = Some(listed.clone());
                ClassRow::new(result, &policy, vec![Adjustments::default()], &[])
            };
            let mut rows = [("a", own), ("b", None)].map(row);
            apply_rule(&policy, &mut rows);
            rows.map(|row| row.grades[0].counted.is_some())
        };
        assert_eq!(chosen("2026-11-22T12:00:00Z", None), [false, false]);
        assert_eq!(chosen("2026-11-19T12:00:00Z", None), [true, false]);
        let own = Some("2026-11-19T12:00:00Z");
        assert_eq!(chosen("2026-11-22T12:00:00Z", own), [true, false]);
    }

    #[test]
    fn of_two_attempts_one_may_be_without_files_or_a_time() {
        let is_open = ["or b", "or a"];
        let empty_at = |time| ("a", nothing(), time);
        let graded_at = |time| ("a", graded(80), time);
        let empty = ("b", nothing(), None);
        let undated = ("b", graded(60), None);
        let dated = ("b", graded(60), Some("2026-11-22T10:00:00Z"));
        let future = ("b", graded(60), Some("2062-11-20T10:00:00Z"));
        for (rule, attempts, expected) in [
            ("ask", [graded_at(None), empty.clone()], is_open),
            // An attempt without files is never the best, but it can be the latest.
            (
                "best",
                [empty_at(Some("2026-11-23T10:00:00Z")), undated.clone()],
                ["see b", "60"],
            ),
            (
                "latest",
                [empty_at(Some("2026-11-23T10:00:00Z")), undated.clone()],
                is_open,
            ),
            (
                "latest",
                [empty_at(Some("2026-11-23T10:00:00Z")), dated.clone()],
                ["(None, None)", "see a"],
            ),
            (
                "latest",
                [empty_at(Some("2026-11-21T10:00:00Z")), dated],
                ["see b", "60"],
            ),
            ("best", [empty_at(None), empty], is_open),
            // If the time of an attempt is unclear, points aren't compared.
            ("best", [graded_at(Some("yesterday")), undated], is_open),
            // One of the years must be wrong.
            (
                "latest",
                [graded_at(Some("2026-11-20T10:00:00Z")), future],
                is_open,
            ),
        ] {
            assert_eq!(counted(rule, &attempts), expected, "{rule} {attempts:?}");
        }
    }

    #[test]
    fn the_message_says_what_the_rule_needs() {
        let latest = policy("[attempts]\ncounts = 'latest'");
        let why = |second: Option<&'static str>| {
            let first = ("a", graded(80), Some("2026-11-20T10:00:00Z"));
            let mut rows = rows(&latest, &[first, ("b", graded(60), second)]);
            apply_rule(&latest, &mut rows);
            rows[0].why(&rows[0].grades[0])
        };
        let local = why(Some("2026-11-21 10:00"));
        assert!(
            local.contains("it has no time zone: set `timezone`"),
            "{local}"
        );
        let unknown = why(None);
        assert!(
            unknown.ends_with("which attempt is the last: remove all but one"),
            "{unknown}"
        );
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
        // The text must name a different submission.
        apply_rule(&policy, &mut rows);
        let others = |ids: &[&str]| {
            let ids = ids.iter().map(|id| (*id).to_owned());
            let remedy = "remove all but one, or set `counts` under [attempts] in the policy";
            Some(GradeProblem::SeveralAttempts(
                ids.collect(),
                remedy.to_owned(),
            ))
        };
        for grade in &rows[0].grades {
            assert_eq!(grade.problem, others(&["b"]));
        }
    }
}
