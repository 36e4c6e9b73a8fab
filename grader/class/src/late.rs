//! Computes the lateness of submissions, according to the platform's information, the policy and
//! the person's extension.

use std::collections::{BTreeMap, BTreeSet};

use grader::policy::{
    AttemptRule, Extension, Lateness, Policy, TimeError, are_far_apart, read_time,
};
use grader::printing::print_error_line;
use jiff::Timestamp;
use judging::sanitize::sanitize;

use crate::entry::{EntryInfo, Person};
use crate::identity::{Attempt, attempts_by_person, matching_people};
use crate::moodle_status::MoodleStatus;
use crate::names::{are_equal, are_same_name};

/// The reason it is unclear how late a submission is. Points must not depend on a guess, so the
/// submission doesn't get final points until a person corrects the time.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{why}")]
pub struct UnclearTime {
    /// The reason, followed by what to do about it.
    pub why: String,
    /// Whether, according to Moodle, the files are a draft that the student hasn't submitted.
    pub is_draft: bool,
}

/// The reason reported if the platform says only that the submission is late, but the person has an
/// extension.
pub const ONLY_A_FLAG: &str = "the platform marks the submission as late, but the extension can \
    only be applied if the submission time and the due time are known: add a `datetime` column to \
    the roster and `due` to the policy";

const NOT_IN_CLASS: &str = "which doesn't match any person or group in this class: use a name, \
    email address, account or student id from grades.csv, or the name of a group or submission";
const SHARED_NAME: &str = "but several people have this name, so all of them get the extension: \
    use an email address or a student number instead";

impl UnclearTime {
    /// Returns an error with this reason, for a submission that isn't known to be a draft.
    pub fn new(why: impl Into<String>) -> Self {
        UnclearTime {
            why: why.into(),
            is_draft: false,
        }
    }

    /// Returns the error to report when points depend on a submission time that cannot be used.
    fn submitted(text: &str, why: TimeError) -> Self {
        UnclearTime::new(format!(
            "the submission time {text:?} cannot be used: {why}"
        ))
    }
}

/// Returns the lateness of a submission for one of the people who handed it in. If its submission
/// time is known and the policy sets a due time, the lateness depends on these two times.
/// Otherwise, it depends on the platform's late flag. `granted` are the person's [extensions in the
/// policy](policy_extensions).
pub fn lateness(
    policy: &Policy,
    info: &EntryInfo,
    person: &Person,
    granted: &[Extension],
) -> Result<Lateness, UnclearTime> {
    let extensions = extensions(policy, info, person, granted)?;
    let due = policy.extended_due(&extensions);
    let exact = match (due, submission_time(policy, info)?) {
        (Some(due), Some(time)) => {
            check_plausible(policy, info, time, due)?;
            policy.lateness(time, &extensions)
        }
        (_, None) | (None, _) => None,
    };
    match exact {
        Some(lateness) => Ok(lateness),
        None if info.is_late() && !extensions.is_empty() => Err(UnclearTime::new(ONLY_A_FLAG)),
        // Unless both times are known, a submission with a late flag is treated as one second past
        // the grace period, and any other submission as on time.
        None => {
            let grace = u64::from(policy.late.grace_minutes) * 60;
            let seconds = if info.is_late() { grace + 1 } else { 0 };
            Ok(Lateness::of_seconds(seconds).assumed(due.is_some() || info.is_late()))
        }
    }
}

/// Rejects a time that is far from the person's due time, and a time in a list that contradicts the
/// platform's late flags, since the list may be about an earlier attempt.
fn check_plausible(
    policy: &Policy,
    info: &EntryInfo,
    time: Timestamp,
    due: Timestamp,
) -> Result<(), UnclearTime> {
    let text = info.submitted().unwrap_or_default();
    if are_far_apart(time, due) {
        return Err(UnclearTime::submitted(text, TimeError::FarFromDue));
    }
    if info.submitted.is_some() {
        return Ok(());
    }
    // The platform may or may not know about the extension.
    let seconds = |due| time.duration_since(due).as_secs();
    let without_extension = policy.late.due.map(seconds);
    let grace = i64::from(policy.late.grace_minutes) * 60;
    if info.late && without_extension.is_some_and(|seconds| seconds <= 0) {
        Err(UnclearTime::new(format!(
            "a list gives the submission time as {text:?}, which is on time, but the platform \
             marks the submission as late: in the list, enter the time of the last attempt or \
             leave the time empty"
        )))
    } else if info.marks_late && !info.late && time.duration_since(due).as_secs() > grace {
        Err(UnclearTime::new(format!(
            "a list gives the submission time as {text:?}, which is late, but the platform does \
             not mark the submission as late: correct the time, or if the platform granted an \
             extension, add it to the roster or the policy"
        )))
    } else {
        Ok(())
    }
}

/// Returns the submission time if it is known and the policy needs it.
pub fn submission_time(
    policy: &Policy,
    info: &EntryInfo,
) -> Result<Option<Timestamp>, UnclearTime> {
    let is_needed = policy.late.due.is_some() || policy.attempts.counts != AttemptRule::Ask;
    let needed = info.submitted().filter(|_| is_needed);
    let read = |text: &str| {
        let time = read_time(text, policy.late.timezone.as_ref());
        time.map_err(|why| UnclearTime::submitted(text, why))
    };
    needed.map(read).transpose()
}

/// Returns the extensions of a person: those that the policy has `granted`, and those from the roster
/// and Moodle's worksheet.
fn extensions(
    policy: &Policy,
    info: &EntryInfo,
    person: &Person,
    granted: &[Extension],
) -> Result<Vec<Extension>, UnclearTime> {
    let status = MoodleStatus::parse(&person.status);
    if let Some(unknown) = status.unknown {
        return Err(UnclearTime::new(format!(
            "Moodle's worksheet contains an unrecognised status, {unknown:?}, which could mean a \
             draft or an extension: switch Moodle to English, then download the worksheet again"
        )));
    }
    // A partner's draft is a different submission.
    if let Some(unsubmitted) = status.unsubmitted.filter(|_| !person.is_from_group) {
        let why = format!(
            "the status in Moodle's worksheet is {unsubmitted:?}: to have the files graded, change \
             the status to \"Submitted for grading\"; otherwise, remove the files from the input"
        );
        let is_draft = true;
        return Err(UnclearTime { why, is_draft });
    }
    let mut extensions = granted.to_vec();
    let due = policy.late.due;
    let needed = |_: &&str| due.is_some() || info.is_late();
    let by_moodle = status.extension.filter(needed).unwrap_or_default();
    let listed = [&person.extension, by_moodle].into_iter();
    for text in listed.filter(|text| !text.is_empty()) {
        let own = match Extension::parse(text, policy.late.timezone.as_ref()) {
            Ok(own) if own.is_far_from(due) => Err(TimeError::FarFromDue),
            own => own,
        };
        extensions.push(own.map_err(|why| {
            UnclearTime::new(format!(
                "the extension {text:?} is neither a number of days nor a valid time: {why}"
            ))
        })?);
    }
    Ok(extensions)
}

/// Returns the policy's extensions for each person's part in a submission. An extension applies to
/// every submission of the people it is for. `all` contains each submission's id and information.
pub fn policy_extensions(
    policy: &Policy,
    all: &[(&str, &EntryInfo)],
) -> BTreeMap<Attempt, Vec<Extension>> {
    let known = attempts_by_person(all.iter().map(|(_, info)| info.people.as_slice()));
    let mut granted: BTreeMap<Attempt, Vec<Extension>> = BTreeMap::new();
    for (name, extension) in &policy.late.extensions {
        let meant = people_meant(name, all);
        let is_meant = |own: &&Vec<Attempt>| own.iter().any(|part| meant.contains(part));
        for part in known.iter().filter(is_meant).flatten() {
            granted.entry(*part).or_default().push(*extension);
        }
    }
    granted
}

/// Returns the people that an extension is for: everybody with this identifier or in this group or,
/// if there is nobody, the [people called](matching_people) `name` in any other way.
fn people_meant(name: &str, all: &[(&str, &EntryInfo)]) -> BTreeSet<Attempt> {
    let parts = all.iter().enumerate().flat_map(|(row, (_, info))| {
        let people = info.people.iter().enumerate();
        people.map(move |(index, person)| ((row, index), person))
    });
    let named = parts.filter(|(_, person)| has_identifier_or_group(person, name));
    let named: BTreeSet<Attempt> = named.map(|(part, _)| part).collect();
    if named.is_empty() {
        BTreeSet::from_iter(matching_people(name, all))
    } else {
        named
    }
}

fn has_identifier_or_group(person: &Person, name: &str) -> bool {
    let mut names = person.identifiers().chain([person.group.as_str()]);
    names.any(|own| are_equal(own, name))
}

/// Prints a warning for each of the policy's extensions that is for nobody in these submissions and
/// none of the people who are `missing`, or that is for several people with the same name.
pub fn warn_about_extensions(policy: &Policy, all: &[(&str, &EntryInfo)], missing: &[Person]) {
    for (name, problem) in extension_problems(policy, all, missing) {
        let name = sanitize(name, 200);
        print_error_line(format_args!(
            "the policy has an extension for {name:?}, {problem}"
        ));
    }
}

/// Returns each name in the policy's extensions that stands for nobody or for several people,
/// together with a description of the problem.
fn extension_problems<'a>(
    policy: &'a Policy,
    all: &[(&str, &EntryInfo)],
    missing: &[Person],
) -> Vec<(&'a str, &'static str)> {
    let known = attempts_by_person(all.iter().map(|(_, info)| info.people.as_slice()));
    let problem = |name: &'a String| {
        let meant = people_meant(name, all);
        let absent = missing.iter();
        let absent = absent.filter(|person| has_identifier_or_group(person, name));
        // A group's name applies to everybody in the group.
        let is_namesake =
            |person: &Person| are_same_name(&person.name, name) && !are_equal(&person.group, name);
        let is_meant =
            |part: &Attempt| meant.contains(part) && is_namesake(&all[part.0].1.people[part.1]);
        let namesakes = known.iter().filter(|own| own.iter().any(is_meant)).count()
            + absent.clone().filter(|person| is_namesake(person)).count();
        if meant.is_empty() && absent.count() == 0 {
            Some((name.as_str(), NOT_IN_CLASS))
        } else {
            (namesakes > 1).then_some((name.as_str(), SHARED_NAME))
        }
    };
    policy.late.extensions.keys().filter_map(problem).collect()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::graded_class::tests::{person, policy};

    fn late_flag() -> EntryInfo {
        EntryInfo {
            late: true,
            ..EntryInfo::default()
        }
    }

    /// Returns the problems with extensions in a class where each person has a submission.
    fn problems<'a>(policy: &'a Policy, people: &[&Person]) -> Vec<(&'a str, &'static str)> {
        let info = |person: &&Person| EntryInfo {
            people: vec![(*person).clone()],
            ..EntryInfo::default()
        };
        let infos = Vec::from_iter(people.iter().map(info));
        let all = Vec::from_iter(infos.iter().map(|info| ("", info)));
        extension_problems(policy, &all, &[])
    }

    #[test]
    fn a_late_flag_without_a_time_counts_as_the_first_second_after_the_grace_period() {
        let mut policy = policy("[late]\npercent_per_day = 10\ngrace_minutes = 5");
        let nobody = Person::default();
        let late = lateness(&policy, &late_flag(), &nobody, &[]).unwrap();
        let assumed = |seconds| Lateness::of_seconds(seconds).assumed(true);
        assert_eq!(late, assumed(301));
        assert_eq!(policy.final_points(80, 100, late).points, 72);
        let on_time = lateness(&policy, &EntryInfo::default(), &nobody, &[]);
        assert_eq!(on_time, Ok(Lateness::NONE));
        policy.late.due = "2026-11-20T23:59:59Z".parse().ok();
        let on_time = lateness(&policy, &EntryInfo::default(), &nobody, &[]);
        assert_eq!(on_time, Ok(assumed(0)));
    }

    #[test]
    fn an_extension_cannot_be_applied_to_a_late_flag() {
        let policy = policy("[late]\ndue = 2026-11-20T23:59:59Z\n[late.extensions]\nann = 2");
        let ann = Person::named("Ann");
        let granted = [Extension::Days(2)];
        let unclear = lateness(&policy, &late_flag(), &ann, &granted);
        assert_eq!(unclear, Err(UnclearTime::new(ONLY_A_FLAG)));
        assert!(lateness(&policy, &late_flag(), &Person::named("Bob"), &[]).is_ok());
        assert!(problems(&policy, &[&ann]).is_empty());
        assert_eq!(problems(&policy, &[]), [("ann", NOT_IN_CLASS)]);
    }

    #[test]
    fn an_extension_for_a_group_or_in_other_letters_belongs_to_somebody() {
        let policy = policy("[late.extensions]\n'Ann LEE' = 2\n'Team A' = 1\n'Team B' = 1");
        let ann = person(json!({ "name": "ann lee", "group": "team a" }));
        assert_eq!(problems(&policy, &[&ann]), [("Team B", NOT_IN_CLASS)]);
    }

    #[test]
    fn an_extension_by_name_should_be_for_one_person() {
        let policy = policy("[late.extensions]\n'ann lee' = 2\nu1 = 2\n'team a' = 1");
        let ann = |sid: &str, group: &str| {
            person(json!({ "name": "Ann Lee", "sid": sid, "group": group }))
        };
        let shared = |people: &[&Person]| {
            let mut problems = problems(&policy, people);
            problems.retain(|(_, problem)| *problem == SHARED_NAME);
            Vec::from_iter(problems.into_iter().map(|(name, _)| name))
        };
        let (one, other) = (ann("u1", "team a"), ann("u2", "team a"));
        assert_eq!(shared(&[&one, &other]), ["ann lee"]);
        assert!(shared(&[&one, &one]).is_empty(), "two attempts of one");
        let [one, other] = ["u1", "u2"].map(|sid| ann(sid, "Ann Lee"));
        assert!(shared(&[&one, &other]).is_empty(), "it is their group's");
    }

    fn submitted(time: &str, late: bool) -> EntryInfo {
        EntryInfo {
            late,
            submitted: Some(time.to_owned()),
            ..EntryInfo::default()
        }
    }

    #[test]
    fn a_time_and_a_due_time_decide_whatever_the_platform_says() {
        let policy = policy("[late]\ndue = 2026-11-20T12:00:00Z");
        let nobody = Person::default();
        let seconds = |time: &str, late| {
            let late = lateness(&policy, &submitted(time, late), &nobody, &[]);
            late.map(|late| late.seconds)
        };
        assert_eq!(seconds("2026-11-20T11:00:00Z", true), Ok(0));
        assert_eq!(seconds("2026-11-20T12:00:07Z", false), Ok(7));
        let unclear = seconds("yesterday", false).unwrap_err();
        assert!(unclear.why.contains("the submission time \"yesterday\""));
    }

    #[test]
    fn a_time_that_decides_nothing_is_not_read() {
        let info = submitted("yesterday", true);
        assert_eq!(submission_time(&Policy::default(), &info), Ok(None));
        let late = lateness(&Policy::default(), &info, &Person::default(), &[]);
        assert_eq!(late.unwrap().seconds, 1);
        // The latest attempt is chosen by its time, even without a due time.
        let latest = policy("[attempts]\ncounts = 'latest'");
        assert!(submission_time(&latest, &info).is_err());
        let dated = submitted("2026-11-20T12:00:00Z", false);
        let time = submission_time(&latest, &dated).unwrap();
        assert_eq!(time.unwrap().to_string(), "2026-11-20T12:00:00Z");
        let due = policy("[late]\ndue = 2026-11-20T12:00:00Z");
        assert!(submission_time(&due, &info).is_err());
    }

    #[test]
    fn the_extension_in_the_roster_counts_like_one_in_the_policy() {
        let policy = policy("[late]\ndue = 2026-11-20T12:00:00Z\n[late.extensions]\n'team a' = 1");
        let hours = |group: &str, extension: &str| {
            let person = person(json!({ "name": "Ann", "group": group, "extension": extension }));
            let mut info = submitted("2026-11-22T12:00:00Z", false);
            info.people.push(person.clone());
            let granted = policy_extensions(&policy, &[("a", &info)]);
            let granted = granted.get(&(0, 0)).map_or(&[][..], Vec::as_slice);
            let late = lateness(&policy, &info, &person, granted);
            late.map(|late| late.seconds / 3600)
        };
        assert_eq!(hours("", ""), Ok(48));
        assert_eq!(hours("Team A", ""), Ok(24));
        assert_eq!(hours("Team A", "2"), Ok(0));
        let unclear = hours("", "some").unwrap_err();
        assert!(unclear.why.contains("the extension \"some\""));
    }
}
