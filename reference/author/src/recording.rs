//! What only the reference can say: it is graded like any submission, and asked over the same pipe.

use std::io;
use std::time::Duration;

use glam::Vec3;
use grader::probe::{Budget, Fault};
use protocol::{Answer, ElementOutcome, Question};

use crate::proof::sources::{ReadError, Sources, read};
use crate::proof::workbench::{BuiltSolution, Workbench, WorkbenchError};

/// The scene of the radiance item, from the workspace's root.
const SCENE: &str = "scenes/cornell-box.json";

/// For a picture.
const BUDGET: Budget = Budget {
    cpu: Duration::from_secs(60),
};

/// A question and the reference's picture for it.
#[derive(Clone, Debug)]
pub struct RecordedPicture {
    /// What was asked.
    pub question: Question,
    /// Linear red, green and blue, row by row from the bottom.
    pub pixels: Vec<Vec3>,
}

/// Why nothing was recorded.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The scene or the reference can not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The reference can not be built.
    #[error("the reference: {0}")]
    Build(#[from] WorkbenchError),
    /// The probe can not be started.
    #[error("can not start the reference's probe: {0}")]
    Start(#[from] io::Error),
    /// The probe did not answer.
    #[error("the reference did not answer: {0:?}")]
    Fault(Fault),
    /// The answer is not a picture.
    #[error("the reference did not draw the picture: {0}")]
    UnexpectedAnswer(String),
}

/// The reference, ready to draw pictures of the Cornell box.
#[derive(Debug)]
pub struct Recorder {
    scene: String,
    sources: Sources,
    reference: BuiltSolution,
}

impl Recorder {
    /// Builds the reference.
    pub fn open(workbench: &Workbench) -> Result<Self, RecordingError> {
        let scene = read(&workbench.root().join(SCENE))?;
        let sources = Sources::reference(workbench.root())?;
        let reference = workbench.build(&sources, "reference")?;
        Ok(Recorder {
            scene,
            sources,
            reference,
        })
    }

    /// The reference's files.
    pub fn reference(&self) -> &Sources {
        &self.sources
    }

    /// The reference's answer to a question about the Cornell box, whose text is told to `question`.
    pub fn record_cornell_box(
        &self,
        question: impl FnOnce(String) -> Question,
    ) -> Result<RecordedPicture, RecordingError> {
        let question = question(self.scene.clone());
        let mut probe = self.reference.launcher().start(BUDGET)?;
        let answers = probe
            .ask([&question], BUDGET)
            .map_err(RecordingError::Fault)?;
        match answers.into_iter().next() {
            Some(Answer::Picture(ElementOutcome::Value(pixels))) => {
                Ok(RecordedPicture { question, pixels })
            }
            Some(Answer::Picture(ElementOutcome::Panicked(panic))) => {
                Err(RecordingError::UnexpectedAnswer(panic.message))
            }
            other => Err(RecordingError::UnexpectedAnswer(format!("{other:?}"))),
        }
    }
}
