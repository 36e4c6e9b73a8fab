//! Records the keys that only the reference can provide. The reference runs in a probe and answers
//! over a pipe, like any submission.

use std::time::Duration;

use anyhow::{Result, anyhow, bail};
use glam::Vec3;
use grader::probe::ItemLimits;
use judging::exam::{Exam, Key};
use protocol::{Answer, ElementOutcome, Question};

use crate::solutions::sources::Sources;
use crate::solutions::workbench::{BuiltSolution, Workbench};

/// The time limit for rendering a picture.
const LIMITS: ItemLimits = ItemLimits::from_cpu(Duration::from_secs(60));

/// The reference, ready to render pictures.
#[derive(Debug)]
pub struct Recorder {
    sources: Sources,
    reference: BuiltSolution,
}

impl Recorder {
    /// Reads and builds the reference.
    pub fn open(workbench: &Workbench) -> Result<Self> {
        let sources = Sources::reference(workbench.root(), workbench.handed_out())?;
        let reference = workbench.build(&sources, "reference");
        let reference =
            reference.map_err(|error| anyhow!("cannot build the reference: {error}"))?;
        Ok(Recorder { sources, reference })
    }

    /// Returns the reference's files.
    pub fn reference(&self) -> &Sources {
        &self.sources
    }

    /// Sets the exam's keys for rendered pictures to the reference's answers.
    pub fn record(&self, mut exam: Exam) -> Result<Exam> {
        for asked in exam.items.iter_mut().flat_map(|item| &mut item.questions) {
            if let Key::Radiance { pixels, .. } = &mut asked.key {
                *pixels = self.picture(&asked.question)?;
            }
        }
        Ok(exam)
    }

    /// Returns the reference's answer to a question about a picture: the linear red, green and blue
    /// values of each pixel, row by row from the bottom.
    fn picture(&self, question: &Question) -> Result<Vec<Vec3>> {
        let probe = self.reference.launcher().start(LIMITS.cpu);
        let answers = probe
            .map_err(|error| anyhow!("cannot start the reference's probe: {error}"))?
            .ask([question], LIMITS)
            .map_err(|fault| anyhow!("the reference did not answer: {fault:?}"))?;
        match answers.into_iter().next() {
            Some(Answer::Picture(ElementOutcome::Value(pixels))) => Ok(pixels),
            other => bail!("the reference did not render the picture: {other:?}"),
        }
    }
}
