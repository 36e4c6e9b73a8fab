//! Reads an exam: the practice exam embedded in this program, or an exam from a file or standard
//! input.

use std::borrow::Cow;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use judging::content_hash::file_hash;
use judging::exam_file::{self, ExamFile};

use crate::error::Error;
use crate::handed_out::HandedOut;
use crate::machine::files::{self, AtPath};

/// Maximum size of an exam file, in bytes. The committed exams are about 3,000,000 bytes long.
const MAX_FILE_BYTES: u64 = 64 << 20;

/// The id of the practice exam. Students have this exam, including its answer keys, and can run it
/// themselves.
pub const PRACTICE_ID: &str = "practice";
/// The name of the practice exam's file, for error messages.
const PRACTICE_FILE: &str = "practice.json";

/// The action named in error messages if the exam cannot be read.
const ACTION: &str = "read the exam";

/// The source of an exam.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum ExamSource {
    /// The practice exam.
    #[default]
    Practice,
    /// Standard input, which can only be read once.
    StandardInput,
    /// The exam file at this path.
    File(PathBuf),
}

impl ExamSource {
    /// Returns the source that the value of `--exam` selects: standard input if it is `-`, the
    /// practice exam if it is missing, and otherwise a file.
    pub fn from_option(path: Option<PathBuf>) -> Self {
        match path {
            None => ExamSource::Practice,
            Some(path) if path.as_os_str() == "-" => ExamSource::StandardInput,
            Some(path) => ExamSource::File(path),
        }
    }

    /// Returns the value of `--exam` for this source, or `None` for the practice exam.
    pub fn option(&self) -> Option<&Path> {
        match self {
            ExamSource::Practice => None,
            ExamSource::StandardInput => Some(Path::new("-")),
            ExamSource::File(path) => Some(path),
        }
    }

    /// Returns the assignment named on the command line or, failing that, the assignment of the
    /// exam file. If there is neither, or if the file's assignment is unknown, returns the default
    /// assignment.
    pub fn assignment(&self, option: Option<&'static HandedOut>) -> &'static HandedOut {
        let of_file = || {
            let ExamSource::File(path) = self else {
                return None;
            };
            let bytes = read(path, files::open(path).ok()?).ok()?;
            HandedOut::find(&exam_file::assignment_id(&bytes)?).ok()
        };
        option.or_else(of_file).unwrap_or_default()
    }

    /// Reads the exam and validates it for this assignment.
    pub fn load(&self, handed_out: &HandedOut) -> Result<ExamFile, Error> {
        let name = self.option().unwrap_or(Path::new(PRACTICE_FILE));
        let bytes = self.bytes(handed_out)?;
        exam_file::parse(name, &bytes, handed_out.assignment).map_err(Error::user)
    }

    /// Returns the hash of the exam's bytes, which need not be a valid exam.
    pub fn hash(&self, handed_out: &HandedOut) -> Result<String, Error> {
        Ok(file_hash(&self.bytes(handed_out)?))
    }

    fn bytes(&self, handed_out: &HandedOut) -> Result<Cow<'static, [u8]>, Error> {
        Ok(match self {
            ExamSource::Practice => Cow::Borrowed(handed_out.practice_exam.as_bytes()),
            ExamSource::StandardInput => Cow::Owned(read(Path::new("-"), io::stdin())?),
            ExamSource::File(path) => {
                let file = files::open(path).map_err(|error| error.of_action(ACTION));
                Cow::Owned(read(path, file.map_err(Error::user)?)?)
            }
        })
    }
}

fn read(path: &Path, input: impl Read) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    let limited = &mut input.take(MAX_FILE_BYTES + 1);
    let read = limited.read_to_end(&mut bytes).at(ACTION, path);
    read.map_err(Error::user)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        let path = path.display();
        return Err(Error::User(format!(
            "the exam {path} is larger than 64 MiB"
        )));
    }
    Ok(bytes)
}
