//! Autograder packages that instructors upload to a platform: the grader, everything that it needs,
//! and the platform's scripts.
//!
//! A package is made from the students' bundle ([`crate::bundle`]), so that both grade the same
//! way.

mod classroom50;
mod gradescope;
pub mod trial;

use std::path::Path;

use clap::ValueEnum;
use grader::exam_source::{ExamSource, ExamSourceError};
use grader::files::{self, PathError};
use grader::handed_out::HandedOut;
use grader::policy::{self, Policy, PolicyError};

use crate::bundle::crates::CratesError;
use crate::bundle::folders::FoldersError;
use crate::bundle::{Bundle, BundleError, archive};
use crate::exams::ExamGenerationError;

/// A platform that grades submissions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Platform {
    /// Gradescope: a zip file to upload as the assignment's autograder.
    Gradescope,
    /// classroom50: a folder for the classroom's repository.
    Classroom50,
    /// GitHub: a template repository whose workflow grades every push.
    Github,
}

/// The choices of a course: its final exam and its policy.
#[derive(Clone, Debug)]
pub struct Course {
    /// The text of the final exam. `None` for a platform that cannot hide it from students.
    pub exam: Option<String>,
    /// The text of the policy file.
    pub policy: String,
}

/// The reason why a package cannot be collected.
#[derive(Debug, thiserror::Error)]
pub enum PackageError {
    /// The students' bundle cannot be collected.
    #[error(transparent)]
    Bundle(#[from] BundleError),
    /// The reference cannot be read.
    #[error(transparent)]
    Folders(#[from] FoldersError),
    /// The crates of the lock file cannot be read.
    #[error(transparent)]
    Crates(#[from] CratesError),
    /// The archive in the package cannot be created.
    #[error("cannot create the archive: {0}")]
    Zip(#[from] zip::result::ZipError),
    /// The exam of the seed cannot be generated.
    #[error(transparent)]
    Exam(#[from] ExamGenerationError),
    /// The exam file is invalid.
    #[error(transparent)]
    ExamFile(#[from] ExamSourceError),
    /// The policy file is invalid.
    #[error(transparent)]
    Policy(#[from] PolicyError),
    /// The exam file or policy file cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// A final exam was given for a platform that would show it to students.
    #[error("students can read {0}: only a package for gradescope can contain a final exam")]
    ExamNotSecret(&'static str),
    /// No final exam was given for Gradescope. The practice exam, which students have, is never
    /// used instead.
    #[error(
        "the final exam is missing: add --exam-seed S, a long number that is hard to guess, or \
         --exam FILE"
    )]
    MissingExam,
}

impl Course {
    /// Generates the exam from a seed or reads its file, if either is given. Reads the policy file,
    /// or uses the default policy.
    pub fn new(
        handed_out: &HandedOut,
        seed: Option<u64>,
        exam: Option<&Path>,
        policy: Option<&Path>,
    ) -> Result<Self, PackageError> {
        let exam = match (seed, exam) {
            (Some(seed), _) => Some(crate::exams::final_exam_text(seed)?),
            (None, Some(path)) => {
                ExamSource::File(path.to_owned()).load(handed_out)?;
                Some(files::read_to_string(path)?)
            }
            (None, None) => None,
        };
        let policy = match policy {
            Some(path) => {
                Policy::read(path)?;
                Policy::read_text(path)?
            }
            None => policy::DEFAULT.to_owned(),
        };
        Ok(Course { exam, policy })
    }
}

/// Collects the files of an assignment's package for a platform from the workspace at `root`.
pub fn collect(
    root: &Path,
    handed_out: &HandedOut,
    platform: Platform,
    course: Course,
) -> Result<Bundle, PackageError> {
    match (platform, course.exam) {
        (Platform::Gradescope, Some(exam)) => {
            gradescope::package(root, handed_out, &exam, &course.policy)
        }
        (Platform::Gradescope, None) => Err(PackageError::MissingExam),
        (Platform::Classroom50, None) => classroom50::package(root, handed_out, &course.policy),
        (Platform::Github, None) => Ok(Bundle::collect(root, handed_out, None)?),
        (Platform::Classroom50, Some(_)) => {
            Err(PackageError::ExamNotSecret("classroom50's folder"))
        }
        (Platform::Github, Some(_)) => Err(PackageError::ExamNotSecret("a template repository")),
    }
}

/// Returns the files of the students' bundle that the grader needs: all but the handout, the
/// scenes, the workflow and the README.
fn grader_files(students: &Bundle) -> impl Iterator<Item = (&str, &Vec<u8>)> {
    const EXCLUDED: [&str; 4] = ["handout/", "scenes/", ".github/", "README.md"];
    let files = students.files.iter();
    let files = files.map(|(path, contents)| (path.as_str(), contents));
    files.filter(|(path, _)| !EXCLUDED.iter().any(|start| path.starts_with(start)))
}

/// Returns the path of a file in the package's copy of the project.
fn package_path(path: &str) -> String {
    format!("{}/{path}", archive::TOP_FOLDER)
}
