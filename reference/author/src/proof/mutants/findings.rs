//! What became of the mutants, beside what was foretold.

use std::collections::BTreeMap;

use crate::proof::mutants::equivalent::{self, Equivalent};

/// What became of one mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// The compiler refuses it: nobody can hand it in.
    NotCompiled,
    /// It loses points.
    Caught,
    /// It earns them all.
    Survives,
    /// It was left out, in haste.
    NotAsked,
}

/// What became of all.
#[derive(Clone, Debug)]
pub struct Findings {
    /// By name.
    pub fates: BTreeMap<String, Fate>,
    /// Those that should survive, and no others.
    pub equivalent: Vec<Equivalent>,
}

impl Findings {
    /// The closing line.
    pub fn line(&self) -> String {
        let count = |fate: Fate| self.fates.values().filter(|found| **found == fate).count();
        let survive = self.survivors().count();
        format!(
            "mutants: {} made, {} do not compile, {} caught, {} equivalent, {survive} survive",
            self.fates.len() - count(Fate::NotAsked),
            count(Fate::NotCompiled),
            count(Fate::Caught),
            count(Fate::Survives) - survive,
        )
    }

    /// What is not as it should be, a line each.
    pub fn complaints(&self) -> Vec<String> {
        let survive = self.survivors().map(|name| {
            format!(
                "`{name}` survives: sharpen the exam; if no answer can differ, say why in {}",
                equivalent::PATH
            )
        });
        let wrongly_listed = self
            .equivalent
            .iter()
            .filter_map(|Equivalent { name, .. }| {
                let found = match self.fates.get(name) {
                    Some(Fate::Survives | Fate::NotAsked) => return None,
                    Some(Fate::Caught) => "is caught",
                    Some(Fate::NotCompiled) => "does not compile",
                    None => "does not exist",
                };
                let path = equivalent::PATH;
                Some(format!("`{name}` {found}: take it out of {path}"))
            });
        survive.chain(wrongly_listed).collect()
    }

    /// Those that should not.
    fn survivors(&self) -> impl Iterator<Item = &String> {
        let survive = self
            .fates
            .iter()
            .filter(|(_, fate)| **fate == Fate::Survives);
        let unforeseen = |name: &String| !self.equivalent.iter().any(|known| known.name == *name);
        survive
            .map(|(name, _)| name)
            .filter(move |name| unforeseen(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn findings(fates: &[(&str, Fate)], equivalent: &[&str]) -> Findings {
        Findings {
            fates: fates
                .iter()
                .map(|(name, fate)| ((*name).to_owned(), *fate))
                .collect(),
            equivalent: equivalent
                .iter()
                .map(|name| Equivalent {
                    name: (*name).to_owned(),
                    why: "it is".to_owned(),
                })
                .collect(),
        }
    }

    #[test]
    fn survivors_that_were_foretold_are_no_complaint() {
        let fates = [
            ("a", Fate::Survives),
            ("b", Fate::Caught),
            ("c", Fate::NotCompiled),
            ("d", Fate::NotAsked),
        ];
        let findings = findings(&fates, &["a", "d"]);
        assert_eq!(
            findings.line(),
            "mutants: 3 made, 1 do not compile, 1 caught, 1 equivalent, 0 survive"
        );
        assert_eq!(findings.complaints(), [""; 0]);
    }

    #[test]
    fn each_survivor_and_each_wrong_listing_is_named() {
        let fates = [
            ("a", Fate::Survives),
            ("b", Fate::Caught),
            ("c", Fate::NotCompiled),
        ];
        let findings = findings(&fates, &["b", "c", "d"]);
        assert!(findings.line().ends_with("0 equivalent, 1 survive"));
        assert_eq!(
            findings.complaints(),
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
