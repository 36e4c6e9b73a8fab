//! The results of a proof.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::solutions::failed_items;

/// The result of a proof for one seed.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SeedResult {
    /// The seed of the exam that was used.
    pub seed: u64,
    /// Whether the mistakes were also graded with this seed.
    pub with_mistakes: bool,
    /// The variants that lost points although they are correct, each with the items it failed.
    pub false_fails: BTreeMap<String, Vec<String>>,
    /// The mistakes that didn't lose the points they must lose, each with the problems found.
    pub uncaught: BTreeMap<String, Vec<String>>,
    /// The mistakes that passed some of the items that `fails.toml` lists for them, each with those
    /// items. Other items still caught these mistakes.
    #[serde(default)]
    pub passed: BTreeMap<String, Vec<String>>,
}

/// The results of a proof for all seeds.
#[derive(Debug)]
pub struct ProofSummary {
    /// The seeds of the exams that were used.
    pub seeds: Range<u64>,
    /// The result for each seed.
    pub results: Vec<SeedResult>,
    /// The number of mistakes.
    pub mistakes: usize,
    /// The number of variants.
    pub variants: usize,
}

impl ProofSummary {
    /// Returns a one-line summary.
    pub fn summary_line(&self) -> String {
        let uncaught = self.names(|result| &result.uncaught);
        let failed = self.names(|result| &result.false_fails);
        let results = self.results.iter();
        let false_fails = results.clone().map(|result| result.false_fails.len());
        let false_fails: usize = false_fails.sum();
        let with_mistakes = results.filter(|result| result.with_mistakes).count();
        format!(
            "mistakes caught {} of {} ({with_mistakes} seeds), variants passed {} of {}, seeds {}, \
             false fails {false_fails}",
            self.mistakes - uncaught.len(),
            self.mistakes,
            self.variants - failed.len(),
            self.variants,
            self.results.len(),
        )
    }

    /// Returns the problems found, one line each.
    pub fn problems(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for result in &self.results {
            for (id, losses) in &result.false_fails {
                lines.push(format!(
                    "seed {}: {id} is correct but loses points: {}",
                    result.seed,
                    losses.join("; ")
                ));
            }
            for problems in result.uncaught.values() {
                lines.push(format!("seed {}: {}", result.seed, problems.join("; ")));
            }
        }
        lines
    }

    /// Returns facts that are worth knowing but aren't problems, one line each.
    pub fn notes(&self) -> Vec<String> {
        let results = self.results.iter();
        let notes = results.flat_map(|result| {
            let passed = result.passed.iter();
            passed.map(|(id, items)| {
                format!(
                    "note: with seed {}, {id} passes {}, which it fails with every seed \
                     according to {}",
                    result.seed,
                    items.join(", "),
                    failed_items::FILE
                )
            })
        });
        notes.collect()
    }

    fn names(
        &self,
        of: impl Fn(&SeedResult) -> &BTreeMap<String, Vec<String>>,
    ) -> BTreeSet<&String> {
        let results = self.results.iter();
        results.flat_map(|result| of(result).keys()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_item_passed_by_luck_is_a_note_and_no_problem() {
        let passed = [("bbox.a".to_owned(), vec!["bbox.flat".to_owned()])];
        let summary = ProofSummary {
            seeds: 5000..5001,
            results: vec![SeedResult {
                seed: 5000,
                with_mistakes: true,
                passed: passed.into(),
                ..SeedResult::default()
            }],
            mistakes: 1,
            variants: 0,
        };
        assert_eq!(summary.problems(), [""; 0]);
        assert_eq!(
            summary.notes(),
            [
                "note: with seed 5000, bbox.a passes bbox.flat, which it fails with every seed \
                 according to mistakes/fails.toml"
            ]
        );
    }
}
