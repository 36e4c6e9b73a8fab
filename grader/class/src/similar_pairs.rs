//! Reads which submissions a similarity checker found similar. The checker compared the numbered
//! files that `--similarity-input` wrote, and the key next to their folder says whose they are.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use grader::files;

use crate::cli::Lists;
use crate::error::Error;
use crate::paths::beside;
use crate::table::Table;

/// Two similar files. Nothing is concluded or graded from them.
#[derive(Clone, Debug, PartialEq)]
pub struct SimilarPair {
    /// The checker's similarity, from 0 to 1.
    pub similarity: f64,
    /// The files, which are of the same task.
    pub files: [ComparedFile; 2],
}

/// A file that the checker compared.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ComparedFile {
    /// The task file's name, without its extension.
    pub task: String,
    /// The submission's id as a safe cell, from the key.
    pub submission: String,
    /// The path of the students' own lines.
    pub path: PathBuf,
    /// The students' own lines.
    pub lines: String,
}

/// Dolos's columns in `pairs.csv`, and JPlag's in the `results.csv` of `--csv-export`: both names
/// and the similarity.
const COLUMNS: [[&str; 3]; 2] = [
    ["leftFilePath", "rightFilePath", "similarity"],
    ["submissionName1", "submissionName2", "averageSimilarity"],
];
/// Checkers list every pair of a class, but nobody would compare more than these.
const MAX_PAIRS: usize = 20;

/// Reads the most similar pairs from all results that `--similar` names.
pub fn read_similar_pairs(lists: &Lists) -> Result<Vec<SimilarPair>, Error> {
    let mut pairs: Vec<SimilarPair> = Vec::new();
    for [folder, results] in lists.similar.as_chunks().0 {
        pairs.extend(read_results(folder, results)?);
    }
    pairs.sort_by(|one, other| other.similarity.total_cmp(&one.similarity));
    pairs.truncate(MAX_PAIRS);
    for file in pairs.iter_mut().flat_map(|pair| &mut pair.files) {
        file.lines = files::read_to_string(&file.path).map_err(Error::user)?;
    }
    Ok(pairs)
}

/// Reads a file with results, without the students' lines. Leaves out pairs of different tasks.
fn read_results(folder: &Path, results: &Path) -> Result<Vec<SimilarPair>, Error> {
    let key = read_key(folder)?;
    let (table, shown) = (Table::read(results)?, results.display());
    let is_known = |names: &[&str; 3]| names.iter().all(|name| table.column(name).is_some());
    let columns = COLUMNS.into_iter().find(is_known).ok_or_else(|| {
        Error::user(format!(
            "{shown} is neither Dolos's pairs.csv nor JPlag's results.csv: pass one of these"
        ))
    })?;
    let mut pairs = Vec::new();
    for (number, row) in table.numbered_rows() {
        let cell = |name: &str| table.column(name).map_or("", |column| row[column].trim());
        let [one, other, similarity] = columns.map(cell);
        let error = |problem: &str| Error::user(format!("{shown}, row {number}: {problem}"));
        let files = [one, other].map(|name| find_compared(name, folder, results, &key));
        let [Some(left), Some(right)] = files else {
            return Err(error(&format!(
                "{one:?} or {other:?} is not a file of a task in {}: pass the folder that was \
                 compared, and put the results of one task into a folder such as sphere",
                folder.display()
            )));
        };
        let parsed = similarity.parse().ok();
        let Some(similarity) = parsed.filter(|number| (0.0..=1.0).contains(number)) else {
            return Err(error("similarity is not from 0 to 1: export it again"));
        };
        if left.task == right.task {
            let files = [left, right];
            pairs.push(SimilarPair { similarity, files });
        }
    }
    Ok(pairs)
}

/// The ids of the submissions, by number. Spreadsheets drop the zeros before a number.
type Key = HashMap<u32, String>;

/// Reads the key next to a folder of compared files.
fn read_key(folder: &Path) -> Result<Key, Error> {
    let path = beside(folder, "key.csv");
    let table = Table::read(&path)
        .map_err(|error| Error::user(format!("{error}; pass the folder of --similarity-input")))?;
    let entry = |row: &Vec<String>| Some((row.first()?.parse().ok()?, row.get(1)?.clone()));
    Ok(table.rows.iter().filter_map(entry).collect())
}

/// Finds a file by the checker's name for it. If that lacks the task, the results' folder names it.
fn find_compared(name: &str, folder: &Path, results: &Path, key: &Key) -> Option<ComparedFile> {
    let name = PathBuf::from(name.replace('\\', "/"));
    let number = name.file_stem()?.to_str()?.parse().ok()?;
    let submission = key.get(&number)?.clone();
    let parent = |path: &Path| Some(path.parent()?.file_name()?.to_str()?.to_owned());
    let tasks = [parent(&name), parent(results)].into_iter().flatten();
    let files = tasks.filter_map(|task| Some((folder.join(&task).join(name.file_name()?), task)));
    let (path, task) = files.into_iter().find(|(path, _)| path.is_file())?;
    Some(ComparedFile {
        task,
        submission,
        path,
        lines: String::new(),
    })
}
