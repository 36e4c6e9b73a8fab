//! Autograder packages that instructors upload to a platform: the grader, everything it needs and
//! the platform's scripts.
//!
//! A package is made from the students' bundle ([`crate::bundle`]), so that submissions are graded
//! the same way on the platform as on students' computers.

mod classroom50;
mod gradescope;
pub mod trial;

use std::path::Path;

use anyhow::{Result, bail};
use clap::ValueEnum;
use grader::exam_source::ExamSource;
use grader::files;
use grader::handed_out::HandedOut;
use grader::policy::{self, Policy};

use crate::authoring::Authoring;
use crate::bundle::{Bundle, BundleOptions, archive};
use crate::light::LightFiles;

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

/// The course's own choices: its final exam, its policy, and whether students get part two solved.
#[derive(Clone, Debug)]
pub struct CourseFiles {
    /// The text of the final exam. `None` for a platform that cannot hide it from students.
    pub exam: Option<String>,
    /// The text of the policy file.
    pub policy: String,
    /// Part two's files in the package.
    pub light: LightFiles,
}

impl CourseFiles {
    /// Generates the exam from a seed or reads it from a file, if either is given. Reads the policy
    /// file, or uses the default policy.
    pub fn new(
        authoring: &'static Authoring,
        seed: Option<u64>,
        exam: Option<&Path>,
        policy: Option<&Path>,
        light: LightFiles,
    ) -> Result<Self> {
        let exam = match (seed, exam) {
            (Some(seed), _) => Some(crate::exams::final_exam_text(authoring, seed)?),
            (None, Some(path)) => {
                ExamSource::File(path.to_owned()).load(authoring.handed_out)?;
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
        Ok(CourseFiles {
            exam,
            policy,
            light,
        })
    }
}

/// Collects the files that make up an assignment's package for a platform. They come from the
/// workspace at `root`.
pub fn collect(
    root: &Path,
    handed_out: &HandedOut,
    platform: Platform,
    course: CourseFiles,
) -> Result<Bundle> {
    const NO_FINAL_EXAM: &str = "so it must not contain a final exam: leave out --exam and \
                                 --exam-seed, or create a package for gradescope";
    let students = || {
        let light = course.light;
        Bundle::collect(root, handed_out, BundleOptions { book: None, light })
    };
    match (platform, course.exam) {
        (Platform::Gradescope, Some(exam)) => {
            gradescope::package(root, handed_out, &students()?, &exam, &course.policy)
        }
        (Platform::Gradescope, None) => bail!(
            "the final exam is missing: add --exam-seed S, a long number that is hard to guess, or \
             --exam FILE"
        ),
        (Platform::Classroom50, None) => {
            classroom50::package(&students()?, &course.policy, handed_out)
        }
        (Platform::Github, None) => students(),
        (Platform::Classroom50, Some(_)) => {
            bail!("students can read classroom50's folder, {NO_FINAL_EXAM}")
        }
        (Platform::Github, Some(_)) => {
            bail!("students can read a template repository, {NO_FINAL_EXAM}")
        }
    }
}

/// Returns the files of the students' bundle that the grader needs: all except the handout, the
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
