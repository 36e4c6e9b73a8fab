//! Completes a class's entries from the roster and the platforms' gradebooks.

use std::collections::{BTreeMap, BTreeSet};

use grader::handed_out::HandedOut;
use grader::submission::copied_names;
use judging::sanitize::sanitize_line;

use crate::cli::Lists;
use crate::entry::{EntryInfo, Person};
use crate::error::Error;
use crate::groups;
use crate::list_kind::ListKind;
use crate::manual_points::ManualPointsList;
use crate::names::{are_equal, fold_name, joined};
use crate::roster::{self, Member};

/// The maximum length of a name in a message, in characters.
const MAX_CHARS: usize = 200;

/// Facts about a class that were found in the lists.
#[derive(Debug, Default)]
pub struct ListFindings {
    /// The people on the lists who belong to no entry.
    pub missing: Vec<Person>,
    /// Sentences about entries whose people could not be identified with certainty.
    pub warnings: Vec<String>,
    /// The manual points.
    pub manual: ManualPointsList,
}

/// Completes the entries from the lists: first unknown identifiers, then group members, and finally
/// submission times, since any member's time may be used. Also reads the manual points, which must
/// be for people in these entries. `ids` contains the entries' ids.
pub fn complete_entries(
    lists: &Lists,
    handed_out: &HandedOut,
    ids: &[&str],
    entries: &mut [&mut EntryInfo],
) -> Result<ListFindings, Error> {
    let rows = roster::read_lists(lists)?;
    if lists.moodle.is_some() {
        // Use only this worksheet's status, not one from an earlier worksheet.
        people_of(entries).for_each(|person| person.status.clear());
    }
    let names = Vec::from_iter(entries.iter().map(|info| only_name(info)));
    roster::fill_in(&rows, people_of(entries));
    let has_teams = groups::resolve_teams(&rows, entries);
    if groups::add_group_members(&rows, entries) || has_teams {
        roster::fill_in(&rows, people_of(entries));
    }
    let similar = resolve_copies(&names, entries);
    for info in entries.iter_mut() {
        groups::remove_repetitions(&mut info.people);
    }
    roster::set_submission_times(&rows, entries);
    for (info, others) in entries.iter_mut().zip(similar) {
        let shared_team = groups::shared_team(&rows, info);
        let shared_name = || shared_name(&rows, info);
        let unclear = shared_team.or_else(shared_name);
        info.unclear_person = unclear.or_else(|| similar_name(info, &others));
        info.is_unlisted = info.unclear_person.is_none() && !is_listed(&rows, info);
    }
    let teams: Vec<Person> = entries
        .iter()
        .filter_map(|info| info.team_record())
        .collect();
    let people = entries.iter().flat_map(|info| &info.people).chain(&teams);
    let mut manual = match &lists.manual_points {
        Some(path) => ManualPointsList::read(path, handed_out)?,
        None => ManualPointsList::default(),
    };
    let missing = roster::missing(&rows, &Vec::from_iter(people));
    let named = ids.iter().copied().zip(entries.iter().map(|info| &**info));
    manual.find_people(&Vec::from_iter(named), &missing)?;
    let warnings = entries.iter();
    let warnings = warnings.filter_map(|info| {
        let unclear = info.unclear_person.clone();
        unclear.or_else(|| misleading_number(&rows, info))
    });
    Ok(ListFindings {
        missing,
        warnings: warnings.collect(),
        manual,
    })
}

/// Rejects a class if more than half of its entries match nobody on the lists. In that case, the
/// lists may belong to another class, or the names may have been misread.
pub fn check_listed(entries: &[(&str, &EntryInfo)], lists: &Lists) -> Result<(), Error> {
    let all = entries.len();
    let mut unlisted = entries.iter().filter(|(_, info)| info.is_unlisted);
    let count = unlisted.clone().count();
    match unlisted.next() {
        Some((_, example)) if 2 * count > all && !lists.accept_unlisted => {
            let example = sanitize_line(&example.display_names(), MAX_CHARS);
            Err(Error::user(format!(
                "{count} of {all} submissions, such as {example:?}, don't match anyone on the \
                 lists: check that the roster or gradebook is for this class and that --dry-run \
                 shows the right names; if both are right, pass --accept-unlisted"
            )))
        }
        Some(_) | None => Ok(()),
    }
}

fn people_of<'a>(entries: &'a mut [&mut EntryInfo]) -> impl Iterator<Item = &'a mut Person> {
    entries.iter_mut().flat_map(|info| &mut info.people)
}

/// Returns whether somebody in the entry is on a list. Also returns `true` if staff provided no
/// lists, and for Canvas's test student, who is never on a list.
fn is_listed(rows: &[Member], info: &EntryInfo) -> bool {
    let mut people = info.people.iter();
    // The list in the download always belongs to this class.
    rows.iter().all(|row| row.list == ListKind::Downloaded)
        || people
            .any(|person| person.is_test_student() || rows.iter().any(|row| row.matches(person)))
}

/// Returns a sentence about a person whose number belongs to a different name in a list.
fn misleading_number(rows: &[Member], info: &EntryInfo) -> Option<String> {
    let mut people = info.people.iter();
    people.find_map(|person| {
        let is_of_other =
            |row: &&Member| row.person.number == person.number && !row.matches(person);
        let mut others = rows.iter().filter(|row| !row.person.number.is_empty());
        let other = others.find(is_of_other)?;
        Some(format!(
            "{}: the number {} was ignored because a list assigns it to {}: if a team handed \
             this in, list its members in the roster's `group` column; otherwise, correct the name",
            info.from,
            person.number,
            other.person.display_name()
        ))
    })
}

/// Returns a sentence about a person who, judging by the name, could be any of several people on
/// the lists.
fn shared_name(rows: &[Member], info: &EntryInfo) -> Option<String> {
    let is_unlisted = |person: &&Person| !rows.iter().any(|row| row.matches(person));
    let person = info.people.iter().find(is_unlisted)?;
    let namesakes = rows.iter().filter(|row| row.is_namesake(person));
    let namesakes = namesakes.filter_map(|row| {
        let mut own = row.person.own_identifiers().into_iter();
        own.find(|own| !own.is_empty())
    });
    let namesakes: BTreeSet<&str> = namesakes.collect();
    (!namesakes.is_empty()).then(|| {
        format!(
            "{}: several people on the lists are named {}, so the submission isn't assigned to any \
             of them: rename it so that it contains one of {} instead",
            info.from,
            person.display_name(),
            joined(namesakes, ", ")
        )
    })
}

/// Returns the name or account of an entry's only person if nothing else is known about the person.
fn only_name(info: &EntryInfo) -> Option<String> {
    let [person] = info.people.as_slice() else {
        return None;
    };
    let is_only = person.number.is_empty() && person.identifiers().count() == 1;
    is_only.then(|| person.display_name().to_owned())
}

/// Finds entries whose names may stand for the same person, such as `Ann Lee`, `Ann_Lee` and
/// `Ann Lee (2)`. If only the original name is on a list, all of them are attempts by the same
/// people. Otherwise, that is unclear. Returns the other names that each entry could have. `names`
/// contains each entry's [`only_name`].
fn resolve_copies(
    names: &[Option<String>],
    entries: &mut [&mut EntryInfo],
) -> Vec<BTreeSet<String>> {
    let is_known =
        |info: &EntryInfo| info.team.is_some() || info.people.iter().any(|person| person.is_listed);
    let known = Vec::from_iter(entries.iter().map(|info| is_known(info)));
    let mut by_name: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (index, name) in names.iter().enumerate() {
        let folded = name.as_deref().map(fold_name).unwrap_or_default();
        by_name.entry(folded).or_default().push(index);
    }
    let mut unclear = vec![BTreeSet::new(); names.len()];
    for (index, name) in names.iter().enumerate().filter(|(index, _)| !known[*index]) {
        let Some(name) = name else { continue };
        let originals = copied_names(name).into_iter().chain([name.as_str()]);
        let originals = originals.filter_map(|own| by_name.get(&fold_name(own)));
        // Submissions with the same name are attempts by one person.
        let is_other = |own: &String| !are_equal(own, name);
        let originals = originals.flatten().copied();
        let originals = originals.filter(|other| names[*other].as_ref().is_some_and(is_other));
        let (listed, others): (Vec<usize>, Vec<usize>) = originals.partition(|other| known[*other]);
        let is_same = |other: &usize| entries[*other].people == entries[listed[0]].people;
        if !listed.is_empty() && listed.iter().all(is_same) {
            let original = &entries[listed[0]];
            let (people, team) = (original.people.clone(), original.team.clone());
            (entries[index].people, entries[index].team) = (people, team);
            continue;
        }
        for other in listed.into_iter().chain(others) {
            unclear[index].insert(entries[other].from.clone());
            unclear[other].insert(entries[index].from.clone());
        }
    }
    unclear
}

/// Returns a sentence about an entry whose name may stand for the same person as those of others.
fn similar_name(info: &EntryInfo, others: &BTreeSet<String>) -> Option<String> {
    (!others.is_empty()).then(|| {
        format!(
            "{}: this may be another submission by the person who handed in {}, or one by somebody \
             else with a similar name: if it is the same person, remove all but one; otherwise, \
             pass a list that contains each person's name or account, e.g. with --roster",
            info.from,
            joined(others, " and ")
        )
    })
}

#[cfg(test)]
mod tests {
    use grader::handed_out::RAYS;

    use serde_json::json;

    use super::*;
    use crate::graded_class::tests::{lists, person};
    use crate::list_kind::ListKind::{Canvas, Gradescope, Roster};

    /// Completes the entries. Returns the people on these lists who aren't in any entry.
    fn missing(texts: &[(ListKind, &str)], entries: &mut [&mut EntryInfo]) -> Vec<Person> {
        let (_folder, lists) = lists(texts);
        complete_entries(&lists, &RAYS, &[], entries)
            .unwrap()
            .missing
    }

    fn with_login(login: &str) -> Person {
        person(json!({ "login": login }))
    }

    fn entry(person: Person) -> EntryInfo {
        EntryInfo {
            people: vec![person],
            ..EntryInfo::default()
        }
    }

    /// Ann's address is in the last list. That list shares her student id with the second list,
    /// which in turn shares her account with the first list, which contains her extension.
    #[test]
    fn a_list_may_be_found_by_what_a_later_one_says() {
        let canvas = "Student,ID,SIS User ID,SIS Login ID,Section,Path (7)\n\
            \"Lee, Ann\",7001,u1,ann,A,\n\"Kim, Bob\",7002,u2,bob,A,\n";
        let gradescope = "First Name,Last Name,SID,Email,Total Score,Max Points\n\
            Ann,Lee,u1,ann@x.edu,,100\nBob,Kim,u2,bob@x.edu,,100\n";
        let roster = "username,extension\nann,2\nbob,3\n";
        let lists = [(Roster, roster), (Canvas, canvas), (Gradescope, gradescope)];
        let mut ann = entry(person(json!({ "email": "ann@x.edu" })));
        let missing = missing(&lists, &mut [&mut ann]);
        let known = |person: &Person| (person.login.clone(), person.extension.clone());
        let known = [&ann.people[0], &missing[0]].map(known);
        let wanted = [("ann", "2"), ("bob", "3")];
        assert_eq!(known, wanted.map(|(a, b)| (a.to_owned(), b.to_owned())));
        assert_eq!(missing.len(), 1, "{missing:?}");
    }

    #[test]
    fn the_rosters_sections_take_precedence() {
        let canvas = "Student,ID,SIS Login ID,Section\n\"Lee, Ann\",7001,ann,Canvas A\n\
            \"Kim, Bob\",7002,bob,Canvas B\n";
        let roster = "username,section\nann,Tess\nbob,\n";
        // The roster's row is only recognised with the login from Canvas's list.
        let people = ["Lee Ann", "Kim Bob"].into_iter().zip(["7001", "7002"]);
        let people = people.map(|(name, number)| json!({ "name": name, "number": number }));
        let mut entries: Vec<EntryInfo> = people.map(|json| entry(person(json))).collect();
        let [ann, bob] = entries.as_mut_slice() else {
            unreachable!();
        };
        missing(&[(Roster, roster), (Canvas, canvas)], &mut [ann, bob]);
        let sections = entries.iter().map(|info| info.people[0].section.as_str());
        assert_eq!(sections.collect::<Vec<_>>(), ["Tess", "Canvas B"]);
    }

    /// Bob is in Ann's group, and both of them have a submission time.
    #[test]
    fn the_last_time_counts_unless_one_cannot_be_read() {
        let submitted = |times: [&str; 2], by_platform: Option<&str>| {
            let [ann, bob] = times;
            let rows = format!("name,group,datetime\nAnn,One,{ann}\nBob,One,{bob}\n");
            let mut entry = EntryInfo {
                submitted: by_platform.map(str::to_owned),
                ..entry(Person::named("Ann"))
            };
            missing(&[(Roster, &rows)], &mut [&mut entry]);
            assert_eq!(entry.listed.is_some(), by_platform.is_none());
            entry.submitted().unwrap().to_owned()
        };
        let (early, late) = ("2026-11-20 12:00:00 +0000", "2026-11-20 23:00:00 +0000");
        assert_eq!(submitted([early, late], None), late);
        assert_eq!(submitted([late, early], None), late);
        assert_eq!(submitted(["", early], None), early);
        // It is unknown which time is the last, so a person must decide.
        assert_eq!(submitted([late, "yesterday"], None), "yesterday");
        assert_eq!(submitted(["yesterday", late], None), "yesterday");
        assert_eq!(submitted([late, late], Some(early)), early);
    }

    #[test]
    fn other_lists_know_more_of_the_members_of_a_group() {
        let canvas = "Student,ID,SIS Login ID,Section,Path (7)\n\
            \"Lee, Ann\",7001,ann,A,\n\"Kim, Bob\",7002,bob,A,\n";
        let roster = "username,group\nann,One\nbob,One\n";
        let mut entry = entry(with_login("ann"));
        let missing = missing(&[(Roster, roster), (Canvas, canvas)], &mut [&mut entry]);
        let numbers: Vec<&str> = entry.people.iter().map(|p| p.number.as_str()).collect();
        assert_eq!(numbers, ["7001", "7002"]);
        assert_eq!(missing, []);
    }

    #[test]
    fn a_list_takes_no_late_flag_away() {
        let roster = "name,datetime,late\nAnn,2026-11-20 12:00:00 +0000,false\n\
            Bob,2026-11-20 12:00:00 +0000,true\nEve,2026-11-20 12:00:00 +0000,false\n";
        let mut entries = ["Ann", "Bob", "Eve"].map(|name| entry(Person::named(name)));
        entries[0].late = true;
        missing(&[(Roster, roster)], &mut entries.each_mut());
        assert_eq!(entries.map(|info| info.is_late()), [true, true, false]);
    }

    /// The submission is Ann's, but the roster only contains her partner's submission time.
    #[test]
    fn the_time_of_any_member_of_the_group_counts() {
        let rows = "name,username,sid,group,datetime\n\
            Ann,ann,u1,One,\n\
            Bob,bob,u2,One,2026-11-20 12:00:00 +0000\n\
            Eve,eve,u3,Two,2026-11-21 12:00:00 +0000\n";
        let mut entry = entry(with_login("ann"));
        let missing = missing(&[(Roster, rows)], &mut [&mut entry]);
        let sids: Vec<&str> = entry.people.iter().map(|p| p.sid.as_str()).collect();
        assert_eq!(sids, ["u1", "u2"]);
        assert_eq!(entry.submitted(), Some("2026-11-20 12:00:00 +0000"));
        let missing: Vec<&str> = missing.iter().map(Person::display_name).collect();
        assert_eq!(missing, ["Eve"]);
    }
}
