//! Checks that the exam catches every mechanical change to the reference's task files. Each mutant
//! must lose points unless it is equivalent to the reference.

use std::collections::BTreeMap;

use anyhow::{Result, bail};
use grader::task_selection::TaskSelection;

use crate::authoring::Authoring;
use crate::exams;
use crate::proof::run::run_compiled;
use crate::solutions::mutants::equivalent::{self, EquivalentMutant, equivalent_mutants};
use crate::solutions::mutants::mutants;
use crate::solutions::sources::Sources;
use crate::solutions::workbench::Workbench;

/// The step size for a sample. The mutants are sorted by name, and a sample contains every eighth
/// mutant.
pub const SAMPLE_STEP: usize = 8;

/// Builds every `step`-th mutant of some tasks and grades each with the practice exam.
pub fn run(authoring: &'static Authoring, tasks: &TaskSelection, step: usize) -> Result<Findings> {
    let workbench = Workbench::open(authoring)?;
    let handed_out = authoring.handed_out;
    let reference = Sources::reference(workbench.root(), handed_out)?;
    let exam = exams::load_practice(workbench.root(), authoring)?;
    let score = workbench.build(&reference, "reference")?.score(&exam)?;
    if score.points < score.max_points {
        // Otherwise, a mutant's loss of points would prove nothing.
        bail!("the reference itself loses points: run `cargo grade reference`");
    }

    let all = mutants(&reference)?;
    let of_tasks = all.iter().filter(|mutant| {
        let mut own = mutant.expected.tasks.iter();
        own.any(|&task| tasks.includes(task))
    });
    let sample = of_tasks.step_by(step);
    let graded = run_compiled(&workbench, sample, "mutants", |mutant, built| {
        let score = built.map(|built| built.score(&exam)).transpose()?;
        let outcome = match score {
            None => MutantOutcome::NotCompiled,
            Some(score) if score.points < score.max_points => MutantOutcome::Caught,
            Some(_) => MutantOutcome::Survived,
        };
        Ok((mutant.id.clone(), outcome))
    })?;
    let skipped = all.iter();
    let skipped = skipped.map(|mutant| (mutant.id.clone(), MutantOutcome::Skipped));
    Ok(Findings {
        outcomes: skipped.chain(graded).collect(),
        equivalent: equivalent_mutants(workbench.root(), handed_out)?,
    })
}

/// The outcome of grading one mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MutantOutcome {
    /// The mutant doesn't compile.
    NotCompiled,
    /// The mutant loses points.
    Caught,
    /// The mutant gets full marks.
    Survived,
    /// The mutant isn't in the sample, so it was not graded.
    Skipped,
}

/// The outcomes of all mutants.
#[derive(Clone, Debug)]
pub struct Findings {
    /// The outcomes, keyed by the mutants' names.
    pub outcomes: BTreeMap<String, MutantOutcome>,
    /// The mutants that are expected to survive.
    pub equivalent: Vec<EquivalentMutant>,
}

impl Findings {
    /// Returns a one-line summary.
    pub fn summary_line(&self) -> String {
        let count = |outcome: MutantOutcome| {
            self.outcomes
                .values()
                .filter(|found| **found == outcome)
                .count()
        };
        let survive = self.unexpected_survivors().count();
        format!(
            "{} made, {} rejected by the compiler, {} caught, {} equivalent, {survive} surviving",
            self.outcomes.len() - count(MutantOutcome::Skipped),
            count(MutantOutcome::NotCompiled),
            count(MutantOutcome::Caught),
            count(MutantOutcome::Survived) - survive,
        )
    }

    /// Returns the problems found, one line each.
    pub fn problems(&self) -> Vec<String> {
        let survive = self.unexpected_survivors().map(|name| {
            format!(
                "`{name}` survives: add a question to the exam that catches it, or explain in {} \
                 why no answer can differ",
                equivalent::FILE
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
                    let path = equivalent::FILE;
                    Some(format!("`{name}` {found}: remove it from {path}"))
                });
        survive.chain(wrongly_listed).collect()
    }

    /// Returns the survivors that aren't listed as equivalent.
    fn unexpected_survivors(&self) -> impl Iterator<Item = &String> {
        let survive = self
            .outcomes
            .iter()
            .filter(|(_, outcome)| **outcome == MutantOutcome::Survived);
        let is_unexpected =
            |name: &String| !self.equivalent.iter().any(|known| known.name == *name);
        survive
            .map(|(name, _)| name)
            .filter(move |name| is_unexpected(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn findings(equivalent: &[&str]) -> Findings {
        let outcomes = [
            ("a", MutantOutcome::Survived),
            ("b", MutantOutcome::Caught),
            ("c", MutantOutcome::NotCompiled),
            ("d", MutantOutcome::Skipped),
        ];
        let known = |name: &&str| EquivalentMutant {
            name: (*name).to_owned(),
            why: "the result is the same".to_owned(),
        };
        Findings {
            outcomes: outcomes.map(|(name, it)| (name.to_owned(), it)).into(),
            equivalent: equivalent.iter().map(known).collect(),
        }
    }

    #[test]
    fn expected_survivors_are_no_problem() {
        let findings = findings(&["a", "d"]);
        let summary = "3 made, 1 rejected by the compiler, 1 caught, 1 equivalent, 0 surviving";
        assert_eq!(findings.summary_line(), summary);
        assert_eq!(findings.problems(), [""; 0]);
    }

    #[test]
    fn reports_each_survivor_and_each_wrong_entry() {
        let findings = findings(&["b", "c", "e"]);
        assert!(
            findings
                .summary_line()
                .ends_with("0 equivalent, 1 surviving")
        );
        let expected = [
            "`a` survives: add a question to the exam that catches it, or explain in \
             mutants/equivalent.toml why no answer can differ",
            "`b` is caught: remove it from mutants/equivalent.toml",
            "`c` does not compile: remove it from mutants/equivalent.toml",
            "`e` does not exist: remove it from mutants/equivalent.toml",
        ];
        assert_eq!(findings.problems(), expected);
    }
}
