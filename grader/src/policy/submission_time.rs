//! The submission time and the due date from the file `submission_metadata.json` that Gradescope
//! gives to autograders
//! (<https://gradescope-autograders.readthedocs.io/en/latest/submission_metadata/>).

use std::path::Path;

use jiff::Timestamp;
use serde::Deserialize;

use crate::error::Error;
use crate::machine::files;
use crate::policy::time_parser::read_time;
use crate::policy::{Extension, Lateness, Policy};

/// The time when a submission was handed in, and its due time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SubmissionTime {
    submitted: Timestamp,
    /// The names and email addresses of the people who submitted.
    people: Vec<String>,
    /// The due time, or `None` if the assignment has no due time.
    due: Option<Timestamp>,
}

/// The fields that are read from the file. Other fields are ignored.
#[derive(Deserialize)]
struct Metadata {
    created_at: String,
    assignment: Assignment,
    #[serde(default)]
    users: Vec<User>,
}

#[derive(Deserialize)]
struct User {
    name: Option<String>,
    email: Option<String>,
}

#[derive(Deserialize)]
struct Assignment {
    due_date: Option<String>,
}

impl SubmissionTime {
    /// Reads Gradescope's file at `path`.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = files::read_to_string(path);
        let text = text.map_err(|error| error.of_action("read Gradescope's"))?;
        SubmissionTime::parse(&text).map_err(|why| {
            Error::Machine(format!(
                "cannot read the submission time and due date in {} ({why}): correct the file, or \
                 leave out --gradescope-metadata, so that no submission counts as late",
                path.display()
            ))
        })
    }

    fn parse(text: &str) -> Result<Self, String> {
        let metadata: Metadata = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let due = metadata.assignment.due_date;
        let people = metadata.users.into_iter();
        let people = people.flat_map(|user| [user.name, user.email]).flatten();
        Ok(SubmissionTime {
            submitted: parse_time(&metadata.created_at)?,
            people: people.collect(),
            due: due.as_deref().map(parse_time).transpose()?,
        })
    }
}

fn parse_time(text: &str) -> Result<Timestamp, String> {
    read_time(text, None).map_err(|why| format!("{text:?}: {why}"))
}

impl Policy {
    /// Returns the lateness of a submission relative to the policy's due time or, if the policy
    /// doesn't set one, to the platform's due time. For a group, the latest extension of any member
    /// applies.
    pub fn lateness_of(&self, submission: &SubmissionTime) -> Lateness {
        let people = submission.people.iter().map(String::as_str);
        let extensions: Vec<Extension> = self.extensions_of(people).collect();
        let by_platform = || {
            let due = self.late.extended(submission.due?, &extensions);
            let zone = self.late.timezone.as_ref();
            Some(Lateness::since(due, submission.submitted, zone))
        };
        let lateness = self.lateness(submission.submitted, &extensions);
        lateness.or_else(by_platform).unwrap_or(Lateness::NONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse_with_due(due: &str) -> Result<SubmissionTime, String> {
        let at = "2026-11-20T23:00:10.365935-08:00";
        SubmissionTime::parse(&format!(
            r#"{{"id": 1, "created_at": "{at}", "assignment": {{"due_date": {due}, "late_due_date": null}}}}"#
        ))
    }

    #[test]
    fn platform_due_date_applies_without_a_policy_due_date() {
        let before = r#""2026-11-20T23:00:00.000000-08:00""#;
        let own = "[late]\ndue = 2026-11-21T07:00:05Z";
        for (due, policy, seconds) in [
            (before, "", 10),
            (before, own, 5),
            ("null", "", 0),
            (r#""2026-11-22T00:00:00.000000-08:00""#, "", 0),
        ] {
            let policy: Policy = toml::from_str(policy).unwrap();
            let lateness = policy.lateness_of(&parse_with_due(due).unwrap());
            assert_eq!(lateness, Lateness::of_seconds(seconds), "{due}");
        }
    }

    #[test]
    fn reports_an_invalid_time() {
        let expected = "\"tomorrow\": it is not a date and time in a recognised format, such as \
                        2026-11-20 23:59:59 +0100";
        assert_eq!(parse_with_due(r#""tomorrow""#), Err(expected.to_owned()));
        let error = SubmissionTime::parse("{}").unwrap_err();
        assert!(error.contains("created_at"), "{error}");
    }

    #[test]
    fn the_file_is_read_from_its_path() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("submission_metadata.json");
        let error = SubmissionTime::read(&path).unwrap_err().to_string();
        assert!(error.contains("read Gradescope's"), "{error}");
        let text = r#"{"created_at": "2026-11-20T23:00:10Z", "assignment": {"due_date": null}}"#;
        std::fs::write(&path, text).unwrap();
        let read = SubmissionTime::read(&path).unwrap();
        assert_eq!(read, SubmissionTime::parse(text).unwrap());
        assert_eq!(read.submitted.to_string(), "2026-11-20T23:00:10Z");
        std::fs::write(&path, "{}").unwrap();
        let error = SubmissionTime::read(&path).unwrap_err().to_string();
        let expected = "submission time and due date in";
        assert!(error.contains(expected), "{error}");
    }

    #[test]
    fn the_latest_extension_in_a_group_counts_for_the_platforms_due_date_as_well() {
        let text = r#"{
            "created_at": "2026-11-22T12:00:00Z",
            "assignment": {"due_date": "2026-11-20T12:00:00Z"},
            "users": [{"name": "Ann", "email": "ann@x.edu"}, {"name": "Bob"}]
        }"#;
        let submission = SubmissionTime::parse(text).unwrap();
        let late = |rules: &str| {
            let policy: Policy = toml::from_str(rules).unwrap();
            policy.lateness_of(&submission).seconds / 3600
        };
        assert_eq!(late(""), 48);
        assert_eq!(late("[late.extensions]\n'ann@x.edu' = 1"), 24);
        assert_eq!(late("[late.extensions]\n'ann@x.edu' = 1\nbob = 2"), 0);
    }
}
