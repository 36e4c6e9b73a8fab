//! What only the reference can say: it is graded like any submission, and asked over the same pipe.

use std::fs;
use std::io;
use std::path::PathBuf;
use std::time::Duration;

use glam::Vec3;
use grader::ask::{Budget, Fault, Launcher};
use grader::build::{BuildError, Builder};
use grader::submission::{NoSubmission, Submission};
use grader::workspace::{NoWorkspace, Workspace};
use protocol::{Answer, Outcome, Question};

/// The scene of the radiance item, from the workspace's root.
const SCENE: &str = "scenes/cornell-box.json";

/// A question and the reference's picture for it.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// What was asked.
    pub question: Question,
    /// Linear red, green and blue, row by row from the bottom.
    pub pixels: Vec<Vec3>,
}

/// Why nothing was recorded.
#[derive(Debug, thiserror::Error)]
pub enum NotRecorded {
    /// There is no project around.
    #[error(transparent)]
    Workspace(#[from] NoWorkspace),
    /// The scene can not be read.
    #[error("can not read {}: {source}", path.display())]
    Scene {
        /// Its file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The reference's files can not be read.
    #[error("the reference: {0}")]
    Submission(#[from] NoSubmission),
    /// The grader can not build.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The reference does not compile.
    #[error("the reference does not compile: see `cargo check -p reference`")]
    NotCompiled,
    /// The probe can not be started.
    #[error("can not start the reference's probe: {0}")]
    Start(io::Error),
    /// The probe did not answer.
    #[error("the reference did not answer: {0:?}")]
    Fault(Fault),
    /// The answer is not a picture.
    #[error("the reference did not draw the picture: {0}")]
    NoPicture(String),
}

/// The reference's answer to a question about the Cornell box.
pub fn cornell_box(question: impl FnOnce(String) -> Question) -> Result<Recorded, NotRecorded> {
    let workspace = Workspace::find()?;
    let path = workspace.root().join(SCENE);
    let scene = fs::read_to_string(&path).map_err(|source| NotRecorded::Scene { path, source })?;
    let question = question(scene);

    let reference = Submission::collect(&workspace.root().join("reference"))?;
    let build = Builder::prepare(&workspace)?.build(&reference)?;
    if !build.not_compiled.is_empty() {
        return Err(NotRecorded::NotCompiled);
    }
    let program = build.probe.clone().ok_or(NotRecorded::NotCompiled)?;
    let budget = Budget {
        cpu: Duration::from_secs(60),
    };
    let launcher = Launcher { program };
    let mut probe = launcher.start(budget).map_err(NotRecorded::Start)?;
    let answers = probe.ask([&question], budget).map_err(NotRecorded::Fault)?;
    match answers.into_iter().next() {
        Some(Answer::Picture(Outcome::Value(pixels))) => Ok(Recorded { question, pixels }),
        Some(Answer::Picture(Outcome::Panicked(panic))) => {
            Err(NotRecorded::NoPicture(panic.message))
        }
        other => Err(NotRecorded::NoPicture(format!("{other:?}"))),
    }
}
