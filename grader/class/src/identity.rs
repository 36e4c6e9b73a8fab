//! Which records are of the same person.

use std::collections::BTreeMap;

use crate::entry::Person;
use crate::names::fold;

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

/// Returns a number for each person in the list, which is equal for all records of one person.
pub fn person_ids(people: &[&Person]) -> Vec<usize> {
    let mut ids = vec![0; people.len()];
    let records = people.iter().map(|person| std::slice::from_ref(*person));
    for (id, attempts) in attempts_by_person(records).into_iter().enumerate() {
        for (index, _) in attempts {
            ids[index] = id;
        }
    }
    ids
}

fn keys(person: &Person) -> Vec<(u8, String)> {
    // In a file name, somebody else may have the same number.
    let number = match person.number.as_str() {
        number if number.is_empty() || person.is_listed => number.to_owned(),
        number => format!("{number} {}", person.name),
    };
    let identifiers = [&person.email, &person.sid, &person.login, &number];
    let mut keys: Vec<(u8, String)> = (0..)
        .zip(identifiers)
        .filter(|(_, text)| !text.is_empty())
        .map(|(kind, text)| (kind, fold(text)))
        .collect();
    if keys.is_empty() {
        keys.push((u8::MAX, fold(&person.name)));
    }
    keys
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn person(name: &str, email: &str, login: &str) -> Person {
        crate::graded_class::tests::person(json!({ "name": name, "email": email, "login": login }))
    }

    #[test]
    fn records_that_share_an_identifier_are_one_person() {
        let rows = [
            vec![person("Ann", "a@x.edu", ""), person("Bob", "", "")],
            vec![person("A. Lee", "", "ann")],
            vec![person("Bob", "", ""), person("Ann", "", "other")],
            vec![person("Ann", "A@x.edu", "ANN")],
            // Either identifier is enough from then on.
            vec![person("A. Lee", "", "ann"), person("Bob", "", "")],
        ];
        let groups = attempts_by_person(rows.iter().map(Vec::as_slice));
        let expected = [
            vec![(0, 0), (1, 0), (3, 0), (4, 0)],
            vec![(0, 1), (2, 0), (4, 1)],
            vec![(2, 1)],
        ];
        assert_eq!(groups, expected);
    }

    #[test]
    fn identifiers_of_records_that_are_joined_later_lead_to_the_same_person() {
        let enrolled = Person {
            sid: "u1".to_owned(),
            ..person("A. Lee", "", "ann")
        };
        let by_sid = Person {
            login: String::new(),
            ..enrolled.clone()
        };
        let rows = [
            vec![person("Ann", "a@x.edu", "")],
            vec![enrolled],
            // Joins the two above, and says nothing of the sid.
            vec![person("Ann", "a@x.edu", "ann")],
            vec![by_sid],
        ];
        let groups = attempts_by_person(rows.iter().map(Vec::as_slice));
        assert_eq!(groups, [[(0, 0), (1, 0), (2, 0), (3, 0)]]);
    }
}
