//! Identifies records of the same person.

use std::collections::{BTreeMap, BTreeSet};

use grader::nearest_name::suggestion;

use crate::entry::{EntryInfo, Person};
use crate::names::{are_equal, are_same_name, fold, joined};

/// The text in [`EntryInfo::from`] before the path of the corrected files.
pub const CORRECTED: &str = " (corrected: ";

/// The prefix of every pseudonym.
pub const PSEUDONYM_PREFIX: &str = "anon-";

/// One person's part in a submission: the index of the row, and the person's index in that row.
pub type Attempt = (usize, usize);

/// Returns the attempts of each person. People are compared by their unique identifiers, or by name
/// if nothing else is known about them.
pub fn attempts_by_person<'a>(rows: impl Iterator<Item = &'a [Person]>) -> Vec<Vec<Attempt>> {
    let (mut attempts, mut people) = (Vec::new(), Vec::new());
    for (row, own) in rows.enumerate() {
        attempts.extend((0..own.len()).map(|index| (row, index)));
        people.extend(own);
    }
    let mut groups: BTreeMap<usize, Vec<Attempt>> = BTreeMap::new();
    for (id, attempt) in person_ids(&people).into_iter().zip(attempts) {
        groups.entry(id).or_default().push(attempt);
    }
    groups.into_values().collect()
}

/// Returns the index of the submission with this id, pseudonym, file or folder. `all` contains each
/// submission's id and information.
pub fn submission_called(who: &str, all: &[(&str, &EntryInfo)]) -> Option<usize> {
    let (who, _) = split_pseudonym(who);
    let by_id = all.iter().position(|(id, _)| are_equal(id, who));
    let is_named = |(_, info): &(&str, &EntryInfo)| {
        let (original, _) = info.from.split_once(CORRECTED).unwrap_or((&info.from, ""));
        [&*info.from, original, &*info.pseudonym].contains(&who)
    };
    by_id.or_else(|| all.iter().position(is_named).filter(|_| !who.is_empty()))
}

/// Splits `anon-1, member 2`, as shown in the graders' tables, into the pseudonym and the number.
fn split_pseudonym(who: &str) -> (&str, Option<usize>) {
    let parts = who.split_once(", member ");
    let parts = parts.filter(|(own, _)| own.starts_with(PSEUDONYM_PREFIX));
    let member = parts.and_then(|(own, number)| Some((own, number.parse().ok()?)));
    member.map_or((who, None), |(own, number)| (own, Some(number)))
}

/// Returns each part in a submission of the people that `who` could refer to: the people with this
/// identifier or, if there are none, everybody who handed in the [submission called](submission_called)
/// `who`, the people with a similar name or whose submission has one, the members of a group, or the
/// person whose name is shown as `who`.
pub fn matching_people(who: &str, all: &[(&str, &EntryInfo)]) -> Vec<Attempt> {
    let (who, member) = split_pseudonym(who);
    let parts = all.iter().enumerate().flat_map(|(row, (_, info))| {
        let people = 0..info.people.len();
        people.map(move |index| (row, index))
    });
    let parts = Vec::from_iter(parts);
    let person = |(row, index): &Attempt| &all[*row].1.people[*index];
    let named = submission_called(who, all);
    let tests: [&dyn Fn(&&Attempt) -> bool; 5] = [
        &|own| person(own).identifiers().any(|name| are_equal(name, who)),
        &|(row, _)| named == Some(*row),
        &|own| {
            let (id, info) = all[own.0];
            let names = [&*person(own).name, &*info.display_names(), id];
            names.iter().any(|name| are_same_name(name, who))
        },
        &|own| are_same_name(&person(own).group, who),
        &|own| {
            // Comparing the beginning is fast and rules out most people.
            let is_possible = who.starts_with(person(own).display_name());
            is_possible && distinct_name(person(own), parts.iter().map(person)) == who
        },
    ];
    let found = tests.iter().map(|test| parts.iter().filter(test));
    let mut found = found.map(|found| Vec::from_iter(found.copied()));
    let found = found.find(|found| !found.is_empty()).unwrap_or_default();
    let found = (1..).zip(found);
    let found = found.filter(|(number, _)| member.is_none_or(|own| own == *number));
    found.map(|(_, part)| part).collect()
}

/// Returns the indices of the submissions that `who` could refer to: the [submission
/// called](submission_called) `who` or, if there is none, those of the [people](matching_people)
/// called `who`. If somebody has several submissions, `counts` returns whether the one with this id
/// counts for them.
pub fn matching_submissions(
    who: &str,
    all: &[(&str, &EntryInfo)],
    counts: impl Fn(&str, &Person) -> bool,
) -> Vec<usize> {
    if let Some(index) = submission_called(who, all) {
        return vec![index];
    }
    let found = matching_people(who, all);
    let person = |(row, index): &Attempt| &all[*row].1.people[*index];
    let counting = found.iter().filter(|own| counts(all[own.0].0, person(own)));
    let counting = BTreeSet::from_iter(counting.map(|(row, _)| *row));
    let ids = person_ids(&Vec::from_iter(found.iter().map(person)));
    let is_known = BTreeSet::from_iter(ids).len() == 1 && counting.len() == 1;
    let found = found.iter().map(|(row, _)| *row).collect();
    Vec::from_iter(if is_known { counting } else { found })
}

/// Returns the index of the only submission that `who` could refer to, as described in
/// [`matching_submissions`].
pub fn find_submission(
    who: &str,
    all: &[(&str, &EntryInfo)],
    counts: impl Fn(&str, &Person) -> bool,
) -> Result<usize, String> {
    Err(match matching_submissions(who, all, counts).as_slice() {
        [only] => return Ok(*only),
        [] => format!(
            "{who:?} doesn't match any submission or person in this class{}; --dry-run and \
             grades.csv list them all",
            suggestion(who, all.iter().map(|(id, _)| *id))
        ),
        several => format!(
            "{who:?} could be {}: use one of these names instead",
            joined(several.iter().map(|index| all[*index].0), " or ")
        ),
    })
}

/// Returns a person's name, followed by an identifier in brackets if somebody else among `people` has
/// the same name.
pub fn distinct_name<'a>(
    person: &'a Person,
    mut people: impl Iterator<Item = &'a Person>,
) -> String {
    let name = person.display_name();
    let identifiers = |person: &'a Person| {
        let own = person.own_identifiers().into_iter();
        own.chain([person.number.as_str()])
    };
    let is_shared = people.any(|other| {
        are_equal(other.display_name(), name) && !identifiers(other).eq(identifiers(person))
    });
    let identifier = identifiers(person).find(|own| !own.is_empty() && *own != name);
    match identifier.filter(|_| is_shared) {
        Some(identifier) => format!("{name} ({identifier})"),
        None => name.to_owned(),
    }
}

/// Returns a number for each person in the list. All records of the same person get the same
/// number.
pub fn person_ids(people: &[&Person]) -> Vec<usize> {
    let mut ids = Vec::new();
    let mut known: BTreeMap<(u8, String), usize> = BTreeMap::new();
    for (index, person) in people.iter().enumerate() {
        let keys = keys(person);
        let found = keys.iter().filter_map(|key| known.get(key).copied());
        let found: BTreeSet<usize> = found.collect();
        let id = found.first().copied().unwrap_or(index);
        if found.len() > 1 {
            // This record shows that earlier records with different identifiers belong to the same
            // person.
            let all = ids.iter_mut().chain(known.values_mut());
            all.filter(|of| found.contains(of)).for_each(|of| *of = id);
        }
        ids.push(id);
        known.extend(keys.into_iter().map(|key| (key, id)));
    }
    ids
}

fn keys(person: &Person) -> Vec<(u8, String)> {
    // Someone else's file name may contain the same number.
    let number = match person.number.as_str() {
        number if number.is_empty() || person.is_listed => number.to_owned(),
        number => format!("{number} {}", person.name),
    };
    let identifiers = person.own_identifiers().into_iter();
    let identifiers = (0..).zip(identifiers.chain([number.as_str()]));
    let known = identifiers.filter(|(_, text)| !text.is_empty());
    let mut keys: Vec<(u8, String)> = known.map(|(kind, text)| (kind, fold(text))).collect();
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
            // From here on, either identifier is enough.
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
    fn a_submission_is_found_by_its_folder_and_by_the_names_that_tables_show() {
        let info = |from: &str, names: &[&str]| EntryInfo {
            people: names.iter().map(|name| person(name, "", "")).collect(),
            from: from.to_owned(),
            ..EntryInfo::default()
        };
        let mut one = info("pt-owls (corrected: bob)", &["Ann", "Bob"]);
        let two = info("pt-ann", &["Ann"]);
        one.people[1].group = "Team 7".to_owned();
        let all = [("night_owls", &one), ("ann2", &two)];
        let find = |who: &str| find_submission(who, &all, |_, _| true);
        for who in [
            "night_owls",
            "Night Owls",
            "pt-owls",
            "Ann + Bob",
            "bob",
            "Team_7",
        ] {
            assert_eq!(find(who), Ok(0), "{who}");
        }
        assert_eq!(find("pt-ann"), Ok(1));
        assert!(find("Ann").unwrap_err().contains("night_owls or ann2"));
        assert!(find("Eve").is_err());
        let counting = |id: &str, person: &Person| id == "ann2" || person.name == "Bob";
        assert_eq!(find_submission("Ann", &all, counting), Ok(1));
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
            // Joins the two records above without mentioning the sid.
            vec![person("Ann", "a@x.edu", "ann")],
            vec![by_sid],
        ];
        let groups = attempts_by_person(rows.iter().map(Vec::as_slice));
        assert_eq!(groups, [[(0, 0), (1, 0), (2, 0), (3, 0)]]);
    }
}
