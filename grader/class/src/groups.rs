//! Group submissions: a platform such as Canvas exports a group's submission under the name of one
//! member, and the roster's group column lists the other members. Moodle names the submission after
//! the group.

use std::collections::{BTreeMap, BTreeSet};

use crate::entry::{EntryInfo, Person};
use crate::list_kind::ListKind;
use crate::names::{are_same_name, can_become, fold, joined};
use crate::roster::Member;

/// If an entry is named after a group and matches nobody, assigns it to the group's members. The
/// members come from the roster or, if the group isn't in the roster, from another list. An entry
/// whose name could refer to several groups isn't assigned to any of them. Returns whether any
/// members were found.
pub fn resolve_teams(rows: &[Member], entries: &mut [&mut EntryInfo]) -> bool {
    let mut has_teams = false;
    for info in entries {
        let mut groups = groups_named_by(rows, info);
        let (Some((_, members)), None) = (groups.pop_first(), groups.first_key_value()) else {
            continue;
        };
        let people = members.into_iter().map(|member| member.person.clone());
        info.team = Some(info.display_names());
        info.people = people.collect();
        has_teams = true;
    }
    has_teams
}

/// If an entry is named after a group, but its name could refer to any of several groups, returns a
/// sentence about it.
pub fn shared_team(rows: &[Member], info: &EntryInfo) -> Option<String> {
    let groups = groups_named_by(rows, info);
    let groups = groups.values().map(|members| &members[0].person.group);
    let groups = Vec::from_iter(groups);
    (groups.len() > 1).then(|| {
        format!(
            "{}: it could belong to any of the groups {}, whose names differ only in punctuation, \
             so it isn't assigned to any of them: rename the groups so that they differ in a \
             letter or digit, both in the file or folder name and in the `group` column",
            info.from,
            joined(groups, ", ")
        )
    })
}

/// Returns the members of each group that an entry may be named after. Returns no groups if the
/// entry is named after a person on one of the staff's lists. The list in a platform's download can
/// also contain a group's account.
fn groups_named_by<'a>(rows: &'a [Member], info: &EntryInfo) -> BTreeMap<String, Vec<&'a Member>> {
    let mut groups: BTreeMap<String, Vec<&Member>> = BTreeMap::new();
    let [person] = info.people.as_slice() else {
        return groups;
    };
    // On GitHub, only an account is known, which is the name of the group's repository.
    let team = match person.name.as_str() {
        "" => person.login.as_str(),
        name => name,
    };
    let mut of_staff = rows.iter().filter(|row| row.list != ListKind::Downloaded);
    if team.is_empty() || of_staff.any(|row| row.matches(person)) {
        return groups;
    }
    let members = rows.iter();
    let members = members.filter(|row| are_same_name(&row.person.group, team));
    let has_roster = members.clone().any(|row| row.list == ListKind::Roster);
    for member in members.filter(|row| !has_roster || row.list == ListKind::Roster) {
        let group = fold(&member.person.group);
        groups.entry(group).or_default().push(member);
    }
    if groups.keys().any(|group| can_become(group, team)) {
        groups.retain(|group, _| can_become(group, team));
    }
    groups
}

/// Merges the records of people who are listed twice.
pub fn remove_repetitions(people: &mut Vec<Person>) {
    let mut distinct: Vec<Person> = Vec::new();
    for person in people.drain(..) {
        let is_repetition = |other: &&mut Person| {
            let has_unknown_name = other.name.is_empty() || person.name.is_empty();
            other.is_same(&person) && (has_unknown_name || are_same_name(&other.name, &person.name))
        };
        match distinct.iter_mut().find(is_repetition) {
            Some(other) => other.fill_missing_from(&person),
            None => distinct.push(person),
        }
    }
    *people = distinct;
}

/// Adds the other members of a group to the entry of the member who submitted, unless they have
/// handed in a separate submission. Returns whether any members were found.
pub fn add_group_members(rows: &[Member], entries: &mut [&mut EntryInfo]) -> bool {
    let members = rows.iter().filter(|row| row.list == ListKind::Roster);
    let people = entries.iter().flat_map(|info| info.people.clone());
    let people: Vec<Person> = people.collect();
    let is_there = |member: &Member| people.iter().any(|person| member.matches(person));
    let mut has_added = false;
    for info in entries {
        let is_theirs = |member: &&Member| info.people.iter().any(|person| member.matches(person));
        let theirs = members.clone().filter(is_theirs);
        let groups: BTreeSet<&str> = theirs.map(|member| member.person.group.as_str()).collect();
        let others = members.clone().filter(|member| {
            let group = member.person.group.as_str();
            !group.is_empty() && groups.contains(group) && !is_there(member)
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
    fn a_repository_named_after_a_group_belongs_to_its_members() {
        let rows =
            "name,login_id,group_name\nHana,hana,Team 7\nIvo,ivo,Team 7\nZoe,team-8,Team 8\n";
        let (_folder, lists) = lists(&[(ListKind::Roster, rows)]);
        let rows = read_lists(&lists).unwrap();
        let resolved = |login| {
            let mut entry = submitted_by(login);
            let is_team = resolve_teams(&rows, &mut [&mut entry]);
            (is_team, entry.display_names())
        };
        assert_eq!(resolved("team-7"), (true, "Hana + Ivo".to_owned()));
        assert_eq!(
            resolved("team-8"),
            (false, "team-8".to_owned()),
            "an account"
        );
        assert_eq!(resolved("team-9"), (false, "team-9".to_owned()));
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
        // It is enough for one of the people who submitted together to be on the roster.
        let mut pair = submitted_by("ann");
        pair.people.extend(submitted_by("guest").people);
        assert!(add_group_members(&rows, &mut [&mut pair]));
        assert_eq!(pair.display_names(), "ann + guest + Bob + Carl");
    }
}
