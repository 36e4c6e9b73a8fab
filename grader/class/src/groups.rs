//! Groups, of which a platform gives out one member's files for all (Canvas does): the roster's column
//! of groups says who the others are.

use std::collections::BTreeSet;

use crate::cli::Lists;
use crate::entry::{About, Person};
use crate::roster::{self, Member};
use crate::table::BadTable;

/// Puts the others of a group beside the one who handed in, unless they handed in by themselves.
/// Takes them off those who are `missing`.
pub fn complete(
    lists: &Lists,
    entries: &mut [&mut About],
    missing: &mut Vec<Person>,
) -> Result<(), BadTable> {
    let Some(path) = &lists.roster else {
        return Ok(());
    };
    let members = roster::read(path)?;
    let people = entries.iter().flat_map(|about| about.people.clone());
    let people: Vec<Person> = people.collect();
    let is_there = |member: &Member| people.iter().any(|person| member.is(person));
    for about in entries {
        let theirs = members
            .iter()
            .filter(|member| about.people.iter().any(|person| member.is(person)));
        let groups: BTreeSet<&str> = theirs.map(|member| member.group.as_str()).collect();
        let others = members.iter().filter(|member| {
            let is_in_group = !member.group.is_empty() && groups.contains(member.group.as_str());
            is_in_group && !is_there(member)
        });
        let others: Vec<Person> = others.map(|member| member.person.clone()).collect();
        missing.retain(|person| !others.contains(person));
        about.people.extend(others);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn handed_in(login: &str) -> About {
        About {
            people: vec![Person {
                login: login.to_owned(),
                ..Person::default()
            }],
            ..About::default()
        }
    }

    #[test]
    fn one_hands_in_for_all_but_those_who_hand_in_by_themselves() {
        let folder = tempfile::TempDir::new().unwrap();
        let roster = folder.path().join("groups.csv");
        let rows = "name,login_id,group_name\nAnn,ann,One\nBob,bob,One\nCarl,carl,One\nDora,dora,\nEve,eve,\n";
        std::fs::write(&roster, rows).unwrap();
        let lists = Lists {
            roster: Some(roster),
            ..Lists::default()
        };
        let mut entries = ["ann", "carl", "dora"].map(handed_in);
        let mut entries: Vec<&mut About> = entries.iter_mut().collect();
        let members = roster::read(lists.roster.as_deref().unwrap()).unwrap();
        let mut missing: Vec<Person> = [1, 4].map(|place| members[place].person.clone()).into();
        complete(&lists, &mut entries, &mut missing).unwrap();
        let names: Vec<String> = entries.iter().map(|about| about.words()).collect();
        // Both of a group that handed in twice have Bob: the preview says that he is there twice.
        assert_eq!(names, ["ann + Bob", "carl + Bob", "dora"]);
        let missing: Vec<&str> = missing.iter().map(Person::words).collect();
        assert_eq!(missing, ["Eve"]);
    }
}
