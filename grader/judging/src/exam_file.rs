//! Reading exam files: from disk, from standard input, or the practice exam that this program was
//! built with. A file that can not be asked is refused before anything is.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use glam::UVec2;
use protocol::Question;
use serde::Serialize;

use crate::exam::{Exam, Item, Key};

/// The version of the format that is read.
const SCHEMA_VERSION: u32 = 1;
/// The most pixels along one side of a picture; ours have 64.
const MAX_PICTURE_SIDE: u32 = 4096;
/// The longest exam file, in bytes; ours have about 3,000,000.
const MAX_FILE_BYTES: u64 = 64 << 20;

const PRACTICE: &str = include_str!("../../exams/practice.json");

/// An exam, and the name of its bytes.
#[derive(Clone, Debug)]
pub struct ExamFile {
    /// What is asked.
    pub exam: Exam,
    /// Of the file's bytes, in hexadecimal.
    pub hash: String,
}

/// Which exam this is.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExamName {
    /// Such as `practice`.
    pub id: String,
    /// Of the exam file's bytes.
    pub hash: String,
}

impl ExamFile {
    /// What the score says of it.
    pub fn name(&self) -> ExamName {
        ExamName {
            id: self.exam.id.clone(),
            hash: self.hash.clone(),
        }
    }
}

/// Why an exam can not be used.
#[derive(Debug, thiserror::Error)]
pub enum ExamError {
    /// The file can not be read.
    #[error("can not read the exam {path}: {source}")]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// The file is longer than any exam.
    #[error("the exam {0} is longer than 64 MiB")]
    TooLong(PathBuf),
    /// The file is not JSON, or not an exam.
    #[error("the exam {path}, {source}; `cargo author exam --seed S` writes a good one")]
    Json {
        /// Which.
        path: PathBuf,
        /// Line and column, and what is wrong there.
        source: serde_json::Error,
    },
    /// The file is an exam that can not be asked.
    #[error("the exam {path}: {problem}; `cargo author exam --seed S` writes a good one")]
    Invalid {
        /// Which.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
}

/// Reads the exam at `path`, from standard input for `-`; without a path, the practice exam.
pub fn load(path: Option<&Path>) -> Result<ExamFile, ExamError> {
    match path {
        None => parse(Path::new("practice.json"), PRACTICE.as_bytes()),
        Some(path) => parse(path, &read(path)?),
    }
}

/// The hash of the exam at `path`, which need not be a good one; without a path, of the practice exam.
pub fn hash(path: Option<&Path>) -> Result<String, ExamError> {
    Ok(match path {
        None => hash_of(PRACTICE.as_bytes()),
        Some(path) => hash_of(&read(path)?),
    })
}

fn hash_of(bytes: &[u8]) -> String {
    blake2b_simd::blake2b(bytes).to_hex()[..32].to_owned()
}

fn read(path: &Path) -> Result<Vec<u8>, ExamError> {
    let mut bytes = Vec::new();
    let read = match path.to_str() {
        Some("-") => io::stdin().take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes),
        Some(_) | None => fs::File::open(path)
            .and_then(|file| file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)),
    };
    read.map_err(|source| ExamError::Io {
        path: path.to_owned(),
        source,
    })?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(ExamError::TooLong(path.to_owned()));
    }
    Ok(bytes)
}

/// The exam in a file's bytes; `path` is for the error.
pub fn parse(path: &Path, bytes: &[u8]) -> Result<ExamFile, ExamError> {
    let exam: Exam = serde_json::from_slice(bytes).map_err(|source| ExamError::Json {
        path: path.to_owned(),
        source,
    })?;
    if let Some(problem) = problem(&exam) {
        return Err(ExamError::Invalid {
            path: path.to_owned(),
            problem,
        });
    }
    Ok(ExamFile {
        exam,
        hash: hash_of(bytes),
    })
}

/// What is wrong with an exam, if anything is.
fn problem(exam: &Exam) -> Option<String> {
    if exam.schema != SCHEMA_VERSION {
        return Some(format!(
            "its format is version {}, and this grader reads version {SCHEMA_VERSION}",
            exam.schema
        ));
    }
    if exam.items.is_empty() {
        return Some("it has no items".to_owned());
    }
    let mut earlier = BTreeSet::new();
    for item in &exam.items {
        let problem = item_problem(item, &earlier);
        let problem = problem.or_else(|| signatures_problem(item, exam.mistakes.len()));
        if let Some(problem) = problem {
            return Some(format!("item {}: {problem}", item.id));
        }
        earlier.insert(item.id.as_str());
    }
    None
}

fn item_problem(item: &Item, earlier: &BTreeSet<&str>) -> Option<String> {
    if !item.id.starts_with(&format!("{}.", item.task)) {
        return Some(format!("its id does not begin with `{}.`", item.task));
    }
    if earlier.contains(item.id.as_str()) {
        return Some("there is another of this id".to_owned());
    }
    if let Some(needed) = item.needs.iter().find(|id| !earlier.contains(id.as_str())) {
        return Some(format!(
            "it needs `{needed}`, which does not come before it"
        ));
    }
    if item.points == 0 || item.questions.is_empty() {
        return Some("it has no points, or no questions".to_owned());
    }
    let misfit = |(number, asked): (usize, &crate::exam::ExamQuestion)| {
        if let Some(film) =
            film(&asked.question).filter(|film| film.max_element() > MAX_PICTURE_SIDE)
        {
            let UVec2 { x, y } = film;
            return Some(format!(
                "question {number} asks for {x} x {y} pixels, and {MAX_PICTURE_SIDE} is the most"
            ));
        }
        let (fits, keys) = match_key(&asked.question, &asked.key);
        let count = asked.question.count();
        match (fits, keys == count) {
            (false, _) => Some(format!("question {number} and its key are of two kinds")),
            (true, false) => Some(format!(
                "question {number} asks {count} times, and its key answers {keys}"
            )),
            (true, true) => {
                let problem = asked.drawing_data.problem(&asked.question)?;
                Some(format!("question {number}: {problem}"))
            }
        }
    };
    (1..).zip(&item.questions).find_map(misfit)
}

/// The pixels that are asked for, where all of a picture is.
fn film(question: &Question) -> Option<UVec2> {
    use protocol::{Rays, Samples};

    match question {
        Question::Camera { camera, samples } => match samples {
            Samples::EveryPixel => Some(camera.film),
            Samples::List(_) => None,
        },
        Question::Shapes { rays, .. }
        | Question::Traverse { rays, .. }
        | Question::BuildAndTraverse { rays, .. } => match rays {
            Rays::View(view) => Some(view.film),
            Rays::List(_) => None,
        },
        Question::Radiance { film, .. } => Some(*film),
        Question::BBox { .. } | Question::Build { .. } | Question::Done => None,
    }
}

/// What is wrong with what an item tells of mistakes, if anything is.
fn signatures_problem(item: &Item, mistakes: usize) -> Option<String> {
    let count: usize = item
        .questions
        .iter()
        .map(|asked| asked.question.count())
        .sum();
    let tells = &item.signatures;
    let too_far = tells
        .elements
        .iter()
        .any(|element| *element as usize >= count);
    let of_none = tells.mistake_answers.iter().any(|told| {
        let answers = told.answers.iter();
        told.mistakes
            .iter()
            .any(|mistake| *mistake as usize >= mistakes)
            || answers
                .map(|(place, _)| *place as usize)
                .any(|place| place >= tells.elements.len())
    });
    (too_far || of_none || tells.correct_answers.len() != tells.elements.len())
        .then(|| "it tells of mistakes or elements that are not there".to_owned())
}

/// Whether a key is one to this question, and how many elements it answers.
fn match_key(question: &Question, key: &Key) -> (bool, usize) {
    use protocol::Rays;

    match (key, question) {
        (Key::Rays { directions, .. }, Question::Camera { .. }) => (true, directions.len()),
        (
            Key::Hits { hits, .. },
            Question::Shapes { .. } | Question::Traverse { .. } | Question::BuildAndTraverse { .. },
        ) => (true, hits.len()),
        (
            Key::FirstHits {
                hits,
                alternatives: also,
            },
            Question::Shapes { rays, .. }
            | Question::Traverse { rays, .. }
            | Question::BuildAndTraverse { rays, .. },
        ) => {
            let inside = also.iter().all(|(place, _)| (*place as usize) < hits.len());
            (matches!(rays, Rays::View(_)) && inside, hits.len())
        }
        (Key::Spans { spans }, Question::BBox { .. }) => (true, spans.len()),
        (Key::Tree { .. }, Question::Build { .. }) => (true, 1),
        (Key::Radiance { pixels, .. }, Question::Radiance { film, .. }) => {
            let all = film.x as usize * film.y as usize;
            (pixels.len() == all, 1)
        }
        (
            Key::Rays { .. }
            | Key::Hits { .. }
            | Key::FirstHits { .. }
            | Key::Spans { .. }
            | Key::Tree { .. }
            | Key::Radiance { .. },
            _,
        ) => (false, 0),
    }
}
