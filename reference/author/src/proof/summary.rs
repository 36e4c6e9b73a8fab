//! What a proof has found out.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::generated_file::GeneratedFile;

/// What came of one seed.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SeedResult {
    /// Which.
    pub seed: u64,
    /// Whether the mistakes were asked as well.
    pub with_mistakes: bool,
    /// Variants that lost points which they should not.
    pub false_fails: BTreeMap<String, Vec<String>>,
    /// Mistakes that did not cost what they should.
    pub uncaught: BTreeMap<String, Vec<String>>,
}

/// What came of all seeds.
#[derive(Debug)]
pub struct ProofSummary {
    /// From the first on, up to and without the last.
    pub seeds: Range<u64>,
    /// In the order of the seeds.
    pub results: Vec<SeedResult>,
    /// How many there are of each.
    pub mistakes: usize,
    /// How many there are.
    pub variants: usize,
}

impl ProofSummary {
    /// The closing line.
    pub fn summary_line(&self) -> String {
        let uncaught = self.names(|found| &found.uncaught);
        let failed = self.names(|found| &found.false_fails);
        let false_fails: usize = self
            .results
            .iter()
            .map(|found| found.false_fails.len())
            .sum();
        let with_mistakes = self
            .results
            .iter()
            .filter(|found| found.with_mistakes)
            .count();
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

    /// Whether nothing was found that should not be.
    pub fn is_proven(&self) -> bool {
        let fine = |found: &SeedResult| found.false_fails.is_empty() && found.uncaught.is_empty();
        self.results.iter().all(fine)
    }

    /// What was found that should not be, a line each.
    pub fn problems(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for found in &self.results {
            for (id, losses) in &found.false_fails {
                lines.push(format!(
                    "seed {}: {id} is right and loses: {}",
                    found.seed,
                    losses.join("; ")
                ));
            }
            for problems in found.uncaught.values() {
                lines.push(format!("seed {}: {}", found.seed, problems.join("; ")));
            }
        }
        lines
    }

    fn names(&self, of: impl Fn(&SeedResult) -> &BTreeMap<String, Vec<String>>) -> Vec<&String> {
        let mut names: Vec<&String> = self
            .results
            .iter()
            .flat_map(|found| of(found).keys())
            .collect();
        names.sort();
        names.dedup();
        names
    }

    /// The whole of it, to be committed: when, and of which commit.
    pub fn record(&self, date: &str, commit: &str) -> GeneratedFile {
        let mut text = format!(
            "# What was proven last\n\n\
             Written by `cargo author prove --seeds {}..{} --write` on {date}, at commit {commit}: \
             the exams of these seeds were asked of every right solution in `reference/variants`, and \
             the first few of them of every mistake in `reference/mistakes`.\n\n\
             > {}\n",
            self.seeds.start,
            self.seeds.end,
            self.summary_line()
        );
        if !self.is_proven() {
            text += "\n";
            text.extend(self.problems().iter().map(|line| format!("- {line}\n")));
        }
        GeneratedFile::new("reference/variants/proof.md", text)
    }
}
