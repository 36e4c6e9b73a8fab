//! What staff uploads to a platform: the grader, all that it needs, and the platform's own scripts.
//!
//! It is made of what students get ([`crate::bundle`]), so that both grade alike.

mod classroom50;
mod gradescope;
pub mod trial;

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use grader::exam_file::ExamError;
use grader::policy::{self, Policy, PolicyError};

use crate::bundle::crates::CratesError;
use crate::bundle::folders::FoldersError;
use crate::bundle::{Bundle, BundleError, archive};
use crate::exams::ExamGenerationError;

/// Where submissions are graded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Platform {
    /// A zip to upload as the assignment's autograder.
    Gradescope,
    /// A folder for the assignment's autograder in the classroom's repository.
    Classroom50,
    /// A template repository that grades every push.
    Github,
}

/// What only this course decides.
#[derive(Clone, Debug)]
pub struct Course {
    /// The final exam's text, where the platform can keep it from students.
    pub exam: Option<String>,
    /// The policy's text.
    pub policy: String,
}

/// There is no package.
#[derive(Debug, thiserror::Error)]
pub enum PackageError {
    /// Not even one for students.
    #[error(transparent)]
    Bundle(#[from] BundleError),
    /// The reference can not be read.
    #[error(transparent)]
    Folders(#[from] FoldersError),
    /// The crates that it is built with are not at hand.
    #[error(transparent)]
    Crates(#[from] CratesError),
    /// The archive in it can not be made.
    #[error("can not make the archive: {0}")]
    Zip(#[from] zip::result::ZipError),
    /// There is no exam of this seed.
    #[error(transparent)]
    Exam(#[from] ExamGenerationError),
    /// The exam's file is none.
    #[error(transparent)]
    ExamFile(#[from] ExamError),
    /// The policy is none.
    #[error(transparent)]
    Policy(#[from] PolicyError),
    /// A file of the course's can not be read.
    #[error("can not read {}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: std::io::Error,
    },
    /// Gradescope alone keeps an exam secret.
    #[error("{0} is read by students: only a package for gradescope can hold a final exam")]
    ExamNotSecret(&'static str),
    /// Without one, what counts would be what students have.
    #[error(
        "name the final exam: --exam-seed S, a long number that nobody guesses, or --exam FILE"
    )]
    MissingExam,
}

impl Course {
    /// From the exam and the policy that the command line names.
    pub fn new(
        seed: Option<u64>,
        exam: Option<&Path>,
        policy: Option<&Path>,
    ) -> Result<Self, PackageError> {
        let exam = match (seed, exam) {
            (Some(seed), _) => Some(crate::exams::final_exam_text(seed)?),
            (None, Some(path)) => {
                grader::exam_file::load(Some(path))?;
                Some(read(path)?)
            }
            (None, None) => None,
        };
        let policy = match policy {
            Some(path) => {
                Policy::read(path)?;
                read(path)?
            }
            None => policy::DEFAULT.to_owned(),
        };
        Ok(Course { exam, policy })
    }
}

fn read(path: &Path) -> Result<String, PackageError> {
    std::fs::read_to_string(path).map_err(|source| PackageError::Io {
        path: path.to_owned(),
        source,
    })
}

/// The files of a platform's package, from the workspace at `root`.
pub fn collect(root: &Path, platform: Platform, course: Course) -> Result<Bundle, PackageError> {
    match (platform, course.exam) {
        (Platform::Gradescope, Some(exam)) => gradescope::package(root, &exam, &course.policy),
        (Platform::Gradescope, None) => Err(PackageError::MissingExam),
        (Platform::Classroom50, None) => classroom50::package(root, &course.policy),
        (Platform::Github, None) => Ok(Bundle::collect(root, None)?),
        (Platform::Classroom50, Some(_)) => {
            Err(PackageError::ExamNotSecret("classroom50's folder"))
        }
        (Platform::Github, Some(_)) => Err(PackageError::ExamNotSecret("a template repository")),
    }
}

/// What the grader needs of what students get: no book, no scenes, no workflow.
fn grader_files(students: &Bundle) -> impl Iterator<Item = (&str, &Vec<u8>)> {
    const LEFT_OUT: [&str; 4] = ["handout/", "scenes/", ".github/", "README.md"];
    let files = students.files.iter();
    let files = files.map(|(path, contents)| (path.as_str(), contents));
    files.filter(|(path, _)| !LEFT_OUT.iter().any(|left_out| path.starts_with(left_out)))
}

/// The name of a file in the package's copy of the project.
fn package_path(path: &str) -> String {
    format!("{}/{path}", archive::TOP_FOLDER)
}
