//! Records the keys that only the reference can provide. The reference runs in a probe and answers
//! over a pipe, like any submission.

use std::time::Duration;

use anyhow::{Result, anyhow, bail};
use glam::Vec3;
use grader::files;
use grader::probe::ItemLimits;
use protocol::{Answer, ElementOutcome, Question};

use crate::solutions::sources::Sources;
use crate::solutions::workbench::{BuiltSolution, Workbench};

/// The path of the radiance item's scene, relative to the workspace root.
const SCENE: &str = "scenes/cornell-box.json";

/// The time limit for rendering a picture.
const LIMITS: ItemLimits = ItemLimits::from_cpu(Duration::from_secs(60));

/// The reference, ready to render pictures of the Cornell box.
#[derive(Debug)]
pub struct Recorder {
    scene: String,
    sources: Sources,
    reference: BuiltSolution,
}

impl Recorder {
    /// Reads the scene and the reference's files, and builds the reference.
    pub fn open(workbench: &Workbench) -> Result<Self> {
        let scene = files::read_to_string(workbench.root().join(SCENE))?;
        let sources = Sources::reference(workbench.root(), workbench.handed_out())?;
        let reference = workbench.build(&sources, "reference");
        let reference =
            reference.map_err(|error| anyhow!("cannot build the reference: {error}"))?;
        Ok(Recorder {
            scene,
            sources,
            reference,
        })
    }

    /// Returns the reference's files.
    pub fn reference(&self) -> &Sources {
        &self.sources
    }

    /// Returns the text of the Cornell box's scene file.
    pub fn scene(&self) -> &str {
        &self.scene
    }

    /// Returns the reference's answer to a question about a picture: linear red, green and blue of
    /// each pixel, row by row from the bottom.
    pub fn record(&self, question: &Question) -> Result<Vec<Vec3>> {
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
