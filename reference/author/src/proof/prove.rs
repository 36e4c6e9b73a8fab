//! The proof: seed after seed, every variant is asked and must lose nothing, and every mistake is
//! asked and must lose something.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::ops::Range;
use std::path::Path;
use std::sync::Mutex;

use indicatif::{ParallelProgressIterator, ProgressBar, ProgressStyle};
use rayon::prelude::*;

use crate::exams;
use crate::proof::solutions::{ProofError, Solutions};
use crate::proof::sources::ReadError;
use crate::proof::summary::{ProofSummary, SeedResult};
use crate::seed::Seed;

/// Asks one seed's exam.
fn prove_seed(
    exhibits: &Solutions,
    seed: u64,
    with_mistakes: bool,
) -> Result<SeedResult, ProofError> {
    let exam = exams::generate("proof", Seed(seed), &exhibits.recorder)?;
    let mut found = SeedResult {
        seed,
        with_mistakes,
        ..SeedResult::default()
    };
    for (variant, sources) in &exhibits.variants {
        let lost = exhibits.variant_losses(variant, sources, &exam)?;
        if !lost.is_empty() {
            found.false_fails.insert(variant.id.clone(), lost);
        }
    }
    for (mistake, sources) in exhibits.mistakes.iter().filter(|_| with_mistakes) {
        let problems = exhibits.grade_mistake(mistake, sources, &exam)?.problems();
        if !problems.is_empty() {
            found.uncaught.insert(mistake.id.clone(), problems);
        }
    }
    Ok(found)
}

/// Asks all these seeds, the first `with_mistakes` of them with the mistakes as well. What was
/// found out is kept after every seed: a proof that is stopped goes on where it was.
pub fn prove(
    exhibits: &Solutions,
    seeds: Range<u64>,
    with_mistakes: u64,
) -> Result<ProofSummary, ProofError> {
    let path = exhibits
        .workbench
        .scratch()
        .join("proofs")
        .join(format!("{}.jsonl", cache_key(exhibits)?));
    let notes = ProofCache::open(&path).map_err(|source| ProofError::Write {
        path: path.clone(),
        source,
    })?;
    let wants_mistakes = |seed: u64| seed - seeds.start < with_mistakes;
    let bar = ProgressBar::new(seeds.end - seeds.start).with_style(
        ProgressStyle::with_template("{wide_bar} {pos} of {len} seeds, {eta} left")
            .expect("a template that was tried"),
    );
    let found: Result<Vec<SeedResult>, ProofError> = seeds
        .clone()
        .into_par_iter()
        .progress_with(bar)
        .map(|seed| {
            let known = notes.seeds.get(&seed);
            match known.filter(|found| found.with_mistakes || !wants_mistakes(seed)) {
                Some(found) => Ok(found.clone()),
                None => {
                    let found = prove_seed(exhibits, seed, wants_mistakes(seed))?;
                    notes.append(&found).map_err(|source| ProofError::Write {
                        path: path.clone(),
                        source,
                    })?;
                    Ok(found)
                }
            }
        })
        .collect();
    Ok(ProofSummary {
        seeds,
        results: found?,
        mistakes: exhibits.mistakes.len(),
        variants: exhibits.variants.len(),
    })
}

/// What an earlier run of the same proof has found out.
struct ProofCache {
    seeds: BTreeMap<u64, SeedResult>,
    file: Mutex<File>,
}

impl ProofCache {
    fn open(path: &Path) -> io::Result<Self> {
        fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
        let text = fs::read_to_string(path).unwrap_or_default();
        // The last line of a run that was killed may be cut short.
        let known = text
            .lines()
            .filter_map(|line| serde_json::from_str::<SeedResult>(line).ok())
            .map(|found| (found.seed, found))
            .collect();
        let file = OpenOptions::new().create(true).append(true).open(path)?;
        Ok(ProofCache {
            seeds: known,
            file: Mutex::new(file),
        })
    }

    fn append(&self, found: &SeedResult) -> io::Result<()> {
        let line = serde_json::to_string(found)?;
        let mut file = self.file.lock().expect("nobody panics while writing");
        // A line of its own, whatever a run that was killed has left behind.
        writeln!(file, "\n{line}")
    }
}

/// What a proof's findings follow from: this program, and everything that is asked.
fn cache_key(exhibits: &Solutions) -> Result<String, ReadError> {
    let program = std::env::current_exe().unwrap_or_default();
    let bytes = fs::read(&program).map_err(|source| ReadError {
        path: program,
        source,
    })?;
    let mut hasher = blake2b_simd::State::new();
    hasher.update(&bytes);
    for (mistake, sources) in &exhibits.mistakes {
        hasher.update(format!("{mistake:?}{sources:?}").as_bytes());
    }
    for (variant, sources) in &exhibits.variants {
        hasher.update(format!("{variant:?}{sources:?}").as_bytes());
    }
    Ok(hasher.finalize().to_hex()[..16].to_owned())
}
