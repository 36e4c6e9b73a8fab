//! Group submissions: a platform such as Canvas exports a group's submission under the name of one
//! member, and the roster's group column lists the other members. Moodle names it after the group.

use std::collections::BTreeSet;

use crate::cli::Lists;
use crate::entry::{EntryInfo, Person};
use crate::error::Error;
use crate::names::are_equal;
use crate::roster::{self, Member};

/// Gives an entry that is named after a group, and matches nobody, to the members of the group: those
/// in the roster or, if it does not have the group, in another list. Returns whether there are any.
pub fn resolve_teams(
    lists: &Lists,
    rows: &[Member],
    entries: &mut [&mut EntryInfo],
) -> Result<bool, Error> {
    let roster = match &lists.roster {
        Some(path) => roster::read_members(path)?,
        None => Vec::new(),
    };
    let mut has_teams = false;
    for info in entries {
        let [person] = info.people.as_slice() else {
            continue;
        };
        let team = person.name.clone();
        if team.is_empty() || rows.iter().any(|row| row.matches(person)) {
            continue;
        }
        let of = |rows: &[Member]| -> Vec<Person> {
            let members = rows.iter().map(|row| &row.person);
            let members = members.filter(|member| are_equal(&member.group, &team));
            members.cloned().collect()
        };
        let mut members = of(&roster);
        if members.is_empty() {
            members = of(rows);
        }
        if !members.is_empty() {
            has_teams = true;
            info.people = members;
            info.team = Some(team);
        }
    }
    Ok(has_teams)
}

/// Joins the records of people who are listed twice.
pub fn remove_repetitions(people: &mut Vec<Person>) {
    let mut distinct: Vec<Person> = Vec::new();
    for person in people.drain(..) {
        let is_repetition = |other: &&mut Person| {
            let has_other_name = !other.name.is_empty()
                && !person.name.is_empty()
                && !are_equal(&other.name, &person.name);
            other.is_same(&person) && !has_other_name
        };
        match distinct.iter_mut().find(is_repetition) {
            Some(other) => other.fill_missing_from(&person),
            None => distinct.push(person),
        }
    }
    *people = distinct;
}

/// Adds the other members of a group to the entry of the member who submitted, except those who
/// made a submission of their own. Returns whether there are any.
pub fn add_group_members(lists: &Lists, entries: &mut [&mut EntryInfo]) -> Result<bool, Error> {
    let Some(path) = &lists.roster else {
        return Ok(false);
    };
    let members = roster::read_members(path)?;
    let people = entries.iter().flat_map(|info| info.people.clone());
    let people: Vec<Person> = people.collect();
    let is_there = |member: &Member| people.iter().any(|person| member.matches(person));
    let mut has_added = false;
    for info in entries {
        let theirs = members
            .iter()
            .filter(|member| info.people.iter().any(|person| member.matches(person)));
        let groups: BTreeSet<&str> = theirs.map(|member| member.person.group.as_str()).collect();
        let others = members.iter().filter(|member| {
            let is_in_group =
                !member.person.group.is_empty() && groups.contains(member.person.group.as_str());
            is_in_group && !is_there(member)
        });
        let others = others.map(|member| Person {
            is_from_group: true,
            ..member.person.clone()
        });
        let mut others: Vec<Person> = others.collect();
        remove_repetitions(&mut others);
        has_added |= !others.is_empty();
        info.people.extend(others);
    }
    Ok(has_added)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn submitted_by(login: &str) -> EntryInfo {
        EntryInfo {
            people: vec![Person {
                login: login.to_owned(),
                ..Person::default()
            }],
            ..EntryInfo::default()
        }
    }

    #[test]
    fn adds_group_members_who_did_not_submit_themselves() {
        let folder = tempfile::TempDir::new().unwrap();
        let roster = folder.path().join("groups.csv");
        let rows = "name,login_id,group_name\nAnn,ann,One\nBob,bob,One\nCarl,carl,One\nDora,dora,\nEve,eve,\n";
        std::fs::write(&roster, rows).unwrap();
        let lists = Lists {
            roster: Some(roster),
            ..Lists::default()
        };
        let mut entries = ["ann", "carl", "dora"].map(submitted_by);
        let mut entries: Vec<&mut EntryInfo> = entries.iter_mut().collect();
        assert!(add_group_members(&lists, &mut entries).unwrap());
        let names: Vec<String> = entries.iter().map(|info| info.display_names()).collect();
        let added = entries.iter().flat_map(|info| &info.people);
        let added = added.filter(|person| person.is_from_group);
        assert_eq!(
            added.map(Person::display_name).collect::<Vec<_>>(),
            ["Bob", "Bob"]
        );
        // Two members of Bob's group submitted, so Bob is in both entries. The preview reports
        // that.
        assert_eq!(names, ["ann + Bob", "carl + Bob", "dora"]);
        assert!(!add_group_members(&lists, &mut entries).unwrap());
        // It is enough that one of those who submitted together is in the list.
        let mut pair = submitted_by("ann");
        pair.people.extend(submitted_by("guest").people);
        assert!(add_group_members(&lists, &mut [&mut pair]).unwrap());
        assert_eq!(pair.display_names(), "ann + guest + Bob + Carl");
    }
}
