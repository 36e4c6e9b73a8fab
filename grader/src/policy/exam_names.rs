//! Checks that the items and tasks named in a policy exist in the exam.

use std::path::Path;

use crate::error::Error;
use crate::inputs::nearest_name::suggestion;
use crate::policy::Policy;
use crate::policy::read::Problem;

impl Policy {
    /// Parses a policy for an exam and rejects names of items and tasks that the exam doesn't
    /// contain. Otherwise, a misspelt name would go unnoticed.
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

    /// Returns a name in the policy that doesn't fit these items, and a message that describes the
    /// problem.
    fn name_problem(&self, items: &[&str]) -> Option<(&str, String)> {
        let mut tasks: Vec<&str> = items.iter().map(|item| task_of(item)).collect();
        tasks.dedup();
        let both = || items.iter().chain(&tasks).copied();
        let unknown = |name: &String, thing: &str, known: Vec<&str>| {
            let nearest = suggestion(name, known);
            format!("the exam has no {thing} `{name}`{nearest}: correct the name or remove it")
        };
        let shown = self.visibility.items.keys().map(|name| {
            let is_known = both().any(|known| known == name);
            let problem = || unknown(name, "task or item", both().collect());
            (name, (!is_known).then(problem))
        });
        let void = self.points.void.iter().map(|name| {
            let problem = if tasks.contains(&name.as_str()) {
                Some(format!(
                    "`{name}` is a task: list its items, or write `{name} = 0` under [points.tasks]"
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
            let problem = "no items would be left: keep at least one";
            ("void", problem.to_owned())
        };
        problem.or_else(|| (!items.is_empty() && !items.iter().any(counts)).then(nothing))
    }
}

/// Returns the task named in an item's id.
fn task_of(item: &str) -> &str {
    item.split('.').next().unwrap_or(item)
}

/// Returns the byte offset of the first use of a name, ignoring comments and longer names.
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

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::policy::Policy;
    use crate::score::tests::small_exam::exam;

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
