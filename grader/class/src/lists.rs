//! Completes a class's entries from the roster and the platforms' gradebooks.

use crate::cli::Lists;
use crate::entry::{EntryInfo, Person};
use crate::groups;
use crate::roster::{self, Member};
use crate::table::TableError;

/// Fills in what the lists know about the entries: first unknown identifiers, then the other members of
/// groups, and last the times of submission, since the time of any member counts. Returns the people on
/// the lists who belong to no entry.
pub fn complete_entries(
    lists: &Lists,
    entries: &mut [&mut EntryInfo],
) -> Result<Vec<Person>, TableError> {
    let rows = roster::read_lists(lists)?;
    if lists.moodle.is_some() {
        // Only this worksheet's status counts, not that of an earlier one.
        let people = entries.iter_mut().flat_map(|info| &mut info.people);
        people.for_each(|person| person.status.clear());
    }
    fill_in(&rows, entries);
    if groups::add_group_members(lists, entries)? {
        fill_in(&rows, entries);
    }
    roster::set_submission_times(lists, entries)?;
    let people = entries.iter().flat_map(|info| &info.people);
    Ok(roster::missing(&rows, &people.collect::<Vec<_>>()))
}

fn fill_in(rows: &[Member], entries: &mut [&mut EntryInfo]) {
    let people = entries.iter_mut().flat_map(|info| &mut info.people);
    roster::fill_in(rows, &mut people.collect::<Vec<_>>());
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    /// Writes a list into the folder.
    fn list(folder: &tempfile::TempDir, name: &str, text: &str) -> Option<PathBuf> {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        Some(path)
    }

    fn with_login(login: &str) -> Person {
        Person {
            login: login.to_owned(),
            ..Person::default()
        }
    }

    fn entry(person: Person) -> EntryInfo {
        EntryInfo {
            people: vec![person],
            ..EntryInfo::default()
        }
    }

    /// Her address is in the last list, which has the student id of the second, which has the account
    /// of the first, which has her extension.
    #[test]
    fn a_list_may_be_found_by_what_a_later_one_says() {
        let folder = tempfile::tempdir().unwrap();
        let canvas = "Student,ID,SIS User ID,SIS Login ID,Section,Path (7)\n\
            \"Lee, Ann\",7001,u1,ann,A,\n\"Kim, Bob\",7002,u2,bob,A,\n";
        let gradescope = "First Name,Last Name,SID,Email,Total Score,Max Points\n\
            Ann,Lee,u1,ann@x.edu,,100\nBob,Kim,u2,bob@x.edu,,100\n";
        let lists = Lists {
            roster: list(&folder, "roster.csv", "username,extension\nann,2\nbob,3\n"),
            canvas: list(&folder, "canvas.csv", canvas),
            gradescope: list(&folder, "gradescope.csv", gradescope),
            ..Lists::default()
        };
        let mut ann = entry(Person {
            email: "ann@x.edu".to_owned(),
            ..Person::default()
        });
        let missing = complete_entries(&lists, &mut [&mut ann]).unwrap();
        let known = |person: &Person| (person.login.clone(), person.extension.clone());
        let known = [&ann.people[0], &missing[0]].map(known);
        let wanted = [("ann", "2"), ("bob", "3")];
        assert_eq!(known, wanted.map(|(a, b)| (a.to_owned(), b.to_owned())));
        assert_eq!(missing.len(), 1, "{missing:?}");
    }

    /// Bob is in Ann's group, and each of them has a time.
    #[test]
    fn the_last_time_counts_unless_one_cannot_be_read() {
        let folder = tempfile::tempdir().unwrap();
        let submitted = |times: [&str; 2], by_platform: Option<&str>| {
            let [ann, bob] = times;
            let rows = format!("name,group,datetime\nAnn,One,{ann}\nBob,One,{bob}\n");
            let lists = Lists {
                roster: list(&folder, "roster.csv", &rows),
                ..Lists::default()
            };
            let mut entry = EntryInfo {
                submitted: by_platform.map(str::to_owned),
                ..entry(Person::named("Ann"))
            };
            complete_entries(&lists, &mut [&mut entry]).unwrap();
            assert_eq!(entry.listed.is_some(), by_platform.is_none());
            entry.submitted().unwrap().to_owned()
        };
        let (early, late) = ("2026-11-20 12:00:00 +0000", "2026-11-20 23:00:00 +0000");
        assert_eq!(submitted([early, late], None), late);
        assert_eq!(submitted([late, early], None), late);
        assert_eq!(submitted(["", early], None), early);
        // Which one is last is unknown, and a person decides.
        assert_eq!(submitted([late, "yesterday"], None), "yesterday");
        assert_eq!(submitted(["yesterday", late], None), "yesterday");
        assert_eq!(submitted([late, late], Some(early)), early);
    }

    #[test]
    fn other_lists_know_more_of_the_members_of_a_group() {
        let folder = tempfile::tempdir().unwrap();
        let canvas = "Student,ID,SIS Login ID,Section,Path (7)\n\
            \"Lee, Ann\",7001,ann,A,\n\"Kim, Bob\",7002,bob,A,\n";
        let lists = Lists {
            roster: list(&folder, "roster.csv", "username,group\nann,One\nbob,One\n"),
            canvas: list(&folder, "canvas.csv", canvas),
            ..Lists::default()
        };
        let mut entry = entry(with_login("ann"));
        let missing = complete_entries(&lists, &mut [&mut entry]).unwrap();
        let numbers: Vec<&str> = entry.people.iter().map(|p| p.number.as_str()).collect();
        assert_eq!(numbers, ["7001", "7002"]);
        assert_eq!(missing, []);
    }

    #[test]
    fn a_list_takes_no_late_flag_away() {
        let folder = tempfile::tempdir().unwrap();
        let roster = "name,datetime,late\nAnn,2026-11-20 12:00:00 +0000,false\n\
            Bob,2026-11-20 12:00:00 +0000,true\nEve,2026-11-20 12:00:00 +0000,false\n";
        let lists = Lists {
            roster: list(&folder, "roster.csv", roster),
            ..Lists::default()
        };
        let mut entries = ["Ann", "Bob", "Eve"].map(|name| entry(Person::named(name)));
        entries[0].late = true;
        complete_entries(&lists, &mut entries.iter_mut().collect::<Vec<_>>()).unwrap();
        assert_eq!(entries.map(|info| info.is_late()), [true, true, false]);
    }

    /// Ann's submission is found, and the roster knows only when her partner handed it in.
    #[test]
    fn the_time_of_any_member_of_the_group_counts() {
        let folder = tempfile::tempdir().unwrap();
        let rows = "name,username,sid,group,datetime\n\
            Ann,ann,u1,One,\n\
            Bob,bob,u2,One,2026-11-20 12:00:00 +0000\n\
            Eve,eve,u3,Two,2026-11-21 12:00:00 +0000\n";
        let lists = Lists {
            roster: list(&folder, "roster.csv", rows),
            ..Lists::default()
        };
        let mut entry = entry(with_login("ann"));
        let missing = complete_entries(&lists, &mut [&mut entry]).unwrap();
        let sids: Vec<&str> = entry
            .people
            .iter()
            .map(|person| person.sid.as_str())
            .collect();
        assert_eq!(sids, ["u1", "u2"]);
        assert_eq!(entry.submitted(), Some("2026-11-20 12:00:00 +0000"));
        let missing: Vec<&str> = missing.iter().map(Person::display_name).collect();
        assert_eq!(missing, ["Eve"]);
    }
}
