//! Tests for reading rosters and matching their rows with people.

use serde_json::json;

use super::*;
use crate::graded_class::tests::{lists, person};

fn parse_roster(table: &str) -> Vec<Member> {
    parse_members(&Table::parse(table.as_bytes()).unwrap(), ListKind::Roster).unwrap()
}

/// Returns the names of all people in a roster.
fn names(table: &str) -> Vec<String> {
    let rows = parse_roster(table).into_iter();
    rows.map(|row| row.person.name).collect()
}

#[test]
fn an_ambiguous_name_matches_nobody() {
    let ann = Person::named("Ann Lee");
    let list = parse_roster("name,email\nAnn Lee,a@x.edu\nann lee,b@x.edu\nBob,c@x.edu\n");
    assert!(!list[0].matches(&ann) && !list[1].matches(&ann));
    assert!(list[2].matches(&Person::named("bob")));
    // A person may be listed in two sections.
    let list = parse_roster("name,email\nAnn Lee,a@x.edu\nAnn Lee,A@x.edu\n");
    assert!(list[0].matches(&ann));
    // An account identifies one person, even if two people have the same name.
    let list = parse_roster("name,username\nAnn Lee,ann1\nAnn Lee,ann2\n");
    let named = |name| {
        list.iter()
            .filter(|m| m.matches(&Person::named(name)))
            .count()
    };
    assert_eq!((named("ann2"), named("Ann Lee")), (1, 0));
}

#[test]
fn the_same_name_with_another_number_does_not_match() {
    let worksheet = "Identifier,Full name,Email address\nParticipant 307,Ann Lee,a@x.edu\n";
    let list = parse_roster(worksheet);
    let numbered = |number: &str| person(json!({ "name": "Ann Lee", "number": number }));
    assert!(list[0].matches(&numbered("307")));
    assert!(!list[0].matches(&numbered("308")));
    let without_numbers = parse_roster("name,email\nAnn Lee,a@x.edu\n");
    assert!(without_numbers[0].matches(&numbered("308")));
}

#[test]
fn one_column_that_identifies_people_is_enough() {
    let with_column = |name: &str| parse_roster(&format!("{name},late\n x ,true\n"));
    for name in ["name", "email", "sid", "username"] {
        let rows = with_column(name);
        assert_eq!(rows[0].person.display_name(), "x", "{name}");
        assert!(rows[0].late);
    }
    let table = Table::parse(b"group,late\nx,true\n").unwrap();
    assert!(parse_members(&table, ListKind::Roster).is_none());
    // The number that Canvas writes into lists of group members.
    let rows = parse_roster("name,canvas_user_id\nAnn,7001\n");
    assert_eq!(rows[0].person.number, "7001");
}

/// Brightspace marks identifiers and the end of each line. See
/// <https://kb.wisc.edu/page.php?id=4330>.
#[test]
fn the_marks_in_brightspaces_list_of_grades_are_no_part_of_the_identifiers() {
    let list = "OrgDefinedId,Username,Last Name,First Name,Email,Total,End-of-Line Indicator\n\
        #00246,#ann.lee,Lee,Ann,a@x.edu,,#\n";
    let person = &parse_roster(list)[0].person;
    assert_eq!(person.name, "Ann Lee");
    assert_eq!(person.own_identifiers(), ["a@x.edu", "00246", "ann.lee"]);
    // In other lists, the mark is part of the text.
    assert_eq!(parse_roster("name\n#ann\n")[0].person.name, "#ann");
}

#[test]
fn a_dash_is_no_time() {
    let rows = parse_roster("name,datetime\nAnn,-\nBob,2026-11-20 12:00\n");
    let times: Vec<&str> = rows.iter().map(|row| row.submitted.as_str()).collect();
    assert_eq!(times, ["", "2026-11-20 12:00"]);
}

#[test]
fn a_name_does_not_count_beside_another_identifier() {
    let rows = parse_roster("name,email,sid,login\nAnn Lee,a@x.edu,u1,ann\n");
    assert!(rows[0].matches(&Person::named("Ann Lee")));
    for other in ["email", "sid", "login"] {
        let person = person(json!({ "name": "Ann Lee", other: "other" }));
        assert!(!rows[0].matches(&person), "{person:?}");
    }
}

#[test]
fn rows_without_a_person_are_left_out() {
    let canvas = "Student,ID,SIS Login ID\n\"Points Possible\",,\n\"Student, Test\",9,test\n,,\n\
        \"Lee, Ann\",1,ann\n";
    assert_eq!(names(canvas), ["Ann Lee"]);
}

#[test]
fn a_name_may_be_in_two_columns() {
    let names = names("First Name,Last Name,Name,SID\nAnn,Lee,,1\nAnn,Lee,A. Lee,2\n");
    assert_eq!(names, ["Ann Lee", "A. Lee"]);
}

#[test]
fn everybody_who_is_missing_is_named_once() {
    let names = |table: &str, people: &[&Person]| {
        let missing = missing(&parse_roster(table), people).into_iter();
        missing.map(|person| person.name).collect::<Vec<_>>()
    };
    let table = "name\nAnn\nBob\nEve\nBob\n";
    assert_eq!(names(table, &[]), ["Ann", "Bob", "Eve"]);
    assert_eq!(names(table, &[&Person::named("eve")]), ["Ann", "Bob"]);
    // Two people with the same name and nothing else to tell them apart.
    let table = "name,group\nAnn,One\nAnn,Two\n";
    let of_group = person(json!({ "name": "Ann", "group": "Two", "is_from_group": true }));
    assert_eq!(names(table, &[&of_group]), ["Ann"]);
    assert_eq!(names(table, &[]), ["Ann", "Ann"]);
}

#[test]
fn a_key_belongs_to_one_person() {
    let check = |table: &str| {
        let (_folder, lists) = lists(&[(ListKind::Roster, table)]);
        read_lists(&lists).map(drop)
    };
    let sections = "name,email,section\nAnn,a@x.edu,1\nann,A@x.edu,2\n";
    assert!(check(sections).is_ok());
    for table in [
        "name,email\nAnn,a@x.edu\n\nBob,A@x.edu\n",
        "name,sid\nAnn,1\n\nBob,1\n",
        "name,login,group\nAnn,a,One\n\nAnn,a,Two\n",
    ] {
        let error = check(table).unwrap_err().to_string();
        assert!(error.contains("rows 2 and 4 both contain"), "{error}");
    }
}
