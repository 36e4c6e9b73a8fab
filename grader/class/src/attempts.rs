//! Several submissions of one person: which of them counts, by the policy's rule.

use std::collections::BTreeMap;

use grader::policy::{AttemptRule, Policy};

use crate::entry::Person;
use crate::late::submission_time;
use crate::model::{ClassRow, GradeProblem};
use crate::outcome::EntryOutcome;

/// One person's part of a submission: the index of the row, and of the person in it.
pub type Attempt = (usize, usize);

/// Returns the attempts of each person. Only unique identifiers are compared, unless nothing but a
/// name is known.
pub fn attempts_by_person<'a>(rows: impl Iterator<Item = &'a [Person]>) -> Vec<Vec<Attempt>> {
    let mut groups: Vec<Vec<Attempt>> = Vec::new();
    let mut known: BTreeMap<(u8, String), usize> = BTreeMap::new();
    for (row, people) in rows.enumerate() {
        for (index, person) in people.iter().enumerate() {
            let keys = keys(person);
            let mut found: Vec<usize> = keys
                .iter()
                .filter_map(|key| known.get(key).copied())
                .collect();
            found.sort_unstable();
            found.dedup();
            let group = found.first().copied().unwrap_or(groups.len());
            if group == groups.len() {
                groups.push(Vec::new());
            }
            // This record shows that earlier ones, with different identifiers, are one person's.
            for other in found.into_iter().skip(1) {
                let moved = std::mem::take(&mut groups[other]);
                groups[group].extend(moved);
                for of in known.values_mut().filter(|of| **of == other) {
                    *of = group;
                }
            }
            groups[group].push((row, index));
            known.extend(keys.into_iter().map(|key| (key, group)));
        }
    }
    groups.retain(|group| !group.is_empty());
    groups
}

fn keys(person: &Person) -> Vec<(u8, String)> {
    let identifiers = [&person.email, &person.sid, &person.login, &person.number];
    let mut keys: Vec<(u8, String)> = (0..)
        .zip(identifiers)
        .filter(|(_, text)| !text.is_empty())
        .map(|(kind, text)| (kind, text.to_lowercase()))
        .collect();
    if keys.is_empty() {
        keys.push((u8::MAX, person.name.clone()));
    }
    keys
}

/// Applies the policy's rule: of several attempts, only one keeps its points.
pub fn apply_rule(policy: &Policy, rows: &mut [ClassRow]) {
    let people = rows.iter().map(|row| row.result.info.people.as_slice());
    for attempts in attempts_by_person(people) {
        if attempts.len() < 2 {
            continue;
        }
        let ids = attempts.iter().map(|(row, _)| rows[*row].result.id.clone());
        let ids: Vec<String> = ids.collect();
        let chosen = choose(policy, rows, &attempts);
        for (row, person) in &attempts {
            if chosen == Some((*row, *person)) {
                continue;
            }
            let own = rows[*row].result.id.clone();
            let problem = match chosen {
                Some((chosen, _)) => GradeProblem::OtherAttempt(rows[chosen].result.id.clone()),
                None => {
                    let others = ids.iter().filter(|id| **id != own).cloned();
                    GradeProblem::SeveralAttempts(others.collect())
                }
            };
            let grade = &mut rows[*row].grades[*person];
            grade.counted = None;
            grade.problem = Some(problem);
        }
    }
}

/// Returns the attempt that counts, or `None` if a person has to choose.
fn choose(policy: &Policy, rows: &[ClassRow], attempts: &[Attempt]) -> Option<Attempt> {
    let mut candidates = Vec::new();
    for (row, person) in attempts {
        match &rows[*row].result.outcome {
            EntryOutcome::Graded(_) => candidates.push((*row, *person)),
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
            let time =
                |(row, _): &Attempt| submission_time(policy, &rows[*row].result.info).ok()?;
            let times: Option<Vec<_>> = candidates.iter().map(time).collect();
            let latest = times?
                .into_iter()
                .zip(candidates)
                .max_by_key(|(time, _)| *time)?;
            Some(latest.1)
        }
        AttemptRule::Best => {
            let points =
                |(row, person): &Attempt| rows[*row].grades[*person].counted.map(|c| c.points);
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
    use super::*;

    fn person(name: &str, email: &str, login: &str) -> Person {
        Person {
            email: email.to_owned(),
            login: login.to_owned(),
            ..Person::named(name)
        }
    }

    #[test]
    fn records_that_share_an_identifier_are_one_person() {
        let rows = [
            vec![person("Ann", "a@x.edu", ""), person("Bob", "", "")],
            vec![person("A. Lee", "", "ann")],
            vec![person("Bob", "", ""), person("Ann", "", "other")],
            vec![person("Ann", "A@x.edu", "ANN")],
        ];
        let groups = attempts_by_person(rows.iter().map(Vec::as_slice));
        let expected = [
            vec![(0, 0), (1, 0), (3, 0)],
            vec![(0, 1), (2, 0)],
            vec![(2, 1)],
        ];
        assert_eq!(groups, expected);
    }
}
