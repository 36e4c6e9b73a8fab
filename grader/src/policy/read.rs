//! Reads policies. An invalid policy is rejected with a message that shows the line and says what
//! to do.

use std::path::Path;

use jiff::Timestamp;
use jiff::tz::TimeZone;
use serde::de;
use serde::{Deserialize, Deserializer};
use toml::value::Datetime;

use crate::error::Error;
use crate::inputs::nearest_name::suggestion;
use crate::machine::files;
use crate::policy::Policy;
use crate::policy::written_time::has_plausible_year;

impl Policy {
    /// Reads the policy at `path`.
    pub fn read(path: &Path) -> Result<Policy, Error> {
        Policy::from_text(path, &Policy::read_text(path)?)
    }

    /// Reads the text of the policy at `path`, which need not be valid.
    pub fn read_text(path: &Path) -> Result<String, Error> {
        files::read_to_string(path).map_err(|error| {
            let error = error.of_action("read the policy");
            Error::User(format!(
                "{error}; `cargo grade --policy-default` prints one to start from"
            ))
        })
    }

    /// Parses a policy. `path` is used in error messages only.
    pub fn from_text(path: &Path, text: &str) -> Result<Policy, Error> {
        Policy::parse(text).map_err(|problem| problem.into_error(path, text))
    }

    /// Parses a policy for an exam, and rejects names of items and tasks that the exam does not
    /// contain. Otherwise a misspelt name would go unnoticed.
    pub fn for_exam<'a>(
        path: &Path,
        text: &str,
        items: impl Iterator<Item = &'a str>,
    ) -> Result<Policy, Error> {
        let policy = Policy::from_text(path, text)?;
        match policy.name_problem(&items.collect::<Vec<_>>()) {
            None => Ok(policy),
            Some((name, problem)) => {
                let offset = name_offset(text, name);
                Err(Problem { offset, problem }.into_error(path, text))
            }
        }
    }

    /// Returns a name that does not fit these items, and the problem with it.
    fn name_problem(&self, items: &[&str]) -> Option<(&str, String)> {
        let mut tasks: Vec<&str> = items.iter().map(|item| task_of(item)).collect();
        tasks.dedup();
        let both = || items.iter().chain(&tasks).copied();
        let unknown = |name: &String, thing: &str, known: Vec<&str>| {
            let nearest = suggestion(name, known);
            format!("the exam has no {thing} `{name}`{nearest}: correct it or remove it")
        };
        let shown = self.visibility.items.keys().map(|name| {
            let is_known = both().any(|known| known == name);
            let problem = || unknown(name, "task or item", both().collect());
            (name, (!is_known).then(problem))
        });
        let void = self.points.void.iter().map(|name| {
            let problem = if tasks.contains(&name.as_str()) {
                Some(format!(
                    "`{name}` is a task: name its items, or write `{name} = 0` under [points.tasks]"
                ))
            } else {
                let is_known = items.contains(&name.as_str());
                (!is_known).then(|| unknown(name, "item", items.to_vec()))
            };
            (name, problem)
        });
        let weighted = self.points.tasks.keys().map(|name| {
            let is_known = tasks.contains(&name.as_str());
            let problem = || unknown(name, "task", tasks.clone());
            (name, (!is_known).then(problem))
        });
        let mut all = shown.chain(void).chain(weighted);
        let problem = all.find_map(|(name, problem)| Some((name.as_str(), problem?)));
        let counts = |item: &&str| {
            !self.points.is_void(item) && self.points.tasks.get(task_of(item)) != Some(&0)
        };
        let nothing = || {
            let problem = "no item is left that counts: leave one in";
            ("void", problem.to_owned())
        };
        problem.or_else(|| (!items.is_empty() && !items.iter().any(counts)).then(nothing))
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

    /// Returns the key with an invalid value, and the problem with it.
    fn problem(&self) -> Option<(&str, &'static str)> {
        let late = &self.late;
        let mut extensions = late.extensions.iter();
        let far = extensions.find(|(_, extension)| extension.is_far_from(late.due));
        if let Some((name, _)) = far {
            return Some((name, "must be at most half a year from the due time"));
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

/// Reads a due time. TOML also has dates, and times without an offset, which are no points in time.
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

/// A problem at a byte offset of the text.
struct Problem {
    offset: usize,
    problem: String,
}

impl Problem {
    fn into_error(self, path: &Path, text: &str) -> Error {
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

/// Returns the task of an item's id.
fn task_of(item: &str) -> &str {
    item.split('.').next().unwrap_or(item)
}

/// Returns the byte offset of the first use of a name, apart from comments and longer names.
fn name_offset(text: &str, name: &str) -> usize {
    let is_part = |char: char| char.is_alphanumeric() || "_-.".contains(char);
    let is_use = |(begin, _): &(usize, &str)| {
        let (before, after) = (&text[..*begin], &text[begin + name.len()..]);
        let line = before.lines().next_back().unwrap_or_default();
        let line = if before.ends_with('\n') { "" } else { line };
        !line.contains('#') && !before.ends_with(is_part) && !after.starts_with(is_part)
    };
    let mut uses = text.match_indices(name).filter(is_use);
    uses.next().map_or(0, |(begin, _)| begin)
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
    use crate::score::tests::small_exam::exam;

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

    #[test]
    fn a_name_that_the_exam_does_not_have_is_rejected_with_its_line() {
        let exam = exam(&["sphere.uv", "sphere.normal", "bbox.flat"]);
        let check = |text: &str| {
            let items = exam.items.iter().map(|item| item.id.as_str());
            let policy = Policy::for_exam(Path::new("policy.toml"), text, items);
            policy.err().map(|error| {
                let error = error.to_string();
                let end = "\n`cargo grade --policy-default` prints all keys with explanations";
                error.strip_suffix(end).unwrap().to_owned()
            })
        };
        let right = "[points]\nvoid = ['sphere.uv']\n[points.tasks]\nbbox = 0\n\
                     [visibility.items]\n'sphere.uv' = 'hidden'\nsphere = 'points'";
        assert_eq!(check(right), None);
        let errors = [
            "[visibility.items]\n# 'sphere.vu' is right\nsphere = 'points'\n'sphere.vu' = 'hidden'",
            "[points]\nvoid = [\n  'bbox.flat', # not flat.\n  'bbox.fat',\n]",
            "[points]\nvoid = ['sphere']",
            "[points]\nvoid = ['light.far']",
            "[points.tasks]\nsphere = 9\nspheres = 3",
            "[points.tasks]\n'sphere.uv' = 3",
            "[points]\nvoid = ['bbox.flat']\ntasks = { sphere = 0 }",
        ];
        let errors = errors.map(|text| check(text).unwrap());
        insta::assert_snapshot!(errors.join("\n"));
    }
}
