//! Completes a class's entries from the roster and the platforms' gradebooks.

use crate::cli::Lists;
use crate::entry::{EntryInfo, Person};
use crate::groups;
use crate::roster;
use crate::table::TableError;

/// Fills in what the lists know about the entries: first unknown identifiers, then the other members of
/// groups, and last the times of submission, since the time of any member counts. Returns the people on
/// the lists who belong to no entry.
pub fn complete_entries(
    lists: &Lists,
    entries: &mut [&mut EntryInfo],
) -> Result<Vec<Person>, TableError> {
    let people = entries.iter_mut().flat_map(|info| &mut info.people);
    let mut missing = roster::join(lists, &mut people.collect::<Vec<_>>())?;
    groups::add_group_members(lists, entries, &mut missing)?;
    roster::set_submission_times(lists, entries)?;
    Ok(missing)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ann's submission is found, and the roster knows only when her partner handed it in.
    #[test]
    fn the_time_of_any_member_of_the_group_counts() {
        let folder = tempfile::tempdir().unwrap();
        let roster = folder.path().join("roster.csv");
        let rows = "name,username,sid,group,datetime\n\
            Ann,ann,u1,One,\n\
            Bob,bob,u2,One,2026-11-20 12:00:00 +0000\n\
            Eve,eve,u3,Two,2026-11-21 12:00:00 +0000\n";
        std::fs::write(&roster, rows).unwrap();
        let lists = Lists {
            roster: Some(roster),
            ..Lists::default()
        };
        let mut entry = EntryInfo {
            people: vec![Person {
                login: "ann".to_owned(),
                ..Person::default()
            }],
            ..EntryInfo::default()
        };
        let missing = complete_entries(&lists, &mut [&mut entry]).unwrap();
        let sids: Vec<&str> = entry
            .people
            .iter()
            .map(|person| person.sid.as_str())
            .collect();
        assert_eq!(sids, ["u1", "u2"]);
        assert_eq!(
            entry.submitted.as_deref(),
            Some("2026-11-20 12:00:00 +0000")
        );
        let missing: Vec<&str> = missing.iter().map(Person::display_name).collect();
        assert_eq!(missing, ["Eve"]);
    }
}
