//! What became of the mutants, beside what was foretold.

use std::collections::BTreeMap;

use crate::proof::mutants::equivalent::{self, EquivalentMutant};

/// What became of one mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MutantOutcome {
    /// The compiler refuses it: nobody can hand it in.
    NotCompiled,
    /// It loses points.
    Caught,
    /// It earns them all.
    Survived,
    /// It was left out, in haste.
    Skipped,
}

/// What became of all.
#[derive(Clone, Debug)]
pub struct Findings {
    /// By name.
    pub outcomes: BTreeMap<String, MutantOutcome>,
    /// Those that should survive, and no others.
    pub equivalent: Vec<EquivalentMutant>,
}

impl Findings {
    /// The closing line.
    pub fn summary_line(&self) -> String {
        let count = |fate: MutantOutcome| {
            self.outcomes
                .values()
                .filter(|found| **found == fate)
                .count()
        };
        let survive = self.unexpected_survivors().count();
        format!(
            "mutants: {} made, {} do not compile, {} caught, {} equivalent, {survive} survive",
            self.outcomes.len() - count(MutantOutcome::Skipped),
            count(MutantOutcome::NotCompiled),
            count(MutantOutcome::Caught),
            count(MutantOutcome::Survived) - survive,
        )
    }

    /// What is not as it should be, a line each.
    pub fn problems(&self) -> Vec<String> {
        let survive = self.unexpected_survivors().map(|name| {
            format!(
                "`{name}` survives: sharpen the exam; if no answer can differ, say why in {}",
                equivalent::PATH
            )
        });
        let wrongly_listed =
            self.equivalent
                .iter()
                .filter_map(|EquivalentMutant { name, .. }| {
                    let found = match self.outcomes.get(name) {
                        Some(MutantOutcome::Survived | MutantOutcome::Skipped) => return None,
                        Some(MutantOutcome::Caught) => "is caught",
                        Some(MutantOutcome::NotCompiled) => "does not compile",
                        None => "does not exist",
                    };
                    let path = equivalent::PATH;
                    Some(format!("`{name}` {found}: take it out of {path}"))
                });
        survive.chain(wrongly_listed).collect()
    }

    /// Those that should not.
    fn unexpected_survivors(&self) -> impl Iterator<Item = &String> {
        let survive = self
            .outcomes
            .iter()
            .filter(|(_, fate)| **fate == MutantOutcome::Survived);
        let unforeseen = |name: &String| !self.equivalent.iter().any(|known| known.name == *name);
        survive
            .map(|(name, _)| name)
            .filter(move |name| unforeseen(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn findings(fates: &[(&str, MutantOutcome)], equivalent: &[&str]) -> Findings {
        Findings {
            outcomes: fates
                .iter()
                .map(|(name, fate)| ((*name).to_owned(), *fate))
                .collect(),
            equivalent: equivalent
                .iter()
                .map(|name| EquivalentMutant {
                    name: (*name).to_owned(),
                    why: "it is".to_owned(),
                })
                .collect(),
        }
    }

    #[test]
    fn expected_survivors_are_no_problem() {
        let fates = [
            ("a", MutantOutcome::Survived),
            ("b", MutantOutcome::Caught),
            ("c", MutantOutcome::NotCompiled),
            ("d", MutantOutcome::Skipped),
        ];
        let findings = findings(&fates, &["a", "d"]);
        assert_eq!(
            findings.summary_line(),
            "mutants: 3 made, 1 do not compile, 1 caught, 1 equivalent, 0 survive"
        );
        assert_eq!(findings.problems(), [""; 0]);
    }

    #[test]
    fn reports_each_survivor_and_each_wrong_entry() {
        let fates = [
            ("a", MutantOutcome::Survived),
            ("b", MutantOutcome::Caught),
            ("c", MutantOutcome::NotCompiled),
        ];
        let findings = findings(&fates, &["b", "c", "d"]);
        assert!(findings.summary_line().ends_with("0 equivalent, 1 survive"));
        assert_eq!(
            findings.problems(),
            [
                "`a` survives: sharpen the exam; if no answer can differ, say why in \
                 reference/mutants/equivalent.toml",
                "`b` is caught: take it out of reference/mutants/equivalent.toml",
                "`c` does not compile: take it out of reference/mutants/equivalent.toml",
                "`d` does not exist: take it out of reference/mutants/equivalent.toml",
            ]
        );
    }
}
