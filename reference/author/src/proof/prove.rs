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
use crate::proof::exhibits::{Exhibits, NotProven};
use crate::proof::sources::Unreadable;
use crate::proof::summary::{Found, Summary};
use crate::seed::Seed;

/// Asks one seed's exam.
fn ask(exhibits: &Exhibits, seed: u64, with_mistakes: bool) -> Result<Found, NotProven> {
    let exam = exams::whole("proof", Seed(seed), &exhibits.recorder)?;
    let mut found = Found {
        seed,
        with_mistakes,
        ..Found::default()
    };
    for (variant, sources) in &exhibits.variants {
        let lost = exhibits.variant_losses(variant, sources, &exam)?;
        if !lost.is_empty() {
            found.false_fails.insert(variant.id.clone(), lost);
        }
    }
    for (mistake, sources) in exhibits.mistakes.iter().filter(|_| with_mistakes) {
        let problems = exhibits.tried(mistake, sources, &exam)?.problems();
        if !problems.is_empty() {
            found.uncaught.insert(mistake.id.clone(), problems);
        }
    }
    Ok(found)
}

/// Asks all these seeds, the first `with_mistakes` of them with the mistakes as well. What was
/// found out is kept after every seed: a proof that is stopped goes on where it was.
pub fn prove(
    exhibits: &Exhibits,
    seeds: Range<u64>,
    with_mistakes: u64,
) -> Result<Summary, NotProven> {
    let path = exhibits
        .workbench
        .scratch()
        .join("proofs")
        .join(format!("{}.jsonl", identity(exhibits)?));
    let notes = Notes::open(&path).map_err(|source| NotProven::Unwritable {
        path: path.clone(),
        source,
    })?;
    let wants_mistakes = |seed: u64| seed - seeds.start < with_mistakes;
    let bar = ProgressBar::new(seeds.end - seeds.start).with_style(
        ProgressStyle::with_template("{wide_bar} {pos} of {len} seeds, {eta} left")
            .expect("a template that was tried"),
    );
    let found: Result<Vec<Found>, NotProven> = seeds
        .clone()
        .into_par_iter()
        .progress_with(bar)
        .map(|seed| {
            let known = notes.known.get(&seed);
            match known.filter(|found| found.with_mistakes || !wants_mistakes(seed)) {
                Some(found) => Ok(found.clone()),
                None => {
                    let found = ask(exhibits, seed, wants_mistakes(seed))?;
                    notes.add(&found).map_err(|source| NotProven::Unwritable {
                        path: path.clone(),
                        source,
                    })?;
                    Ok(found)
                }
            }
        })
        .collect();
    Ok(Summary {
        seeds,
        found: found?,
        mistakes: exhibits.mistakes.len(),
        variants: exhibits.variants.len(),
    })
}

/// What an earlier run of the same proof has found out.
struct Notes {
    known: BTreeMap<u64, Found>,
    file: Mutex<File>,
}

impl Notes {
    fn open(path: &Path) -> io::Result<Self> {
        fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
        let text = fs::read_to_string(path).unwrap_or_default();
        // The last line of a run that was killed may be cut short.
        let known = text
            .lines()
            .filter_map(|line| serde_json::from_str::<Found>(line).ok())
            .map(|found| (found.seed, found))
            .collect();
        let file = OpenOptions::new().create(true).append(true).open(path)?;
        Ok(Notes {
            known,
            file: Mutex::new(file),
        })
    }

    fn add(&self, found: &Found) -> io::Result<()> {
        let line = serde_json::to_string(found)?;
        let mut file = self.file.lock().expect("nobody panics while writing");
        // A line of its own, whatever a run that was killed has left behind.
        writeln!(file, "\n{line}")
    }
}

/// What a proof's findings follow from: this program, and everything that is asked.
fn identity(exhibits: &Exhibits) -> Result<String, Unreadable> {
    let program = std::env::current_exe().unwrap_or_default();
    let bytes = fs::read(&program).map_err(|source| Unreadable {
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
