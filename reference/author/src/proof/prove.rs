//! The proof. For many seeds, it grades every variant, which must lose no points, and every
//! mistake, which must lose some.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use anyhow::Result;
use grader::files::{self, AtPath, PathError};
use judging::content_hash::ContentHash;

use crate::proof::grade::{GradedSolution, variant_losses};
use crate::proof::run::{exam_of, for_seeds};
use crate::proof::summary::{ProofSummary, SeedResult};
use crate::solutions::Solutions;
use crate::solutions::failed_items::FailedItems;

/// Grades all solutions with the exam for one seed. If the lists of failed items were made with
/// this seed, a mistake must fail all items in its list. With any other seed, the mistake can pass
/// one of these items by luck: an item that misses the mistake in one exam out of 200 is still
/// likely to be in a list made with 20 seeds.
fn prove_seed(
    solutions: &Solutions,
    seed: u64,
    with_mistakes: bool,
    is_listed: bool,
) -> Result<SeedResult> {
    let exam = exam_of(solutions, seed)?;
    let mut result = SeedResult {
        seed,
        with_mistakes,
        ..SeedResult::default()
    };
    let workbench = &solutions.workbench;
    for variant in &solutions.variants {
        let lost = variant_losses(workbench, variant, &exam)?;
        if !lost.is_empty() {
            result.false_fails.insert(variant.id.clone(), lost);
        }
    }
    for mistake in solutions.mistakes.iter().filter(|_| with_mistakes) {
        let built = workbench.build(&mistake.sources, &mistake.id)?;
        let graded = GradedSolution::new(mistake, &built, &exam)?;
        let passed = graded.passed_items();
        let problems = if is_listed {
            graded.problems()
        } else {
            graded.task_problems()
        };
        if !problems.is_empty() {
            result.uncaught.insert(mistake.id.clone(), problems);
        }
        if !is_listed && !passed.is_empty() {
            result.passed.insert(mistake.id.clone(), passed);
        }
    }
    Ok(result)
}

/// Runs the proof for these seeds. Mistakes are only graded with the first `with_mistakes` seeds.
/// The result of every seed is saved, so that an interrupted proof can be continued.
pub fn prove(solutions: &Solutions, seeds: Range<u64>, with_mistakes: u64) -> Result<ProofSummary> {
    let workbench = &solutions.workbench;
    let listed_seeds = FailedItems::load(workbench.root(), workbench.handed_out())?.seeds;
    let key = cache_key(solutions, listed_seeds)?;
    let cache = ProofCache::open(workbench.scratch().join(format!("proofs/{key}.jsonl")))?;
    let wants_mistakes = |seed: u64| seed - seeds.start < with_mistakes;
    let results = for_seeds(seeds.clone(), |seed| {
        let cached = cache.seeds.get(&seed);
        match cached.filter(|result| result.with_mistakes || !wants_mistakes(seed)) {
            Some(result) => Ok(result.clone()),
            None => {
                let result =
                    prove_seed(solutions, seed, wants_mistakes(seed), seed < listed_seeds)?;
                cache.append(&result)?;
                Ok(result)
            }
        }
    })?;
    Ok(ProofSummary {
        seeds,
        results,
        mistakes: solutions.mistakes.len(),
        variants: solutions.variants.len(),
    })
}

/// The saved results of earlier runs of the same proof.
struct ProofCache {
    seeds: BTreeMap<u64, SeedResult>,
    path: PathBuf,
    file: Mutex<File>,
}

impl ProofCache {
    fn open(path: PathBuf) -> Result<Self, PathError> {
        files::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
        let text = fs::read_to_string(&path).unwrap_or_default();
        // The last line is incomplete if a run was killed while writing it.
        let results = text
            .lines()
            .filter_map(|line| serde_json::from_str(line).ok());
        let seeds = results.map(|result: SeedResult| (result.seed, result));
        let file = OpenOptions::new().create(true).append(true).open(&path);
        let file = file.at("write", &path)?;
        Ok(ProofCache {
            seeds: seeds.collect(),
            path,
            file: Mutex::new(file),
        })
    }

    fn append(&self, result: &SeedResult) -> Result<(), PathError> {
        let line = serde_json::to_string(result).expect("all map keys are strings");
        let mut file = self.file.lock().expect("no thread panics while writing");
        // Start with a line break, in case a killed run left an incomplete line.
        writeln!(file, "\n{line}").at("write", &self.path)
    }
}

/// Returns a hash of everything a proof depends on: this program, all solutions and the lists of
/// failed items.
fn cache_key(solutions: &Solutions, listed_seeds: u64) -> Result<String, PathError> {
    let program = std::env::current_exe().unwrap_or_default();
    let mut hash = ContentHash::default()
        .with(&files::read(program)?)
        .with(&listed_seeds.to_le_bytes());
    for solution in solutions.mistakes.iter().chain(&solutions.variants) {
        hash.add(format!("{solution:?}").as_bytes());
    }
    Ok(hash.hex())
}
