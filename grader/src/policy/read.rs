//! Reads policies. An invalid policy is rejected with a message that shows the line and says what
//! to do.

use std::path::Path;

use jiff::Timestamp;
use jiff::tz::TimeZone;
use serde::de;
use serde::{Deserialize, Deserializer};
use toml::value::Datetime;

use crate::error::Error;
use crate::machine::files;
use crate::policy::Policy;
use crate::policy::time_parser::has_plausible_year;

impl Policy {
    /// Reads the policy at `path`.
    pub fn read(path: &Path) -> Result<Policy, Error> {
        Policy::from_text(path, &Policy::read_text(path)?)
    }

    /// Reads the text of the policy at `path`, which may be invalid.
    pub fn read_text(path: &Path) -> Result<String, Error> {
        files::read_to_string(path).map_err(|error| {
            let error = error.of_action("read the policy");
            Error::User(format!(
                "{error}; `cargo grade --policy-default` prints a policy to start from"
            ))
        })
    }

    /// Parses a policy. `path` is used in error messages only.
    pub fn from_text(path: &Path, text: &str) -> Result<Policy, Error> {
        Policy::parse(text).map_err(|problem| problem.into_error(path, text))
    }

    fn parse(text: &str) -> Result<Policy, Problem> {
        let policy: Policy = toml::from_str(text).map_err(|error| Problem {
            offset: error.span().map_or(0, |span| span.start),
            problem: error.message().to_owned(),
        })?;
        match policy.problem() {
            None => Ok(policy),
            Some((key, problem)) => Err(Problem {
                offset: line_offset(text, key),
                problem: problem.to_owned(),
            }),
        }
    }

    /// Returns a key that has an invalid value, and the problem with that value.
    fn problem(&self) -> Option<(&str, &'static str)> {
        let late = &self.late;
        let mut extensions = late.extensions.iter();
        let far = extensions.find(|(_, extension)| extension.is_far_from(late.due));
        if let Some((name, _)) = far {
            return Some((name, "must be within half a year of the due time"));
        }
        [
            (self.points.out_of == Some(0), "out_of", "must not be 0"),
            (
                late.percent_per_day > 100,
                "percent_per_day",
                "must not exceed 100",
            ),
            (
                late.most_percent > 100,
                "most_percent",
                "must not exceed 100",
            ),
        ]
        .into_iter()
        .find_map(|(is_wrong, key, problem)| is_wrong.then_some((key, problem)))
    }
}

/// Reads a due time. TOML also has dates and local times, but these don't identify a point in time.
pub(super) fn due_time<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Timestamp>, D::Error> {
    let time = Datetime::deserialize(deserializer)?
        .to_string()
        .parse()
        .ok();
    let time = time.filter(|time| has_plausible_year(*time));
    time.map(Some).ok_or_else(|| {
        de::Error::custom(
            "must be a date and time with an offset, such as 2026-11-20T23:59:59+01:00",
        )
    })
}

/// Reads the name of a time zone.
pub(super) fn time_zone<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<TimeZone>, D::Error> {
    let name = String::deserialize(deserializer)?;
    TimeZone::get(&name).map(Some).map_err(|_| {
        de::Error::custom("must be the name of a time zone, such as America/New_York or UTC")
    })
}

/// A problem at a byte offset in the text.
pub(super) struct Problem {
    pub(super) offset: usize,
    pub(super) problem: String,
}

impl Problem {
    pub(super) fn into_error(self, path: &Path, text: &str) -> Error {
        let before = text.get(..self.offset).unwrap_or(text);
        let line = before.matches('\n').count();
        Error::User(format!(
            "the policy {}, line {}: {}\n  {}\n`cargo grade --policy-default` prints all keys with \
             explanations",
            path.display(),
            line + 1,
            self.problem,
            text.lines().nth(line).unwrap_or_default().trim()
        ))
    }
}

/// Returns the byte offset of the line that starts with this key.
fn line_offset(text: &str, key: &str) -> usize {
    let mut begin = 0;
    for line in text.split_inclusive('\n') {
        if line
            .trim_start_matches([' ', '\t', '"', '\''])
            .starts_with(key)
        {
            return begin;
        }
        begin += line.len();
    }
    0
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::policy::{DEFAULT, Policy};

    #[test]
    fn documented_default_equals_the_built_in_default() {
        assert_eq!(Policy::parse(DEFAULT).ok(), Some(Policy::default()));
    }

    #[test]
    fn commented_examples_are_valid() {
        let shown = |line: &str| {
            let line = line.strip_prefix("# ")?;
            line.split_once(" = ").map(|_| line.to_owned())
        };
        let lines = DEFAULT.lines();
        let lines = lines.map(|line| shown(line).unwrap_or_else(|| line.to_owned()));
        let with_examples = lines.collect::<Vec<_>>().join("\n");
        let policy = Policy::parse(&with_examples).ok().unwrap();
        assert_eq!(policy.points.out_of, Some(50));
        assert!(policy.late.due.is_some() && policy.late.closed_after_days.is_some());
        assert_eq!(policy.late.extensions.len(), 2);
        assert_eq!(policy.visibility.items.len(), 2);
        assert_eq!(
            (policy.points.void.len(), policy.points.tasks.len()),
            (1, 2)
        );
    }

    #[test]
    fn an_invalid_policy_is_rejected_with_the_line_and_what_must_be_there() {
        let texts = [
            "[points]\n# Half.\n  out_of = 0\n",
            "[late]\ngrace_minutes = 5\nfree_days = 1\npercent_per_day = 101",
            "[late]\nmost_percent = 101",
            "[late]\nmost_percent = 1\nsurprise = 2",
            "[late]\ndue = 2026-11-20T23:59:59",
            "[late]\ndue = 0026-11-20T23:59:59Z",
            "[late]\ndue = 2026-11-20T23:59:59Z\n[late.extensions]\n'ann@x' = 2025-11-25T23:59:59Z",
            "[late]\ntimezone = 'Europe/Atlantis'",
            "late",
            "[late",
            "[points]\n\nrounding = 'upwards'",
            "[late]\nfree_days = -1",
            "[late]\ndue = 2026-11-20",
            "[visibility.items]\nbuild = 'secret'",
        ];
        let first_lines = texts.map(|text| {
            let error = Policy::from_text(Path::new("policy.toml"), text).unwrap_err();
            let error = error.to_string();
            let end = "\n`cargo grade --policy-default` prints all keys with explanations";
            error.strip_suffix(end).unwrap().to_owned()
        });
        insta::assert_snapshot!(first_lines.join("\n"));
    }

    #[test]
    fn a_percentage_may_be_anything_up_to_100() {
        for percent in [0, 99, 100] {
            let text = format!("[late]\npercent_per_day = {percent}\nmost_percent = {percent}");
            let policy = Policy::from_text(Path::new("policy.toml"), &text).unwrap();
            assert_eq!(policy.late.percent_per_day, percent);
            assert_eq!(policy.late.most_percent, percent);
        }
    }

    #[test]
    fn a_policy_is_read_from_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("policy.toml");
        let error = Policy::read(&path).unwrap_err().to_string();
        assert!(error.contains("read the policy"), "{error}");
        assert!(error.contains("`cargo grade --policy-default`"), "{error}");
        let text = "[points]\nout_of = 50\n[late]\ntimezone = 'UTC'\ndue = 2026-11-20T23:59:59Z";
        std::fs::write(&path, text).unwrap();
        assert_eq!(Policy::read_text(&path).unwrap(), text);
        let policy = Policy::read(&path).unwrap();
        assert_eq!(policy.points.out_of, Some(50));
        assert!(policy.late.timezone.is_some() && policy.late.due.is_some());
    }
}
