//! Grades a submission that answers the practice exam by heart: it must earn nothing in final exams.

use std::ops::Range;

use grader::score::Score;
use indicatif::ParallelProgressIterator;
use judging::exam::Exam;
use rayon::prelude::*;

use crate::exams;
use crate::proof::ProofError;
use crate::proof::progress::progress_bar;
use crate::seed::Seed;
use crate::solutions::Solutions;
use crate::solutions::by_heart::by_heart;
use crate::solutions::sources::Sources;

/// The points that the submission earns.
#[derive(Debug)]
pub struct ByHeart {
    /// The submission.
    pub sources: Sources,
    /// The seeds of the final exams.
    pub seeds: Range<u64>,
    /// The points in the practice exam.
    pub practice_points: u32,
    /// The items of final exams that earned points, each with the seed of its exam.
    pub earned: Vec<(u64, String)>,
}

/// Makes the submission, and grades it with the practice exam and with final exams of these seeds.
pub fn grade_by_heart(
    solutions: &Solutions,
    practice: &Exam,
    seeds: Range<u64>,
) -> Result<ByHeart, ProofError> {
    let workbench = &solutions.workbench;
    let reference = solutions.recorder.built_reference();
    let sources = by_heart(practice, reference, workbench.handed_out())?;
    let build = || workbench.build(&sources, "by heart");
    let practice_points = build()?.score(practice)?.points;
    let scores: Result<Vec<(u64, Score)>, ProofError> = seeds
        .clone()
        .into_par_iter()
        .progress_with(progress_bar(seeds.end - seeds.start, "seeds"))
        .map(|seed| {
            let exam = exams::generate("proof", Seed(seed), &solutions.recorder)?;
            Ok((seed, build()?.score(&exam)?))
        })
        .collect();
    let mut earned = Vec::new();
    for (seed, score) in scores? {
        let items = score.items().filter(|item| item.points > 0);
        earned.extend(items.map(|item| (seed, item.id.clone())));
    }
    Ok(ByHeart {
        sources,
        seeds,
        practice_points,
        earned,
    })
}

impl ByHeart {
    /// Returns the items that earned points in final exams, one line each.
    pub fn problems(&self) -> Vec<String> {
        let problems = self.earned.iter().map(|(seed, item)| {
            format!("seed {seed}: answers to the practice exam earn points in {item}")
        });
        problems.collect()
    }

    /// Returns a one-line summary.
    pub fn summary_line(&self) -> String {
        let Range { start, end } = self.seeds;
        format!(
            "by heart: {} of 100 points in the practice exam, points in {} items of {} final exams \
             (seeds {start}..{end})",
            self.practice_points,
            self.earned.len(),
            end - start,
        )
    }
}
