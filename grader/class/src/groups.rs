//! Group submissions: a platform such as Canvas exports a group's submission under the name of one
//! member, and the roster's group column lists the other members. Moodle names it after the group.

use std::collections::BTreeSet;

use crate::entry::{EntryInfo, Person};
use crate::list_kind::ListKind;
use crate::names::are_equal;
use crate::roster::Member;

/// Assigns entries that are named after a group and match nobody to the group's members, according
/// to the roster or, if the group isn't in it, another list. Returns whether any were found.
pub fn resolve_teams(rows: &[Member], entries: &mut [&mut EntryInfo]) -> bool {
    let mut has_teams = false;
    for info in entries {
        let [person] = info.people.as_slice() else {
            continue;
        };
        let team = person.name.clone();
        if team.is_empty() || rows.iter().any(|row| row.matches(person)) {
            continue;
        }
        let members = rows
            .iter()
            .filter(|row| are_equal(&row.person.group, &team));
        let has_roster = members.clone().any(|row| row.list == ListKind::Roster);
        let members = members.filter(|row| !has_roster || row.list == ListKind::Roster);
        let members: Vec<Person> = members.map(|row| row.person.clone()).collect();
        if !members.is_empty() {
            has_teams = true;
            info.people = members;
            info.team = Some(team);
        }
    }
    has_teams
}

/// Merges the records of people who are listed twice.
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

/// Adds the other members of a group to the entry of the member who submitted, except those with a
/// submission of their own. Returns whether any were found.
pub fn add_group_members(rows: &[Member], entries: &mut [&mut EntryInfo]) -> bool {
    let members = rows.iter().filter(|row| row.list == ListKind::Roster);
    let people = entries.iter().flat_map(|info| info.people.clone());
    let people: Vec<Person> = people.collect();
    let is_there = |member: &Member| people.iter().any(|person| member.matches(person));
    let mut has_added = false;
    for info in entries {
        let theirs = members
            .clone()
            .filter(|member| info.people.iter().any(|person| member.matches(person)));
        let groups: BTreeSet<&str> = theirs.map(|member| member.person.group.as_str()).collect();
        let others = members.clone().filter(|member| {
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
    has_added
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::graded_class::tests::{lists, person};
    use crate::roster::read_lists;

    fn submitted_by(login: &str) -> EntryInfo {
        EntryInfo {
            people: vec![person(json!({ "login": login }))],
            ..EntryInfo::default()
        }
    }

    #[test]
    fn adds_group_members_who_did_not_submit_themselves() {
        let rows = "name,login_id,group_name\nAnn,ann,One\nBob,bob,One\nCarl,carl,One\nDora,dora,\nEve,eve,\n";
        let (_folder, lists) = lists(&[(ListKind::Roster, rows)]);
        let rows = read_lists(&lists).unwrap();
        let mut entries = ["ann", "carl", "dora"].map(submitted_by);
        let mut entries: Vec<&mut EntryInfo> = entries.iter_mut().collect();
        assert!(add_group_members(&rows, &mut entries));
        let names: Vec<String> = entries.iter().map(|info| info.display_names()).collect();
        let added = entries.iter().flat_map(|info| &info.people);
        let added = added.filter(|person| person.is_from_group);
        assert_eq!(
            added.map(Person::display_name).collect::<Vec<_>>(),
            ["Bob", "Bob"]
        );
        // Two members of Bob's group submitted, so Bob is in both entries. The preview reports
        // this.
        assert_eq!(names, ["ann + Bob", "carl + Bob", "dora"]);
        assert!(!add_group_members(&rows, &mut entries));
        // It is enough if one of the people who submitted together is in the list.
        let mut pair = submitted_by("ann");
        pair.people.extend(submitted_by("guest").people);
        assert!(add_group_members(&rows, &mut [&mut pair]));
        assert_eq!(pair.display_names(), "ann + guest + Bob + Carl");
    }
}
